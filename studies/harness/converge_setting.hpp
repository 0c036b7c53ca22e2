#pragma once

#include <string>

#include "core/dynamics/integrator_type.hpp"
#include "scene/scene.hpp"
#include "studies/harness/converge.hpp"

namespace vlbeam {

/// Whether time is refined by the step, else by the tolerance; and the name of what is refined.
inline bool has_step(const Scene& scene) { return has_fixed_step(scene.integrator.type) && !scene.integrator.adaptive; }
inline std::string accuracy_name(const Scene& scene) { return has_step(scene) ? "step" : "rtol"; }
/// A level in words.
std::string setting_text(const Scene& scene, const Setting& s);

}  // namespace vlbeam
