#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/beam/lumped_mass.hpp"
#include "core/beam/mesh.hpp"
#include "core/beam/node_block.hpp"
#include "core/beam/span_kernels.hpp"
#include "core/beam/support.hpp"

namespace vlbeam {

/// A run of fixed-length elements from an end of the beam, with its support, up to an open node where something else
/// carries on. Its mass matrix is constant: factored once, block by block from the supported end, so that a
/// right-hand side costs one sweep towards the open node and one back. A span may hold no element at all.
template <int D>
class Span {
 public:
  using Vector = Vec<double, D>;
  using Components = typename Support<D>::Components;

  /// Elements of `mesh` between nodes `outer` and `open`, `open` on either side; `rest` holds the nodes of the
  /// rest shape, null for a straight, unstrained one; `masses` sit on the whole beam. Throws std::invalid_argument for
  /// a mass matrix that is not positive definite (too few quadrature points).
  /// `before`, a span of the same beam on another mesh, gives away what holds for its first `unchanged` elements,
  /// counted from the outer node, which are as they were there, rest shapes included: the cost is that of the others.
  Span(const Mesh& mesh, int outer, int open, const Support<D>& support, const BeamSections& sections,
       const BeamRules& rules, const double* rest, const std::vector<PointMass>& masses = {}, Span* before = nullptr,
       int unchanged = 0);

  static constexpr int all = std::numeric_limits<int>::max();

  /// Adds elastic, viscous and gravity forces to the nodal array `force`; returns the dissipated power [W].
  double add_forces(const double* q, const double* rate, const Vector& gravity, double* force) const;

  /// Adds the inertia M a of the nodal accelerations `a` less those forces to the nodal array `residual`; returns the
  /// same. Of at least so many elements next to the outer node: whole packs are computed.
  double add_residual(const double* q, const double* rate, const double* a, const Vector& gravity, double* residual,
                      int most = all) const;

  /// First moment of mass, the integral of rhoA r [kg m], by nodal positions; by their rates, the momentum.
  Vector first_moment(const double* q) const;

  /// Adds the inertia M a of the nodal accelerations `a` to the nodal array `out`: of all elements but so many next to
  /// the outer node, a multiple of Pack::width.
  void add_inertia(const double* a, double* out, int left_out = 0) const;

  /// Adds the tangent of M a minus the elastic and viscous forces to the node blocks of a block tridiagonal matrix:
  /// upper[k] couples node k to k + 1, lower[k] to k - 1.
  void add_tangent(const double* q, const double* rate, const TangentWeights& by, NodeTangent<D>* diagonal,
                   NodeTangent<D>* upper, NodeTangent<D>* lower) const;

  /// Eliminates all nodes but the open one from M a = force: `force` then holds, in the support's frame, what
  /// `substitute` needs, and at the open node the reduced force, in global components. So many outer nodes, on which no
  /// force acts, are not looked at.
  void reduce(double* force, int left_out = 0) const;

  /// Accelerations of the span's nodes, given that of the open node (global components), in place of the forces; of all
  /// but so many outer ones.
  void substitute(double* force, int left_out = 0) const;

  int open() const { return open_; }
  const Support<D>& support() const { return support_; }
  /// The support stands otherwise, and fixes the same components of its frame: what is factored does not know the
  /// frame.
  void stand_by(const Support<D>& support) { support_ = support; }
  /// Mass left at the open node once the others are eliminated, in the support's frame.
  const NodeBlock<D>& open_mass() const { return open_mass_; }
  /// What the support leaves free at the open node: everything, unless the span has no element.
  Components open_free_position() const { return outer_ == open_ ? support_.free_position : Components::Ones(); }
  Components open_free_slope() const { return outer_ == open_ ? support_.free_slope : Components::Ones(); }

 private:
  /// One elimination step: inverse of the node's block, and inverse times coupling to the next node inwards.
  struct Pivot {
    NodeBlock<D> inverse;
    CouplingBlock<Components> next;
    bool operator==(const Pivot&) const = default;
  };
  /// The steps of neighbouring nodes, which repeat themselves by turns: where elements are equal, elimination soon
  /// makes one step again and again, or, for rounding, two, four or eight.
  struct PivotRun {
    static constexpr int turns = 8;

    /// An empty run from `node` on; `any` only fills it.
    PivotRun(const Pivot& any, int node) : first(node), end(node) { pivots.fill(any); }

    std::array<Pivot, turns> pivots;  ///< that of node n is at n % turns
    int first, end;                   ///< nodes, counted from the outer one

    const Pivot& operator[](int node) const { return pivots[static_cast<std::size_t>(node) % turns]; }
  };
  /// Elements and nodes are counted from the outer node inwards.
  int element(int i) const { return step_ > 0 ? outer_ + i : outer_ - 1 - i; }
  int node(int i) const { return outer_ + step_ * i; }
  int count() const { return step_ * (open_ - outer_); }
  /// Lowest element of the pack `p`, which holds `count` elements.
  int first_of(int p, int count) const {
    return step_ > 0 ? element(p * Pack::width) : element(p * Pack::width + count - 1);
  }
  FixedInertia inertia(int i) const;
  Packs some_packs(std::ptrdiff_t first, std::ptrdiff_t n) const {
    return Packs(packs_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(n));
  }
  /// Takes from `before` what goes on to hold; returns for how many elements.
  int take_over(Span& before, int unchanged);
  void build_packs(const Mesh& mesh, const BeamRules& rules, const SectionPieces& pieces, const double* rest,
                   const std::vector<PointMass>& masses);
  void factor(int known);
  void add_pivot(const Pivot& pivot, int node);

  int outer_, open_, step_;  ///< step_ is +1 or -1: from the outer node towards the open one
  Support<D> support_;
  BeamSection section_;  ///< the beam's own: pieces of others are in the tables of their elements
  bool curved_at_rest_;
  std::vector<PackOfElements> packs_;
  std::vector<PivotRun> runs_;  ///< without the open node
  NodeBlock<D> open_mass_;
};

extern template class Span<2>;
extern template class Span<3>;

}  // namespace vlbeam
