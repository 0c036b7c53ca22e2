#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Checks the beam of a scene: its axis, its section and material, its elements. Throws InvalidInput.
void validate_beam(const Scene& scene);

}  // namespace vlbeam
