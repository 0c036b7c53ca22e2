#pragma once

#include "core/element/moving_tangent.hpp"
#include "core/instruction_set.hpp"

namespace vlbeam {

/// MovingElement<double, D, Ends>, all but masses without a rest shape, compiled for one instruction set.
template <int D, MovingEnds Ends>
struct MovingKernels {
  using Coordinates = MovingCoordinates<double, D>;

  MovingEquations<double, D> (*equations)(const Coordinates& q, const Coordinates& rate, const WeightFunction& weights,
                                          const ShapeTabulation& table, const MovingLaw<D>& law);
  MovingEquations<double, D> (*forces)(const Coordinates& q, const Coordinates& rate, const Coordinates& a,
                                       const WeightFunction& weights, const ShapeTabulation& table,
                                       const MovingLaw<D>& law);
  MovingEquations<double, D> (*masses)(const Coordinates& q, const WeightFunction& weights,
                                       const ShapeTabulation& table, const MovingLaw<D>& law);
  /// moving_tangent() without rest shape and damping: of one unknown end, or of two whose motion is given. Else null.
  MovingTangent<Ends, D> (*tangent)(const Coordinates& q, const Coordinates& rate, const Coordinates& a,
                                    const TangentWeights& by, const WeightFunction& weights,
                                    const ShapeTabulation& table, const MovingLaw<D>& law);
  MovingTangent<Ends, D, 0> (*driven_tangent)(const Coordinates& q, const Coordinates& rate, const Coordinates& a,
                                              const TangentWeights& by, const WeightFunction& weights,
                                              const ShapeTabulation& table, const MovingLaw<D>& law);
};

/// Those for an instruction set that is available().
template <int D, MovingEnds Ends>
MovingKernels<D, Ends> moving_kernels(InstructionSet set);

/// The fastest ones.
template <int D, MovingEnds Ends>
const MovingKernels<D, Ends>& fastest_moving_kernels();

namespace portable {
template <int D, MovingEnds Ends>
MovingKernels<D, Ends> moving_kernels();
template <int D, MovingEnds Ends, int Unknown>
MovingTangent<Ends, D, Unknown> moving_tangent(const MovingCoordinates<double, D>& q,
                                               const MovingCoordinates<double, D>& rate,
                                               const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                               const WeightFunction& weights, const ShapeTabulation& table,
                                               const MovingLaw<D>& law);
}  // namespace portable
namespace avx2 {
template <int D, MovingEnds Ends>
MovingKernels<D, Ends> moving_kernels();
template <int D, MovingEnds Ends, int Unknown>
MovingTangent<Ends, D, Unknown> moving_tangent(const MovingCoordinates<double, D>& q,
                                               const MovingCoordinates<double, D>& rate,
                                               const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                               const WeightFunction& weights, const ShapeTabulation& table,
                                               const MovingLaw<D>& law);
}  // namespace avx2

}  // namespace vlbeam
