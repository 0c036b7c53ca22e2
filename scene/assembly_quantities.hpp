#pragma once

#include "scene/sample_quantities.hpp"

namespace vlbeam {

/// sample_quantities() of several beams and bodies: those of each beam below its name, then bodies and links.
std::vector<SampleQuantity> assembly_quantities(const Scene& whole);

}  // namespace vlbeam
