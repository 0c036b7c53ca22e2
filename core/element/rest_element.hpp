#pragma once

#include "core/element/moving_kinematics.hpp"
#include "core/element/rest_strain.hpp"

namespace vlbeam {

/// Where an end of an element is when nothing stresses the beam: the rest curve C and its first three derivatives by
/// arc length, at the material coordinate `x` of that end. Of an end that does not move the first two alone count,
/// its rest position and slope; that slope is C' but for elements that are an exact chain of conics.
template <int D>
struct RestEnd {
  double x = 0;
  std::array<Vec<double, D>, 4> curve;

  /// Derivative of order n <= 2 at `at`, whose value is `x`: what follows `at` of it, by Taylor's series.
  template <class Real>
  Vec<Real, D> derivative(std::size_t n, const Real& at) const {
    const Real d = at - Real(x);
    Vec<Real, D> sum;
    for (int c = 0; c < D; ++c) {
      sum[c] = Real(curve[3][c]);
      for (std::size_t k = 3; k > n; --k)
        sum[c] = Real(curve[k - 1][c]) + sum[c] * d * Real(1.0 / static_cast<double>(k - n));
    }
    return sum;
  }
};

/// What an element is when nothing stresses it: the same element, in its present weights, between these ends.
template <int D>
struct RestElement {
  RestEnd<D> a, b;
};

/// Strains of the rest shape of a variable-length element, and what they change by as its ends move. Its ends follow
/// the rest curve, so that their slope and the second derivative of the curve add to dr/dx_A and dr/dx_B at fixed x.
template <class Real, int D, MovingEnds Ends>
class RestKinematics {
 public:
  using Vector = Vec<Real, D>;
  using Kinematics = MovingKinematics<Real, D, Ends>;

  RestKinematics(const RestElement<D>& rest, const Real& x_a, const Real& x_b, WeightTransport transport,
                 const WeightFunction& weights, const BeamSection& section)
      : slope_a_(node<Kinematics::a_moves>(rest.a, 1, x_a)),
        slope_b_(node<Kinematics::b_moves>(rest.b, 1, x_b)),
        section_(section),
        kinematics_(
            {{node<Kinematics::a_moves>(rest.a, 0, x_a), slope_a_, node<Kinematics::b_moves>(rest.b, 0, x_b), slope_b_},
             x_a,
             x_b},
            at_rest(), transport, weights) {
    if constexpr (Kinematics::a_moves) second_a_ = rest.a.derivative(2, x_a);
    if constexpr (Kinematics::b_moves) second_b_ = rest.b.derivative(2, x_b);
  }

  /// `f` holds the shape functions at u.
  template <class Parameter, class Shape>
  RestStrain<Real> at(const Parameter& u, const ShapeTable<Shape>& f) const {
    const PointMotion<Real, D> point = kinematics_.at(u, f);
    const StrainGradients<Real, D> strain(point.r_x, point.r_xx, section_);
    RestStrain<Real> rest;
    rest.axial = strain.axial;
    rest.curvature = strain.curvature;
    rest.along = strain.change(point.r_xx, point.r_xxx);
    if constexpr (Kinematics::a_moves) {
      rest.by_a = strain.change(combine(point.s_x, 0, slope_a_, second_a_) + point.y_a_x,
                                combine(point.s_xx, 0, slope_a_, second_a_) + point.y_a_xx);
    }
    if constexpr (Kinematics::b_moves) {
      rest.by_b = strain.change(combine(point.s_x, 2, slope_b_, second_b_) + point.y_b_x,
                                combine(point.s_xx, 2, slope_b_, second_b_) + point.y_b_xx);
    }
    return rest;
  }

 private:
  template <bool Moves>
  static Vector node(const RestEnd<D>& end, std::size_t n, const Real& x) {
    if constexpr (Moves) return end.derivative(n, x);
    return end.curve[n].template cast<Real>();
  }
  static MovingCoordinates<Real, D> at_rest() {
    return {{Vector::Zero(), Vector::Zero(), Vector::Zero(), Vector::Zero()}, Real(0), Real(0)};
  }
  static Vector combine(const std::array<Real, 4>& s, std::size_t node, const Vector& slope, const Vector& second) {
    return slope * s[node] + second * s[node + 1];
  }

  Vector slope_a_, slope_b_, second_a_, second_b_;
  const BeamSection& section_;
  Kinematics kinematics_;
};

}  // namespace vlbeam
