#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// What validate() checks of a scene that spins, flows or has rotary inertia. Throws InvalidInput.
void validate_flow(const Scene& scene);

}  // namespace vlbeam
