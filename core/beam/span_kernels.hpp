#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/beam/node_map.hpp"
#include "core/element/fixed_element.hpp"
#include "core/element/instruction_set.hpp"
#include "core/element/pack.hpp"
#include "core/element/rest_strain.hpp"
#include "core/tangent_weights.hpp"

namespace vlbeam {

/// What elements of equal length and weights share: their bases, four to a pack, and rhoA times their constant
/// matrices.
struct PackTables {
  FixedBasis<Pack> basis;
  std::vector<RestStrain<Pack>> rest;  ///< at the points of the basis; empty without a rest shape
  std::array<FixedInertia, Pack::width> inertia;
};

/// Neighbouring elements of fixed length, computed at once.
struct PackOfElements {
  int first;  ///< element
  int count;
  std::shared_ptr<const PackTables> tables;
};
using Packs = std::span<const PackOfElements>;

/// The sums over packs, in which most of the time of a run goes, compiled for one instruction set.
template <int D>
struct SpanKernels {
  /// Adds elastic and viscous forces to the nodal array `force`; returns the dissipated power [W].
  double (*forces)(Packs packs, const BeamSection& section, const double* q, const double* rate, double* force);
  /// Adds those that a curved or strained rest shape adds.
  void (*rest_forces)(Packs packs, const BeamSection& section, const double* q, double* force);
  /// As Span::add_tangent.
  void (*tangents)(Packs packs, const BeamSection& section, const double* q, const double* rate,
                   const TangentWeights& by, NodeTangent<D>* diagonal, NodeTangent<D>* upper, NodeTangent<D>* lower);
  /// Adds the tangent of minus what rest_forces() adds, times `by_q`.
  void (*rest_tangents)(Packs packs, const BeamSection& section, const double* q, double by_q, NodeTangent<D>* diagonal,
                        NodeTangent<D>* upper, NodeTangent<D>* lower);
};

/// Those for an instruction set that is available().
template <int D>
SpanKernels<D> span_kernels(InstructionSet set);

/// The fastest ones.
template <int D>
const SpanKernels<D>& span_kernels();

namespace portable {
template <int D>
SpanKernels<D> span_kernels();
}
namespace avx2 {
template <int D>
SpanKernels<D> span_kernels();
}

}  // namespace vlbeam
