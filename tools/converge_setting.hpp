#pragma once

#include <string>

#include "scene/integrator_type.hpp"
#include "scene/scene.hpp"
#include "tools/converge.hpp"

namespace vlbeam {

/// Whether time is refined by the step, else by the tolerance; and the name of what is refined.
inline bool has_step(const Scene& scene) { return has_fixed_step(scene.integrator.type) && !scene.integrator.adaptive; }
inline std::string accuracy_name(const Scene& scene) { return has_step(scene) ? "step" : "rtol"; }

/// The scene on another mesh. Node numbers name the same material points there; throws InvalidInput where a node would
/// fall between two others. Whether the scene can be modelled so is not checked.
Scene on_mesh(const Scene& scene, int elements, int points);
/// The scene whose steps err by `share` of what they are allowed to: all tolerances, and the longest step, whose error
/// grows with its cube. For methods that choose their steps.
Scene with_tolerance(const Scene& scene, double share);

/// A level in words.
std::string setting_text(const Scene& scene, const Setting& s);

}  // namespace vlbeam
