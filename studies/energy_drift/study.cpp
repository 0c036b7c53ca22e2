// Drift of the total energy over long horizons, apart from its jumps at length-control events.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>

#include "io/scene_json.hpp"
#include "tools/measures.hpp"

namespace vlbeam {
namespace energy_drift {
namespace {

struct Case {
  std::string name;
  Scene scene;
};

/// Every scene of the configuration with each of its variants, both as JSON merge patches.
std::vector<Case> read_cases(const Json& config) {
  std::vector<Case> cases;
  for (const auto& [problem, spec] : config.at("problems").items()) {
    for (const auto& [variant, patch] : spec.at("variants").items()) {
      Json scene = config.at("scene");
      scene.merge_patch(spec.at("scene"));
      scene.merge_patch(patch);
      cases.push_back({problem + "_" + variant, scene_from_json(scene)});
    }
  }
  return cases;
}

/// Energy by the model's own points without what length control added up to time t [J].
double drift_at(const RunResult& result, const Sample& sample) {
  double drift = sample.discrete_total - result.samples.front().discrete_total;
  for (const Event& event : result.events) {
    if (event.t <= sample.t) drift -= event.discrete_jump;
  }
  return drift;
}

/// Slope of the least-squares line through the drift [J/s].
double slope_of(const RunResult& result) {
  double n = 0, t = 0, e = 0, tt = 0, te = 0;
  for (const Sample& sample : result.samples) {
    const double drift = drift_at(result, sample);
    n += 1;
    t += sample.t;
    e += drift;
    tt += sample.t * sample.t;
    te += sample.t * drift;
  }
  return (n * te - t * e) / (n * tt - t * t);
}

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context.config);
  const auto outcomes = context.sweep(
      cases, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); },
      [](const Case& item) { return item.scene.duration * item.scene.beam.elements; });

  StudyReport report;
  Table table{.name = "drift",
              .caption =
                  "Largest drift of the total energy between length-control events over the largest kinetic "
                  "energy, slope of the drift [J/s], sum of the jumps at the events [J], largest change of "
                  "the total energy, events included, over the largest kinetic energy; the last two by a 25-point rule",
              .columns = {"case", "integrator", "steps", "drift", "slope", "events", "jumps", "change"}};
  Table history{.name = "history",
                .caption = "|E - E_0| without the jumps, over the largest kinetic energy",
                .columns = {"case", "t", "drift"},
                .curve = true};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [name, scene] = cases[i];
    StudyCase item{
        .options = {{"case", name}, {"scene", scene_to_json(scene)}}, .results = {}, .failure = outcomes[i].failure};
    if (outcomes[i]) {
      const RunResult& result = *outcomes[i];
      double drift = 0, jumps = 0;
      for (const Sample& sample : result.samples) {
        const double now = std::abs(drift_at(result, sample)) / result.max_kinetic;
        drift = std::max(drift, now);
        history.rows.push_back({name, sample.t, now});
      }
      for (const Event& event : result.events) jumps += event.energy_jump.total();
      const double change = energy_change(result);
      table.rows.push_back({name, to_string(scene.integrator.type), result.solver.steps, drift, slope_of(result),
                            result.events.size(), jumps, change});
      report.measured["drift_" + name] = drift;
      report.measured["change_" + name] = change;
      report.measured["event_jump_" + name] = event_energy(result).largest / result.max_kinetic;
      report.measured["slope_" + name] = slope_of(result);
      report.measured["steps_" + name] = static_cast<double>(result.solver.steps);
      item.results = {{"steps", result.solver.steps},
                      {"rejected", result.solver.rejected},
                      {"drift", drift},
                      {"largest_kinetic_energy", result.max_kinetic}};
    }
    report.cases.push_back(std::move(item));
  }
  report.tables = {table, history};
  report.figures = {{.name = "drift",
                     .caption = "Drift of the total energy against time",
                     .script = "drift.gp",
                     .variables = {{"folder", context.folder.string()}}}};
  return report;
}

}  // namespace
}  // namespace energy_drift

Study energy_drift_study();

Study energy_drift_study() {
  return {.name = "energy_drift",
          .title = "Drift of the total energy by integrator and formulation, and its jumps at length control",
          .run = energy_drift::run};
}

}  // namespace vlbeam
