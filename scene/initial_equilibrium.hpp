#pragma once

#include <functional>
#include <optional>

#include "mechanics/statics/equilibrium.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// How a scene wants its equilibria found.
EquilibriumOptions equilibrium_options(const Scene& scene);

/// What a sample says of an equilibrium.
inline StaticSample static_sample_of(const Equilibrium& at) {
  return {at.factor, at.negative_pivots, at.holding_force, at.hidden_pivots};
}

/// Where a motion starts, at rest.
template <int D>
struct InitialEquilibrium {
  ChainState<D> chain;
  StaticSample seen;
};

/// The equilibrium of a scene under gravity and loads as they are at t = 0, with supports and joints where they are
/// then. Calls `goes_on` at every equilibrium on the way, and returns nothing if it says false. Throws
/// ComputationFailed if there is no equilibrium.
template <int D>
std::optional<InitialEquilibrium<D>> initial_equilibrium(const Scene& scene, const std::function<bool()>& goes_on);

}  // namespace vlbeam
