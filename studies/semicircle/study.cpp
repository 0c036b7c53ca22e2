// A mass that slides along a semicircular beam suspended at both ends (Ding & Ouyang 2022, §6.3, Figures 15 and 16).
#include "studies/harness/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "core/geometry/elementary.hpp"
#include "core/length_control/chain_motion.hpp"
#include "io/scene_json.hpp"
#include "mechanics/flow/mesh_motion.hpp"
#include "scene/build.hpp"
#include "scene/options.hpp"
#include "studies/harness/histories.hpp"
#include "tools/judged.hpp"
#include "tools/measures.hpp"
#include "tools/rigid_wire.hpp"
#include "tools/scene_sweep.hpp"

namespace vlbeam {
namespace semicircle {
namespace {

constexpr double compared_at = 0.4;  // [s], the time of the meshes' errors

/// As-built or paper, frozen or transported, rational or polynomial, and the mesh.
std::string kind_of(const SceneCase& item) {
  const Scene& scene = item.scene;
  std::string key = scene.beam.rest_shape == RestShape::as_built ? "asbuilt" : "paper";
  if (weight_transport(scene) == WeightTransport::transported) key += "_transported";
  if (scene.beam.element == ElementKind::ale_ancf) key += "_ancf";
  return key;
}
std::string key_of(const SceneCase& item) { return kind_of(item) + "_n" + std::to_string(item.scene.beam.elements); }

/// Runs that answer a question of their own: ledgers at tight tolerances, the bead on a stiff wire, and the equations
/// as printed.
bool apart(const SceneCase& item) {
  return item.sweep.starts_with("audit") || item.sweep.ends_with("bead") || item.sweep == "printed";
}

/// A breakdown of the equations as printed is a finding, of all others an error.
RunResult run_case(const SceneCase& item) {
  if (item.sweep != "printed") return StudyContext::simulate_to_the_end(item.scene);
  RunResult run = StudyContext::simulate_until_interrupted(item.scene);
  if (run.status == RunStatus::interrupted) throw std::runtime_error("interrupted");
  return run;
}

double cost(const SceneCase& item) {
  const double n = item.scene.beam.elements;
  return n * n * item.scene.duration * (item.scene.integrator.type == IntegratorType::dopri5 ? 1 : 10);
}

/// Largest distance of the initial shape from the true circle, over its radius.
double radius_error(const Scene& scene) {
  const auto chain = build_chain<2>(scene);
  const double R = scene.beam.curve.radius;
  double largest = 0;
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const auto q = chain.coordinates(k);
    const auto curve =
        RationalCubic<double, 2>::from_nodal(q.e, q.x_b - q.x_a, current_weights(chain, k, weight_transport(scene)));
    for (int i = 0; i <= 50; ++i) {
      largest = std::max(largest,
                         std::abs(portable::hypot(curve.evaluate(i / 50.0)[0][0], curve.evaluate(i / 50.0)[0][1]) - R));
    }
  }
  return largest / R;
}

/// Largest generalized force at the start without gravity, over EA: M a of the accelerations.
double initial_force(Scene scene) {
  scene.gravity = {0, 0, 0};
  const BeamModel<2> model = build_model<2>(scene);
  BeamSystem<2> system(model, build_chain<2>(scene));
  auto* equations = system.second_order();
  const Eigen::VectorXd y = system.initial_state();
  Eigen::VectorXd q, v;
  equations->expand(y, q, v);
  Eigen::VectorXd residual(equations->coordinates());
  equations->residual(q, v, Eigen::VectorXd::Zero(q.size()), 0, residual);
  return residual.cwiseAbs().maxCoeff() / model.section.stiffness.EA;
}

class Report {
 public:
  Report(const StudyContext& context, const std::vector<SceneCase>& cases)
      : folder_(context.folder.string()),
        judged_(judged_at(context.folder.parent_path(), "semicircle", compared_at)),
        cases_(cases),
        outcomes_(context.sweep(cases, run_case, cost)) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (apart(cases[i]) || !outcomes_[i]) continue;
      const int n = cases[i].scene.beam.elements;
      if (kind_of(cases[i]) == "asbuilt" && n >= finest_) {
        finest_ = n;
        reference_ = &*outcomes_[i];
      }
    }
  }

  StudyReport operator()() {
    add_cases();
    add_audit();
    add_convergence();
    add_beads("bead", "bead", "EA = EI = 1e8");
    add_beads("elastic bead", "elastic_bead", "EA = EI = 1e6, gravity that grows over 0.25 s");
    add_printed();
    add_figures();
    return std::move(report_);
  }

