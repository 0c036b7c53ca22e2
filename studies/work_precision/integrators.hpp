#pragma once

#include "studies/work_precision/runs.hpp"

namespace vlbeam::work_precision {

/// Every integrator on every problem: temporal error against right-hand sides and time, and what to use.
/// `references` holds the certified state of each problem and element.
void compare_integrators(StudyReport& report, const StudyContext& context, const Json& references);

/// What figures of the integrators of a study need: names, colours by family, marks.
GnuplotVariables style(const Json& config);

}  // namespace vlbeam::work_precision
