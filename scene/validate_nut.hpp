#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Throws InvalidInput where a nut cannot run on the beam of this scene.
void validate_nut(const Scene& scene);

}  // namespace vlbeam