 private:
  const RunResult* find(const std::string& key) const {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (!apart(cases_[i]) && outcomes_[i] && key_of(cases_[i]) == key) return &*outcomes_[i];
    }
    return nullptr;
  }

  void add_cases() {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Scene& scene = cases_[i].scene;
      StudyCase item{.options = {{"sweep", cases_[i].sweep}, {"scene", scene_to_json(scene)}},
                     .results = {},
                     .failure = outcomes_[i].failure};
      if (outcomes_[i]) {
        const RunResult& run = *outcomes_[i];
        const Sample& last = run.samples.back();
        item.results = {{"events", run.events.size()},
                        {"joint_position", last.joint_position ? Json(*last.joint_position) : Json()},
                        {"beam_length", last.beam_length},
                        {"total_energy", last.energy.total()},
                        {"max_kinetic", run.max_kinetic},
                        {"max_energy_drift", run.max_energy_drift},
                        {"rhs_evaluations", run.solver.rhs_evaluations}};
      }
      report_.cases.push_back(std::move(item));
    }
  }

  /// The initial state, and the ledger of tightly integrated runs.
  void add_audit() {
    double radius = 0, force = 0, drift = 0;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Scene& scene = cases_[i].scene;
      if (axis_form(scene) == AxisForm::exact) radius = std::max(radius, radius_error(scene));
      if (axis_form(scene) == AxisForm::even && scene.beam.elements == 8) {
        const auto kind = std::string(scene.beam.element == ElementKind::ale_rancf ? "rational" : "polynomial");
        report_.measured["even_radius_error_" + kind] = radius_error(scene);
      }
      if (scene.beam.rest_shape == RestShape::as_built) force = std::max(force, initial_force(scene));
      if (cases_[i].sweep.starts_with("audit") && outcomes_[i]) {
        drift = std::max(drift, outcomes_[i]->max_energy_drift / outcomes_[i]->max_kinetic);
      }
    }
    report_.measured["initial_radius_error"] = radius;
    report_.measured["initial_force"] = force;
    report_.measured["ledger_drift"] = drift;
  }

  /// Errors of position against the finest as-built mesh, and the jumps of energy.
  void add_convergence() {
    Table table{.name = "meshes",
                .caption =
                    "Error of the mass's and the joint's position over L at 0.4 s, 0.8 s and the end against the "
                    "finest as-built mesh; axial energy of the initial shape [J]; events and the sum of their "
                    "jumps of total energy [J]",
                .columns = {"kind", "elements", "error_0.4", "error_0.8", "error_end", "initial_axial", "events",
                            "energy_jumps"}};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (apart(cases_[i]) || !outcomes_[i] || reference_ == nullptr) continue;
      const RunResult& run = *outcomes_[i];
      const double length = beam_length(cases_[i].scene), end = run.samples.back().t;
      auto error = [&](double t) { return position_error(run, *reference_, t) / length; };
      double jumps = 0;
      for (const Event& event : run.events) jumps += std::abs(event.discrete_jump);
      table.rows.push_back({kind_of(cases_[i]), cases_[i].scene.beam.elements, error(0.4), error(0.8), error(end),
                            run.samples.front().energy.axial, run.events.size(), jumps});
      report_.measured["error_" + key_of(cases_[i])] = error(compared_at);
      report_.measured["initial_axial_" + key_of(cases_[i])] = run.samples.front().energy.axial;
      report_.measured["initial_bending_" + key_of(cases_[i])] = run.samples.front().energy.bending;
    }
    report_.tables.push_back(std::move(table));
    if (const RunResult* coarser = find("asbuilt_n" + std::to_string(finest_ / 2)); coarser && reference_) {
      report_.measured["finest_difference"] =
          position_error(*coarser, *reference_, compared_at) / beam_length(cases_.front().scene);
    }
    const Sample* sample = reference_ != nullptr ? sample_at(*reference_, compared_at) : nullptr;
    if (sample != nullptr) {
      const double length = beam_length(cases_.front().scene);
      report_.measured["judged_error"] = judged_.error(*sample) / length;
      report_.measured["judge_uncertainty"] = judged_.uncertainty / length;
    }
    std::vector<double> levels, errors;
    for (int n = finest_ / 8; n < finest_; n *= 2) {
      const auto found = report_.measured.find("error_asbuilt_n" + std::to_string(n));
      if (found == report_.measured.end()) continue;
      levels.push_back(n);
      errors.push_back(found->second);
    }
    if (!levels.empty()) report_.fits.push_back(fit_order("as-built, error at 0.4 s", levels, errors));
    add_limits();
  }

  /// Beads on wires: where they are off a rigid wire's, and off the finest mesh of the other element.
  void add_beads(const std::string& sweep, const std::string& name, const std::string& wire) {
    struct Run {
      double place;  // over L, off the rigid wire's
      std::size_t events;
      double strain_jumps;
    };
    std::map<std::string, std::map<int, Run>> runs;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].sweep != sweep || !outcomes_[i]) continue;
      const Scene& scene = cases_[i].scene;
      const RunResult& run = *outcomes_[i];
      const Sample& last = run.samples.back();
      double jumps = 0;
      for (const Event& event : run.events) jumps += std::abs(event.energy_jump.axial + event.energy_jump.bending);
      const double place =
          last.joint_position ? (*last.joint_position - on_rigid_arc(scene, {last.t}).front()) / beam_length(scene) : 1;
      const std::string element = scene.beam.element == ElementKind::ale_rancf ? "rancf" : "ancf";
      runs[element][scene.beam.elements] = {place, run.events.size(), jumps};
    }
    if (runs.size() < 2) return;
    Table table{.name = name,
                .caption = "Bead on a semicircular wire, " + wire +
                           ": where it is at 1 s off a rigid wire's, and off the other element's finest mesh, over L; "
                           "events and the sum of their jumps of strain energy [J]",
                .columns = {"element", "elements", "off_rigid", "error", "events", "strain_jumps"}};
    const auto finest = [&](const std::string& element) { return runs.at(element).rbegin()->second.place; };
    const double apart = std::abs(finest("ancf") - finest("rancf"));
    double uncertainty = apart;
    for (const auto& [element, of] : runs) {
      uncertainty = std::max(uncertainty, std::abs(finest(element) - std::next(of.rbegin())->second.place));
      std::vector<double> levels, errors;
      for (const auto& [n, run] : of) {
        levels.push_back(n);
        errors.push_back(std::abs(run.place - finest(element == "ancf" ? "rancf" : "ancf")));
        const std::string key = element + "_n" + std::to_string(n);
        table.rows.push_back(
            {element == "ancf" ? "ALE-ANCF" : "ALE-RANCF", n, run.place, errors.back(), run.events, run.strain_jumps});
        report_.measured[name + "_off_rigid_" + key] = std::abs(run.place);
        report_.measured[name + "_error_" + key] = errors.back();
      }
      const OrderFit& fit =
          report_.fits.emplace_back(fit_order(name + "_" + element, levels, errors, {.floor = apart}));
      if (!std::isfinite(fit.slope)) continue;
      report_.measured[name + "_order_" + element] = fit.slope;
      report_.measured[name + "_order_uncertainty_" + element] = fit.slope_uncertainty;
    }
    report_.measured[name + "_off_rigid"] = (finest("ancf") + finest("rancf")) / 2;
    report_.measured[name + "_apart"] = apart;
    report_.measured[name + "_uncertainty"] = uncertainty;
    report_.tables.push_back(std::move(table));
  }

  /// The equations as printed: virtual work, strains from a straight beam, five points, nodal velocities.
  void add_printed() {
    Table table{.name = "printed",
                .caption =
                    "The equations as printed: how the run ends and when [s], change of the total energy until then "
                    "and its largest value [J], events",
                .columns = {"elements", "status", "end", "energy_change", "largest_change", "events"}};
    std::vector<NamedRun> runs;
    const RunResult* finest = nullptr;
    std::string names;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].sweep != "printed" || !outcomes_[i]) continue;
      const RunResult& run = *outcomes_[i];
      const int n = cases_[i].scene.beam.elements;
      const double start = run.samples.front().energy.total();
      double largest = 0;
      for (const Sample& sample : run.samples) largest = std::max(largest, std::abs(sample.energy.total() - start));
      const bool failed = run.status == RunStatus::failed;
      const double change = run.samples.back().energy.total() - start;
      table.rows.push_back({n, to_string(run.status), failed ? run.failure_time : run.samples.back().t,
                            failed ? Json() : Json(change), failed ? Json() : Json(largest), run.events.size()});
      if (failed) {
        report_.measured["printed_failure_n" + std::to_string(n)] = run.failure_time;
        continue;
      }
      report_.measured["printed_energy_n" + std::to_string(n)] = change;
      report_.measured["printed_largest_n" + std::to_string(n)] = largest;
      runs.push_back({"n" + std::to_string(n), &run});
      names += (names.empty() ? "" : " ") + std::to_string(n);
      finest = &run;
    }
    report_.tables.push_back(std::move(table));
    if (!finest) return;
    report_.tables.push_back(
        histories("printed_history", "The equations as printed, runs to their end: SI units", runs,
                  {"mass_x", "mass_y", "beam_length", "joint", "kinetic", "strain", "gravity", "total"}));
    const std::vector<NamedRun> last{{"printed", finest}};
    report_.tables.push_back(
        shapes("printed_shapes", "Positions along the beam at the times in the column names [m]", last, 161));
    report_.tables.push_back(
        shape_nodes("printed_nodes", "Nodes at the times kept [m]", {last[0], {"coarsest", runs.front().result}}));
    std::string times;
    for (const Configuration& shape : finest->configurations) {
      times += (times.empty() ? "" : " ") + number_text(shape.t);
    }
    report_.figures.push_back({.name = "figure15",
                               .caption = "Figure 15: the initial configuration, and one arc element",
                               .script = "figure15.gp",
                               .variables = {{"folder", folder_}}});
    report_.figures.push_back(
        {.name = "figure16_printed",
         .caption = "Figure 16 by the equations as printed: configurations, beam length, trajectory, energies",
         .script = "figure16.gp",
         .variables = {{"folder", folder_},
                       {"meshes", names},
                       {"times", times},
                       {"finest", runs.back().name.substr(1)},
                       {"history", "printed_history"},
                       {"shape", "printed_shapes"},
                       {"node", "printed_nodes"},
                       {"run", "printed"},
                       {"setting", "equations as printed: virtual work, strains from a straight beam"}}});
  }

  /// What all meshes of each kind say about the position of the mass at 0.4 s.
  void add_limits() {
    for (const char* kind : {"asbuilt", "asbuilt_transported", "asbuilt_ancf", "paper"}) {
      std::vector<double> meshes;
      std::map<std::string, std::vector<double>> values;
      for (int n = 4; n <= finest_; n *= 2) {
        const RunResult* run = find(std::string(kind) + "_n" + std::to_string(n));
        const Sample* sample = run ? sample_at(*run, compared_at) : nullptr;
        if (!sample || !sample->joint_position || !sample->mass_position) continue;
        meshes.push_back(n);
        values["joint"].push_back(*sample->joint_position);
        values["mass_x"].push_back((*sample->mass_position)[0]);
        values["mass_y"].push_back((*sample->mass_position)[1]);
      }
      for (const auto& [name, of_meshes] : values) {
        report_.grid_convergence.push_back(grid_convergence(std::string(kind) + "_" + name, meshes, of_meshes));
      }
    }
  }

  void add_figures() {
    std::vector<NamedRun> meshes, choices;
    std::string names;
    for (const int n : {4, 8, 16, 32, 64}) {
      const std::string key = "asbuilt_n" + std::to_string(n);
      if (const RunResult* run = find(key)) {
        meshes.push_back({"n" + std::to_string(n), run});
        names += (names.empty() ? "" : " ") + std::to_string(n);
      }
    }
    std::string times;
    for (const Configuration& shape : reference_ ? reference_->configurations : std::vector<Configuration>{}) {
      times += (times.empty() ? "" : " ") + number_text(shape.t);
    }
    const std::string finest = std::to_string(finest_);
    for (const auto& [name, key] : {std::pair{"asbuilt", "asbuilt_n"}, std::pair{"paper", "paper_n"}}) {
      if (const RunResult* run = find(key + finest)) choices.push_back({name, run});
    }
    report_.tables.push_back(
        histories("meshes_history", "Runs on the as-built rest shape against time: SI units", meshes,
                  {"mass_x", "mass_y", "beam_length", "joint", "kinetic", "strain", "gravity", "total"}));
    report_.tables.push_back(
        histories("rest_history", "The finest mesh from either rest shape against time: SI units", choices,
                  {"mass_x", "mass_y", "beam_length", "joint", "kinetic", "strain", "gravity", "total"}));
    report_.tables.push_back(
        shapes("shapes", "Positions along the beam at the times in the column names [m]", choices, 161));
    report_.tables.push_back(shape_nodes("nodes", "Nodes at the times kept [m]", choices));
    const GnuplotVariables variables{{"folder", folder_}, {"meshes", names}, {"times", times}, {"finest", finest}};
    GnuplotVariables figure16 = variables;
    figure16.insert({{"history", "meshes_history"},
                     {"shape", "shapes"},
                     {"node", "nodes"},
                     {"run", "asbuilt"},
                     {"setting", "variational, strains measured from the initial shape"}});
    report_.figures.push_back(
        {.name = "figure16",
         .caption = "Figure 16: configurations, beam length, trajectory of the sliding node, energies",
         .script = "figure16.gp",
         .variables = figure16});
    report_.figures.push_back({.name = "rest_shape",
                               .caption = "Strains measured from the initial shape, and from a straight beam",
                               .script = "rest_shape.gp",
                               .variables = variables});
  }

  std::string folder_;
  Judged judged_;
  const std::vector<SceneCase>& cases_;
  std::vector<Outcome<RunResult>> outcomes_;
  int finest_ = 0;
  const RunResult* reference_ = nullptr;
  StudyReport report_;
};

StudyReport run(const StudyContext& context) {
  const auto cases = read_scene_cases(context.config);
  return Report(context, cases)();
}

}  // namespace
}  // namespace semicircle

Study semicircle_study();

Study semicircle_study() {
  return {.name = "semicircle",
          .title = "A mass sliding on a suspended semicircular beam: the paper's Example 3",
          .run = semicircle::run};
}

}  // namespace vlbeam
