#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace vlbeam {

/// A block tridiagonal matrix with blocks of `B` unknowns, one a node, and a few more unknowns, the border, each of
/// which couples to a few neighbouring nodes only: what a chain of elements with a moving node and constraints makes of
/// a Newton iteration. Factored once, solved many times; cost and memory are proportional to the number of nodes.
template <int B>
class BorderedBlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, B, B>;
  using Vector = Eigen::Matrix<double, B, 1>;
  static constexpr int reach = 4;  ///< nodes that one unknown of the border couples to

  /// An unknown of the border: its coupling to the nodes from `first` on.
  struct Border {
    int first = 0;
    std::array<Vector, reach> column, row;
  };

  /// A zero matrix of `nodes` blocks without border.
  void reset(int nodes) {
    const auto n = static_cast<std::size_t>(nodes);
    diagonal.assign(n, Block::Zero());
    upper.assign(n, Block::Zero());
    lower.assign(n, Block::Zero());
    inverse_.resize(n);
    border.clear();
    corner.setZero();
  }

  /// One more unknown, which couples to nodes from `first` on, or just to the last ones before it where there are
  /// fewer.
  Border& add_border(int first) {
    Border& added = border.emplace_back();
    added.first = first;
    added.column.fill(Vector::Zero());
    added.row.fill(Vector::Zero());
    if (corner.rows() < borders()) corner.conservativeResizeLike(Eigen::MatrixXd::Zero(borders(), borders()));
    return added;
  }

  /// Uncouples an unknown of the border from all others, with `size` on the diagonal.
  void fix(int unknown, double size) {
    Border& fixed = border[static_cast<std::size_t>(unknown)];
    fixed.column.fill(Vector::Zero());
    fixed.row.fill(Vector::Zero());
    corner.row(unknown).setZero();
    corner.col(unknown).setZero();
    corner(unknown, unknown) = size;
  }

  int nodes() const { return static_cast<int>(diagonal.size()); }
  int borders() const { return static_cast<int>(border.size()); }

  /// Block LU from the first node to the last, then the small system that the border leaves. Returns false where a
  /// pivot is singular or not finite.
  bool factor() {
    const std::size_t n = diagonal.size();
    for (std::size_t k = 0; k < n; ++k) {
      Block pivot = diagonal[k];
      if (k > 0) {
        lower[k] = lower[k] * inverse_[k - 1];  // the elimination factor takes the place of the block it eliminates
        pivot.noalias() -= lower[k] * upper[k - 1];
      }
      inverse_[k] = inverse_of(pivot);
      if (!inverse_[k].allFinite()) return false;
    }
    if (border.empty()) return true;
    const std::size_t stride = B * n;
    columns_.assign(stride * border.size(), 0.0);
    rest_ = corner.topLeftCorner(borders(), borders());
    for (int j = 0; j < borders(); ++j) {
      const Border& from = border[static_cast<std::size_t>(j)];
      double* column = columns_.data() + stride * static_cast<std::size_t>(j);
      for (int i = 0; i < reached(from); ++i) block(column, from.first + i) = from.column[static_cast<std::size_t>(i)];
      substitute(column, static_cast<std::size_t>(from.first));
      for (int i = 0; i < borders(); ++i) rest_(i, j) -= row_times(border[static_cast<std::size_t>(i)], column);
    }
    set_scales(rest_, corner_scale_);
    corner_lu_.compute(corner_scale_.asDiagonal() * rest_ * corner_scale_.asDiagonal());
    return rest_.allFinite() && corner_lu_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0;
  }

  /// Solves in place; `x` holds B numbers a node, then the border's unknowns.
  void solve(double* x) const {
    substitute(x, 0);
    if (border.empty()) return;
    const std::size_t stride = B * diagonal.size();
    Eigen::Map<Eigen::VectorXd> extra(x + stride, borders());
    for (int i = 0; i < borders(); ++i) extra[i] -= row_times(border[static_cast<std::size_t>(i)], x);
    scaled_ = corner_scale_.cwiseProduct(extra);
    solved_.noalias() = corner_lu_.solve(scaled_);
    extra = corner_scale_.cwiseProduct(solved_);
    Eigen::Map<Eigen::VectorXd> nodal(x, static_cast<Eigen::Index>(stride));
    for (int j = 0; j < borders(); ++j) {
      nodal -= extra[j] * Eigen::Map<const Eigen::VectorXd>(columns_.data() + stride * static_cast<std::size_t>(j),
                                                            static_cast<Eigen::Index>(stride));
    }
  }

  /// Of the last factored matrix, which is symmetric: how many of its eigenvalues are negative, by Sylvester's law
  /// those of its pivots, the last of which is the small matrix that the border leaves (Haynsworth 1968). One below
  /// `zero` of its block's diagonal counts as none.
  int negative_pivots(double zero) const {
    int count = 0;
    for (std::size_t k = 0; k < inverse_.size(); ++k) {
      Vector size;  // slopes, the second half of a node's unknowns, have another unit than places
      size.head(B / 2).setConstant(std::sqrt(diagonal[k].diagonal().head(B / 2).cwiseAbs().maxCoeff()));
      size.tail(B - B / 2).setConstant(std::sqrt(diagonal[k].diagonal().tail(B - B / 2).cwiseAbs().maxCoeff()));
      const Block scaled = size.asDiagonal() * inverse_[k] * size.asDiagonal();
      const Block even = (scaled + scaled.transpose()) / 2;
      const Eigen::SelfAdjointEigenSolver<Block> solver(even, Eigen::EigenvaluesOnly);
      for (const double value : solver.eigenvalues()) count += value < 0 && value > -1 / zero ? 1 : 0;
    }
    if (border.empty()) return count;
    const Eigen::VectorXd sizes = corner.diagonal().head(borders()).cwiseAbs().cwiseMax(rest_.diagonal().cwiseAbs());
    const Eigen::VectorXd scale = (sizes.array() > 0).select(sizes, 1).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * rest_ * scale.asDiagonal();
    const Eigen::MatrixXd even = (scaled + scaled.transpose()) / 2;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(even, Eigen::EigenvaluesOnly);
    for (const double value : solver.eigenvalues()) count += value < -zero ? 1 : 0;
    return count;
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
    for (int j = 0; j < borders(); ++j) {
      const Border& b = border[static_cast<std::size_t>(j)];
      for (int i = 0; i < reached(b); ++i) {
        const Eigen::Index at = B * (b.first + i);
        dense.block<B, 1>(at, B * n + j) = b.column[static_cast<std::size_t>(i)];
        dense.block<1, B>(B * n + j, at) = b.row[static_cast<std::size_t>(i)].transpose();
      }
    }
    if (borders() > 0) {
      dense.block(B * n, B * n, borders(), borders()) = corner.topLeftCorner(borders(), borders());
    }
  }

  std::vector<Block> diagonal, upper, lower;  ///< upper[k] couples k to k + 1, lower[k] couples k to k - 1
  std::vector<Border> border;
  Eigen::MatrixXd corner;  ///< among the border's unknowns; new ones are zero, and any beyond them

 private:
  /// Powers of two that bring the diagonal near that of the first unknown. Unknowns have several units: pivots chosen
  /// by size would depend on them, and with them the rounding.
  template <class Matrix, class Scales>
  static void set_scales(const Matrix& matrix, Scales& scales) {
    scales.resize(matrix.rows());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      const double ratio = std::abs(matrix(i, i) / matrix(0, 0));
      scales[i] = std::isnormal(ratio) ? std::ldexp(1.0, -(std::ilogb(ratio) >> 1)) : 1;
    }
  }

  static Block inverse_of(const Block& pivot) {
    if constexpr (B <= 4) {
      return pivot.inverse();  // in closed form, without pivoting
    } else {
      Vector scale;
      set_scales(pivot, scale);
      return scale.asDiagonal() * (scale.asDiagonal() * pivot * scale.asDiagonal()).eval().inverse() *
             scale.asDiagonal();
    }
  }

  static Eigen::Map<Vector> block(double* x, int k) { return Eigen::Map<Vector>(x + std::ptrdiff_t{B} * k); }
  static Eigen::Map<const Vector> block(const double* x, int k) {
    return Eigen::Map<const Vector>(x + std::ptrdiff_t{B} * k);
  }

  int reached(const Border& b) const { return std::min(reach, nodes() - b.first); }
  double row_times(const Border& b, const double* x) const {
    double sum = 0;
    for (int i = 0; i < reached(b); ++i) sum += b.row[static_cast<std::size_t>(i)].dot(block(x, b.first + i));
    return sum;
  }

  /// Forward and back substitution of a right-hand side that is zero before node `first`.
  void substitute(double* x, std::size_t first) const {
    const int n = nodes();
    for (int k = static_cast<int>(first) + 1; k < n; ++k) {
      block(x, k).noalias() -= lower[static_cast<std::size_t>(k)] * block(x, k - 1);
    }
    block(x, n - 1) = inverse_.back() * block(x, n - 1).eval();
    for (int k = n - 1; k-- > 0;) {
      const auto i = static_cast<std::size_t>(k);
      const Vector rest = block(x, k) - upper[i] * block(x, k + 1);
      block(x, k).noalias() = inverse_[i] * rest;
    }
  }

  std::vector<Block> inverse_;
  std::vector<double> columns_;                     ///< the border's columns, solved
  Eigen::MatrixXd rest_;                            ///< of the corner, once the nodes are eliminated
  Eigen::PartialPivLU<Eigen::MatrixXd> corner_lu_;  ///< of that, scaled
  Eigen::VectorXd corner_scale_;
  mutable Eigen::VectorXd scaled_, solved_;
};

}  // namespace vlbeam
