// What the automatic integrator costs, over the cheapest setting that errs as little, scene by scene.
#include "studies/defaults/cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/files.hpp"
#include "io/json.hpp"
#include "io/scene_json.hpp"
#include "scene/build.hpp"
#include "scene/stiffness.hpp"
#include "scene/validate.hpp"
#include "studies/harness/claims.hpp"

namespace vlbeam::defaults {
namespace {

constexpr double tangent_work = 5;  // evaluations, as measured
constexpr double stability = 1.6;   // mean step of dopri5 times the largest frequency

enum class Role { reference, other_reference, automatic, setting };

struct CostCase {
  std::string scene, setting;
  Role role;
  double accuracy;  ///< asked of an automatic run; else 0
  Scene run;
};

bool allowed(const Scene& scene) {
  try {
    validate(scene);
  } catch (const InvalidInput&) {
    return false;
  }
  return true;
}

IntegratorSpec adaptive(const Scene& scene, double tolerance, ErrorEstimate estimate) {
  IntegratorSpec spec;
  spec.type = IntegratorType::generalized_alpha;
  spec.adaptive = true;
  spec.error_estimate = estimate;
  spec.step = scene.duration / 50;
  spec.rtol = 1e-14;
  const double length = tolerance * beam_length(scene);
  spec.atol_by_kind = AbsoluteTolerances{.length = length, .velocity = length / spec.step, .angle = {}, .spin = {}};
  return spec;
}

IntegratorSpec dopri5(double tolerance) {
  IntegratorSpec spec;
  spec.rtol = spec.atol = tolerance;
  return spec;
}

std::vector<CostCase> read_cases(const StudyContext& context) {
  const Json& config = context.config.at("cost");
  std::vector<CostCase> cases;
  const auto add_scene = [&](const std::string& name, const std::filesystem::path& folder) {
    Json json = read_json(folder / (name + ".json"));
    json.erase("integrator");
    const auto add = [&](const std::string& setting, Role role, double accuracy, Scene scene) {
      if (allowed(scene)) cases.push_back({name, setting, role, accuracy, std::move(scene)});
    };
    Scene plain;
    for (const Json& accuracy : config.at("accuracies")) {
      json["integrator"] = {{"accuracy", accuracy}};
      plain = scene_from_json(json);
      add("automatic", Role::automatic, accuracy, plain);
    }
    const auto with = [&plain](const IntegratorSpec& integrator) {
      Scene scene = plain;
      scene.integrator = integrator;
      return scene;
    };
    const bool explicitly = plain.duration * mean_largest_frequency(plain) / stability <= config.at("explicit_steps");
    for (const double tolerance : config.at("implicit").get<std::vector<double>>()) {
      const std::string at = " " + number_like(tolerance, "1e-4");
      add("generalized-alpha" + at, Role::setting, 0, with(adaptive(plain, tolerance, ErrorEstimate::filtered)));
    }
    for (const double tolerance : config.at("explicit").get<std::vector<double>>()) {
      if (explicitly) add("dopri5 " + number_like(tolerance, "1e-4"), Role::setting, 0, with(dopri5(tolerance)));
    }
    const Scene exact = with(dopri5(config.at("explicit_reference")));
    const bool by_explicit = explicitly && allowed(exact);
    add("reference", Role::reference, 0,
        by_explicit ? exact : with(adaptive(plain, config.at("reference"), ErrorEstimate::all)));
    add("other reference", Role::other_reference, 0,
        by_explicit ? with(dopri5(100 * config.at("explicit_reference").get<double>()))
                    : with(adaptive(plain, config.at("other_reference"), ErrorEstimate::all)));
  };
  for (const Json& name : config.at("library")) {
    add_scene(name, context.folder.parent_path().parent_path() / "scenes");
  }
  for (const Json& name : config.at("brought")) add_scene(name, context.folder / "scenes");
  return cases;
}

/// Positions of a sample over the beam's length, and angles about the axis [rad].
std::vector<double> places(const Sample& sample, double length) {
  std::vector<double> all;
  const auto add = [&](const Point& point) {
    for (const double coordinate : point) all.push_back(coordinate / length);
  };
  add(sample.end);
  if (sample.joint_position) all.push_back(*sample.joint_position / length);
  if (sample.mass_position) add(*sample.mass_position);
  for (const SlidingSample& joint : sample.joints) {
    if (joint.position) all.push_back(*joint.position / length);
    if (joint.mass_position) add(*joint.mass_position);
  }
  if (sample.flow) {
    for (const Point& load : sample.flow->loads) add(load);
    if (sample.flow->end_angles)
      all.insert(all.end(), sample.flow->end_angles->begin(), sample.flow->end_angles->end());
  }
  return all;
}

/// Largest difference of these over all samples; infinite where one run has what the other lacks.
double difference(const RunResult& a, const RunResult& b, double length) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (a.samples.size() != b.samples.size()) return none;
  double largest = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const std::vector<double> here = places(a.samples[i], length), there = places(b.samples[i], length);
    if (here.size() != there.size()) return none;
    for (std::size_t k = 0; k < here.size(); ++k) largest = std::max(largest, std::abs(here[k] - there[k]));
  }
  return largest;
}

