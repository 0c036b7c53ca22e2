#pragma once

#include "studies/work_precision/runs.hpp"

namespace vlbeam::work_precision {

/// What steps and events cost against the number of elements, on one thread and on several: a mass that passes an
/// element a step, on beams of elements of equal length.
void compare_sizes(StudyReport& report, const StudyContext& context);

}  // namespace vlbeam::work_precision
