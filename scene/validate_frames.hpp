#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Refuses what does not go together with the law that a beam bends by in space, and sections that it needs to know
/// more of. Throws InvalidInput.
void validate_frames(const Scene& scene);

}  // namespace vlbeam
