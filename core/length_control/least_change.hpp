#pragma once

#include "core/element/moving_element.hpp"
#include "core/length_control/chain_state.hpp"
#include "core/length_control/merging.hpp"

namespace vlbeam {

/// Gives element `merged` of `chain` the shape that changes least. It is made of two elements of `before`. Free are the
/// slopes of its two nodes (inside the beam; a kinked joint keeps its slopes) and, if it is `rational`, its weights. Of
/// all shapes that store the old strain energy it takes, over that element and its neighbours, the one with the least
///
///   integral of EA (eps - eps_old)^2 + EI (kappa - kappa_old)^2 + K |r - r_old|^2/l^4 dx + K/l c^2 |ln w|^2,
/// K = max(EI, EA l^2/1000), c = 0.03 (derived; not in the paper). Where the beam is straight, weights change nothing;
/// the last term fixes them there, so that they depend continuously on the curve. If the beam is curved at rest, eps
/// and kappa count from the rest shape; r is the displacement from the rest shape, turned as the beam is; w is relative
/// to the weights of MergeShape::rest_arc. So a beam in its rest shape remains there. If no shape keeps the strain
/// energy, as with two slopes alone, it takes the one that changes it least. Returns the weights.
template <int D>
MergedWeights least_change(ChainState<D>& chain, const ChainState<D>& before, int merged, bool rational,
                           const MovingLaw<D>& law);

extern template MergedWeights least_change(ChainState<2>&, const ChainState<2>&, int, bool, const MovingLaw<2>&);
extern template MergedWeights least_change(ChainState<3>&, const ChainState<3>&, int, bool, const MovingLaw<3>&);

}  // namespace vlbeam
