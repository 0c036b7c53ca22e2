#pragma once

#include "scene/assembly.hpp"

namespace vlbeam {

/// Throws InvalidInput where names, links, bodies or beams of a scene do not go together.
void validate_assembly(const Scene& whole);

}  // namespace vlbeam
