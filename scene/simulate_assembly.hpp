#pragma once

#include "scene/assembly.hpp"
#include "scene/simulate.hpp"

namespace vlbeam {

/// Runs a scene of several beams and bodies. The scene has been validated.
RunResult simulate_assembly(const Scene& whole, const ProgressCallback& progress, const RunOutput& output);

}  // namespace vlbeam
