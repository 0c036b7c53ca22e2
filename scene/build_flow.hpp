#pragma once

#include "core/length_control/chain_state.hpp"
#include "mechanics/motion/system/beam_model.hpp"
#include "scene/derived.hpp"

namespace vlbeam {

/// How the nodes of a scene that flows() travel, what holds inner ones, and rotary inertia. `along` is the axis.
/// Throws InvalidInput.
template <int D>
void add_flow(const Scene& scene, const Vec<double, D>& along, BeamModel<D>& model);

/// The initial mesh and motion of such a scene: straight, stretched by the tension, moving evenly.
template <int D>
ChainState<D> flowing_chain(const Scene& scene, const BeamModel<D>& model);

}  // namespace vlbeam
