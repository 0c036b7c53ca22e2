#pragma once

#include "core/scene/scene.hpp"

namespace vlbeam {

/// What validate() checks of a scene that spins, flows or bears loads. Throws InvalidInput.
void validate_flow(const Scene& scene);

}  // namespace vlbeam
