#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Throws InvalidInput for blocks that tie no joints, or joints that cannot be tied.
void validate_blocks(const Scene& scene);

}  // namespace vlbeam
