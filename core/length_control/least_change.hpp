#pragma once

#include "core/element/moving_element.hpp"
#include "core/length_control/chain_state.hpp"
#include "core/length_control/merging.hpp"

namespace vlbeam {

/// Gives element `merged` of `chain`, made of two elements of `before`, the shape that changes least, by the slopes of
/// its two nodes (inside the beam; a kinked joint keeps its slopes) and, for a `rational` one, by its weights. Of the
/// shapes that store the strain energy of the old ones it takes, over that element and its neighbours, the one nearest
/// in
///   integral of EA (eps - eps_old)^2 + EI (kappa - kappa_old)^2 + K |r - r_old|^2/l^4 dx + K/l c^2 |ln w|^2,
/// K = max(EI, EA l^2/1000), c = 0.03: the last term alone fixes the weights where the beam is straight and they change
/// nothing, so that they depend continuously on the curve (derived; not in the paper). Of a beam that is curved at rest
/// eps and kappa are from the rest shape, r is what the beam's position differs by from the rest shape's, turned as the
/// beam is, and w is over the weights of MergePolicy::rest_arc: a beam in its rest shape remains there. Where no
/// shape keeps the strain energy, as with two slopes alone, the one that changes it least. Returns the weights.
template <int D>
MergedWeights least_change(ChainState<D>& chain, const ChainState<D>& before, int merged, bool rational,
                           const MovingLaw<D>& law);

extern template MergedWeights least_change(ChainState<2>&, const ChainState<2>&, int, bool, const MovingLaw<2>&);
extern template MergedWeights least_change(ChainState<3>&, const ChainState<3>&, int, bool, const MovingLaw<3>&);

}  // namespace vlbeam
