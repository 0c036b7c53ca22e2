// Which choice of each option is right when a scene does not make one: every scene by its defaults, and with one option
// at a time chosen otherwise.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/geometry/elementary.hpp"
#include "io/scene_json.hpp"
#include "scene/build.hpp"
#include "studies/defaults/cost.hpp"
#include "tools/measures.hpp"

namespace vlbeam {
namespace defaults {
namespace {

const std::string by_default = "default";

struct Case {
  std::string scene, variant;
  Scene run;
  int reference = 0;  ///< 0: judged; 1: the finest mesh; 2: the same by other choices
};

Json merged(Json target, const Json& patch) {
  target.merge_patch(patch);
  return target;
}

std::vector<Case> read_cases(const Json& config) {
  std::vector<Case> cases;
  for (const auto& [name, spec] : config.at("scenes").items()) {
    // clang 14 cannot capture structured bindings
    const auto add = [&, &name = name, &spec = spec](const std::string& variant, const Json& elements,
                                                     const Json& choice, int reference) {
      const Json scene = merged(merged(spec.at("scene"), {{"beam", {{"elements", elements}}}}), choice);
      cases.push_back({name, variant, scene_from_json(scene), reference});
    };
    for (const Json& elements : spec.at("elements")) {
      add(by_default, elements, Json::object(), 0);
      const Json usual = scene_to_json(cases.back().run);
      for (const auto& [variant, choice] : config.at("variants").items()) {
        add(variant, elements, choice, 0);
        if (scene_to_json(cases.back().run) == usual) cases.pop_back();  // what the default is here
      }
    }
    add("reference", spec.at("reference"), Json::object(), 1);
    add("other reference", spec.at("reference"), config.at("other_reference"), 2);
  }
  return cases;
}

/// Integrand evaluations of all elements, in millions: what a run costs on any machine.
double work(const Scene& scene, const RunResult& run) {
  return 1e-6 * static_cast<double>(run.solver.rhs_evaluations) * scene.beam.elements * quadrature_points(scene);
}

/// How many times the error of one variant is that of another, over all scenes and meshes that both have.
struct Ratios {
  double logarithms = 0, worst = 0;
  int count = 0;

  void add(double ratio) {
    logarithms += portable::log(ratio);
    worst = std::max(worst, ratio);
    ++count;
  }
  double mean() const { return portable::exp(logarithms / count); }
};

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context.config);
  const auto outcomes = context.sweep(
      cases, [](const Case& item) { return StudyContext::simulate_until_interrupted(item.run); },
      [](const Case& item) { return item.run.beam.elements * item.run.beam.elements * item.run.duration; });

  StudyReport report;
  std::map<std::string, std::array<const RunResult*, 2>> references;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!outcomes[i] || outcomes[i]->status == RunStatus::interrupted) {
      report.cases.push_back({.options = {{"scene", cases[i].scene}, {"variant", cases[i].variant}},
                              .results = {},
                              .failure = outcomes[i] ? "interrupted" : outcomes[i].failure});
    } else if (cases[i].reference > 0) {
      references[cases[i].scene][static_cast<std::size_t>(cases[i].reference) - 1] = &*outcomes[i];
    }
  }
  Table table{.name = "settings",
              .caption =
                  "Scenes by their defaults, and with one option chosen otherwise: error of positions at the end "
                  "[m], and what it is known to; what length control does to the energy by 25 points, summed, "
                  "over the largest kinetic energy; events, those whose energy could not be restored; millions "
                  "of integrand evaluations",
              .columns = {"scene", "elements", "variant", "status", "error", "known_to", "energy_at_events", "events",
                          "unrestored", "work"}};
  std::map<std::pair<std::string, int>, double> usual;  // errors by default
  std::map<std::string, Ratios> error_ratios, work_ratios;
  std::map<std::pair<std::string, int>, double> usual_work;
  double finished = 1;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& item = cases[i];
    if (item.reference > 0 || !outcomes[i]) continue;
    const RunResult& result = *outcomes[i];
    const auto& [finest, other] = references[item.scene];
    const auto error_of = [&finest = finest](const RunResult* of) {
      return finest != nullptr && of != nullptr ? position_error(of->samples.back(), finest->samples.back())
                                                : std::nan("");
    };
    const bool failed = result.status == RunStatus::failed;
    const double error = failed ? std::nan("") : error_of(&result), known_to = error_of(other);
    const double energy = event_energy(result).sum / result.max_kinetic, cost = work(item.run, result);
    const auto unrestored = std::ranges::count_if(result.events, [](const Event& event) { return !event.restored; });
    const int n = item.run.beam.elements;
    const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
    table.rows.push_back({item.scene, n, item.variant, to_string(result.status), number(error), number(known_to),
                          number(energy), result.events.size(), unrestored, cost});
    report.cases.push_back(
        {.options = {{"scene", item.scene}, {"elements", n}, {"variant", item.variant}},
         .results = {{"status", to_string(result.status)}, {"error", number(error)}, {"work", cost}}});
    const std::string key = item.variant + "/" + item.scene + "_n" + std::to_string(n);
    report.measured["energy_at_events/" + key] = energy;
    if (std::isfinite(error)) report.measured["error/" + key] = error;
    const std::pair<std::string, int> mesh{item.scene, n};
    if (item.variant == by_default) {
      if (failed) finished = 0;
      usual[mesh] = error;
      usual_work[mesh] = cost;
    } else if (std::isfinite(error) && error > known_to && usual[mesh] > known_to) {
      error_ratios[item.variant].add(error / usual[mesh]);
      work_ratios[item.variant].add(cost / usual_work[mesh]);
    }
  }
  report.tables.push_back(std::move(table));
  Table means{.name = "ratios",
              .caption =
                  "One option chosen otherwise, over the defaults: geometric mean and largest ratio of errors "
                  "over the scenes and meshes whose errors are known, and mean ratio of work",
              .columns = {"variant", "meshes", "mean", "largest", "work"}};
  for (const auto& [variant, ratios] : error_ratios) {
    means.rows.push_back({variant, ratios.count, ratios.mean(), ratios.worst, work_ratios[variant].mean()});
    report.measured["error_ratio/" + variant] = ratios.mean();
    report.measured["largest_error_ratio/" + variant] = ratios.worst;
    report.measured["work_ratio/" + variant] = work_ratios[variant].mean();
  }
  report.tables.push_back(std::move(means));
  report.measured["defaults_finish"] = finished;
  add_cost(context, report);
  return report;
}

}  // namespace
}  // namespace defaults

Study defaults_study();

Study defaults_study() {
  return {.name = "defaults",
          .title = "Defaults: what each option costs and gains where a scene leaves it out",
          .run = defaults::run};
}

}  // namespace vlbeam
