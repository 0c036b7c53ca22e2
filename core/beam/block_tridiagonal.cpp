#include "core/beam/block_tridiagonal.hpp"

#include <atomic>
#include <cassert>
#include <cmath>

#include "core/beam/block_kernels.hpp"
#include "core/geometry/dense.hpp"
#include "core/pieces.hpp"

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

const BlockKernels& fastest_block_kernels() {
  static const BlockKernels kernels = block_kernels(fastest_instruction_set());
  return kernels;
}

/// Calls a(i) and b(i), each for i from 0 to its count, if any, both of which need nothing of each other: at once where
/// there are threads, or by turns, so that the processor works on the one while the other waits for what it needs of
/// itself.
template <class A, class B>
void side_by_side(bool by_threads, int count_a, const A& a, int count_b, const B& b) {
  if (by_threads) {
    at_once(2, [&](std::ptrdiff_t side) {
      for (int i = 0; i < (side == 0 ? count_a : count_b); ++i) side == 0 ? a(i) : b(i);
    });
    return;
  }
  const int both = std::max(std::min(count_a, count_b), 0);
  for (int i = 0; i < both; ++i) {
    a(i);
    b(i);
  }
  for (int i = both; i < count_a; ++i) a(i);
  for (int i = both; i < count_b; ++i) b(i);
}

}  // namespace

BlockKernels block_kernels([[maybe_unused]] InstructionSet set) {
#ifdef VLBEAM_HAS_AVX2
  if (set == InstructionSet::avx2) return avx2::block_kernels();
#endif
  return portable::block_kernels();
}

template <int B>
void BorderedBlockTridiagonal<B>::reset(int nodes) {
  const auto n = static_cast<std::size_t>(nodes);
  for (std::vector<Block>* blocks : {&diagonal, &upper, &lower}) blocks->resize(n);
  in_pieces(nodes, B, [this](std::ptrdiff_t first, std::ptrdiff_t count) {
    for (std::vector<Block>* blocks : {&diagonal, &upper, &lower}) {
      std::fill_n(blocks->begin() + first, count, Block::Zero());
    }
  });
  middle_ = solves_ && !is_long() ? nodes - 1 : nodes / 2;
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
bool BorderedBlockTridiagonal<B>::factor_pivot(int k, const Block& pivot) {
  const auto i = static_cast<std::size_t>(k);
  if (!solves_) {
    diagonal[i] = inverse_of(pivot);
    return diagonal[i].allFinite();
  }
  Pivot& own = pivots_[i];
  set_scales(pivot, own.scale);
  own.scaled = own.scale.asDiagonal() * pivot * own.scale.asDiagonal();
  own.lu.compute(own.scaled);
  return pivot.allFinite() && own.lu.matrixLU().diagonal().cwiseAbs().minCoeff() > 0;
}

template <int B>
void BorderedBlockTridiagonal<B>::eliminate(int node, int from, Block& pivot) {
  const auto k = static_cast<std::size_t>(node), before = static_cast<std::size_t>(from);
  Block& forth = from < node ? lower[k] : upper[k];  // what eliminates it takes its place
  const Block& back = from < node ? upper[before] : lower[before];
  if (solves_) {
    const Pivot& own = pivots_[before];
    const Block scaled = own.scale.asDiagonal() * forth.transpose();
    forth = (own.scale.asDiagonal() * own.scaled.transpose().partialPivLu().solve(scaled)).transpose();
    pivot.noalias() -= forth * back;
  } else if constexpr (B == 4) {
    fastest_block_kernels().eliminate(diagonal[before].data(), back.data(), forth.data(), pivot.data());
  } else {
    forth = forth * diagonal[before];
    pivot.noalias() -= forth * back;
  }
}

template <int B>
bool BorderedBlockTridiagonal<B>::factor() {
  const int last = nodes() - 1;
  std::atomic<bool> sound = true;
  const auto factor_node = [&](int k, int before) {
    Block pivot = diagonal[static_cast<std::size_t>(k)];
    if (before >= 0 && before <= last) eliminate(k, before, pivot);
    if (!factor_pivot(k, pivot)) sound = false;  // only then: threads that write to one place wait for each other
  };
  side_by_side(
      is_long(), middle_, [&](int i) { factor_node(i, i - 1); }, last - middle_,
      [&](int i) { factor_node(last - i, last - i + 1); });
  if (!sound) return false;
  Block pivot = diagonal[static_cast<std::size_t>(middle_)];
  if (middle_ > 0) eliminate(middle_, middle_ - 1, pivot);
  if (middle_ < last) eliminate(middle_, middle_ + 1, pivot);
  if (!factor_pivot(middle_, pivot)) return false;
  if (border.empty()) return true;
  const std::size_t stride = B * diagonal.size();
  columns_.resize(stride * border.size());
  in_pieces(static_cast<std::ptrdiff_t>(columns_.size()), 1,
            [&](std::ptrdiff_t at, std::ptrdiff_t count) { std::fill_n(columns_.begin() + at, count, 0.0); });
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
  in_pieces(nodal.size(), 1, [&](std::ptrdiff_t first, std::ptrdiff_t count) {
    for (int j = 0; j < borders(); ++j) {
      const double* const column = columns_.data() + stride * static_cast<std::size_t>(j);
      nodal.segment(first, count) -= extra[j] * Eigen::Map<const Eigen::VectorXd>(column + first, count);
    }
  });
}

template <int B>
int BorderedBlockTridiagonal<B>::negative_pivots(double zero) const {
  assert(solves_);
  int count = 0;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    Vector size;  // places, slopes and, of an odd number, an angle have units of their own
    for (int first = 0; first < B; first += B / 2) {
      const int end = std::min(first + B / 2, B);
      double largest = 0;
      for (int i = first; i < end; ++i) largest = std::max(largest, std::abs(diagonal[k](i, i)));
      for (int i = first; i < end; ++i) size[i] = std::sqrt(largest);
    }
    const Vector by = (pivots_[k].scale.cwiseProduct(size)).cwiseInverse();
    const Block scaled = by.asDiagonal() * pivots_[k].scaled * by.asDiagonal();
    const Block even = (scaled + scaled.transpose()) / 2;
    for (const double value : eigenvalues(even)) count += value < -zero ? 1 : 0;
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
    x = diagonal[k] * x.eval();
  }
}