double work(const RunResult& run) {
  return static_cast<double>(run.solver.rhs_evaluations) +
         tangent_work * static_cast<double>(run.solver.newton.tangents);
}

/// Of one scene and accuracy.
struct Found {
  double error = 0, ratio = 1;
};

}  // namespace

void add_cost(const StudyContext& context, StudyReport& report) {
  const auto cases = read_cases(context);
  const auto outcomes = context.sweep(
      cases, [](const CostCase& item) { return StudyContext::simulate_until_interrupted(item.run); },
      [](const CostCase& item) {
        return item.run.beam.elements * (item.role == Role::setting || item.role == Role::automatic ? 1 : 100);
      });
  struct Runs {
    const RunResult *reference = nullptr, *other = nullptr;
    double length = 1;
    std::vector<std::size_t> settings, automatic;
  };
  std::map<std::string, Runs> scenes;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Runs& runs = scenes[cases[i].scene];
    runs.length = beam_length(cases[i].run);
    const bool done =
        outcomes[i] && outcomes[i]->status != RunStatus::failed && outcomes[i]->status != RunStatus::interrupted;
    if (!done && cases[i].role != Role::setting) {
      report.cases.push_back({.options = {{"scene", cases[i].scene}, {"setting", cases[i].setting}},
                              .results = {},
                              .failure = outcomes[i] ? outcomes[i]->failure : outcomes[i].failure});
    }
    if (!done) continue;
    if (cases[i].role == Role::reference) runs.reference = &*outcomes[i];
    if (cases[i].role == Role::other_reference) runs.other = &*outcomes[i];
    if (cases[i].role == Role::automatic) runs.automatic.push_back(i);
    if (cases[i].role == Role::setting) runs.settings.push_back(i);
  }
  Table costs{.name = "cost",
              .caption =
                  "Scenes whose integrator is left to the program, by the accuracy asked: the method chosen, steps, "
                  "the largest error of positions in time over all samples and the beam's length, what it is known "
                  "to, work in evaluations of the equations, and over that of the cheapest setting with an error of "
                  "at most twice the accuracy",
              .columns = {"scene", "accuracy", "method", "steps", "error", "known_to", "work", "ratio", "cheapest"}};
  Table drawn{.name = "cost_figure",
              .caption = "The same at the first accuracy, row by row as it is drawn",
              .columns = {"place", "scene", "error", "ratio"},
              .curve = true};
  std::map<double, std::vector<Found>> found;
  for (const auto& [name, runs] : scenes) {
    if (runs.reference == nullptr || runs.other == nullptr) continue;
    const double known_to = difference(*runs.other, *runs.reference, runs.length);
    for (const std::size_t i : runs.automatic) {
      const CostCase& item = cases[i];
      const double error = difference(*outcomes[i], *runs.reference, runs.length), cost = work(*outcomes[i]);
      double least = cost;
      std::string cheapest = "automatic";
      for (const std::size_t k : runs.settings) {
        if (difference(*outcomes[k], *runs.reference, runs.length) > 2 * item.accuracy) continue;
        if (work(*outcomes[k]) >= least) continue;
        least = work(*outcomes[k]);
        cheapest = cases[k].setting;
      }
      costs.rows.push_back({name, item.accuracy, to_string(item.run.integrator.type), outcomes[i]->solver.steps, error,
                            known_to, cost, cost / least, cheapest});
      if (i == runs.automatic.front()) {
        drawn.rows.push_back({drawn.rows.size() + 1, name, std::max(error, 1e-9), cost / least});
      }
      const std::string key = name + "_" + number_like(item.accuracy, "1e-4");
      report.measured["time_error/" + key] = error;
      report.measured["work_over_cheapest/" + key] = cost / least;
      report.measured["default_steps/" + key] = static_cast<double>(outcomes[i]->solver.steps);
      if (known_to <= item.accuracy) found[item.accuracy].push_back({error, cost / least});
    }
  }
  for (const auto& [accuracy, all] : found) {
    const std::string key = "_" + number_like(accuracy, "1e-4");
    double logarithms = 0, worst = 0, error = 0;
    for (const Found& one : all) {
      logarithms += portable::log(one.ratio);
      worst = std::max(worst, one.ratio);
      error = std::max(error, one.error);
    }
    report.measured["time_error_largest" + key] = error;
    report.measured["work_ratio_mean" + key] = portable::exp(logarithms / static_cast<double>(all.size()));
    report.measured["work_ratio_largest" + key] = worst;
    report.measured["scenes_judged" + key] = static_cast<double>(all.size());
  }
  report.tables.push_back(std::move(costs));
  report.tables.push_back(std::move(drawn));
  report.figures.push_back({"cost",
                            "What leaving the integrator out costs: error in time and work, scene by scene",
                            "cost.gp",
                            {{"folder", context.folder.string()}}});
}

}  // namespace vlbeam::defaults
