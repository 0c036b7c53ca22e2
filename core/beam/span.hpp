#pragma once

#include <memory>
#include <vector>

#include "core/beam/mesh.hpp"
#include "core/beam/node_block.hpp"
#include "core/beam/node_map.hpp"
#include "core/beam/support.hpp"
#include "core/element/fixed_element.hpp"
#include "core/element/pack.hpp"

namespace vlbeam {

/// A run of fixed-length elements from an end of the beam, with its support, up to an open node where something else
/// carries on. Its mass matrix is constant: factored once, block by block from the supported end, so that a
/// right-hand side costs one sweep towards the open node and one back. A span may hold no element at all.
template <int D>
class Span {
 public:
  using Vector = Vec<double, D>;
  using Components = typename Support<D>::Components;

  /// Elements of `mesh` between nodes `outer` and `open`, `open` on either side. Throws std::invalid_argument for a
  /// mass matrix that is not positive definite (too few quadrature points).
  Span(const Mesh& mesh, int outer, int open, const Support<D>& support, const BeamSection& section, StrainLaw law,
       const QuadratureRule& rule);

  /// Adds elastic, viscous and gravity forces to the nodal array `force`; returns the dissipated power [W].
  double add_forces(const double* q, const double* rate, const Vector& gravity, double* force) const;

  /// Eliminates all nodes but the open one from M a = force: `force` then holds, in the support's frame, what
  /// `substitute` needs, and at the open node the reduced force, in global components.
  void reduce(double* force) const;

  /// Accelerations of the span's nodes, given that of the open node (global components), in place of the forces.
  void substitute(double* force) const;

  int open() const { return open_; }
  const Support<D>& support() const { return support_; }
  /// Mass left at the open node once the others are eliminated, in the support's frame.
  const NodeBlock<D>& open_mass() const { return open_mass_; }
  /// What the support leaves free at the open node: everything, unless the span has no element.
  Components open_free_position() const { return outer_ == open_ ? support_.free_position : Components::Ones(); }
  Components open_free_slope() const { return outer_ == open_ ? support_.free_slope : Components::Ones(); }

 private:
  struct PackOfElements {
    int first;
    int count;
    std::shared_ptr<const FixedBasis<Pack>> basis;
  };
  /// One elimination step: inverse of the node's block, and inverse times coupling to the next node inwards.
  struct Pivot {
    NodeBlock<D> inverse;
    CouplingBlock<Components> next;
  };
  using ForceKernel = double (*)(const std::vector<PackOfElements>&, const BeamSection&, const double*, const double*,
                                 double*);

  template <StrainLaw Law, bool Bending, bool Damped>
  static double pack_forces(const std::vector<PackOfElements>& packs, const BeamSection& section, const double* q,
                            const double* rate, double* force);
  static ForceKernel choose_kernel(StrainLaw law, const BeamSection& section);
  void build_packs(const Mesh& mesh, const QuadratureRule& rule);
  void factor(const Mesh& mesh, const QuadratureRule& rule);

  int outer_, open_, step_;  ///< step_ is +1 or -1: from the outer node towards the open one
  Support<D> support_;
  BeamSection section_;
  ForceKernel kernel_;
  std::vector<PackOfElements> packs_;
  std::vector<Pivot> pivots_;  ///< from the outer node inwards, without the open node
  NodeBlock<D> open_mass_;
  std::vector<std::array<double, 2>> load_;  ///< rhoA times the integral of a node's two shape functions, from low node
};

extern template class Span<2>;
extern template class Span<3>;

}  // namespace vlbeam
