#pragma once

#include <Eigen/Core>

namespace vlbeam {

/// A point, slope or force: `D` components of scalar type `Real`.
template <class Real, int D>
using Vec = Eigen::Matrix<Real, D, 1>;

/// r x v: in the plane, its component across it is the last.
template <int D>
Vec<double, 3> moment_about_origin(const Vec<double, D>& r, const Vec<double, D>& v) {
  const double across = r[0] * v[1] - r[1] * v[0];
  if constexpr (D == 2) return {0, 0, across};
  if constexpr (D == 3) return {r[1] * v[2] - r[2] * v[1], r[2] * v[0] - r[0] * v[2], across};
}

}  // namespace vlbeam
