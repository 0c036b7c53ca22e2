// When an element beside the mass is cut: the trigger, its hysteresis, and no length control at all, on the falling
// beam (Ding & Ouyang 2022, §6.1) and the suspended one (§6.2).
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/elementary.hpp"
#include "io/scene_json.hpp"
#include "scene/options.hpp"
#include "tools/judged.hpp"
#include "tools/measures.hpp"

namespace vlbeam {
namespace thresholds {
namespace {

struct Case {
  std::string beam;  ///< falling | suspended
  bool reference = false;
  Scene scene;
};

constexpr ElementKind kinds[] = {ElementKind::ale_rancf, ElementKind::ale_ancf};

std::string kind_key(ElementKind element) { return element == ElementKind::ale_ancf ? "ancf" : "rancf"; }

std::vector<Case> read_cases(const Json& config) {
  std::vector<Case> cases;
  for (const std::string beam : {"falling", "suspended"}) {
    Json json = config.at("scene");
    if (beam == "suspended") {
      for (const auto& [pointer, value] : config.at("suspended").items()) json[Json::json_pointer(pointer)] = value;
    }
    const Scene base = scene_from_json(json);
    auto with = [&](ElementKind element, double upper, double hysteresis) -> Scene& {
      Case item{beam, false, base};
      item.scene.beam.element = element;
      item.scene.length_control.upper = upper;
      item.scene.length_control.hysteresis = hysteresis;
      return cases.emplace_back(std::move(item)).scene;
    };
    for (const auto element : kinds) {
      for (const double upper : config.at("upper").get<std::vector<double>>()) {
        for (const double hysteresis : config.at("hysteresis").get<std::vector<double>>()) {
          with(element, upper, hysteresis);
        }
      }
      for (const Json& pair : config.at("wide")) with(element, pair[0], pair[1]);
      // the joint runs into its neighbour, whose element shrinks to nothing: explicit steps would do so too
      Scene& uncontrolled = with(element, 1.5, 0.001);
      uncontrolled.length_control.enabled = false;
      uncontrolled.integrator = {};
      uncontrolled.integrator.type = IntegratorType::generalized_alpha;
      uncontrolled.integrator.step = 1e-4;
    }
    Scene& reference = with(ElementKind::ale_ancf, 1.5, 0.001);
    reference.beam.elements = config.at("reference_elements").at(beam);
    reference.length_control.velocities = VelocityTransfer::conservative;
    cases.back().reference = true;
  }
  return cases;
}

double cost(const Case& item) { return portable::pow(item.scene.beam.elements, 2); }

/// Shortest element over the standard length: at the start and on either side of every event.
double shortest_element(const Scene& scene, const RunResult& run) {
  double shortest = 1;
  auto look = [&](const Configuration& shape) {
    for (std::size_t k = 1; k < shape.x.size(); ++k) {
      shortest = std::min(shortest, (shape.x[k] - shape.x[k - 1]) * scene.beam.elements / beam_length_m);
    }
  };
  for (const Event& event : run.events) {
    look(event.before);
    look(event.after);
  }
  return shortest;
}

class Report {
 public:
  Report(const StudyContext& context, const std::vector<Case>& cases)
      : folder_(context.folder.string()),
        judged_(judged_at(context.folder.parent_path(), "falling_beam")),
        cases_(cases),
        outcomes_(context.sweep(
            cases,
            [](const Case& item) {
              // without length control a run is meant to fail: where it does is the finding
              return item.scene.length_control.enabled ? StudyContext::simulate_to_the_end(item.scene)
                                                       : StudyContext::simulate_until_interrupted(item.scene);
            },
            cost)) {}

  StudyReport operator()() {
    Table table{.name = "thresholds",
                .caption =
                    "Error over L at the end against a fine mesh, sums of the jumps of kinetic and strain energy [J], "
                    "events, shortest element over L_std, evaluations of the equations; last: how far the joint gets",
                .columns = {"beam", "element", "control", "upper", "hysteresis", "error", "kinetic_jumps",
                            "elastic_jumps", "events", "shortest", "rhs_evaluations", "reached", "until"}};
    for (std::size_t i = 0; i < cases_.size(); ++i) add(cases_[i], outcomes_[i], table);
    report_.tables.push_back(std::move(table));
    summarize();
    report_.figures = {{.name = "thresholds",
                        .caption = "Error, energy jumps and events against the trigger",
                        .script = "thresholds.gp",
                        .variables = {{"folder", folder_}}}};
    return std::move(report_);
  }

