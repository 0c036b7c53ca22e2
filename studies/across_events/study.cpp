// Which order generalized-alpha has in time across length-control events, and what spoils it.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/geometry/elementary.hpp"
#include "io/scene_json.hpp"
#include "tools/measures.hpp"
#include "tools/scene_sweep.hpp"

namespace vlbeam {
namespace across_events {
namespace {

struct Case {
  std::string sweep;
  Scene scene;
  bool exact = false;  ///< by the explicit method, tightly
};

std::string key_of(const Case& item) {
  const Scene& scene = item.scene;
  return item.sweep + "/" + (scene.beam.element == ElementKind::ale_ancf ? "ancf" : "rancf") + "_" +
         std::string(to_string(scene.length_control.velocities)) + "_n" + std::to_string(scene.beam.elements);
}

/// Of each scene first the exact solution, then its steps by either kind of Newton's method.
std::vector<Case> read_cases(const Json& config) {
  std::vector<Case> cases;
  const Scene integrators = scene_from_json(config.at("exact"));
  for (const auto& [sweep, scene] : read_scene_cases(config)) {
    Case& exact = cases.emplace_back(Case{sweep, scene, true});
    exact.scene.integrator = integrators.integrator;
    for (const auto& newton : names(NewtonKind{})) {
      for (const double step : config.at("steps").get<std::vector<double>>()) {
        Case& item = cases.emplace_back(Case{sweep, scene, false});
        item.scene.integrator = {};
        item.scene.integrator.type = IntegratorType::generalized_alpha;
        item.scene.integrator.newton = newton.value;
        item.scene.integrator.step = step;
      }
    }
  }
  return cases;
}

double cost(const Case& item) {
  const double n = item.scene.beam.elements;
  return n * item.scene.duration * (item.exact ? 1e4 * n : 1 / item.scene.integrator.step);
}

/// A mesh so fine that the step is long for most of its modes, and events are as frequent as steps.
void add_fine_mesh(const StudyContext& context, StudyReport& report) {
  const Scene scene = scene_from_json(context.config.at("fine"));
  const auto outcome =
      context.sweep(std::vector{scene}, [](const Scene& fine) { return StudyContext::simulate_to_the_end(fine); })[0];
  if (!outcome) {
    report.cases.push_back({.options = {{"scene", "fine"}}, .results = {}, .failure = outcome.failure});
    return;
  }
  report.measured["fine/events"] = static_cast<double>(outcome->events.size());
  report.measured["fine/drift"] = outcome->max_energy_drift / outcome->max_kinetic;
  report.measured["fine/rejected_share"] =
      static_cast<double>(outcome->solver.rejected) / static_cast<double>(outcome->solver.steps);
}

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context.config);
  const auto outcomes = context.sweep(
      cases, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); }, cost);

  StudyReport report;
  Table table{.name = "steps",
              .caption =
                  "Generalized-alpha at the end of each scene: error against the same mesh by an explicit method "
                  "at a tight tolerance, over 1 m",
              .columns = {"scene", "element", "velocities", "elements", "events", "newton", "step", "error"}};
  std::map<std::string, std::vector<double>> steps, errors;
  const RunResult* exact = nullptr;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& item = cases[i];
    if (!outcomes[i]) {
      report.cases.push_back(
          {.options = {{"scene", key_of(item)}, {"integrator", to_string(item.scene.integrator.type)}},
           .results = {},
           .failure = outcomes[i].failure});
    }
    if (item.exact) {
      exact = outcomes[i] ? &*outcomes[i] : nullptr;
      if (exact == nullptr) continue;
      const auto events = static_cast<double>(exact->events.size());
      auto& fewest = report.measured.try_emplace(item.sweep + "/events", events).first->second;
      fewest = std::min(fewest, events);
      continue;
    }
    if (exact == nullptr || !outcomes[i]) continue;
    const auto& integrator = item.scene.integrator;
    const double error = position_error(outcomes[i]->samples.back(), exact->samples.back());
    table.rows.push_back({item.sweep, to_string(item.scene.beam.element),
                          to_string(item.scene.length_control.velocities), item.scene.beam.elements,
                          exact->events.size(), to_string(integrator.newton), integrator.step, error});
    const std::string key = key_of(item) + "_" + std::string(to_string(integrator.newton));
    steps[key].push_back(integrator.step);
    errors[key].push_back(error);
  }
  report.tables.push_back(std::move(table));

  // of each scene, its velocities and its mesh: over both elements and both kinds of Newton's method
  for (const auto& [key, of_steps] : errors) {
    const OrderFit fit = fit_order(key, steps[key], of_steps);
    const std::string scene = key.substr(0, key.find('/')), rest = key.substr(key.find('_') + 1),
                      name = scene + "/" + rest.substr(0, rest.rfind('_'));
    for (const double order : fit.pairwise_orders) {
      auto& least = report.measured.try_emplace(name + "/least_pair", order).first->second;
      auto& largest = report.measured.try_emplace(name + "/largest_pair", order).first->second;
      least = std::min(least, order);
      largest = std::max(largest, order);
    }
    const double order =
        portable::log(of_steps.front() / of_steps.back()) / portable::log(steps[key].front() / steps[key].back());
    auto& lowest = report.measured.try_emplace(name + "/least_order", order).first->second;
    auto& highest = report.measured.try_emplace(name + "/largest_order", order).first->second;
    lowest = std::min(lowest, order);
    highest = std::max(highest, order);
    for (const double error : of_steps) {
      auto& smallest = report.measured.try_emplace(name + "/smallest_error", error).first->second;
      auto& worst = report.measured.try_emplace(name + "/largest_error", error).first->second;
      smallest = std::min(smallest, error);
      worst = std::max(worst, error);
    }
    report.fits.push_back(fit);
  }
  add_fine_mesh(context, report);
  return report;
}

}  // namespace
}  // namespace across_events

Study across_events_study();

Study across_events_study() {
  return {.name = "across_events",
          .title = "Across events: the order of generalized-alpha where elements merge",
          .run = across_events::run};
}

}  // namespace vlbeam
