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

/// Moves what gives way, while all other nodes stay, until `excess` [J] of the strain energy by `rule` is gone or the
/// least is reached, by Newton's iteration. Slopes behind kinks stay. Returns the iterations taken.
/// What it is for: a published cut keeps the curve, and a merge the outer nodes, but where the axial strain is sampled,
/// or locks, the energy of that curve in other elements is another one, the larger the stiffer the beam. No more than
/// what the event has created is taken away: a beam in motion is not at its least energy.
template <int D>
int relax(ChainState<D>& chain, std::vector<GivingNode> giving, const BeamRule& rule, const MovingLaw<D>& law,
          double excess = std::numeric_limits<double>::infinity());

}  // namespace vlbeam
