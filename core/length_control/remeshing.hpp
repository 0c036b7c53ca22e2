#pragma once

#include "core/element/moving_element.hpp"
#include "core/length_control/chain_state.hpp"
#include "core/length_control/length_control.hpp"
#include "core/length_control/merging.hpp"

namespace vlbeam {

/// Cuts and merges at the joint chain.joints[which]. With both, the number of nodes stays and the joint moves on by one
/// node. The outer nodes keep coordinates and rates (Ding & Ouyang 2022, section 4), except slopes that the merge
/// policy changes.
template <int D>
MergedWeights segment_and_merge(ChainState<D>& chain, std::size_t which, Direction direction, const Remeshing& what,
                                const LengthControl& control, const MovingLaw<D>& law);

/// Deletes the only joint, before the last element (forward) or the first one (backward) vanishes. The element behind
/// it is cut at L_std from the end of the beam, or half way to the next fixed node if that is nearer. The two
/// elements at the moving node become one, inside which the mass now rides. The number of nodes stays; the cut is
/// node `joint`.
template <int D>
MergedWeights merge_at_end(ChainState<D>& chain, Direction direction, const LengthControl& control,
                           const MovingLaw<D>& law);

/// Gives the mass inside the last or the first element a moving node, the only joint. The element is cut there, and the
/// next fixed node deleted, so the number of nodes stays. Undoes merge_at_end(), except for shapes.
template <int D>
MergedWeights cut_at_end(ChainState<D>& chain, const LengthControl& control, const MovingLaw<D>& law);

/// The last joint leaves the beam at its last node (forward), or the first one at its first node (backward). The last
/// element, about to vanish, goes, too. The element behind it is continued to the end, with its curve and velocity, and
/// cut at L_std from the end, where the uniform mesh lacks a node; not where another joint is nearer than that.
template <int D>
void separate(ChainState<D>& chain, Direction direction, const LengthControl& control, WeightTransport transport);

}  // namespace vlbeam
