// A heavy mass that runs back and forth on a beam between two pins (Ding & Ouyang 2022, §6.2), and what the beam's
// slopes may do at the mass.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/geometry/elementary.hpp"
#include "io/json.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "scene/options.hpp"
#include "tools/measures.hpp"

namespace vlbeam {
namespace suspended_beam {
namespace {

struct Case {
  std::string group;  ///< paper | finer | modes | virtual_work | friction
  Scene scene;
};

std::string key_of(ElementKind element) { return element == ElementKind::ale_ancf ? "ancf" : "rancf"; }
std::string key_of(JointSlopes slopes) {
  return slopes == JointSlopes::equal_stretch ? "equal" : std::string(to_string(slopes));
}
std::string key_of(Formulation formulation) {
  return formulation == Formulation::variational ? "variational" : "virtual";
}

std::string mesh_key(const Scene& scene) {
  return key_of(scene.sliding_mass->slopes) + "_" + key_of(scene.beam.element) + "_n" +
         std::to_string(scene.beam.elements);
}

std::vector<double> times(double duration, double interval) {
  std::vector<double> result;
  for (int i = 0; i * interval <= duration * (1 + 1e-12); ++i) result.push_back(i * interval);
  return result;
}

std::vector<Case> read_cases(const Json& config) {
  const Scene base = scene_from_json(config.at("scene"));
  std::vector<Case> cases;
  auto add = [&](const char* group, int n, ElementKind element) -> Scene& {
    Scene scene = base;
    scene.beam.elements = n;
    scene.beam.element = element;
    return cases.emplace_back(Case{group, scene}).scene;
  };

  const Json& paper = config.at("paper");
  auto like_the_paper = [&](Scene& scene, const char* tolerance) {
    scene.duration = paper.at("duration");
    scene.output = {paper.at("interval"), paper.at("configurations").get<std::vector<double>>()};
    scene.integrator.rtol = scene.integrator.atol = paper.at(tolerance);
  };
  for (const auto& formulation : names(Formulation{})) {
    for (const auto element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
      Scene& scene = add("paper", paper.at("elements"), element);
      like_the_paper(scene, "tolerance");
      scene.formulation = formulation.value;
    }
  }
  Scene& finer = add("finer", paper.at("finer"), ElementKind::ale_ancf);
  like_the_paper(finer, "finer_tolerance");
  finer.length_control.velocities = VelocityTransfer::projected;

  const Json& modes = config.at("modes");
  auto with_slopes = [&](Scene& scene, JointSlopes slopes) {
    scene.sliding_mass->slopes = slopes;
    scene.length_control.velocities = VelocityTransfer::projected;
    scene.duration = modes.at("duration");
    scene.output.interval = modes.at("interval");
    scene.output.configurations = times(scene.duration, scene.output.interval);
    scene.integrator.rtol = scene.integrator.atol = modes.at("tolerance");
  };
  const Json& friction = config.at("friction");
  for (const auto& [slopes, name] : names(JointSlopes{})) {
    for (const int n : modes.at("elements").get<std::vector<int>>()) {
      for (const auto element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
        with_slopes(add("modes", n, element), slopes);
      }
    }
    if (slopes == JointSlopes::continuous || slopes == JointSlopes::equal_stretch) {
      with_slopes(add("modes", modes.at("reference"), ElementKind::ale_ancf), slopes);
    }
    Scene& scene = add("virtual_work", config.at("virtual_work").at("elements"), ElementKind::ale_ancf);
    with_slopes(scene, slopes);
    scene.formulation = Formulation::virtual_work;
    for (const int n : friction.at("elements").get<std::vector<int>>()) {
      Scene& rubbing = add("friction", n, ElementKind::ale_ancf);
      with_slopes(rubbing, slopes);
      rubbing.sliding_mass->friction = AxialFriction{friction.at("coefficient"), friction.at("velocity")};
    }
  }
  return cases;
}

double cost(const Case& item) {
  const double n = item.scene.beam.elements;
  return n * n * quadrature_points(item.scene) * item.scene.duration;
}

/// Arc length of a shape [m].
double length_of(const Configuration& shape) {
  constexpr int pieces = 4000;
  const double length = shape.x.back() - shape.x.front();
  double sum = 0;
  auto last = point_at(shape, shape.x.front());
  for (int i = 1; i <= pieces; ++i) {
    const auto next = point_at(shape, shape.x.front() + length * i / pieces);
    sum += portable::hypot(next[0] - last[0], next[1] - last[1]);
    last = next;
  }
  return sum;
}

/// Slopes before and behind the mass.
struct SlopesAtMass {
  double before = nan, behind = nan;  ///< |r_x|
  double angle = nan;                 ///< from one to the other [degrees]
};

SlopesAtMass slopes_at_mass(const Configuration& shape, double joint) {
  const auto node = static_cast<std::size_t>(std::ranges::lower_bound(shape.x, joint - 1e-9) - shape.x.begin());
  const Point before = shape.r_x[node], behind = shape.kinks.empty() ? before : shape.kinks.front().r_x;
  const double turn =
      portable::atan2(before[0] * behind[1] - before[1] * behind[0], before[0] * behind[0] + before[1] * behind[1]);
  return {portable::hypot(before[0], before[1]), portable::hypot(behind[0], behind[1]),
          turn * 180 / portable::acos(-1.0)};
}

class Report {
 public:
  Report(const StudyContext& context, const std::vector<Case>& cases)
      : context_(context),
        cases_(cases),
        outcomes_(context.sweep(
            cases, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); }, cost)) {}

