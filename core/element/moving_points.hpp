#pragma once

#include <vector>

#include "core/element/beam_rule.hpp"
#include "core/element/moving_kinematics.hpp"
#include "core/element/pack.hpp"
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

/// The same in lanes: four points that feel the same at once. Where fewer are left, the last one is repeated without
/// weight.
struct PackTabulation {
  struct Point {
    Pack u, weight;
    Feels feels;
  };
  std::vector<Point> rule;
  std::vector<ShapeTable<Pack>> shape;

  PackTabulation() = default;
  explicit PackTabulation(const ShapeTabulation& table) {
    for (std::size_t g = 0; g < table.rule.size();) {
      const Feels feels = table.rule[g].feels;
      Point point{0.0, 0.0, feels};
      ShapeTable<Pack> lanes;
      std::size_t last = g;
      for (int lane = 0; lane < Pack::width; ++lane) {
        const bool there = g < table.rule.size() && table.rule[g].feels == feels;
        if (there) last = g++;
        point.u.set(lane, table.rule[last].u);
        point.weight.set(lane, there ? table.rule[last].weight : 0);
        for (std::size_t i = 0; i < 4; ++i) {
          for (std::size_t n = 0; n < 4; ++n) lanes[i][n].set(lane, table.shape[last][i][n]);
        }
      }
      rule.push_back(point);
      shape.push_back(lanes);
    }
  }
};

/// An element's points, one by one and four at a time.
struct PointTables {
  ShapeTabulation one;
  PackTabulation four;

  PointTables() = default;
  PointTables(const BeamRule& rule, const Weights<double>& w) : one(rule, w), four(one) {}
};

/// A quadrature point of a variable-length element, or four in lanes.
template <class Real, class Parameter>
struct ReferencePoint {
  Parameter u, share;  ///< its parameter, and its weight over the element's length
  Real weight;         ///< [m]
  Real weight_rate;    ///< rate of `weight` [m/s]
  Real mesh_velocity;  ///< of the point along the beam [m/s]
  Feels feels;         ///< what of the beam
};

/// Calls `visit(point, motion, rest)` at the quadrature points of a variable-length element: a ReferencePoint, what
/// `evaluate(u, shape functions)` gives there, and the RestStrain by `rest` (null without a rest shape). `reshaped`
/// says that the shape functions are not those of the table, a ShapeTabulation or, for numbers in lanes, a
/// PackTabulation.
template <class Real, int D, MovingEnds Ends, class Table, class Rest, class Evaluate, class Visit>
[[gnu::always_inline]] inline void for_each_point(const MovingKinematics<Real, D, Ends>& kinematics, const Table& table,
                                                  bool reshaped, const Rest* rest, const Evaluate& evaluate,
                                                  const Visit& visit) {
  const auto point_at = [&](std::size_t g) {
    const auto& [u, w, feels] = table.rule[g];
    return ReferencePoint<Real, std::decay_t<decltype(u)>>{
        u, w, kinematics.length() * w, kinematics.length_rate() * w, kinematics.mesh_velocity(u), feels};
  };
  constexpr auto straight = static_cast<const RestStrain<Real>*>(nullptr);
  if constexpr (in_lanes<Real>) {  // neither reshaped nor with a rest shape
    for (std::size_t g = 0; g < table.rule.size(); ++g) {
      const auto point = point_at(g);
      visit(point, evaluate(point.u, table.shape[g]), straight);
    }
  } else if (rest == nullptr) {
    for (std::size_t g = 0; g < table.rule.size(); ++g) {
      const auto point = point_at(g);
      const auto motion = reshaped ? evaluate(point.u, rational_shape(kinematics.weights(), Real(point.u)))
                                   : evaluate(point.u, table.shape[g]);
      visit(point, motion, straight);
    }
  } else if constexpr (D > 1) {  // a single field has no rest shape
    for (std::size_t g = 0; g < table.rule.size(); ++g) {
      const auto point = point_at(g);
      const ShapeTable<Real> shape = rational_shape(kinematics.weights(), Real(point.u));
      const RestStrain<Real> strain = rest->at(point.u, shape);
      visit(point, evaluate(point.u, shape), static_cast<const RestStrain<Real>*>(&strain));
    }
  }
}

}  // namespace vlbeam
