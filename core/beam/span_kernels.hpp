#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/beam/node_map.hpp"
#include "core/element/fixed_element.hpp"
#include "core/element/rest_strain.hpp"
#include "core/instruction_set.hpp"
#include "core/pack.hpp"
#include "core/tangent_weights.hpp"

namespace vlbeam {

/// What elements of equal length and weights share: their bases, four to a pack, and rhoA times their constant
/// matrices.
struct PackTables {
  FixedBasis<Pack> basis;
  std::vector<RestStrain<Pack>> rest;  ///< at the points of the basis; empty without a rest shape
  FixedInertiaOf<Pack> inertia;

  FixedInertia inertia_of(int lane) const {
    FixedInertia one;
    for (std::size_t i = 0; i < 4; ++i) {
      one.load[i] = inertia.load[i][lane];
      for (std::size_t j = 0; j < 4; ++j) one.mass[i][j] = inertia.mass[i][j][lane];
    }
    return one;
  }
  void set_inertia(int lane, const FixedInertia& from) {
    for (std::size_t i = 0; i < 4; ++i) {
      inertia.load[i].set(lane, from.load[i]);
      for (std::size_t j = 0; j < 4; ++j) inertia.mass[i][j].set(lane, from.mass[i][j]);
    }
  }
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
  /// Adds elastic and viscous forces and weight to the nodal array `force`; returns the dissipated power [W].
  double (*forces)(Packs packs, const BeamSection& section, const double* q, const double* rate,
                   const Vec<double, D>& gravity, double* force);
  /// Adds inertia, of the nodal accelerations `a`, less those forces; returns the same.
  double (*residual)(Packs packs, const BeamSection& section, const double* q, const double* rate, const double* a,
                     const Vec<double, D>& gravity, double* residual);
  /// Adds inertia alone.
  void (*inertia)(Packs packs, const double* a, double* out);
  /// Adds the forces, times `scale`, that a curved or strained rest shape adds.
  void (*rest_forces)(Packs packs, const BeamSection& section, const double* q, double scale, double* out);
  /// As Span::add_tangent.
  void (*tangents)(Packs packs, const BeamSection& section, const double* q, const double* rate,
                   const TangentWeights& by, NodeTangent<D>* diagonal, NodeTangent<D>* upper, NodeTangent<D>* lower);
  /// Adds the tangent of minus those of a rest shape, times `by_q`.
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
