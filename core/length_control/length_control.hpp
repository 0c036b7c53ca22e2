#pragma once

#include "core/element/moving_element.hpp"
#include "core/length_control/chain_state.hpp"
#include "core/length_control/merge_policy.hpp"
#include "core/length_control/merging.hpp"

namespace vlbeam {

/// How the elements beside a moving node are kept near the standard length.
struct LengthControl {
  bool enabled = true;
  double standard_length = 0;  ///< L_std [m]
  double upper = 1.5;          ///< an element longer than upper (1 + hysteresis) L_std is cut
  double hysteresis = 1e-3;
  MergePolicy merge = MergePolicy::point_fit;
  bool rational = true;  ///< merged elements may have weights other than 1
  VelocityTransfer velocities = VelocityTransfer::nodal;

  double trigger_length() const { return upper * (1 + hysteresis) * standard_length; }
};

/// Which way the moving node goes relative to the fixed ones.
enum class Direction { forward, backward };

/// The element behind the moving node is cut at L_std from its far end, and the node ahead deleted: the two elements
/// there become one. Nodes keep their number and `joint` moves on by one; nodal coordinates and rates of the outer
/// nodes are kept (Ding & Ouyang 2022, section 4), but for slopes that the merge policy changes. `backward` is the
/// mirror image.
template <int D>
MergedWeights segment_and_merge(ChainState<D>& chain, Direction direction, const LengthControl& control,
                                StrainLaw strain_law, const MovingLaw<D>& law);

/// The moving node leaves the beam at its last node (forward) or first node (backward). The last element, about to
/// vanish, goes with it: curve and velocity of the element behind the node are continued to the end, and cut at L_std
/// from it, where the uniform mesh lacks a node.
template <int D>
void separate(ChainState<D>& chain, Direction direction, const LengthControl& control, WeightTransport transport);

}  // namespace vlbeam