  StudyReport operator()() {
    add_cases();
    add_paper();
    add_modes();
    add_ledger();
    add_friction();
    return std::move(report_);
  }

 private:
  template <class Predicate>
  std::vector<std::pair<const Scene*, const RunResult*>> select(const std::string& group,
                                                                const Predicate& holds) const {
    std::vector<std::pair<const Scene*, const RunResult*>> found;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].group == group && outcomes_[i] && holds(cases_[i].scene)) {
        found.emplace_back(&cases_[i].scene, &*outcomes_[i]);
      }
    }
    return found;
  }
  auto select(const std::string& group) const {
    return select(group, [](const Scene&) { return true; });
  }

  void figure(const std::string& name, const std::string& caption, const std::string& script,
              GnuplotVariables variables = {}) {
    variables["folder"] = context_.folder.string();
    report_.figures.push_back({.name = name, .caption = caption, .script = script, .variables = variables});
  }

  void add_cases() {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Scene& scene = cases_[i].scene;
      StudyCase item{.options = {{"group", cases_[i].group},
                                 {"elements", scene.beam.elements},
                                 {"element", to_string(scene.beam.element)},
                                 {"slopes", to_string(scene.sliding_mass->slopes)},
                                 {"formulation", to_string(scene.formulation)},
                                 {"velocities", to_string(scene.length_control.velocities)}},
                     .results = {},
                     .failure = outcomes_[i].failure};
      if (scene.sliding_mass->friction) item.options["friction"] = scene.sliding_mass->friction->coefficient;
      if (outcomes_[i]) {
        const RunResult& result = *outcomes_[i];
        item.results = {{"joint_position", *result.samples.back().joint_position},
                        {"events", result.events.size()},
                        {"largest_kinetic_energy", result.max_kinetic},
                        {"energy_drift", result.max_energy_drift},
                        {"slope_residual", result.slopes.position},
                        {"rhs_evaluations", result.solver.rhs_evaluations}};
      }
      report_.cases.push_back(std::move(item));
    }
  }

  /// Figures 13 and 14.
  void add_paper() {
    const Json& config = context_.config.at("paper");
    const int points = config.at("points");
    auto with = [](Formulation formulation) {
      return [formulation](const Scene& scene) { return scene.formulation == formulation; };
    };
    const auto finer = select("finer");
    for (const auto& [formulation, name] : names(Formulation{})) {
      const auto runs = select("paper", with(formulation));
      if (runs.size() < 2 || finer.empty()) continue;
      const std::string key = key_of(formulation);
      Table histories{.name = "histories_" + key,
                      .caption = "Mass, length of the beam [m], its rate [m/s], energies [J] against time [s]",
                      .columns = {"t"},
                      .curve = true};
      Table shapes{.name = "configurations_" + key,
                   .caption = "Material points at the times in the column names [m]",
                   .columns = {"x"},
                   .curve = true};
      Table controls{.name = "length_control_" + key,
                     .caption = "The beam before and after its first two length-control events [m]",
                     .columns = {"x"},
                     .curve = true};
      Table masses{.name = "masses_" + key,
                   .caption = "Positions of the mass at the times of the configurations [m]",
                   .columns = {"element", "t", "x", "y"},
                   .curve = true};
      const double length = beam_length(*runs.front().first);
      for (Table* table : {&shapes, &controls}) {
        for (int i = 0; i < points; ++i) table->rows.push_back({length * i / (points - 1)});
      }
      auto add_shape = [](Table& table, const std::string& column, const Configuration& shape) {
        table.columns.insert(table.columns.end(), {column + "_x", column + "_y"});
        for (auto& row : table.rows) {
          const auto r = point_at(shape, row.front().get<double>());
          row.insert(row.end(), {r[0], r[1]});
        }
      };
      auto add_run = [&](const std::string& element, const RunResult& result) {
        for (const char* quantity : {"joint", "length", "rate", "kinetic", "strain", "gravity", "total"}) {
          histories.columns.push_back(element + "_" + quantity);
        }
        if (histories.rows.empty()) {
          for (const Sample& sample : result.samples) histories.rows.push_back({sample.t});
        }
        for (std::size_t i = 0; i < result.samples.size(); ++i) {
          const Sample& s = result.samples[i];
          auto& row = histories.rows[i];
          row.insert(row.end(), {*s.joint_position, s.beam_length, s.beam_length_rate, s.energy.kinetic,
                                 s.energy.axial + s.energy.bending, s.energy.gravity, s.energy.total()});
        }
        for (const Configuration& shape : result.configurations) {
          add_shape(shapes, element + "_" + number_text(shape.t), shape);
          const Sample* sample = sample_at(result, shape.t);
          masses.rows.push_back({element, shape.t, (*sample->mass_position)[0], (*sample->mass_position)[1]});
        }
      };
      for (const auto& [scene, result] : runs) {
        const std::string element = key_of(scene->beam.element);
        add_run(element, *result);
        const auto events = merges_until(*result, scene->duration);
        for (std::size_t k = 0; k < std::min<std::size_t>(2, events.size()); ++k) {
          const std::string column = element + "_" + std::to_string(k + 1);
          add_shape(controls, column + "_before", events[k]->before);
          add_shape(controls, column + "_after", events[k]->after);
        }
        measure_paper(key + "_" + element, *result, events);
      }
      add_run("finer", *finer.front().second);
      report_.tables.insert(report_.tables.end(), {histories, shapes, controls, masses});
      std::string kept;
      for (const double t : config.at("configurations").get<std::vector<double>>()) kept += number_text(t) + " ";
      const GnuplotVariables variables{{"key", key},
                                       {"setting", std::string(name)},
                                       {"times", kept},
                                       {"elements", std::to_string(runs.front().first->beam.elements)},
                                       {"finer", std::to_string(finer.front().first->beam.elements)}};
      figure("figure13_" + key, "Figure 13: configurations of the beam and the mass, " + std::string(name),
             "figure13.gp", variables);
      figure("figure14_" + key, "Figure 14: length control, length of the beam and energies, " + std::string(name),
             "figure14.gp", variables);
    }
    if (!finer.empty()) {
      double furthest = 0;
      for (const Sample& s : finer.front().second->samples) furthest = std::max(furthest, *s.joint_position);
      report_.measured["furthest_finer"] = furthest;
      report_.measured["back_at_finer"] = *finer.front().second->samples.back().joint_position;
    }
  }

  void measure_paper(const std::string& key, const RunResult& result, const std::vector<const Event*>& events) {
    double segmented = 0, merged = 0, length = 0, energy = 0;
    for (const Event* event : events) {
      const Displacement moved = displacement_by(*event);
      const double longer = length_of(event->after) - length_of(event->before), jump = event->energy_jump.total();
      const auto& k = event->weights;
      events_.rows.push_back({key, event->t, event->joint_position, moved.segmented, moved.merged, longer, jump, k[0],
                              k[1], k[2], event->unit_fallback ? 1 : 0});
      segmented = std::max(segmented, moved.segmented);
      merged = std::max(merged, moved.merged);
      length = std::max(length, std::abs(longer));
      energy = std::max(energy, std::abs(jump));
    }
    report_.measured["events_" + key] = static_cast<double>(events.size());
    report_.measured["segmented_" + key] = segmented;
    report_.measured["merged_" + key] = merged;
    report_.measured["length_jump_" + key] = length;
    report_.measured["energy_jump_" + key] = energy;
    report_.measured["drift_" + key] = result.max_energy_drift / result.max_kinetic;
  }

  /// Joint modes: position of the mass and kink against time, and how they converge.
  void add_modes() {
    report_.tables.push_back(events_);
    const Json& config = context_.config.at("modes");
    const int reference = config.at("reference"), finest = config.at("elements").back();
    Table histories{.name = "modes",
                    .caption = "ALE-ANCF, finest mesh: position of the mass [m], kink at it [degrees] by mode",
                    .columns = {"t"},
                    .curve = true};
    Table errors{.name = "modes_errors",
                 .caption =
                     "Position of the mass at the end, its distance from that of the reference mesh of the same "
                     "limit (continuous for tangent, equal-stretch for free) and the largest such distance of all "
                     "samples [m], largest kink [degrees], drift of energy over the largest kinetic energy",
                 .columns = {"slopes", "element", "elements", "joint_position", "error_end", "error", "kink", "drift"}};
    std::map<std::string, std::array<std::vector<double>, 2>> ends;
    for (const auto& [scene, result] : select("modes")) {
      const JointSlopes slopes = scene->sliding_mass->slopes;
      const bool beam = slopes == JointSlopes::continuous || slopes == JointSlopes::tangent;
      const auto exact = select("modes", [&](const Scene& other) {
        return other.beam.elements == reference && (other.sliding_mass->slopes == JointSlopes::continuous) == beam;
      });
      double error = 0, error_end = nan, kink = 0;
      for (std::size_t i = 0; i < result->samples.size() && !exact.empty(); ++i) {
        error_end = std::abs(*result->samples[i].joint_position - *exact.front().second->samples[i].joint_position);
        error = std::max(error, error_end);
      }
      const bool shown = scene->beam.elements == finest && scene->beam.element == ElementKind::ale_ancf;
      if (shown) {
        histories.columns.insert(histories.columns.end(), {key_of(slopes) + "_joint", key_of(slopes) + "_kink"});
        if (histories.rows.empty()) {
          for (const Sample& sample : result->samples) histories.rows.push_back({sample.t});
        }
      }
      for (std::size_t i = 0; i < result->samples.size(); ++i) {
        const double joint = *result->samples[i].joint_position;
        const double angle = slopes_at_mass(result->configurations[i], joint).angle;
        kink = std::max(kink, std::abs(angle));
        if (shown) histories.rows[i].insert(histories.rows[i].end(), {joint, angle});
      }
      const double drift = result->max_energy_drift / result->max_kinetic, end = *result->samples.back().joint_position;
      errors.rows.push_back({to_string(slopes), to_string(scene->beam.element), scene->beam.elements, end, error_end,
                             error, kink, drift});
      const std::string key = mesh_key(*scene);
      auto& [meshes, positions] = ends[key.substr(0, key.rfind("_n"))];
      meshes.push_back(scene->beam.elements);
      positions.push_back(end);
      report_.measured["joint_" + key] = end;
      report_.measured["error_" + key] = error;
      report_.measured["kink_" + key] = kink;
      report_.measured["slope_residual_" + key] = result->slopes.position;
      double& worst = report_.measured["drift_" + key_of(slopes)];
      worst = std::max(worst, drift);
    }
    for (auto& [key, found] : ends) {
      report_.grid_convergence.push_back(grid_convergence("joint_" + key, std::move(found[0]), std::move(found[1])));
    }
    const Table pairs = pairs_of("modes", "modes_pairs", config.at("elements").get<std::vector<int>>());
    report_.tables.insert(report_.tables.end(), {histories, errors, pairs});
    figure("modes", "What the beam's slopes do at the mass", "modes.gp",
           {{"finest", std::to_string(finest)}, {"reference", std::to_string(reference)}});
  }

  /// The modes of one group beside each other, mesh by mesh; ALE-ANCF.
  Table pairs_of(const std::string& group, const std::string& name, const std::vector<int>& elements) {
    Table table{.name = name,
                .caption = "Largest distance between the positions of the mass in two modes, all samples [m]; ALE-ANCF",
                .columns = {"elements", "continuous_tangent", "equal_free", "continuous_equal"}};
    for (const int n : elements) {
      const auto largest = [&](JointSlopes a, JointSlopes b) {
        const auto with = [&](JointSlopes slopes) {
          return select(group, [&](const Scene& scene) {
            return scene.beam.elements == n && scene.beam.element == ElementKind::ale_ancf &&
                   scene.sliding_mass->slopes == slopes;
          });
        };
        const auto first = with(a), second = with(b);
        if (first.empty() || second.empty()) return nan;
        double distance = 0;
        const auto &one = first.front().second->samples, &other = second.front().second->samples;
        for (std::size_t i = 0; i < one.size(); ++i) {
          distance = std::max(distance, std::abs(*one[i].joint_position - *other[i].joint_position));
        }
        return distance;
      };
      const double beam = largest(JointSlopes::continuous, JointSlopes::tangent),
                   hinge = largest(JointSlopes::equal_stretch, JointSlopes::free),
                   apart = largest(JointSlopes::continuous, JointSlopes::equal_stretch);
      table.rows.push_back({n, beam, hinge, apart});
      const std::string suffix = "_" + group + "_n" + std::to_string(n);
      report_.measured["continuous_tangent" + suffix] = beam;
      report_.measured["equal_free" + suffix] = hinge;
      report_.measured["continuous_equal" + suffix] = apart;
    }
    return table;
  }

  /// Energy between events by formulation.
  void add_ledger() {
    Table table{.name = "ledger",
                .caption =
                    "Distance of the total energy from what it was and the jumps since, over the largest kinetic "
                    "energy, by mode; ALE-ANCF",
                .columns = {"t"},
                .curve = true};
    const int n = context_.config.at("virtual_work").at("elements");
    for (const auto& [group, prefix] : {std::pair{"virtual_work", "virtual_"}, std::pair{"modes", "variational_"}}) {
      for (const auto& [scene, result] : select(group, [n](const Scene& s) {
             return s.beam.elements == n && s.beam.element == ElementKind::ale_ancf;
           })) {
        const std::string key = key_of(scene->sliding_mass->slopes);
        table.columns.push_back(prefix + key);
        if (table.rows.empty()) {
          for (const Sample& sample : result->samples) table.rows.push_back({sample.t});
        }
        double jumps = 0;
        auto event = result->events.begin();
        for (std::size_t i = 0; i < result->samples.size(); ++i) {
          const Sample& sample = result->samples[i];
          for (; event != result->events.end() && event->t <= sample.t; ++event) jumps += event->discrete_jump;
          const double gap = sample.discrete_total - result->samples.front().discrete_total - jumps;
          table.rows[i].push_back(std::abs(gap) / result->max_kinetic);
        }
        if (scene->formulation == Formulation::virtual_work) {
          report_.measured["drift_virtual_" + key] = result->max_energy_drift / result->max_kinetic;
        }
      }
    }
    report_.tables.push_back(table);
    figure("ledger", "Energy between events by formulation and mode", "ledger.gp", {{"elements", std::to_string(n)}});
  }

  void add_friction() {
    const Json& config = context_.config.at("friction");
    const int finest = config.at("elements").back();
    Table histories{.name = "friction",
                    .caption =
                        "With friction, finest mesh: position of the mass [m], stretches before and behind it, "
                        "dissipated energy [J] by mode",
                    .columns = {"t"},
                    .curve = true};
    Table table{.name = "friction_modes",
                .caption =
                    "With friction: position of the mass at the end [m], dissipated energy [J], largest jump of "
                    "the stretch at the mass, drift of energy over the largest kinetic energy",
                .columns = {"slopes", "elements", "joint_position", "dissipated", "stretch_jump", "drift"}};
    for (const auto& [scene, result] : select("friction")) {
      const std::string key = key_of(scene->sliding_mass->slopes);
      const bool shown = scene->beam.elements == finest;
      if (shown) {
        for (const char* quantity : {"joint", "before", "behind", "dissipated"}) {
          histories.columns.push_back(key + "_" + quantity);
        }
        if (histories.rows.empty()) {
          for (const Sample& sample : result->samples) histories.rows.push_back({sample.t});
        }
      }
      double jump = 0;
      for (std::size_t i = 0; i < result->samples.size(); ++i) {
        const Sample& sample = result->samples[i];
        const auto slopes = slopes_at_mass(result->configurations[i], *sample.joint_position);
        jump = std::max(jump, std::abs(slopes.behind - slopes.before));
        if (!shown) continue;
        histories.rows[i].insert(histories.rows[i].end(),
                                 {*sample.joint_position, slopes.before, slopes.behind, sample.energy.dissipated});
      }
      const double end = *result->samples.back().joint_position, dissipated = result->samples.back().energy.dissipated;
      const double drift = result->max_energy_drift / result->max_kinetic;
      table.rows.push_back(
          {to_string(scene->sliding_mass->slopes), scene->beam.elements, end, dissipated, jump, drift});
      const std::string suffix = key + "_n" + std::to_string(scene->beam.elements);
      report_.measured["friction_joint_" + suffix] = end;
      report_.measured["friction_dissipated_" + suffix] = dissipated;
      report_.measured["friction_stretch_jump_" + suffix] = jump;
      double& worst = report_.measured["friction_drift"];
      worst = std::max(worst, drift);
    }
    const Table pairs = pairs_of("friction", "friction_pairs", config.at("elements").get<std::vector<int>>());
    report_.tables.insert(report_.tables.end(), {histories, table, pairs});
    figure("friction", "Axial friction by joint mode", "friction.gp",
           {{"finest", std::to_string(finest)}, {"coefficient", number_text(config.at("coefficient"))}});
  }

  const StudyContext& context_;
  const std::vector<Case>& cases_;
  std::vector<Outcome<RunResult>> outcomes_;
  Table events_{.name = "events",
                .caption =
                    "Length control of the coarse runs: largest displacement of a material point on the segmented "
                    "and on the merged side [m], jumps of the beam's length [m] and of the total energy [J], "
                    "weights of the merged element, 1 where it fell back to unit weights",
                .columns = {"run", "t", "joint_position", "segmented", "merged", "length_jump", "energy_jump", "k_0",
                            "k_1", "k_2", "fallback"}};
  StudyReport report_;
};

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context.config);
  return Report(context, cases)();
}

}  // namespace
}  // namespace suspended_beam

Study suspended_beam_study();

Study suspended_beam_study() {
  return {.name = "suspended_beam",
          .title = "A suspended beam with a heavy sliding mass (§6.2), and the beam's slopes at the mass",
          .run = suspended_beam::run};
}

}  // namespace vlbeam
