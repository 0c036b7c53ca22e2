#pragma once

#include <cmath>

#include "core/geometry/rational_cubic.hpp"

namespace vlbeam::test {

/// Nodal coordinates and weights of an exact circular arc, length R theta.
template <int D>
struct ArcElement {
  NodalCubic<double, D> e;
  Weights<double> w;
};

/// Arc of radius `R` about the origin, from column 0 of `Q` towards column 1 by the angle `theta` (Ding & Ouyang 2022,
/// Eq. 43: weights 1, w1, w1, 1 and end slopes of length 2 sin(theta/2)/theta). `skew` other than 1 gives the same
/// curve other weights and end slopes.
template <int D>
ArcElement<D> circular_arc(double R, double theta, const Eigen::Matrix<double, D, D>& Q, double skew = 1) {
  const double m = 2 * std::sin(theta / 2) / theta, w1 = (1 + 2 * std::cos(theta / 2)) / 3;
  const Vec<double, D> x = Q.col(0), y = Q.col(1);
  const Vec<double, D> end = std::cos(theta) * x + std::sin(theta) * y;
  const Vec<double, D> end_tangent = -std::sin(theta) * x + std::cos(theta) * y;
  return {{R * x, skew * m * y, R * end, m / skew * end_tangent}, {1, skew * w1, skew * skew * w1, skew * skew * skew}};
}

template <int D>
RationalCubic<double, D> arc_curve(double R, double theta, const Eigen::Matrix<double, D, D>& Q, double skew = 1) {
  const auto arc = circular_arc<D>(R, theta, Q, skew);
  return RationalCubic<double, D>::from_nodal(arc.e, R * theta, arc.w);
}

}  // namespace vlbeam::test
