#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/beam/block_tridiagonal.hpp"
#include "core/beam/chain_view.hpp"
#include "core/beam/support.hpp"

namespace vlbeam {

/// The tangent of a beam's equations. Nodes are its blocks; its border holds, as coordinates do, the material
/// coordinates of joints and the slopes behind kinks, then whatever else is added. In space each node may have an
/// angle, too: these stand behind all nodes and the border, which reaches no far node then.
template <int D>
class BeamMatrix : public BorderedBlockTridiagonal<node_size<D>> {
 public:
  static constexpr int B = node_size<D>;
  using Base = BorderedBlockTridiagonal<B>;
  using Base::add_border, Base::border, Base::corner, Base::diagonal, Base::lower, Base::upper;
  using typename Base::Block;
  using WideBlock = Eigen::Matrix<double, B + 1, B + 1>;

  /// A zero matrix of so many nodes, with the border of these joints.
  void start(int nodes, std::span<const JointPlace> joints) {
    Base::reset(nodes);
    turns_ = false;
    of_angles_.clear();
    for (const JointPlace& joint : joints) add_border(std::max(0, joint.node - 1));
    for (const JointPlace& joint : joints) {
      for (int c = 0; c < (joint.behind < 0 ? 0 : D); ++c) add_border(std::max(0, joint.node - 1));
    }
  }

  void solve_pivots() {
    Base::solve_pivots();
    wide_.solve_pivots();
  }

  /// Gives each node an angle.
  void add_angles() requires(D == 3) {
    turns_ = true;
    wide_.reset(Base::nodes());
  }

