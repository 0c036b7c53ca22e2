#pragma once

#include <vector>

#include "core/element/moving_kinematics.hpp"
#include "core/element/quadrature.hpp"
#include "core/element/rest_curve.hpp"

namespace vlbeam {

/// Shape functions at the points of a rule for one set of weights; with frozen weights they hold until the next
/// length-control event, so that the rational element then costs what the polynomial one costs.
struct ShapeTabulation {
  QuadratureRule rule;
  std::vector<ShapeTable<double>> shape;

  ShapeTabulation() = default;
  ShapeTabulation(const QuadratureRule& rule_, const Weights<double>& w) : rule(rule_) {
    for (const auto& point : rule) {
      shape.push_back(w == unit_weights ? hermite_shape(point.u) : rational_shape(w, point.u));
    }
  }
};

/// A quadrature point of a variable-length element, at fixed shares of the interval it belongs to: the element or,
/// where the rest strains jump inside it, a piece of it. An interval's end either moves with the element's or stays.
template <class Real>
struct ReferencePoint {
  Real weight;              ///< quadrature weight times the interval's length [m]
  Real weight_rate;         ///< rate of `weight` [m/s]
  Real mesh_velocity;       ///< of the point along the beam [m/s]
  Real reach_a, reach_b;    ///< derivative of the point's material coordinate by x_A, by x_B
  double grows_a, grows_b;  ///< derivative of `weight` by -x_A, by x_B
};

/// Calls `visit(point, motion, rest)` at the quadrature points of a variable-length element: a ReferencePoint, what
/// `evaluate(u, shape functions)` gives there, and the RestStrain (null without a rest shape). `reshaped` says that the
/// shape functions are not those of the table.
template <class Real, int D, MovingEnds Ends, class Evaluate, class Visit>
[[gnu::always_inline]] inline void for_each_point(const MovingKinematics<Real, D, Ends>& kinematics,
                                                  const ShapeTabulation& table, bool reshaped,
                                                  const RestCurve<D>* shape, const Evaluate& evaluate,
                                                  const Visit& visit) {
  const auto& rate = kinematics.rates();
  if (shape == nullptr) {
    for (std::size_t g = 0; g < table.rule.size(); ++g) {
      const auto [u, w] = table.rule[g];
      const ReferencePoint<Real> point{kinematics.length() * w,
                                       kinematics.length_rate() * w,
                                       kinematics.mesh_velocity(u),
                                       Real(1 - u),
                                       Real(u),
                                       w,
                                       w};
      const auto motion =
          reshaped ? evaluate(u, rational_shape(kinematics.weights(), Real(u))) : evaluate(u, table.shape[g]);
      visit(point, motion, static_cast<const RestStrain<Real>*>(nullptr));
    }
    return;
  }
  if constexpr (D > 1) {  // a single field has no rest shape
    const auto& q = kinematics.coordinates();
    const Real inverse = Real(1) / kinematics.length();
    const int start = shape->piece_at(q.x_a);
    for (int piece = start; piece < shape->pieces(); ++piece) {
      const bool first = piece == start;
      const bool last = piece + 1 == shape->pieces() || !(Real(shape->end_of(piece)) < q.x_b);
      const Real from = first ? q.x_a : Real(shape->end_of(piece - 1)), to = last ? q.x_b : Real(shape->end_of(piece));
      const Real from_rate = first ? rate.x_a : Real(0), to_rate = last ? rate.x_b : Real(0);
      const Real length = to - from, length_rate = to_rate - from_rate;
      for (const auto& [u, w] : table.rule) {
        const Real x = from + length * u;
        const ReferencePoint<Real> point{length * w,
                                         length_rate * w,
                                         from_rate * (1 - u) + to_rate * u,
                                         Real(first ? 1 - u : 0),
                                         Real(last ? u : 0),
                                         first ? w : 0,
                                         last ? w : 0};
        const Real at = (x - q.x_a) * inverse;
        const RestStrain<Real> rest = shape->at(x, piece);
        const auto motion = evaluate(at, rational_shape(kinematics.weights(), at));
        visit(point, motion, static_cast<const RestStrain<Real>*>(&rest));
      }
      if (last) break;
    }
  }
}

}  // namespace vlbeam
