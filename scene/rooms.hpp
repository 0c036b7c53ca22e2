#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Throws InvalidInput where a scene asks for a room of mechanics/ that this program was built without, by its key.
void refuse_missing_rooms(const Scene& scene);

/// Whether the integrators of SUNDIALS are there.
bool knows_sundials();

}  // namespace vlbeam
