#pragma once

#include <Eigen/Core>

namespace vlbeam {

/// Coordinates of an element of a chain: its nodal vectors and the marks of its ends, which count where those are
/// joints.
template <int D>
inline constexpr int point_coordinates = 4 * D + 2;
template <int D>
using PointMatrix = Eigen::Matrix<double, point_coordinates<D>, point_coordinates<D>>;

}  // namespace vlbeam
