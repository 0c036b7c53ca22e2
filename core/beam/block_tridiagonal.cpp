#include "core/beam/block_tridiagonal.hpp"

#include <cmath>

#include "core/geometry/dense.hpp"

namespace vlbeam {
namespace {

/// Powers of two that bring the diagonal near that of the first unknown. Unknowns have several units: pivots chosen
/// by size would depend on them, and with them the rounding.
template <class Matrix, class Scales>
void set_scales(const Matrix& matrix, Scales& scales) {
  scales.resize(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const double ratio = std::abs(matrix(i, i) / matrix(0, 0));
    scales[i] = std::isnormal(ratio) ? std::ldexp(1.0, -(std::ilogb(ratio) >> 1)) : 1;
  }
}

template <int B>
Eigen::Matrix<double, B, B> inverse_of(const Eigen::Matrix<double, B, B>& pivot) {
  if constexpr (B <= 4) {
    return pivot.inverse();  // in closed form, without pivoting
  } else {
    Eigen::Matrix<double, B, 1> scale;
    set_scales(pivot, scale);
    return scale.asDiagonal() * (scale.asDiagonal() * pivot * scale.asDiagonal()).eval().inverse() * scale.asDiagonal();
  }
}

template <int B>
auto node_part(double* x, int k) {
  return Eigen::Map<Eigen::Matrix<double, B, 1>>(x + std::ptrdiff_t{B} * k);
}
template <int B>
auto node_part(const double* x, int k) {
  return Eigen::Map<const Eigen::Matrix<double, B, 1>>(x + std::ptrdiff_t{B} * k);
}

}  // namespace

template <int B>
void BorderedBlockTridiagonal<B>::reset(int nodes) {
  const auto n = static_cast<std::size_t>(nodes);
  diagonal.assign(n, Block::Zero());
  upper.assign(n, Block::Zero());
  lower.assign(n, Block::Zero());
  inverse_.resize(solves_ ? 0 : n);
  pivots_.resize(solves_ ? n : 0);
  border.clear();
  corner.setZero();
}

template <int B>
typename BorderedBlockTridiagonal<B>::Border& BorderedBlockTridiagonal<B>::add_border(int first) {
  Border& added = border.emplace_back();
  added.first = first;
  added.column.fill(Vector::Zero());
  added.row.fill(Vector::Zero());
  if (corner.rows() < borders()) corner.conservativeResizeLike(Eigen::MatrixXd::Zero(borders(), borders()));
  return added;
}

template <int B>
void BorderedBlockTridiagonal<B>::fix(int unknown, double size) {
  Border& fixed = border[static_cast<std::size_t>(unknown)];
  fixed.column.fill(Vector::Zero());
  fixed.row.fill(Vector::Zero());
  fixed.far = -1;
  corner.row(unknown).setZero();
  corner.col(unknown).setZero();
  corner(unknown, unknown) = size;
}

template <int B>
bool BorderedBlockTridiagonal<B>::factor() {
  const std::size_t n = diagonal.size();
  for (std::size_t k = 0; k < n; ++k) {
    Block pivot = diagonal[k];
    if (k > 0) {
      // the elimination factor takes the place of the block it eliminates
      if (solves_) {
        const Pivot& before = pivots_[k - 1];
        const Block scaled = before.scale.asDiagonal() * lower[k].transpose();
        lower[k] = (before.scale.asDiagonal() * before.scaled.transpose().partialPivLu().solve(scaled)).transpose();
      } else {
        lower[k] = lower[k] * inverse_[k - 1];
      }
      pivot.noalias() -= lower[k] * upper[k - 1];
    }
    if (solves_) {
      Pivot& own = pivots_[k];
      set_scales(pivot, own.scale);
      own.scaled = own.scale.asDiagonal() * pivot * own.scale.asDiagonal();
      own.lu.compute(own.scaled);
      if (!pivot.allFinite() || own.lu.matrixLU().diagonal().cwiseAbs().minCoeff() == 0) return false;
    } else {
      inverse_[k] = inverse_of(pivot);
      if (!inverse_[k].allFinite()) return false;
    }
  }
  if (border.empty()) return true;
  const std::size_t stride = B * n;
  columns_.assign(stride * border.size(), 0.0);
  rest_ = corner.topLeftCorner(borders(), borders());
  for (int j = 0; j < borders(); ++j) {
    const Border& from = border[static_cast<std::size_t>(j)];
    double* column = columns_.data() + stride * static_cast<std::size_t>(j);
    for (int i = 0; i < reached(from); ++i)
      node_part<B>(column, from.first + i) = from.column[static_cast<std::size_t>(i)];
    if (from.far >= 0) node_part<B>(column, from.far) += from.far_column;
    substitute(column, static_cast<std::size_t>(from.far < 0 ? from.first : std::min(from.first, from.far)));
    for (int i = 0; i < borders(); ++i) rest_(i, j) -= row_times(border[static_cast<std::size_t>(i)], column);
  }
  set_scales(rest_, corner_scale_);
  corner_lu_.compute(corner_scale_.asDiagonal() * rest_ * corner_scale_.asDiagonal());
  return rest_.allFinite() && corner_lu_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0;
}

template <int B>
void BorderedBlockTridiagonal<B>::solve(double* x) const {
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

template <int B>
int BorderedBlockTridiagonal<B>::negative_pivots(double zero) const {
  int count = 0;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    Vector size;  // places, slopes and, of an odd number, an angle have units of their own
    for (int first = 0; first < B; first += B / 2) {
      const int end = std::min(first + B / 2, B);
      double largest = 0;
      for (int i = first; i < end; ++i) largest = std::max(largest, std::abs(diagonal[k](i, i)));
      for (int i = first; i < end; ++i) size[i] = std::sqrt(largest);
    }
    if (solves_) {
      const Vector by = (pivots_[k].scale.cwiseProduct(size)).cwiseInverse();
      const Block scaled = by.asDiagonal() * pivots_[k].scaled * by.asDiagonal();
      const Block even = (scaled + scaled.transpose()) / 2;
      for (const double value : eigenvalues(even)) count += value < -zero ? 1 : 0;
      continue;
    }
    const Block scaled = size.asDiagonal() * inverse_[k] * size.asDiagonal();
    const Block even = (scaled + scaled.transpose()) / 2;
    for (const double value : eigenvalues(even)) count += value < 0 && value > -1 / zero ? 1 : 0;
  }
  if (border.empty()) return count;
  const Eigen::VectorXd sizes = corner.diagonal().head(borders()).cwiseAbs().cwiseMax(rest_.diagonal().cwiseAbs());
  const Eigen::VectorXd scale = (sizes.array() > 0).select(sizes, 1).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * rest_ * scale.asDiagonal();
  const Eigen::MatrixXd even = (scaled + scaled.transpose()) / 2;
  for (const double value : eigenvalues(even)) count += value < -zero ? 1 : 0;
  return count;
}

template <int B>
void BorderedBlockTridiagonal<B>::expand(Eigen::MatrixXd& dense) const {
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
    if (b.far < 0) continue;
    dense.block<B, 1>(B * b.far, B * n + j) += b.far_column;
    dense.block<1, B>(B * n + j, B * b.far) += b.far_row.transpose();
  }
  if (borders() > 0) {
    dense.block(B * n, B * n, borders(), borders()) = corner.topLeftCorner(borders(), borders());
  }
}

