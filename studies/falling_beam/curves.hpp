#pragma once

#include "studies/falling_beam/cases.hpp"

namespace vlbeam::falling_beam {

/// The data of all figures as tables, and the figures.
void add_figures(StudyReport& report, const Runs& runs, const StudyContext& context);

}  // namespace vlbeam::falling_beam
