#pragma once

#include "studies/falling_beam/tables.hpp"
#include "tools/judged.hpp"

namespace vlbeam::falling_beam {

/// The converged reference with its own error, the independent codes, and the errors of all meshes against it.
void add_reference(StudyReport& report, const Runs& runs, const Times& times, const Json& independent);
/// Of the finest mesh also against the judge, whose last answer is given.
void add_mesh_convergence(StudyReport& report, const Runs& runs, const Times& times, const Judged& judged);

/// Convergence in quadrature points and in the integrator's tolerance, on fixed meshes.
void add_quadrature_convergence(StudyReport& report, const Runs& runs, const Times& times);
void add_temporal_convergence(StudyReport& report, const Runs& runs, const Times& times);

/// Digits of another program on the same meshes, and the order of the smooth, ramped twin.
void add_digits(StudyReport& report, const Runs& runs, const Json& independent);
void add_ramped_twin(StudyReport& report, const Runs& runs, const Json& config, const Json& independent);

}  // namespace vlbeam::falling_beam