/// substitute() by inverse pivots.
template <int B>
void BorderedBlockTridiagonal<B>::substitute_by_kernels(double* x, int first) const {
  const BlockKernels& kernels = fastest_block_kernels();
  const double *const below = lower.front().data(), *const above = upper.front().data(),
                      *const inverse = diagonal.front().data();
  const auto at_once_or_by_turns = [&](const auto& sweep, const BlockRun& a, const BlockRun& b) {
    if (!is_long()) return sweep(a, b);
    at_once(2, [&](std::ptrdiff_t side) { sweep(side == 0 ? a : BlockRun{}, side == 0 ? BlockRun{} : b); });
  };
  const auto subtract = [&](const BlockRun& a, const BlockRun& b) { kernels.subtract(a, b, x); };
  const auto finish = [&](const BlockRun& a, const BlockRun& b) { kernels.finish(a, b, inverse, x); };
  const int last = nodes() - 1, start = first + 1;
  at_once_or_by_turns(subtract, {below, start, 1, middle_ - start}, {above, last - 1, -1, last - middle_ - 1});
  if (middle_ >= start) subtract({below, middle_, 1, 1}, {});
  if (middle_ < last) subtract({above, middle_, -1, 1}, {});
  apply_pivot(static_cast<std::size_t>(middle_), node_part<B>(x, middle_));
  at_once_or_by_turns(finish, {above, middle_ - 1, -1, middle_}, {below, middle_ + 1, 1, last - middle_});
}

template <int B>
void BorderedBlockTridiagonal<B>::substitute(double* x, std::size_t first) const {
  if constexpr (B == 4) {
    if (!solves_) return substitute_by_kernels(x, static_cast<int>(first));
  }
  const int last = nodes() - 1, middle = middle_;
  const Block *const below = lower.data(), *const above = upper.data();
  const auto subtract = [x](const Block* by, int k, int from) {
    node_part<B>(x, k).noalias() -= by[k] * node_part<B>(x, from);
  };
  const auto finish = [=, this](const Block* by, int k, int from) {
    subtract(by, k, from);
    apply_pivot(static_cast<std::size_t>(k), node_part<B>(x, k));
  };
  const int start = static_cast<int>(first) + 1;
  side_by_side(
      is_long(), middle - start, [=](int i) { subtract(below, start + i, start + i - 1); }, last - middle - 1,
      [=](int i) { subtract(above, last - 1 - i, last - i); });
  if (middle >= start) subtract(below, middle, middle - 1);
  if (middle < last) subtract(above, middle, middle + 1);
  apply_pivot(static_cast<std::size_t>(middle), node_part<B>(x, middle));
  side_by_side(
      is_long(), middle, [=](int i) { finish(above, middle - 1 - i, middle - i); }, last - middle,
      [=](int i) { finish(below, middle + 1 + i, middle + i); });
}

template class BorderedBlockTridiagonal<2>;
template class BorderedBlockTridiagonal<4>;
template class BorderedBlockTridiagonal<6>;
template class BorderedBlockTridiagonal<7>;

}  // namespace vlbeam
