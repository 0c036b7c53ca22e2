#pragma once

#include "scene/assembly.hpp"

namespace vlbeam {

/// Throws InvalidInput where beams, bodies and links have no names of their own.
void check_names(const AssemblySpec& parts);

/// Throws InvalidInput where names, links, bodies or beams of a scene do not go together.
void validate_assembly(const Scene& whole);

}  // namespace vlbeam
