#pragma once

#include <vector>

#include "core/geometry/vec.hpp"

namespace vlbeam {

/// Directions across one, of length 1: one in the plane, two in space.
template <int D>
std::vector<Vec<double, D>> across(const Vec<double, D>& along) {
  if constexpr (D == 2) {
    return {Vec<double, 2>(-along[1], along[0])};
  } else {
    Eigen::Index least = 0;
    along.cwiseAbs().minCoeff(&least);
    const Vec<double, 3> first = along.cross(Vec<double, 3>::Unit(least)).normalized();
    return {first, along.cross(first)};
  }
}

}  // namespace vlbeam
