#pragma once

#include "core/length_control/chain_state.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Lets sections stand at the nodes of a chain as the scene says, or else turned by nothing from one node to the next.
void add_frames(const Scene& scene, ChainState<3>& chain);

/// The twist per length beside a node, the mean of both sides [rad/m].
double twist_rate_at(const ChainState<3>& chain, int node);
/// By which the triads of a node turn about the tangent as it goes along the beam [rad/m]: as sections do, but for what
/// those of the curve `rest`, which the node follows, do otherwise than the elements at rest.
double turning_along(const ChainState<3>& chain, const Axis<3>& rest, int node);

}  // namespace vlbeam
