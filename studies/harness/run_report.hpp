#pragma once

#include <string>

#include "core/scene/result.hpp"
#include "studies/harness/json.hpp"

namespace vlbeam {

/// The deterministic part of a run's report: status, scene, samples as columns, configurations, events, solver.
/// Positions have as many components as the scene has dimensions.
Json run_report(const Scene& scene, const RunResult& result);

/// Wall times of a run [s].
Json run_timing(const RunTiming& timing);

/// The samples as a table with one line of column names; empty cells where a quantity is not there.
std::string samples_csv(const Scene& scene, const RunResult& result);

/// A few lines for a reader at the terminal.
std::string run_summary(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