 private:
  const RunResult* reference_of(const std::string& beam) const {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].reference && cases_[i].beam == beam && outcomes_[i]) return &*outcomes_[i];
    }
    return nullptr;
  }

  void add(const Case& item, const Outcome<RunResult>& outcome, Table& table) {
    const Scene& scene = item.scene;
    const auto& control = scene.length_control;
    StudyCase entry{.options = {{"beam", item.beam},
                                {"reference", item.reference},
                                {"elements", scene.beam.elements},
                                {"element", to_string(scene.beam.element)},
                                {"length_control", control.enabled},
                                {"upper", control.upper},
                                {"hysteresis", control.hysteresis}},
                    .results = {},
                    .failure = outcome.failure};
    if (outcome) {
      const RunResult& run = *outcome;
      double kinetic = 0, elastic = 0;
      for (const Event& event : run.events) {
        kinetic += std::abs(event.energy_jump.kinetic);
        elastic += std::abs(event.energy_jump.axial + event.energy_jump.bending);
      }
      const RunResult* reference = reference_of(item.beam);
      const double until = run.samples.back().t;
      const bool whole = until >= scene.duration * (1 - 1e-9) && run.status != RunStatus::failed;
      const double error = reference && whole ? position_error(run, *reference, until) : std::nan("");
      const double reached = run.samples.back().joint_position.value_or(beam_length_m);
      const double shortest = shortest_element(scene, run);
      entry.results = {{"status", to_string(run.status)},
                       {"failure", run.failure},
                       {"until", until},
                       {"reached", reached},
                       {"events", run.events.size()},
                       {"kinetic_jumps", kinetic},
                       {"elastic_jumps", elastic},
                       {"shortest_element", shortest},
                       {"rhs_evaluations", run.solver.rhs_evaluations}};
      if (!item.reference) {
        table.rows.push_back({item.beam, to_string(scene.beam.element), control.enabled ? "on" : "off", control.upper,
                              control.hysteresis, std::isfinite(error) ? Json(error) : Json(), kinetic, elastic,
                              run.events.size(), shortest, run.solver.rhs_evaluations, reached, until});
        const std::string key = item.beam + "_" + kind_key(scene.beam.element);
        if (!control.enabled) {
          report_.measured["uncontrolled_reached_" + key] = reached;
        } else if (std::isfinite(error)) {
          auto& most = report_.measured["largest_error_" + key];
          most = std::max(most, error);
          if (control.hysteresis == 0.001) {
            const std::string trigger = "_" + number_text(control.upper);
            report_.measured["error_" + key + trigger] = error;
            const Sample* sample = item.beam == "falling" ? sample_at(run, judged_.t) : nullptr;
            if (sample != nullptr) {
              report_.measured["judged_error_" + key + trigger] = judged_.error(*sample) / beam_length_m;
              report_.measured["judge_uncertainty"] = judged_.uncertainty / beam_length_m;
            }
            report_.measured["events_" + key + trigger] = static_cast<double>(run.events.size());
            report_.measured["shortest_" + key + trigger] = shortest;
          }
        }
      }
    }
    report_.cases.push_back(std::move(entry));
  }

  /// The widest trigger against the paper's.
  void summarize() {
    for (const std::string beam : {"falling", "suspended"}) {
      for (const auto element : kinds) {
        const std::string key = beam + "_" + kind_key(element);
        const auto at = [&](const std::string& name) {
          const auto found = report_.measured.find(name);
          return found == report_.measured.end() ? std::nan("") : found->second;
        };
        const double share = at("error_" + key + "_1.95") / at("error_" + key + "_1.5");
        if (std::isfinite(share)) report_.measured["error_share_" + key] = share;
      }
    }
  }

  std::string folder_;
  Judged judged_;
  const std::vector<Case>& cases_;
  std::vector<Outcome<RunResult>> outcomes_;
  StudyReport report_;
};

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context.config);
  return Report(context, cases)();
}

}  // namespace
}  // namespace thresholds

Study thresholds_study();

Study thresholds_study() {
  return {.name = "thresholds",
          .title = "When to cut an element: trigger, hysteresis, and no length control",
          .run = thresholds::run};
}

}  // namespace vlbeam
