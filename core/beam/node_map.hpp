#pragma once

#include <Eigen/Core>

#include "core/geometry/rational_cubic.hpp"

namespace vlbeam {

// Nodal arrays (coordinates, rates, accelerations, forces) are contiguous: node k has its position at
// 2 D k and its slope at 2 D k + D.

template <int D>
inline constexpr int node_size = 2 * D;

/// Block of a tangent between two nodes, position and slope each.
template <int D>
using NodeTangent = Eigen::Matrix<double, node_size<D>, node_size<D>>;

template <int D>
Eigen::Map<Vec<double, D>> position(double* nodes, int k) {
  return Eigen::Map<Vec<double, D>>(nodes + node_size<D> * k);
}
template <int D>
Eigen::Map<const Vec<double, D>> position(const double* nodes, int k) {
  return Eigen::Map<const Vec<double, D>>(nodes + node_size<D> * k);
}
template <int D>
Eigen::Map<Vec<double, D>> slope(double* nodes, int k) {
  return Eigen::Map<Vec<double, D>>(nodes + node_size<D> * k + D);
}
template <int D>
Eigen::Map<const Vec<double, D>> slope(const double* nodes, int k) {
  return Eigen::Map<const Vec<double, D>>(nodes + node_size<D> * k + D);
}

/// Nodal coordinates of element k, between nodes k and k + 1.
template <int D>
NodalCubic<double, D> element_nodes(const double* nodes, int k) {
  return {position<D>(nodes, k), slope<D>(nodes, k), position<D>(nodes, k + 1), slope<D>(nodes, k + 1)};
}

}  // namespace vlbeam
