#pragma once

#include <cmath>

#include "core/geometry/rational_cubic.hpp"

namespace vlbeam {

/// Exact arc of a circle as one rational cubic: from `angle` to `angle` + `turn` [rad] about `center`, in the plane of
/// the first two axes; |turn| < pi. Weights (1, w, w, 1), w = (1 + 2 cos(turn/2))/3 (Ding & Ouyang 2022, Eq. 43).
template <int D>
RationalCubic<double, D> circular_arc(const Vec<double, D>& center, double radius, double angle, double turn) {
  const double w = (1 + 2 * std::cos(turn / 2)) / 3;
  const double reach = 2 * radius * std::sin(turn / 2) / (3 * w);  // from an end to the next control point
  auto at = [&](double phi, double outwards, double along) -> Vec<double, D> {
    Vec<double, D> point = center;
    point[0] += outwards * std::cos(phi) - along * std::sin(phi);
    point[1] += outwards * std::sin(phi) + along * std::cos(phi);
    return point;
  };
  return {
      {at(angle, radius, 0), at(angle, radius, reach), at(angle + turn, radius, -reach), at(angle + turn, radius, 0)},
      {1, w, w, 1}};
}

}  // namespace vlbeam
