#include "studies/falling_beam/cases.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/run_report.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "tools/measures.hpp"

namespace vlbeam::falling_beam {
namespace {

constexpr double report_times[] = {0.3, 0.4, 0.5, 0.6, 0.65, 0.7};  // [s]

/// Rough work of a run: explicit steps shrink with the square of the element length, and with the tolerance.
double cost(const Case& item) {
  const Scene& scene = item.scene;
  const double n = scene.beam.elements;
  const double accuracy = portable::pow(1e-6 / scene.integrator.rtol, 0.2);
  const double steps = std::max(n * n / 1600, n / 60 * accuracy);
  return steps * n * (3 + quadrature_points(scene)) * scene.duration * scene.duration;
}

Json state_at(const RunResult& result, double t) {
  const Sample* sample = sample_at(result, t);
  if (!sample) return nullptr;
  const Point mass = sample->mass_position.value_or(Point{});
  return {{"t", t},
          {"joint_position", sample->joint_position ? Json(*sample->joint_position) : Json()},
          {"mass_position", {mass[0], mass[1]}},
          {"end", {sample->end[0], sample->end[1]}},
          {"total_energy", sample->energy.total()}};
}

Json results_of(const RunResult& result) {
  Json states = Json::array();
  for (const double t : report_times) {
    if (const Json state = state_at(result, t); !state.is_null()) states.push_back(state);
  }
  const double separation = separation_time(result);
  return {{"status", to_string(result.status)},
          {"length_control_events", merges_until(result, result.samples.back().t).size()},
          {"separation_time", std::isfinite(separation) ? Json(separation) : Json()},
          {"max_kinetic", result.max_kinetic},
          {"max_energy_drift", result.max_energy_drift},
          {"steps", result.solver.steps},
          {"rejected", result.solver.rejected},
          {"rhs_evaluations", result.solver.rhs_evaluations},
          {"states", states}};
}

}  // namespace

bool Wanted::fits(const Scene& scene) const {
  return (!elements || *elements == scene.beam.elements) && (!element || *element == scene.beam.element) &&
         (!clamp || *clamp == scene.start.clamp) && (!points || *points == quadrature_points(scene)) &&
         (!tolerance || std::abs(*tolerance / scene.integrator.rtol - 1) < 1e-6) &&
         (!hysteresis || *hysteresis == scene.length_control.hysteresis);
}

std::vector<const Run*> Runs::select(std::string_view sweep, const Wanted& wanted) const {
  std::vector<const Run*> found;
  for (const Run& run : runs_) {
    if (run.sweep == sweep && run.result && wanted.fits(run.scene)) found.push_back(&run);
  }
  return found;
}

const Run* Runs::find(std::string_view sweep, const Wanted& wanted) const {
  const auto found = select(sweep, wanted);
  return found.empty() ? nullptr : found.front();
}

Runs run_cases(const StudyContext& context, const std::vector<Case>& cases) {
  auto outcomes = context.sweep(
      cases, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); }, cost);
  std::vector<Run> runs;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    runs.push_back(
        {cases[i].sweep, cases[i].scene, std::move(outcomes[i].result), outcomes[i].failure, outcomes[i].seconds});
  }
  return Runs(std::move(runs));
}

std::vector<StudyCase> report_cases(const Runs& runs) {
  std::vector<StudyCase> cases;
  for (const Run& run : runs.all()) {
    cases.push_back({.options = {{"sweep", run.sweep}, {"scene", scene_to_json(run.scene)}},
                     .results = run.result ? results_of(*run.result) : Json::object(),
                     .failure = run.failure});
  }
  return cases;
}

Json timing(const Runs& runs) {
  Json list = Json::array();
  for (const Run& run : runs.all()) {
    Json entry = {{"sweep", run.sweep},
                  {"elements", run.scene.beam.elements},
                  {"element", to_string(run.scene.beam.element)},
                  {"quadrature_points", quadrature_points(run.scene)},
                  {"tolerance", run.scene.integrator.rtol},
                  {"seconds", run.seconds}};
    if (run.result) entry["timing"] = run_timing(run.result->timing);
    list.push_back(entry);
  }
  return list;
}

}  // namespace vlbeam::falling_beam
