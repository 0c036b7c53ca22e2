// What length control costs: weights of merged elements and velocities of the new mesh, on the falling beam with a
// sliding mass (Ding & Ouyang 2022, §6.1).
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/json.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "tools/judged.hpp"
#include "tools/measures.hpp"

namespace vlbeam {
namespace weights {
namespace {

constexpr double early = 0.5, late = 0.65;  // [s], before and after the whip
struct Case {
  std::string group;  ///< mesh | reference | other reference | implicit | policy | initial
  Scene scene;
};

std::string key_of(ElementKind element) { return element == ElementKind::ale_ancf ? "ancf" : "rancf"; }

std::string key_of(const Case& item) {
  const Scene& scene = item.scene;
  return key_of(scene.beam.element) + "_" + std::string(to_string(scene.length_control.velocities)) + "_n" +
         std::to_string(scene.beam.elements);
}

/// In all elements of ALE-RANCF, polynomials among them: what 5 miss of an event's bending energy would hide what the
/// weights do.
constexpr int rational_points = 10;

std::vector<Case> read_cases(const Json& config) {
  std::vector<Case> cases;
  const Scene base = scene_from_json(config.at("scene"));
  auto with = [&](const char* group, int n, ElementKind element, VelocityTransfer velocities) -> Case& {
    Case item{group, base};
    item.scene.beam.elements = n;
    item.scene.beam.element = element;
    if (element == ElementKind::ale_rancf) item.scene.beam.quadrature_points = rational_points;
    item.scene.length_control.velocities = velocities;
    return cases.emplace_back(std::move(item));
  };
  for (const auto element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
    for (const auto& velocities : names(VelocityTransfer{})) {
      for (const int n : config.at("elements").get<std::vector<int>>()) with("mesh", n, element, velocities.value);
      const Json& implicit = config.at("implicit");
      for (const double step : implicit.at("steps").get<std::vector<double>>()) {
        auto& integrator = with("implicit", implicit.at("elements"), element, velocities.value).scene.integrator;
        integrator = {};
        integrator.type = IntegratorType::generalized_alpha;
        integrator.step = step;
        integrator.rho_inf = implicit.at("rho_inf");
      }
    }
  }
  const Json& policy = config.at("policy");
  for (const int n : policy.at("elements").get<std::vector<int>>()) {
    for (const auto& merge : names(MergePolicy{})) {
      if (merge.value == MergePolicy::rest_arc) continue;  // unit weights, on a beam that is straight at rest
      if (merge.value == MergePolicy::own) continue;       // no rule to try
      for (const auto velocities : {VelocityTransfer::nodal, VelocityTransfer::conservative}) {
        for (const auto element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
          if (element == ElementKind::ale_ancf && merge.value == MergePolicy::point_fit) continue;  // its unit weights
          Case& item = with("policy", n, element, velocities);
          item.scene.length_control.merge = merge.value;
          item.scene.duration = policy.at("duration");
        }
      }
    }
  }
  const Json& initial = config.at("initial");
  for (const int n : initial.at("elements").get<std::vector<int>>()) {
    for (const auto& weights : initial.at("weights").get<std::vector<std::array<double, 4>>>()) {
      for (const auto transport : {WeightTransport::frozen, WeightTransport::transported}) {
        Scene& scene = with("initial", n, ElementKind::ale_rancf, VelocityTransfer::nodal).scene;
        scene.beam.weights = weights;
        scene.beam.rest_shape = RestShape::as_built;
        scene.weights = transport;
        scene.duration = initial.at("duration");
      }
    }
  }
  for (const int n : config.at("reference").get<std::vector<int>>()) {
    with("reference", n, ElementKind::ale_ancf, VelocityTransfer::conservative);
  }
  with("other reference", config.at("reference").back(), ElementKind::ale_ancf, VelocityTransfer::nodal);
  return cases;
}

double cost(const Case& item) {
  const double n = item.scene.beam.elements;
  return (item.group == "implicit" ? 100 / item.scene.integrator.step : 4e3 * n) * n * quadrature_points(item.scene);
}

/// Sums over the length-control events until `late`.
struct Jumps {
  double kinetic = 0, elastic = 0, total = 0, size = 0, largest = 0, moved = 0, momentum = 0;
};  // of energies by the 25-point rule

Jumps jumps_of(const RunResult& result) {
  Jumps sum;
  for (const Event* event : merges_until(result, late)) {
    sum.size += std::abs(event->energy_jump.total());
    for (const double m : event->momentum_jump) sum.momentum = std::max(sum.momentum, std::abs(m));
    sum.kinetic += std::abs(event->energy_jump.kinetic);
    sum.elastic += std::abs(event->energy_jump.axial + event->energy_jump.bending);
    sum.total += event->energy_jump.total();
    sum.largest = std::max(sum.largest, std::abs(event->energy_jump.total()));
    sum.moved = std::max(sum.moved, displacement_by(*event).merged);
  }
  return sum;
}

class Report {
 public:
  Report(const StudyContext& context, const std::vector<Case>& cases)
      : folder_(context.folder.string()),
        judged_(judged_at(context.folder.parent_path(), "falling_beam")),
        cases_(cases),
        outcomes_(context.sweep(
            cases, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); }, cost)) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i].group == "reference" && outcomes_[i]) {
        coarser_ = reference_;
        reference_ = &*outcomes_[i];
      }
      if (cases[i].group == "other reference" && outcomes_[i]) other_ = &*outcomes_[i];
    }
  }

  StudyReport operator()() {
    add_cases();
    if (reference_ != nullptr && coarser_ != nullptr) {
      for (const double t : {early, late}) {
        // what the next mesh differs by, or the same mesh with other velocities: both tend to one limit
        const double mesh = position_error(*coarser_, *reference_, t);
        const double velocities = other_ != nullptr ? position_error(*other_, *reference_, t) : 0;
        report_.measured["reference_mesh_difference_" + time_key(t)] = mesh;
        report_.measured["reference_velocities_difference_" + time_key(t)] = velocities;
        report_.measured["reference_error_" + time_key(t)] = std::max(mesh, velocities);
      }
    }
    add_meshes();
    add_policies();
    add_initial();
    add_implicit();
    const GnuplotVariables variables{{"folder", folder_}};
    report_.figures = {{.name = "errors",
                        .caption = "Error against the number of elements, before and after the whip",
                        .script = "errors.gp",
                        .variables = variables},
                       {.name = "jumps",
                        .caption = "Energy that length control gains and loses",
                        .script = "jumps.gp",
                        .variables = variables},
                       {.name = "temporal",
                        .caption = "Generalized-alpha: temporal error against the step",
                        .script = "temporal.gp",
                        .variables = variables}};
    return std::move(report_);
  }

 private:
  static std::string time_key(double t) { return t == early ? "early" : "late"; }

  void add_cases() {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Scene& scene = cases_[i].scene;
      Json options = {{"group", cases_[i].group},
                      {"elements", scene.beam.elements},
                      {"element", to_string(scene.beam.element)},
                      {"merge", to_string(merge_policy(scene))},
                      {"velocities", to_string(scene.length_control.velocities)},
                      {"weights", scene.beam.weights},
                      {"integrator", to_string(scene.integrator.type)}};
      if (has_fixed_step(scene.integrator.type)) options["step"] = scene.integrator.step;
      StudyCase item{.options = std::move(options), .results = {}, .failure = outcomes_[i].failure};
      if (outcomes_[i]) {
        const RunResult& result = *outcomes_[i];
        const Jumps jumps = jumps_of(result);
        item.results = {{"events", merges_until(result, late).size()},
                        {"kinetic_jumps", jumps.kinetic},
                        {"elastic_jumps", jumps.elastic},
                        {"total_jump", jumps.total},
                        {"largest_jump", jumps.largest},
                        {"rhs_evaluations", result.solver.rhs_evaluations}};
      }
      report_.cases.push_back(std::move(item));
    }
  }

  void add_meshes() {
    Table table{
        .name = "meshes",
        .caption = "Until 0.65 s, each run against N = " + reference_name() +
                   ": error at 0.5 s and at 0.65 s, sums of the jumps at length-control events [J], the largest "
                   "jump of the total energy at one event [J], all by a 25-point rule, the largest displacement of a "
                   "material point over the element length, and Table 2's sigma",
        .columns = {"element", "velocities", "elements", "events", "error_early", "error_late", "kinetic_jumps",
                    "elastic_jumps", "total_jump", "largest_jump", "moved", "sigma"}};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].group != "mesh" || !outcomes_[i]) continue;
      const Scene& scene = cases_[i].scene;
      const RunResult& result = *outcomes_[i];
      const Jumps jumps = jumps_of(result);
      const double nan = std::nan("");
      const double at_early = reference_ ? position_error(result, *reference_, early) : nan,
                   at_late = reference_ ? position_error(result, *reference_, late) : nan;
      const double moved = jumps.moved * scene.beam.elements, sigma = weight_set(result, late).sigma;
      table.rows.push_back({to_string(scene.beam.element), to_string(scene.length_control.velocities),
                            scene.beam.elements, merges_until(result, late).size(), number_or_null(at_early),
                            number_or_null(at_late), jumps.kinetic, jumps.elastic, jumps.total, jumps.largest, moved,
                            sigma});
      const std::string key = key_of(cases_[i]);
      report_.measured["kinetic_jumps_" + key] = jumps.kinetic;
      report_.measured["elastic_jumps_" + key] = jumps.elastic;
      report_.measured["largest_jump_" + key] = jumps.largest / result.max_kinetic;
      report_.measured["energy_jumps_" + key] = jumps.size;
      std::size_t unrestored = 0;
      for (const Event& event : result.events) unrestored += event.restored ? 0 : 1;
      report_.measured["unrestored_" + key] = static_cast<double>(unrestored);
      report_.measured["moved_" + key] = moved;
      report_.measured["sigma_" + key] = sigma;
      if (std::isfinite(at_early)) report_.measured["error_early_" + key] = at_early;
      if (const Sample* sample = sample_at(result, judged_.t); sample != nullptr) {
        report_.measured["judged_error_" + key] = judged_.error(*sample) / beam_length_m;
        report_.measured["judge_uncertainty"] = judged_.uncertainty / beam_length_m;
      }
      if (std::isfinite(at_late)) report_.measured["error_late_" + key] = at_late;
      if (scene.length_control.velocities != VelocityTransfer::nodal) {
        const std::string nodal = key_of(scene.beam.element) + "_nodal_n" + std::to_string(scene.beam.elements);
        report_.measured["kinetic_jumps_share_" + key] = jumps.kinetic / report_.measured.at("kinetic_jumps_" + nodal);
        report_.measured["energy_jumps_share_" + key] = jumps.size / report_.measured.at("energy_jumps_" + nodal);
      }
    }
    report_.tables.push_back(std::move(table));
  }

  double error_at(const RunResult& run, double t) const {
    return reference_ ? position_error(run, *reference_, t) : std::nan("");
  }

  /// Ways to choose the shape of a merged element.
  void add_policies() {
    Table table{.name = "policies",
                .caption =
                    "Shapes of merged elements: error over L at 0.5 s, sums of the jumps of strain energy and of the "
                    "total [J], largest jump of a momentum [kg m/s, kg m^2/s], largest displacement of a material "
                    "point over the element length",
                .columns = {"element", "merge", "velocities", "elements", "events", "error_early", "elastic_jumps",
                            "energy_jumps", "momentum_jump", "moved"}};
    std::map<std::string, Jumps> paper;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].group != "policy" || !outcomes_[i]) continue;
      const Scene& scene = cases_[i].scene;
      const auto& control = scene.length_control;
      const RunResult& run = *outcomes_[i];
      const Jumps jumps = jumps_of(run);
      const double error = error_at(run, early), moved = jumps.moved * scene.beam.elements;
      table.rows.push_back({to_string(scene.beam.element), to_string(merge_policy(scene)),
                            to_string(control.velocities), scene.beam.elements, merges_until(run, late).size(),
                            number_or_null(error), jumps.elastic, jumps.size, jumps.momentum, moved});
      const std::string mesh = "_n" + std::to_string(scene.beam.elements);
      const bool rational = scene.beam.element == ElementKind::ale_rancf;
      if (rational && control.merge == MergePolicy::point_fit && control.velocities == VelocityTransfer::nodal) {
        paper[mesh] = jumps;
        report_.measured["error_point_fit" + mesh] = error;
      }
      const std::string policy = std::string(to_string(merge_policy(scene))) + "_" + key_of(scene.beam.element) + "_" +
                                 std::string(to_string(control.velocities)) + mesh;
      report_.measured["policy_largest_jump/" + policy] = jumps.largest / run.max_kinetic;
      report_.measured["policy_energy_jumps/" + policy] = jumps.size;
      report_.measured["policy_momentum_jump/" + policy] = jumps.momentum;
      if (control.merge != MergePolicy::least_change) continue;
      const std::string key = key_of(scene.beam.element) + "_" + std::string(to_string(control.velocities)) + mesh;
      report_.measured["least_change_momentum_" + key] = jumps.momentum;
      report_.measured["least_change_error_share_" + key] = error / report_.measured["error_point_fit" + mesh];
      if (!rational) continue;
      report_.measured["least_change_elastic_share_" + key] = jumps.elastic / paper[mesh].elastic;
      report_.measured["least_change_energy_share_" + key] = jumps.size / paper[mesh].size;
    }
    report_.tables.push_back(std::move(table));
  }

  /// Weights other than 1 from the start, strains measured from the shape they give.
  void add_initial() {
    Table table{.name = "initial",
                .caption =
                    "Initial weights of every element, frozen or transported, strains from the initial shape: joint "
                    "position [m] and error over L at 0.4 s, sums of the jumps of kinetic and strain energy until "
                    "then [J]",
                .columns = {"elements", "weights", "w0", "w1", "w2", "w3", "joint", "events", "error", "kinetic_jumps",
                            "elastic_jumps"}};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].group != "initial" || !outcomes_[i]) continue;
      const Scene& scene = cases_[i].scene;
      const Jumps jumps = jumps_of(*outcomes_[i]);
      const auto& w = scene.beam.weights;
      const double error = error_at(*outcomes_[i], scene.duration);
      const auto joint = outcomes_[i]->samples.back().joint_position;
      table.rows.push_back({scene.beam.elements, to_string(weight_transport(scene)), w[0], w[1], w[2], w[3],
                            joint ? Json(*joint) : Json(), outcomes_[i]->events.size(), number_or_null(error),
                            jumps.kinetic, jumps.elastic});
      if (w[0] != w[3] || w[1] == w[2]) continue;  // skew: a speed along the beam that changes inside the element
      auto& most = report_.measured["skew_error_" + std::string(to_string(weight_transport(scene))) + "_n" +
                                    std::to_string(scene.beam.elements)];
      most = std::max(most, error);
    }
    report_.tables.push_back(std::move(table));
  }

  /// Temporal errors: against the same mesh and velocities by the error-controlled method of the scene.
  void add_implicit() {
    Table table{.name = "temporal",
                .caption = "Generalized-alpha to 0.65 s on one mesh: error against the same mesh converged in time",
                .columns = {"element", "velocities", "step", "error_early", "error_late", "newton_iterations"}};
    std::map<std::string, std::vector<double>> steps, errors;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].group != "implicit" || !outcomes_[i]) continue;
      const Scene& scene = cases_[i].scene;
      const auto same = [&](const Case& other) { return other.group == "mesh" && key_of(other) == key_of(cases_[i]); };
      const auto found = std::ranges::find_if(cases_, same);
      if (found == cases_.end()) continue;
      const auto& exact = outcomes_[static_cast<std::size_t>(found - cases_.begin())];
      if (!exact) continue;
      const double at_early = position_error(*outcomes_[i], *exact, early),
                   at_late = position_error(*outcomes_[i], *exact, late);
      table.rows.push_back({to_string(scene.beam.element), to_string(scene.length_control.velocities),
                            scene.integrator.step, number_or_null(at_early), number_or_null(at_late),
                            outcomes_[i]->solver.newton.iterations});
      const std::string key = key_of(cases_[i]);
      steps[key].push_back(scene.integrator.step);
      errors[key].push_back(at_late);
    }
    for (const auto& [key, late_errors] : errors) {
      const OrderFit fit = fit_order("temporal_" + key, steps[key], late_errors);
      report_.measured["temporal_order_" + key] = fit.slope;
      report_.measured["temporal_finest_" + key] = late_errors.back();
      report_.fits.push_back(fit);
    }
    report_.tables.push_back(std::move(table));
  }

  std::string reference_name() const {
    int n = 0;
    for (const Case& item : cases_) {
      if (item.group == "reference") n = item.scene.beam.elements;
    }
    return std::to_string(n);
  }

  std::string folder_;
  Judged judged_;
  const std::vector<Case>& cases_;
  std::vector<Outcome<RunResult>> outcomes_;
  const RunResult* reference_ = nullptr;
  const RunResult* coarser_ = nullptr;
  const RunResult* other_ = nullptr;  ///< the finest mesh with nodal velocities
  StudyReport report_;
};

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context.config);
  return Report(context, cases)();
}

}  // namespace
}  // namespace weights

Study weights_study();

Study weights_study() {
  return {.name = "weights",
          .title = "Weights and velocities at length control: what merging costs in error and in energy",
          .run = weights::run};
}

}  // namespace vlbeam
