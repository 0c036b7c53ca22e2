#pragma once

#include <limits>
#include <vector>

#include "core/element/beam_rule.hpp"
#include "core/element/moving_element.hpp"
#include "core/length_control/chain_state.hpp"

namespace vlbeam {

/// What gives way at a node.
struct GivingNode {
  int node;
  bool position, slope;
};

/// Moves what gives way, by Newton's iteration, until `excess` [J] of the strain energy by `rules` is gone or the least
/// is reached. All other nodes and slopes behind kinks stay. Returns the iterations taken. Why: a published cut keeps
/// the curve, and a merge the outer nodes. Where the axial strain is sampled, or locks, new elements store another
/// energy in that curve, the more the stiffer the beam. Only what the event has created is taken away, because a beam
/// in motion is not at its least energy.
template <int D>
int relax(ChainState<D>& chain, std::vector<GivingNode> giving, const BeamRules& rules, const MovingLaw<D>& law,
          double excess = std::numeric_limits<double>::infinity());

}  // namespace vlbeam
