#include "studies/work_precision/sizes.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/pieces.hpp"
#include "io/scene_json.hpp"

namespace vlbeam::work_precision {
namespace {

/// A mass that is shot along a beam of `elements` elements, all of the same length.
Scene shot(const Json& config, const Json& scene, int elements) {
  const double length = config.at("element_length").get<double>() * elements, step = config.at("step").get<double>();
  const double duration = step * config.at("steps").get<int>();
  return scene_from_json(merged(
      scene,
      {{"beam", {{"elements", elements}, {"curve", {{"end", {length, 0}}}}}},
       {"sliding_mass", {{"position", config.at("start").get<double>() * length}, {"velocity", config.at("speed")}}},
       {"length_control", {{"velocities", "projected"}}},
       {"integrator", {{"type", "generalized-alpha"}, {"step", step}}},
       {"duration", duration},
       {"output", {{"interval", duration}}}}));
}

}  // namespace

void compare_sizes(StudyReport& report, const StudyContext& context) {
  const Json& config = context.config.at("sizes");
  Table work{.name = "work_by_elements",
             .caption = "a mass passes an element a step: what the run takes, by the number of elements",
             .columns = {"elements", "steps", "events", "evaluations", "iterations", "tangents"}};
  Table times{.name = "time_by_elements",
              .caption =
                  "wall time of the same runs: of an evaluation with its share of tangents and solutions, an "
                  "element, and of what an event does to mesh and velocities",
              .columns = {"elements", "threads", "motion_s", "ns_an_evaluation_and_element", "event_ms"},
              .timing = true};
  const auto counts = config.at("counts").get<std::vector<int>>();
  double first_evaluations = 0, first_tangents = 0;
  for (const int elements : counts) {
    const Scene scene = shot(config, context.config.at("scene"), elements);
    for (const int threads : config.at("threads").get<std::vector<int>>()) {
      const ThreadLimit limit(threads);
      const RunResult result = simulate(scene, StudyContext::until_interrupted());
      const auto evaluations = static_cast<double>(result.solver.rhs_evaluations),
                 events = static_cast<double>(result.events.size());
      times.rows.push_back({elements, threads, result.timing.motion,
                            1e9 * result.timing.motion / (evaluations * elements),
                            1e3 * result.timing.length_control / std::max(events, 1.0)});
      if (threads != 1) continue;
      // at an element a step rounding decides in which step an event falls, and so how many steps there are
      const auto tangents = static_cast<double>(result.solver.newton.tangents),
                 steps = static_cast<double>(result.solver.steps);
      work.rows.push_back({elements, result.solver.steps, result.events.size(), result.solver.rhs_evaluations,
                           result.solver.newton.iterations, result.solver.newton.tangents});
      if (elements == counts.front()) {
        first_evaluations = evaluations / steps;
        first_tangents = tangents / steps;
      }
      const std::string of = "sizes/N" + std::to_string(elements);
      report.measured[of + "/evaluations"] = evaluations;
      report.measured[of + "/tangents"] = tangents;
      report.measured["sizes/growth/evaluations"] = evaluations / steps / first_evaluations;
      report.measured["sizes/growth/tangents"] = tangents / steps / first_tangents;
    }
  }
  report.tables.push_back(work);
  report.tables.push_back(times);
  report.figures.push_back({.name = "time_by_elements",
                            .caption = "Wall time of an evaluation and of an event against the number of elements, on "
                                       "one thread and on two",
                            .script = "sizes.gp",
                            .timing = true});
}

}  // namespace vlbeam::work_precision
