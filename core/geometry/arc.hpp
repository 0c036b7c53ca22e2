#pragma once

#include "core/geometry/elementary.hpp"
#include "core/geometry/rational_cubic.hpp"

namespace vlbeam {

/// Exact arc of a circle as one rational cubic: from `angle` to `angle` + `turn` [rad] about `center`, in the plane of
/// the first two axes; |turn| < pi. Weights (1, w, w, 1), w = (1 + 2 cos(turn/2))/3 (Ding & Ouyang 2022, Eq. 43).
template <int D>
RationalCubic<double, D> circular_arc(const Vec<double, D>& center, double radius, double angle, double turn) {
  const double w = (1 + 2 * portable::cos(turn / 2)) / 3;
  const double reach = 2 * radius * portable::sin(turn / 2) / (3 * w);  // from an end to the next control point
  auto at = [&](double phi, double outwards, double along) -> Vec<double, D> {
    Vec<double, D> point = center;
    point[0] += outwards * portable::cos(phi) - along * portable::sin(phi);
    point[1] += outwards * portable::sin(phi) + along * portable::cos(phi);
    return point;
  };
  return {
      {at(angle, radius, 0), at(angle, radius, reach), at(angle + turn, radius, -reach), at(angle + turn, radius, 0)},
      {1, w, w, 1}};
}

/// Weights (1, w, w, 1) of a cubic between unit slopes `s_a` and `s_b`, as long as the arc between them, that passes
/// through the middle of that arc: w = (theta cot(theta/4) - 1)/3 = 1 - theta^2/36 - ..., theta its turn (derived). Its
/// distance from the arc falls with theta^6, and its speed is even to theta^4.
template <int D>
Weights<double> even_arc_weights(const Vec<double, D>& s_a, const Vec<double, D>& s_b) {
  const Vec<double, D> a = s_a.normalized(), b = s_b.normalized();
  const double turn = 2 * portable::atan2((a - b).norm(), (a + b).norm());
  if (turn == 0) return unit_weights;
  const double w = (turn / portable::tan(turn / 4) - 1) / 3;
  return {1, w, w, 1};
}

}  // namespace vlbeam
