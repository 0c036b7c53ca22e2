#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "core/element/beam_rule.hpp"
#include "core/element/moving_kinematics.hpp"
#include "core/element/rest_element.hpp"
#include "core/element/section_pieces.hpp"
#include "core/pack.hpp"

namespace vlbeam {

/// Whether a number is made of packs, one lane a point.
template <class Real>
inline constexpr bool in_packs = std::is_same_v<Real, Pack>;
/// What the parameter of a point is then.
template <class Real>
using PointParameter = std::conditional_t<in_packs<Real>, Pack, double>;

/// Four points of a rule that feel the same, or fewer: then the last one again, with weight 0.
struct PackOfPoints {
  Pack u, weight;
  ShapeTable<Pack> shape;
  Feels feels;
};

/// Shape functions at the points of a rule for one set of weights; with frozen weights they hold until the next
/// length-control event, so that the rational element then costs what the polynomial one costs.
struct ShapeTabulation {
  BeamRule rule;
  std::vector<ShapeTable<double>> shape;
  std::vector<PackOfPoints> packs;  ///< the same, four at once

  ShapeTabulation() = default;
  ShapeTabulation(const BeamRule& rule_, const Weights<double>& w) : rule(rule_) {
    for (const auto& point : rule) {
      shape.push_back(w == unit_weights ? hermite_shape(point.u) : rational_shape(w, point.u));
    }
    for (std::size_t g = 0; g < rule.size();) {
      std::size_t end = g + 1;
      while (end < rule.size() && end < g + Pack::width && rule[end].feels == rule[g].feels) ++end;
      packs.push_back(pack(g, end));
      g = end;
    }
  }

 private:
  PackOfPoints pack(std::size_t begin, std::size_t end) const {
    PackOfPoints points;
    points.feels = rule[begin].feels;
    for (int lane = 0; lane < Pack::width; ++lane) {
      const std::size_t at = begin + static_cast<std::size_t>(lane), g = std::min(at, end - 1);
      points.u.set(lane, rule[g].u);
      points.weight.set(lane, at < end ? rule[g].weight : 0);
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t n = 0; n < 4; ++n) points.shape[i][n].set(lane, shape[g][i][n]);
      }
    }
    return points;
  }
};

/// A quadrature point of a variable-length element; with packs four of them.
template <class Real, class Parameter = double>
struct ReferencePoint {
  Parameter u, share;  ///< its parameter, and its weight over the element's length
  Real weight;         ///< [m]
  Real weight_rate;    ///< rate of `weight` [m/s]
  Real mesh_velocity;  ///< of the point along the beam [m/s]
  Feels feels;         ///< what of the beam

  // What its place and its weight change by as an end moves along the beam.
  Parameter by_a() const { return 1 - u; }
  Parameter by_b() const { return u; }
  Parameter weight_by_a() const { return -share; }
  Parameter weight_by_b() const { return share; }
  const BeamSection& felt(const FeltSections& sections) const { return sections[feels]; }
  const BeamSection& whole(const FeltSections& sections) const { return sections.everything; }
};

/// The same where the section changes inside the element: a point of one piece, which lies between an end of the
/// element, which may move, and a place where the section changes, which does not.
template <class Real>
struct PiecePoint {
  Real u, x, weight, weight_rate, mesh_velocity;
  Feels feels;
  double to_a, to_b;          ///< by_a(), by_b()
  double weight_a, weight_b;  ///< weight_by_a(), weight_by_b()
  const FeltSections* here;   ///< of the piece

  double by_a() const { return to_a; }
  double by_b() const { return to_b; }
  double weight_by_a() const { return weight_a; }
  double weight_by_b() const { return weight_b; }
  const BeamSection& here_felt() const { return (*here)[feels]; }
  const BeamSection& felt(const FeltSections& /*sections*/) const { return here_felt(); }
  const BeamSection& whole(const FeltSections& /*sections*/) const { return here->everything; }
};

