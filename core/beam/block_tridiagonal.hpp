#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vlbeam {

/// A block tridiagonal matrix with blocks of `B` unknowns, one a node, and one more unknown that couples to a few
/// neighbouring nodes only (the border): what a chain of elements with a moving node makes of a Newton iteration.
/// Factored once, solved many times; cost and memory are proportional to the number of nodes.
template <int B>
class BorderedBlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, B, B>;
  using Vector = Eigen::Matrix<double, B, 1>;
  static constexpr int border_reach = 3;  ///< nodes that the border couples to

  /// A zero matrix of `nodes` blocks; `border_first` is the first node the border couples to, negative for no border.
  void reset(int nodes, int border_first) {
    const auto n = static_cast<std::size_t>(nodes);
    diagonal.assign(n, Block::Zero());
    upper.assign(n, Block::Zero());
    lower.assign(n, Block::Zero());
    inverse_.resize(n);
    column_.resize(B * n);
    border_first_ = border_first;
    column.fill(Vector::Zero());
    row.fill(Vector::Zero());
    corner = 0;
  }

  bool bordered() const { return border_first_ >= 0; }
  int nodes() const { return static_cast<int>(diagonal.size()); }

  /// Block LU from the first node to the last. Returns false where a pivot is singular or not finite.
  bool factor() {
    const std::size_t n = diagonal.size();
    for (std::size_t k = 0; k < n; ++k) {
      Block pivot = diagonal[k];
      if (k > 0) {
        lower[k] = lower[k] * inverse_[k - 1];  // the elimination factor takes the place of the block it eliminates
        pivot.noalias() -= lower[k] * upper[k - 1];
      }
      inverse_[k] = pivot.inverse();
      if (!inverse_[k].allFinite()) return false;
    }
    if (!bordered()) return true;
    std::fill(column_.begin(), column_.end(), 0.0);
    const auto first = static_cast<std::size_t>(border_first_);
    for (std::size_t i = 0; i < border_reach; ++i) block(column_.data(), first + i) = column[i];
    substitute(column_.data(), first);
    double pivot = corner;
    for (std::size_t i = 0; i < border_reach; ++i) pivot -= row[i].dot(block(column_.data(), first + i));
    corner_inverse_ = 1 / pivot;
    return std::isfinite(corner_inverse_);
  }

  /// Solves in place; `x` holds B numbers a node and, with a border, one more.
  void solve(double* x) const {
    substitute(x, 0);
    if (!bordered()) return;
    const auto first = static_cast<std::size_t>(border_first_);
    double& extra = x[B * nodes()];
    for (std::size_t i = 0; i < border_reach; ++i) extra -= row[i].dot(block(x, first + i));
    extra *= corner_inverse_;
    for (std::size_t k = 0; k < diagonal.size(); ++k) block(x, k) -= block(column_.data(), k) * extra;
  }

  /// Writes the matrix, not yet factored, into the leading part of a dense one of zeros.
  void expand(Eigen::MatrixXd& dense) const {
    const Eigen::Index n = nodes();
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      dense.block<B, B>(B * k, B * k) = diagonal[i];
      if (k + 1 < n) dense.block<B, B>(B * k, B * (k + 1)) = upper[i];
      if (k > 0) dense.block<B, B>(B * k, B * (k - 1)) = lower[i];
    }
    if (!bordered()) return;
    for (std::size_t i = 0; i < border_reach; ++i) {
      const Eigen::Index at = B * (border_first_ + static_cast<Eigen::Index>(i));
      dense.block<B, 1>(at, B * n) = column[i];
      dense.block<1, B>(B * n, at) = row[i].transpose();
    }
    dense(B * n, B * n) = corner;
  }

  std::vector<Block> diagonal, upper, lower;  ///< upper[k] couples k to k + 1, lower[k] couples k to k - 1
  std::array<Vector, border_reach> column, row;
  double corner = 0;

 private:
  static Eigen::Map<Vector> block(double* x, std::size_t k) { return Eigen::Map<Vector>(x + B * k); }
  static Eigen::Map<const Vector> block(const double* x, std::size_t k) { return Eigen::Map<const Vector>(x + B * k); }

  /// Forward and back substitution of a right-hand side that is zero before node `first`.
  void substitute(double* x, std::size_t first) const {
    const std::size_t n = diagonal.size();
    for (std::size_t k = first + 1; k < n; ++k) block(x, k).noalias() -= lower[k] * block(x, k - 1);
    block(x, n - 1) = inverse_[n - 1] * block(x, n - 1).eval();
    for (std::size_t k = n - 1; k-- > 0;) {
      const Vector rest = block(x, k) - upper[k] * block(x, k + 1);
      block(x, k).noalias() = inverse_[k] * rest;
    }
  }

  std::vector<Block> inverse_;
  std::vector<double> column_;
  int border_first_ = -1;
  double corner_inverse_ = 0;
};

}  // namespace vlbeam
