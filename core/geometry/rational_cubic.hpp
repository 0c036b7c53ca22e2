#pragma once

#include <array>

#include "core/geometry/vec.hpp"
#include "core/geometry/weights.hpp"

namespace vlbeam {

/// The four nodal coordinates of a cubic element: end positions and end slopes with respect to the material
/// coordinate (Ding & Ouyang 2022, Eq. 4). Also holds their rates.
template <class Real, int D>
struct NodalCubic {
  Vec<Real, D> r_a, s_a, r_b, s_b;
};

/// Sum of the nodal coordinates, times the shape functions `s` or their derivatives.
template <class Real, int D>
Vec<Real, D> combine_nodes(const std::array<Real, 4>& s, const NodalCubic<Real, D>& e) {
  return e.r_a * s[0] + e.s_a * s[1] + e.r_b * s[2] + e.s_b * s[3];
}

/// Rational cubic Bezier curve in `D` dimensions (Ding & Ouyang 2022, Eq. 1-3), parameter u in [0, 1].
template <class Real, int D>
struct RationalCubic {
  std::array<Vec<Real, D>, 4> points;
  Weights<Real> weights;

  /// The curve of an element of length `l` [m] with nodal coordinates `e` (Eq. 6).
  static RationalCubic from_nodal(const NodalCubic<Real, D>& e, const Real& l, const Weights<Real>& w) {
    RationalCubic curve;
    curve.weights = w;
    curve.points[0] = e.r_a;
    curve.points[1] = e.r_a + e.s_a * Real(l * w[0] / (Real(3) * w[1]));
    curve.points[2] = e.r_b - e.s_b * Real(l * w[3] / (Real(3) * w[2]));
    curve.points[3] = e.r_b;
    return curve;
  }

  /// Nodal coordinates of an element of length `l` [m] with this curve (Eq. 5).
  NodalCubic<Real, D> to_nodal(const Real& l) const {
    const auto& w = weights;
    return {points[0], (points[1] - points[0]) * Real(Real(3) * w[1] / (l * w[0])), points[3],
            (points[3] - points[2]) * Real(Real(3) * w[2] / (l * w[3]))};
  }

  /// Position and the first three derivatives with respect to u, or as many of these as are asked for.
  template <int count = 4>
  std::array<Vec<Real, D>, count> evaluate(const Real& u) const {
    std::array<std::array<Real, 4>, 4> b = bernstein(u);
    std::array<Real, count> w;
    std::array<Vec<Real, D>, count> value;
    for (int n = 0; n < count; ++n) {
      w[n] = Real(0);
      value[n].setZero();
      for (int i = 0; i < 4; ++i) {
        const Real wb = weights[i] * b[i][n];
        w[n] += wb;
        value[n] += points[i] * wb;
      }
    }
    constexpr int binomial[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
    for (int n = 0; n < count; ++n) {
      for (int k = 1; k <= n; ++k) value[n] -= value[n - k] * Real(Real(binomial[n][k]) * w[k]);
      value[n] *= Real(1) / w[0];
    }
    return value;
  }

  /// The same curve on the interval [a, b] of its parameter, inside [0, 1] or beyond it (Eq. 21 for a split).
  RationalCubic restrict(const Real& a, const Real& b) const {
    std::array<Vec<Real, D>, 4> homogeneous;
    for (int i = 0; i < 4; ++i) homogeneous[i] = points[i] * weights[i];
    RationalCubic part;
    part.weights = restrict_cubic(weights, a, b);
    part.points = restrict_cubic(homogeneous, a, b);
    for (int i = 0; i < 4; ++i) part.points[i] *= Real(1) / part.weights[i];
    return part;
  }

  /// Bernstein polynomials b[i][n]: the n-th derivative of the i-th at u.
  static std::array<std::array<Real, 4>, 4> bernstein(const Real& u) {
    const Real v = Real(1) - u;
    return {{{v * v * v, Real(-3) * v * v, Real(6) * v, Real(-6)},
             {Real(3) * u * v * v, Real(3) * v * v - Real(6) * u * v, Real(6) * u - Real(12) * v, Real(18)},
             {Real(3) * u * u * v, Real(6) * u * v - Real(3) * u * u, Real(6) * v - Real(12) * u, Real(-18)},
             {u * u * u, Real(3) * u * u, Real(6) * u, Real(6)}}};
  }
};

}  // namespace vlbeam