/// Calls `visit(point, motion, rest)` at the quadrature points of a variable-length element: a ReferencePoint, what
/// `evaluate(u, shape functions)` gives there, and the RestStrain by `rest` (null without a rest shape). `reshaped`
/// says that the shape functions are not those of the table. With packs four points at a time.
template <class Real, int D, MovingEnds Ends, class Rest, class Evaluate, class Visit>
[[gnu::always_inline]] inline void for_each_point(const MovingKinematics<Real, D, Ends>& kinematics,
                                                  const ShapeTabulation& table, bool reshaped, const Rest* rest,
                                                  const Evaluate& evaluate, const Visit& visit) {
  using Parameter = PointParameter<Real>;
  const auto at_each = [&](const auto& see) {
    const auto point_at = [&](const Parameter& u, const Parameter& w, Feels feels) {
      return ReferencePoint<Real, Parameter>{
          u, w, kinematics.length() * w, kinematics.length_rate() * w, kinematics.mesh_velocity(u), feels};
    };
    if constexpr (std::is_same_v<Parameter, Pack>) {
      for (const PackOfPoints& points : table.packs) {
        see(point_at(points.u, points.weight, points.feels), points.shape);
      }
    } else {
      for (std::size_t g = 0; g < table.rule.size(); ++g) {
        const auto [u, w, feels] = table.rule[g];
        see(point_at(u, w, feels), table.shape[g]);
      }
    }
  };
  if (rest == nullptr) {
    at_each([&](const auto& point, const ShapeTable<Parameter>& shape) {
      const auto motion =
          reshaped ? evaluate(point.u, rational_shape(kinematics.weights(), Real(point.u))) : evaluate(point.u, shape);
      visit(point, motion, static_cast<const RestStrain<Real>*>(nullptr));
    });
    return;
  }
  if constexpr (D > 1 && std::is_same_v<Rest, RestKinematics<Real, D, Ends>>) {  // a single field has no rest shape
    at_each([&](const auto& point, const ShapeTable<Parameter>& /*frozen*/) {
      const ShapeTable<Real> shape = rational_shape(kinematics.weights(), Real(point.u));
      const RestStrain<Real> strain = rest->at(point.u, shape);
      visit(point, evaluate(point.u, shape), &strain);
    });
  }
}

/// A number without its derivatives.
template <class Real>
double number_of(const Real& number) {
  if constexpr (std::is_arithmetic_v<Real>) {
    return number;
  } else if constexpr (requires { number.value(); }) {
    return number_of(number.value());
  } else {
    return number_of(number.value);
  }
}

/// for_each_point() of an element in which the section changes: the points of the table's rule on each of its pieces,
/// as PiecePoint. Not with packs.
template <class Real, int D, MovingEnds Ends, class Rest, class Evaluate, class Visit>
void for_each_point_in_pieces(const MovingKinematics<Real, D, Ends>& kinematics, const BeamRule& rule,
                              const BeamSection& own, const SectionPieces& pieces, const Rest* rest,
                              const Evaluate& evaluate, const Visit& visit) {
  const Real x_a = kinematics.coordinates().x_a, x_b = kinematics.coordinates().x_b;
  const Real v_a = kinematics.rates().x_a, v_b = kinematics.rates().x_b;
  pieces.visit(number_of(x_a), number_of(x_b), [&](const SectionPieces::Stretch& piece) {
    const FeltSections here(piece.share->of(own));
    const Real low = piece.at_start ? x_a : Real(piece.low), high = piece.at_end ? x_b : Real(piece.high);
    const Real v_low = piece.at_start ? v_a : Real(0), v_high = piece.at_end ? v_b : Real(0);
    for (const auto& [share, w, feels] : rule) {
      PiecePoint<Real> point;
      point.x = low + (high - low) * Real(share);
      point.u = (point.x - x_a) / kinematics.length();
      point.weight = (high - low) * Real(w);
      point.weight_rate = (v_high - v_low) * Real(w);
      point.mesh_velocity = v_low * Real(1 - share) + v_high * Real(share);
      point.feels = feels;
      point.to_a = piece.at_start ? 1 - share : 0;
      point.to_b = piece.at_end ? share : 0;
      point.weight_a = piece.at_start ? -w : 0;
      point.weight_b = piece.at_end ? w : 0;
      point.here = &here;
      const ShapeTable<Real> shape = rational_shape(kinematics.weights(), point.u);
      if (rest == nullptr) {
        visit(point, evaluate(point.u, shape), static_cast<const RestStrain<Real>*>(nullptr));
      } else if constexpr (D > 1 && std::is_same_v<Rest, RestKinematics<Real, D, Ends>>) {
        const RestStrain<Real> strain = rest->at(point.u, shape);
        visit(point, evaluate(point.u, shape), &strain);
      }
    }
  });
}

}  // namespace vlbeam
