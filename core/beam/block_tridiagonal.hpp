#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/pieces.hpp"

namespace vlbeam {

/// A block tridiagonal matrix with blocks of `B` unknowns, one a node, and a few more unknowns, the border, each of
/// which couples to a few neighbouring nodes and, where it ties two places, to a far one: what a chain of elements with
/// a moving node and constraints makes of a Newton iteration. Factored once, solved many times; cost and memory are
/// proportional to the number of nodes.
template <int B>
class BorderedBlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, B, B>;
  using Vector = Eigen::Matrix<double, B, 1>;
  static constexpr int reach = 3;  ///< nodes that one unknown of the border couples to

  /// An unknown of the border: its coupling to the nodes from `first` on, and to one more, `far`, where it is not -1.
  struct Border {
    int first = 0;
    std::array<Vector, reach> column, row;
    int far = -1;
    Vector far_column = Vector::Zero(), far_row = Vector::Zero();
  };

  /// A zero matrix of `nodes` blocks without border.
  void reset(int nodes);

  /// One more unknown, which couples to nodes from `first` on, or just to the last ones before it where there are
  /// fewer.
  Border& add_border(int first);

  /// Uncouples an unknown of the border from all others, with `size` on the diagonal.
  void fix(int unknown, double size);

  int nodes() const { return static_cast<int>(diagonal.size()); }
  int borders() const { return static_cast<int>(border.size()); }

  /// Solves with each pivot from now on, by pivoting, instead of multiplying with its inverse. The inverse of a badly
  /// conditioned pivot errs most where the pivot is stiffest, and this error takes the place of what the elimination
  /// leaves of a stiff matrix in soft directions. Slower, and from one end as long as there are few nodes: what is
  /// singular but for rounding then comes last. The integrators do not need it, whose mass stiffens all directions.
  void solve_pivots() { solves_ = true; }

  /// Block LU from both ends to the middle, at once where there are many nodes and threads; then the small system that
  /// the border leaves. The factors take the place of the matrix. Returns false where a pivot is singular or not
  /// finite.
  bool factor();

  /// Solves in place; `x` holds B numbers a node, then the border's unknowns.
  void solve(double* x) const;

  /// Of the last factored matrix, which is symmetric, with pivots that are solved: how many of its eigenvalues are
  /// negative, by Sylvester's law those of its pivots, the last of which is the small matrix that the border leaves
  /// (Haynsworth 1968). One below `zero` of its block's diagonal counts as none.
  int negative_pivots(double zero) const;

  /// Writes the matrix, not yet factored, into the leading part of a dense one of zeros.
  void expand(Eigen::MatrixXd& dense) const;

  std::vector<Block> diagonal, upper, lower;  ///< upper[k] couples k to k + 1, lower[k] couples k to k - 1
  std::vector<Border> border;
  Eigen::MatrixXd corner;  ///< among the border's unknowns; new ones are zero, and any beyond them

 private:
  /// Whether it is worth the call of a thread.
  bool is_long() const { return std::ptrdiff_t{B} * nodes() >= long_range; }
  int reached(const Border& b) const { return std::min(reach, nodes() - b.first); }
  double row_times(const Border& b, const double* x) const;

  /// Returns false where it is singular or not finite.
  bool factor_pivot(int k, const Block& pivot);
  /// Eliminates its neighbour `from`, which is factored, from a node's row, whose pivot this becomes.
  void eliminate(int node, int from, Block& pivot);

  /// Makes of `x` the solution of pivot k.
  template <class Columns>
  void apply_pivot(std::size_t k, Columns&& x) const;

  /// Forward and back substitution of a right-hand side that is zero before node `first`.
  void substitute(double* x, std::size_t first) const;
  void substitute_by_kernels(double* x, int first) const;

  struct Pivot {
    Vector scale;
    Block scaled;
    Eigen::PartialPivLU<Block> lu;
  };

  bool solves_ = false;
  int middle_ = -1;                                 ///< node where the factorizations from both ends meet
  std::vector<Pivot> pivots_;                       ///< where they are solved
  std::vector<double> columns_;                     ///< the border's columns, solved
  Eigen::MatrixXd rest_;                            ///< of the corner, once the nodes are eliminated
  Eigen::PartialPivLU<Eigen::MatrixXd> corner_lu_;  ///< of that, scaled
  Eigen::VectorXd corner_scale_;
  mutable Eigen::VectorXd scaled_, solved_;
};

extern template class BorderedBlockTridiagonal<2>;
extern template class BorderedBlockTridiagonal<4>;
extern template class BorderedBlockTridiagonal<6>;
extern template class BorderedBlockTridiagonal<7>;

}  // namespace vlbeam