template <int B>
double BorderedBlockTridiagonal<B>::row_times(const Border& b, const double* x) const {
  double sum = 0;
  for (int i = 0; i < reached(b); ++i) sum += b.row[static_cast<std::size_t>(i)].dot(node_part<B>(x, b.first + i));
  if (b.far >= 0) sum += b.far_row.dot(node_part<B>(x, b.far));
  return sum;
}

template <int B>
template <class Columns>
void BorderedBlockTridiagonal<B>::apply_pivot(std::size_t k, Columns&& x) const {
  if (solves_) {
    const Pivot& own = pivots_[k];
    const Vector scaled = own.scale.cwiseProduct(x);
    x = own.scale.cwiseProduct(own.lu.solve(scaled));
  } else {
    x = inverse_[k] * x.eval();
  }
}

template <int B>
void BorderedBlockTridiagonal<B>::substitute(double* x, std::size_t first) const {
  const int n = nodes();
  for (int k = static_cast<int>(first) + 1; k < n; ++k) {
    node_part<B>(x, k).noalias() -= lower[static_cast<std::size_t>(k)] * node_part<B>(x, k - 1);
  }
  apply_pivot(static_cast<std::size_t>(n - 1), node_part<B>(x, n - 1));
  for (int k = n - 1; k-- > 0;) {
    const auto i = static_cast<std::size_t>(k);
    node_part<B>(x, k).noalias() -= upper[i] * node_part<B>(x, k + 1);
    apply_pivot(i, node_part<B>(x, k));
  }
}

template class BorderedBlockTridiagonal<2>;
template class BorderedBlockTridiagonal<4>;
template class BorderedBlockTridiagonal<6>;
template class BorderedBlockTridiagonal<7>;

}  // namespace vlbeam
