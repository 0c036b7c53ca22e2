#pragma once

/// All that a program of one's own needs to run scenes: what the library of vlbeam offers to others.
///
///     const vlbeam::Scene scene = vlbeam::parse_scene(text);     // or read_scene(file)
///     const vlbeam::RunResult result = vlbeam::simulate(scene);  // result.status
///     std::cout << vlbeam::report(scene, result);                // JSON: vlbeam schema run
///
/// A scene that is not understood throws InvalidInput. A motion that breaks down does not: result.status and
/// result.failure say how the run ended.

#include <string>
#include <string_view>

#include "core/error.hpp"
#include "io/provenance.hpp"
#include "io/run_report.hpp"
#include "io/scene_json.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"
#include "scene/simulate.hpp"

namespace vlbeam {

/// The report of a run, as `vlbeam run --report` writes it.
inline std::string report(const Scene& scene, const RunResult& result) {
  std::string text;
  write_run_report(scene, result, {{"provenance", provenance()}, {"timing", run_timing(result.timing)}},
                   [&text](std::string_view piece) { text += piece; });
  return text;
}

/// The samples as a CSV file has them, units in the first line.
inline std::string samples_csv(const Scene& scene, const RunResult& result) {
  std::string text;
  write_samples_csv(scene, result, [&text](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace vlbeam
