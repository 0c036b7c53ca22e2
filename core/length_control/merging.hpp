#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/geometry/dense.hpp"
#include "core/geometry/rational_cubic.hpp"

namespace vlbeam {

/// Weights k = (w_0, w_1, w_2)/w_3 of a merged element.
struct MergedWeights {
  std::array<double, 3> k{1, 1, 1};
  bool unit_fallback = false;  ///< the fit gave a k_i <= 0 and unit weights were taken instead (Eq. 38)

  Weights<double> weights() const { return {k[0], k[1], k[2], 1}; }
};

/// Weights by which the merged element of length `l` with nodal coordinates `e` passes through `deleted`, the position
/// of the deleted node, at its old parameter `u`; of all such weights those with the least |k - 1|
/// (Ding & Ouyang 2022, Eq. 31-38). Throws std::domain_error where something is not finite. As in the paper weights are
/// measured against w_3, whichever way the joint goes: the mirror image of a merge may get other weights.
template <int D>
MergedWeights point_fit(const NodalCubic<double, D>& e, double l, double u, const Vec<double, D>& deleted) {
  // K(u) (r(u) - r_H) = 0 is linear in k: columns of k_0, k_1, k_2 and what is left
  const double v = 1 - u;
  const Vec<double, D> a = e.r_a - deleted, b = e.r_b - deleted;
  Eigen::Matrix<double, D, 3> matrix;
  matrix.col(0) = v * v * v * a + l * u * v * v * e.s_a;
  matrix.col(1) = 3 * u * v * v * a;
  matrix.col(2) = 3 * u * u * v * b;
  const Vec<double, D> rest = u * u * u * b - l * u * u * v * e.s_b;
  const Vec<double, D> misfit = -(rest + matrix.rowwise().sum());
  if (!matrix.allFinite() || !misfit.allFinite()) {  // of which no decomposition says anything, not even that it failed
    throw std::domain_error("an element is to be merged whose shape is not finite: the motion has broken down");
  }
  // a straight element has one equation, whatever rounding adds to the others
  const Eigen::Vector3d x = least_squares<D, 3>(matrix, misfit, 1e-12);
  MergedWeights merged;
  for (int i = 0; i < 3; ++i) merged.k[static_cast<std::size_t>(i)] = 1 + x[i];
  if (std::any_of(merged.k.begin(), merged.k.end(), [](double k) { return !(k > 0); })) {
    merged.k = {1, 1, 1};
    merged.unit_fallback = true;
  }
  return merged;
}

}  // namespace vlbeam
