#pragma once

#include <optional>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Warns where gravity that acts at once on an unstrained beam makes it vibrate by more than a tenth of the strain
/// energy that the run has. What the fast vibrations of the beam bear under its weight is found by a few implicit steps
/// that damp them at once: they then have the strain energy of their equilibrium, and the run has as much in vibrations
/// about it. Slow motions, of falling and swinging, have hardly begun by then.
std::optional<Warning> sudden_gravity(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
