// What survives a hard case: stiff, slack, heavily damped, light, fast, folded, chattering, badly weighted.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/geometry/elementary.hpp"
#include "core/length_control/chain_motion.hpp"
#include "io/json.hpp"
#include "io/scene_json.hpp"
#include "mechanics/motion/system/mass_condition.hpp"
#include "scene/build.hpp"
#include "scene/options.hpp"
#include "tools/measures.hpp"

namespace vlbeam {
namespace hard_cases {
namespace {

constexpr int samples = 50;                   // of a run
constexpr std::size_t looked_at_events = 50;  // after which the mass matrix is looked at

/// One variant of a group, by the integrator that is judged or by one of the two that certify it.
struct Case {
  std::string group, variant;
  Json value;  ///< what the figure plots against
  Scene scene;
  bool judged = true;
};

Json merged(Json target, const Json& patch) {
  target.merge_patch(patch);
  return target;
}

std::vector<Case> read_cases(const Json& config) {
  std::vector<Case> cases;
  for (const auto& [group, spec] : config.at("groups").items()) {
    for (const auto& [variant, own] : spec.at("variants").items()) {
      const Json scene = merged(merged(config.at("scene"), spec.at("scene")), own.at("scene"));
      // clang 14 cannot capture structured bindings
      const auto add = [&, &group = group, &variant = variant, &own = own](const Json& integrator, bool judged) {
        Scene read = scene_from_json(merged(scene, {{"integrator", integrator}}));
        read.output.interval = read.duration / samples;
        if (judged) read.output.configurations = {0, read.duration / 4, read.duration / 2, read.duration};
        cases.push_back({group, variant, own.value("value", Json()), read, judged});
      };
      add(own.value("integrator", spec.at("integrator")), true);
      for (const Json& reference : own.value("references", spec.value("references", Json::array()))) {
        add(reference, false);
      }
    }
  }
  return cases;
}

/// Condition number of the mass matrix on a mesh that a run has had; the joint is its node at `joint_position`.
double condition_of(const Scene& scene, const Configuration& shape, const std::optional<double>& joint_position) {
  if (scene.sliding_mass && !joint_position) return nan;  // the mass has left
  ChainState<2> chain;
  chain.mesh.x = shape.x;
  for (std::size_t k = 0; k < shape.x.size(); ++k) {
    chain.q.insert(chain.q.end(), {shape.r[k][0], shape.r[k][1], shape.r_x[k][0], shape.r_x[k][1]});
    if (k > 0) chain.mesh.weights.push_back({shape.weights[k - 1], shape.x[k - 1], shape.x[k]});
    if (joint_position && shape.x[k] == *joint_position) chain.joints = {{.node = static_cast<int>(k)}};
  }
  if (joint_position && chain.joints.empty()) {  // it rides inside an element
    chain.loose = {chain.mesh.element_at(*joint_position), *joint_position, 0, false};
  }
  chain.rate.assign(chain.q.size(), 0);
  BeamSystem<2> system(build_model<2>(scene), chain);
  return mass_condition(system, system.initial_state());
}

/// The largest at the kept shapes and behind the first events.
double worst_condition(const Scene& scene, const RunResult& result) {
  double worst = nan;
  const auto look = [&](const Configuration& shape, const std::optional<double>& joint) {
    worst = std::fmax(worst, condition_of(scene, shape, joint));
  };
  for (const Configuration& shape : result.configurations) {
    const Sample* sample = sample_at(result, shape.t);
    if (sample != nullptr) look(shape, sample->joint_position);
  }
  for (std::size_t i = 0; i < std::min(result.events.size(), looked_at_events); ++i) {
    const Event& event = result.events[i];
    if (event.type == EventType::segment_merge) look(event.after, event.joint_position);
  }
  return worst;
}

/// Largest change of the total energy, dissipation included, over the largest kinetic energy.
double energy_error(const RunResult& result) {
  double largest = 0;
  for (const Sample& sample : result.samples) {
    largest = std::max(largest, std::abs(sample.discrete_total - result.samples.front().discrete_total));
  }
  return largest / result.max_kinetic;
}

/// Shortest tangent |r_x| at a node of the kept shapes.
double shortest_tangent(const RunResult& result) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto look = [&](const Configuration& shape) {
    for (const Point& slope : shape.r_x) shortest = std::min(shortest, portable::hypot(slope[0], slope[1]));
  };
  for (const Configuration& shape : result.configurations) look(shape);
  for (const Event& event : result.events) look(event.after);
  return shortest;
}

double apart(const Point& a, const Point& b) { return portable::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// How two runs differ at their ends, over how far each of joint, end and mass has come in the first of them at most:
/// the worst of the three.
double relative_difference(const RunResult& a, const RunResult& b) {
  const Sample &first = a.samples.front(), &last = a.samples.back(), &other = b.samples.back();
  double end = 0, mass = 0, joint = 0;
  for (const Sample& sample : a.samples) {
    end = std::max(end, apart(sample.end, first.end));
    if (!sample.mass_position || !first.mass_position) continue;
    mass = std::max(mass, apart(*sample.mass_position, *first.mass_position));
    joint = std::max(joint, std::abs(*sample.joint_position - *first.joint_position));
  }
  double worst = end > 0 ? apart(last.end, other.end) / end : 0;
  if (last.mass_position.has_value() != other.mass_position.has_value()) return nan;
  if (last.mass_position && mass > 0) {
    worst = std::max({worst, apart(*last.mass_position, *other.mass_position) / mass,
                      std::abs(*last.joint_position - *other.joint_position) / joint});
  }
  return worst;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context.config);
  const auto outcomes = context.sweep(
      cases, [](const Case& item) { return StudyContext::simulate_until_interrupted(item.scene); },
      [](const Case& item) { return item.judged ? 1 : 10; });

  StudyReport report;
  Table table{
      .name = "cases",
      .caption =
          "what became of each case: error at the end against the first of two certifying integrators, "
          "whose difference is the reference's own error; the same over how far joint, end and mass have come "
          "at most, the worst of the three; error of the energy over the largest kinetic energy: by the model's "
          "own points, and by a 25-point rule",
      .columns = {"case", "variant", "value", "integrator", "outcome", "error", "reference_error", "relative_error",
                  "relative_reference_error", "energy_error", "energy_change", "events", "smallest_step", "condition",
                  "shortest_tangent"}};
  Table expectations{.name = "expectations",
                     .caption = "what was expected of each case before it was run",
                     .columns = {"case", "expectation"}};
  for (const auto& [group, spec] : context.config.at("groups").items()) {
    expectations.rows.push_back({group, spec.at("expectation")});
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!cases[i].judged) continue;
    const Case& item = cases[i];
    const std::string key = item.group + "/" + item.variant;
    StudyCase row{.options = {{"case", item.group},
                              {"variant", item.variant},
                              {"integrator", to_string(item.scene.integrator.type)}},
                  .results = {},
                  .failure = outcomes[i].failure};
    std::vector<const RunResult*> references;
    for (std::size_t k = i + 1; k < cases.size() && !cases[k].judged; ++k) {
      if (outcomes[k] && outcomes[k]->status != RunStatus::failed) references.push_back(&*outcomes[k]);
    }
    if (!outcomes[i] || outcomes[i]->status == RunStatus::interrupted) {
      if (row.failure.empty()) row.failure = "interrupted";
      report.cases.push_back(row);
      continue;
    }
    const RunResult& result = *outcomes[i];
    const bool failed = result.status == RunStatus::failed;
    const bool certified = references.size() == 2;
    const double own = certified ? position_error(references[1]->samples.back(), references[0]->samples.back()) : nan;
    const double error =
        certified && !failed ? position_error(result.samples.back(), references[0]->samples.back()) : nan;
    const double relative_own = certified ? relative_difference(*references[0], *references[1]) : nan;
    const double relative = certified && !failed ? relative_difference(*references[0], result) : nan;
    const double change = energy_change(result);
    const double energy = energy_error(result), condition = worst_condition(item.scene, result);
    const std::string outcome =
        failed ? "failed at " + number_text(std::round(1e4 * result.failure_time) / 1e4) + " s: " + result.failure
               : std::string(to_string(result.status));
    row.results = {{"outcome", outcome},
                   {"error", number(error)},
                   {"reference_error", number(own)},
                   {"relative_error", number(relative)},
                   {"relative_reference_error", number(relative_own)},
                   {"energy_error", number(energy)},
                   {"energy_change", number(change)},
                   {"events", result.events.size()},
                   {"steps", result.solver.steps},
                   {"rejected", result.solver.rejected},
                   {"smallest_step", result.solver.smallest_step},
                   {"condition", number(condition)},
                   {"shortest_tangent", number(shortest_tangent(result))}};
    table.rows.push_back({item.group, item.variant, item.value, to_string(item.scene.integrator.type), outcome,
                          number(error), number(own), number(relative), number(relative_own), number(energy),
                          number(change), result.events.size(), result.solver.smallest_step, number(condition),
                          number(shortest_tangent(result))});
    report.measured["finished/" + key] = failed ? 0 : 1;
    report.measured["events/" + key] = static_cast<double>(result.events.size());
    const std::pair<const char*, double> numbers[] = {{"error/", error},
                                                      {"reference_error/", own},
                                                      {"relative_error/", relative},
                                                      {"relative_reference_error/", relative_own},
                                                      {"energy/", energy},
                                                      {"energy_change/", change},
                                                      {"condition/", condition}};
    for (const auto& [name, value] : numbers) {
      if (std::isfinite(value)) report.measured[name + key] = value;
    }
    report.cases.push_back(row);
  }
  report.tables = {expectations, table};
  report.figures = {{.name = "sweeps",
                     .caption = "Condition number of the mass matrix, temporal error and energy error against what "
                                "makes a case hard",
                     .script = "sweeps.gp"}};
  return report;
}

}  // namespace
}  // namespace hard_cases

Study hard_cases_study();

Study hard_cases_study() {
  return {.name = "hard_cases",
          .title = "Hard cases: what finishes, how well, and what fails clearly",
          .run = hard_cases::run};
}

}  // namespace vlbeam
