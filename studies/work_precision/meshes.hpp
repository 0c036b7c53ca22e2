#pragma once

#include "studies/work_precision/runs.hpp"

namespace vlbeam::work_precision {

/// Total error of the falling beam against work and time over meshes, elements, integrators and their rungs, split into
/// what the mesh and what the integrator leaves. `converged` is the state of a far finer mesh.
void compare_meshes(StudyReport& report, const StudyContext& context, const State& converged);

}  // namespace vlbeam::work_precision