  /// Adds the coupling of two nodes that are neighbours or the same: position, slope and angle each.
  void add_turning(int row, int column, const WideBlock& block) requires(D == 3) {
    const auto i = static_cast<std::size_t>(row);
    (row == column ? diagonal : column > row ? upper : lower)[i] += block.template topLeftCorner<B, B>();
    WideBlock& wide = (row == column ? wide_.diagonal : column > row ? wide_.upper : wide_.lower)[i];
    wide.col(B) += block.col(B);
    wide.row(B).template head<B>() += block.row(B).template head<B>();
  }
  /// The same of the element between node k and the next.
  template <class Matrix>
  void add_turning_element(int k, const Matrix& matrix) requires(D == 3) {
    constexpr int W = B + 1;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) add_turning(k + i, k + j, matrix.template block<W, W>(i * W, j * W));
    }
  }
  /// The same where ends of it are joints: rows and columns 14 and 15 belong to the material coordinates of the joints
  /// marks[e], if to any.
  template <class Matrix>
  void add_turning_at_joints(int k, const Matrix& matrix, const std::array<int, 2>& marks) requires(D == 3) {
    constexpr int W = B + 1, X = 2 * W;
    add_turning_element(k, matrix);
    of_angles_.resize(border.size());
    for (int e = 0; e < 2; ++e) {
      const int mark = marks[static_cast<std::size_t>(e)];
      if (mark < 0) continue;
      auto& b = border[static_cast<std::size_t>(mark)];
      auto& angles = of_angles_[static_cast<std::size_t>(mark)];
      for (int end = 0; end < 2; ++end) {
        const auto here = static_cast<std::size_t>(k + end - b.first);
        b.column[here] += matrix.template block<B, 1>(end * W, X + e);
        b.row[here] += matrix.template block<1, B>(X + e, end * W).transpose();
        angles.column[here] += matrix(end * W + B, X + e);
        angles.row[here] += matrix(X + e, end * W + B);
      }
      for (int f = 0; f < 2; ++f) {
        const int other = marks[static_cast<std::size_t>(f)];
        if (other >= 0) corner(mark, other) += matrix(X + e, X + f);
      }
    }
  }
  /// Couples an unknown of the border with the angle of a node that it reaches, the `reached`th of them.
  void tie_angle(int unknown, std::size_t reached, double size) requires(D == 3) {
    of_angles_.resize(border.size());
    OfAngles& angles = of_angles_[static_cast<std::size_t>(unknown)];
    angles.column[reached] = angles.row[reached] = size;
  }
  /// Adds to what a node's slope does to itself.
  void add_slope_stiffness(int node, const Eigen::Matrix<double, D, D>& matrix) {
    diagonal[static_cast<std::size_t>(node)].template bottomRightCorner<D, D>() += matrix;
  }

  void fix(int unknown, double size) {
    Base::fix(unknown, size);
    if (static_cast<std::size_t>(unknown) < of_angles_.size()) of_angles_[static_cast<std::size_t>(unknown)] = {};
  }

  bool factor() {
    if constexpr (D == 3) {
      if (turns_) {
        widen_border();
        for (std::size_t k = 0; k < diagonal.size(); ++k) {
          wide_.diagonal[k].template topLeftCorner<B, B>() = diagonal[k];
          wide_.upper[k].template topLeftCorner<B, B>() = upper[k];
          wide_.lower[k].template topLeftCorner<B, B>() = lower[k];
        }
        return wide_.factor();
      }
    }
    return Base::factor();
  }
  void solve(double* x) const {
    if constexpr (D == 3) {
      if (turns_) {
        const Eigen::Index n = Base::nodes(), more = Base::borders(), angles = B * n + more;
        work_.resize((B + 1) * n + more);
        for (Eigen::Index k = 0; k < n; ++k) {
          work_.template segment<B>((B + 1) * k) = Eigen::Map<const typename Base::Vector>(x + B * k);
          work_[(B + 1) * k + B] = x[angles + k];
        }
        for (Eigen::Index i = 0; i < more; ++i) work_[(B + 1) * n + i] = x[B * n + i];
        wide_.solve(work_.data());
        for (Eigen::Index k = 0; k < n; ++k) {
          Eigen::Map<typename Base::Vector>(x + B * k) = work_.template segment<B>((B + 1) * k);
          x[angles + k] = work_[(B + 1) * k + B];
        }
        for (Eigen::Index i = 0; i < more; ++i) x[B * n + i] = work_[(B + 1) * n + i];
        return;
      }
    }
    Base::solve(x);
  }
  int negative_pivots(double zero) const {
    if constexpr (D == 3) {
      if (turns_) return wide_.negative_pivots(zero);
    }
    return Base::negative_pivots(zero);
  }
  void expand(Eigen::MatrixXd& dense) const {
    Base::expand(dense);
    if constexpr (D == 3) {
      const Eigen::Index n = Base::nodes(), first = B * n + Base::borders();
      const auto put = [&](Eigen::Index row, Eigen::Index column, const WideBlock& block) {
        dense.block<B, 1>(B * row, first + column) = block.template topRightCorner<B, 1>();
        dense.block<1, B>(first + row, B * column) = block.template bottomLeftCorner<1, B>();
        dense(first + row, first + column) = block(B, B);
      };
      for (Eigen::Index k = 0; turns_ && k < n; ++k) {
        const auto i = static_cast<std::size_t>(k);
        put(k, k, wide_.diagonal[i]);
        if (k + 1 < n) put(k, k + 1, wide_.upper[i]);
        if (k > 0) put(k, k - 1, wide_.lower[i]);
      }
      for (std::size_t j = 0; turns_ && j < of_angles_.size(); ++j) {
        const Eigen::Index own = B * n + static_cast<Eigen::Index>(j);
        for (int i = 0; i < Base::reach && border[j].first + i < n; ++i) {
          const Eigen::Index angle = first + border[j].first + i;
          dense(angle, own) = of_angles_[j].column[static_cast<std::size_t>(i)];
          dense(own, angle) = of_angles_[j].row[static_cast<std::size_t>(i)];
        }
      }
    }
  }

  /// Coordinates of nodes: those behind them are the border's.
  Eigen::Index nodal() const { return Eigen::Index{B} * Base::nodes(); }

  /// The entry of two coordinates, of nodes next to each other or of the border and a node that it reaches.
  double& entry(Eigen::Index row, Eigen::Index column) {
    const Eigen::Index n = nodal();
    if (row >= n && column >= n) return corner(row - n, column - n);
    const auto of = [](Eigen::Index at) { return static_cast<std::size_t>(at / B); };
    const auto reached = [&](const typename Base::Border& b, Eigen::Index at) {
      return of(at) - static_cast<std::size_t>(b.first);
    };
    if (column >= n) {
      auto& b = border[static_cast<std::size_t>(column - n)];
      return b.column[reached(b, row)][row % B];
    }
    if (row >= n) {
      auto& b = border[static_cast<std::size_t>(row - n)];
      return b.row[reached(b, column)][column % B];
    }
    auto& band = of(row) == of(column) ? diagonal : of(column) > of(row) ? upper : lower;
    return band[of(row)](row % B, column % B);
  }

  /// Adds the matrix of element k, for its nodal vectors in order. Its row and column 4 D + e belong to the material
  /// coordinate of joint marks[e], if to any.
  template <class Matrix>
  void add_element(const ChainView<D>& beam, int k, const Matrix& matrix, const std::array<int, 2>& marks = {-1, -1}) {
    const JointPlace* const start = beam.joint_at(k);
    if (start != nullptr && start->behind >= 0) return add_behind_kink(beam, k, matrix, marks);
    constexpr int X = 4 * D;
    const auto i = static_cast<std::size_t>(k);
    diagonal[i] += matrix.template block<B, B>(0, 0);
    upper[i] += matrix.template block<B, B>(0, B);
    lower[i + 1] += matrix.template block<B, B>(B, 0);
    diagonal[i + 1] += matrix.template block<B, B>(B, B);
    for (int e = 0; e < 2; ++e) {
      const int mark = marks[static_cast<std::size_t>(e)];
      if (mark < 0) continue;
      auto& b = border[static_cast<std::size_t>(mark)];
      const auto here = static_cast<std::size_t>(k - b.first);
      for (int end = 0; end < 2; ++end) {
        b.column[here + static_cast<std::size_t>(end)] += matrix.template block<B, 1>(end * B, X + e);
        b.row[here + static_cast<std::size_t>(end)] += matrix.template block<1, B>(X + e, end * B).transpose();
      }
      for (int f = 0; f < 2; ++f) {
        const int other = marks[static_cast<std::size_t>(f)];
        if (other >= 0) corner(mark, other) += matrix(X + e, X + f);
      }
    }
  }

  /// The same of a point inside element k, with a row and a column for the material coordinate of each of its ends.
  template <class Matrix>
  void add_point(const ChainView<D>& beam, int k, const Matrix& matrix) {
    const auto mark = [&](int node) {
      const JointPlace* const joint = beam.joint_at(node);
      return joint == nullptr ? -1 : static_cast<int>(joint - beam.joints.data());
    };
    add_element(beam, k, matrix, {mark(k), mark(k + 1)});
  }

  /// Adds a mass, or the like, to the place of a node.
  void add_mass(int node, double mass) {
    diagonal[static_cast<std::size_t>(node)].template topLeftCorner<D, D>().diagonal().array() += mass;
  }

  /// Takes what a support holds at a node, and at the slope behind a kink there, out of rows and columns, and leaves
  /// its stiffness in its place.
  void hold(int node, Eigen::Index behind, const Support<D>& support) {
    const bool angle = !turns_ || support.free_angle;
    if ((support.free_position > 0).all() && (support.free_slope > 0).all() && angle) return;
    using Keep = Eigen::Matrix<double, D, D>;
    const auto kept = [&](const typename Support<D>::Components& free) {
      return Keep(support.frame * free.matrix().asDiagonal() * support.frame.transpose());
    };
    Block keep = Block::Zero();
    keep.template topLeftCorner<D, D>() = kept(support.free_position);
    keep.template bottomRightCorner<D, D>() = kept(support.free_slope);
    const auto k = static_cast<std::size_t>(node);
    const auto sizes = diagonal[k].diagonal().cwiseAbs().eval();
    const double slope_size = sizes.template tail<D>().maxCoeff() > 0 ? sizes.template tail<D>().maxCoeff() : 1;
    typename Base::Vector size;  // of what is fixed: slopes have another unit
    size.template head<D>().setConstant(sizes.template head<D>().maxCoeff());
    size.template tail<D>().setConstant(slope_size);
    diagonal[k] = keep * diagonal[k] * keep + size.asDiagonal() * (Block::Identity() - keep);
    if (k + 1 < diagonal.size()) {
      upper[k] = keep * upper[k];
      lower[k + 1] = lower[k + 1] * keep;
    }
    if (k > 0) {
      lower[k] = keep * lower[k];
      upper[k - 1] = upper[k - 1] * keep;
    }
    if constexpr (D == 3) {
      if (turns_) hold_angles(k, keep, support.free_angle);
      for (std::size_t j = 0; j < of_angles_.size() && !support.free_angle; ++j) {
        const int reached = node - border[j].first;
        if (reached < 0 || reached >= Base::reach) continue;
        of_angles_[j].column[static_cast<std::size_t>(reached)] = of_angles_[j].row[static_cast<std::size_t>(reached)] =
            0;
      }
    }
    for (auto& b : border) {
      if (b.far == node) {
        b.far_column = keep * b.far_column;
        b.far_row = keep * b.far_row;
      }
      const int reached = node - b.first;
      if (reached < 0 || reached >= Base::reach) continue;
      auto& column = b.column[static_cast<std::size_t>(reached)];
      auto& row = b.row[static_cast<std::size_t>(reached)];
      column = keep * column;
      row = keep * row;
    }
    if (behind >= 0) hold_border(behind - nodal(), kept(support.free_slope), slope_size);
  }

 private:
  /// What couples an unknown of the border to the angles of the nodes that it reaches.
  struct OfAngles {
    std::array<double, Base::reach> column{}, row{};
  };
  /// Makes the border that of the wide blocks.
  void widen_border() {
    wide_.border.clear();
    wide_.corner = corner;
    for (std::size_t j = 0; j < border.size(); ++j) {
      auto& wide = wide_.add_border(border[j].first);
      wide.first = border[j].first;
      for (std::size_t i = 0; i < Base::reach; ++i) {
        wide.column[i].template head<B>() = border[j].column[i];
        wide.row[i].template head<B>() = border[j].row[i];
        if (j >= of_angles_.size()) continue;
        wide.column[i][B] = of_angles_[j].column[i];
        wide.row[i][B] = of_angles_[j].row[i];
      }
    }
  }

  /// Of node k: what couples to angles, in the directions that a support leaves, and its own angle.
  void hold_angles(std::size_t k, const Block& keep, bool free) {
    const auto column = [&](WideBlock& block) {
      block.template topRightCorner<B, 1>() = (keep * block.template topRightCorner<B, 1>()).eval();
    };
    const auto row = [&](WideBlock& block) {
      block.template bottomLeftCorner<1, B>() = (block.template bottomLeftCorner<1, B>() * keep).eval();
    };
    column(wide_.diagonal[k]), column(wide_.upper[k]), column(wide_.lower[k]);
    row(wide_.diagonal[k]);
    if (k + 1 < wide_.lower.size()) row(wide_.lower[k + 1]);
    if (k > 0) row(wide_.upper[k - 1]);
    if (free) return;
    const double size = wide_.diagonal[k](B, B);
    wide_.diagonal[k].row(B).setZero(), wide_.diagonal[k].col(B).setZero();
    wide_.upper[k].row(B).setZero(), wide_.lower[k].row(B).setZero();
    if (k + 1 < wide_.lower.size()) wide_.lower[k + 1].col(B).setZero();
    if (k > 0) wide_.upper[k - 1].col(B).setZero();
    wide_.diagonal[k](B, B) = size > 0 ? size : 1;
  }

  /// Keeps a part of D unknowns of the border.
  void hold_border(Eigen::Index at, const Eigen::Matrix<double, D, D>& keep, double size) {
    for (std::size_t n = 0; n < Base::reach; ++n) {
      Eigen::Matrix<double, B, D> columns, rows;
      for (int c = 0; c < D; ++c) {
        columns.col(c) = border[static_cast<std::size_t>(at + c)].column[n];
        rows.col(c) = border[static_cast<std::size_t>(at + c)].row[n];
      }
      columns = (columns * keep).eval();
      rows = (rows * keep).eval();
      for (int c = 0; c < D; ++c) {
        border[static_cast<std::size_t>(at + c)].column[n] = columns.col(c);
        border[static_cast<std::size_t>(at + c)].row[n] = rows.col(c);
      }
    }
    corner.template middleRows<D>(at) = (keep * corner.template middleRows<D>(at)).eval();
    corner.template middleCols<D>(at) = (corner.template middleCols<D>(at) * keep).eval();
    corner.template block<D, D>(at, at) += size * (Eigen::Matrix<double, D, D>::Identity() - keep);
  }

  template <class Matrix>
  void add_behind_kink(const ChainView<D>& beam, int k, const Matrix& matrix, const std::array<int, 2>& marks) {
    std::array<Eigen::Index, 4 * D + 2> at{};  // where the rows stand, -1 where there is none
    at.fill(-1);
    for (int i = 0; i < 4 * D; ++i) at[static_cast<std::size_t>(i)] = beam.vector(k, i / D) + i % D;
    for (std::size_t e = 0; e < 2; ++e) {
      if (marks[e] >= 0) at[4 * D + e] = nodal() + marks[e];
    }
    for (int i = 0; i < matrix.rows(); ++i) {
      for (int j = 0; j < matrix.cols(); ++j) {
        const Eigen::Index row = at[static_cast<std::size_t>(i)], column = at[static_cast<std::size_t>(j)];
        if (row >= 0 && column >= 0) entry(row, column) += matrix(i, j);
      }
    }
  }

  bool turns_ = false;
  /// Until it is factored, of its blocks the last row and column alone.
  BorderedBlockTridiagonal<D == 3 ? B + 1 : B> wide_;
  std::vector<OfAngles> of_angles_;  ///< of the border, as far as any was added
  mutable Eigen::VectorXd work_;
};

}  // namespace vlbeam
