#pragma once

#include "studies/harness/study.hpp"

namespace vlbeam::defaults {

/// What scenes cost whose integrator is left to the program, and how far their positions are off in time: tables, a
/// figure and measured numbers, added to the report.
void add_cost(const StudyContext& context, StudyReport& report);

}  // namespace vlbeam::defaults
