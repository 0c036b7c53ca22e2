#pragma once

#include <vector>

#include "core/element/beam_rule.hpp"
#include "core/element/moving_kinematics.hpp"
#include "core/element/rest_element.hpp"

namespace vlbeam {

/// Shape functions at the points of a rule for one set of weights; with frozen weights they hold until the next
/// length-control event, so that the rational element then costs what the polynomial one costs.
struct ShapeTabulation {
  BeamRule rule;
  std::vector<ShapeTable<double>> shape;

  ShapeTabulation() = default;
  ShapeTabulation(const BeamRule& rule_, const Weights<double>& w) : rule(rule_) {
    for (const auto& point : rule) {
      shape.push_back(w == unit_weights ? hermite_shape(point.u) : rational_shape(w, point.u));
    }
  }
};

/// A quadrature point of a variable-length element.
template <class Real>
struct ReferencePoint {
  double u, share;     ///< its parameter, and its weight over the element's length
  Real weight;         ///< [m]
  Real weight_rate;    ///< rate of `weight` [m/s]
  Real mesh_velocity;  ///< of the point along the beam [m/s]
  Feels feels;         ///< what of the beam
};

/// Calls `visit(point, motion, rest)` at the quadrature points of a variable-length element: a ReferencePoint, what
/// `evaluate(u, shape functions)` gives there, and the RestStrain by `rest` (null without a rest shape). `reshaped`
/// says that the shape functions are not those of the table.
template <class Real, int D, MovingEnds Ends, class Rest, class Evaluate, class Visit>
[[gnu::always_inline]] inline void for_each_point(const MovingKinematics<Real, D, Ends>& kinematics,
                                                  const ShapeTabulation& table, bool reshaped, const Rest* rest,
                                                  const Evaluate& evaluate, const Visit& visit) {
  const auto point_at = [&](std::size_t g) {
    const auto [u, w, feels] = table.rule[g];
    return ReferencePoint<Real>{
        u, w, kinematics.length() * w, kinematics.length_rate() * w, kinematics.mesh_velocity(u), feels};
  };
  if (rest == nullptr) {
    for (std::size_t g = 0; g < table.rule.size(); ++g) {
      const ReferencePoint<Real> point = point_at(g);
      const auto motion = reshaped ? evaluate(point.u, rational_shape(kinematics.weights(), Real(point.u)))
                                   : evaluate(point.u, table.shape[g]);
      visit(point, motion, static_cast<const RestStrain<Real>*>(nullptr));
    }
    return;
  }
  if constexpr (D > 1) {  // a single field has no rest shape
    for (std::size_t g = 0; g < table.rule.size(); ++g) {
      const ReferencePoint<Real> point = point_at(g);
      const ShapeTable<Real> shape = rational_shape(kinematics.weights(), Real(point.u));
      const RestStrain<Real> strain = rest->at(point.u, shape);
      visit(point, evaluate(point.u, shape), static_cast<const RestStrain<Real>*>(&strain));
    }
  }
}

}  // namespace vlbeam
