// Slender beams: what the axial strain at all points costs, what sampled strain costs, and which the default takes.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/geometry/elementary.hpp"
#include "io/files.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "scene/options.hpp"
#include "studies/slender/elastica.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {
namespace slender {
namespace {

constexpr AxialStrain strains[] = {AxialStrain::full, AxialStrain::lobatto};

/// Strain energy that events move, up or down [J].
double moved_at_events(const RunResult& run) {
  double sum = 0;
  for (const Event& event : run.events) {
    sum += std::abs(event.energy_jump.axial) + std::abs(event.energy_jump.bending);
  }
  return sum;
}

/// Geometric mean of what has been added.
class Mean {
 public:
  void add(double value) {
    sum_ += portable::log(value);
    ++count_;
  }
  double value() const { return portable::exp(sum_ / count_); }

 private:
  double sum_ = 0;
  int count_ = 0;
};

struct Case {
  std::string problem;
  double slenderness;  ///< EA L^2/EI, or what else is varied
  Scene scene;
};

double cost(const Case& item) { return item.scene.beam.elements * (item.problem == "wire" ? 100 : 1); }

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context),
        reference_(parse_json(read_text(context.folder.parent_path().parent_path() / "reference" / "slender.json"))) {
    for (const double slenderness : numbers("slenderness")) add_meshes("elastica", slenderness);
    for (const double EA : {1e5, 1e7}) add_meshes("arm_scale", EA);
    add_meshes("rod_in_sleeve", 1e7);
    add_meshes("bent", 1e8);
    add_meshes("falling", 4e4);
    for (const double softer : {1.0, 0.01}) add_meshes("wire", softer);
    add_meshes("wire_1e-5", 1);
  }

  StudyReport operator()() {
    report_.measured["unfinished_by_default"] = report_.measured["unfinished_otherwise"] = 0;
    report_.measured["unfinished_beyond_1e8"] = 0;
    const auto outcomes = context_.sweep(
        cases_, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); }, cost);
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Case& item = cases_[i];
      if (outcomes[i]) {
        runs_.emplace(key_of(item), &*outcomes[i]);
      } else {  // what locks may find no equilibrium: that is an answer, too
        Scene plain = item.scene;
        plain.beam.axial_strain.reset();
        const bool by_default = axial_strain(plain) == *item.scene.beam.axial_strain;
        const bool extreme = item.problem == "elastica" && item.slenderness > 1e8;
        report_.measured[extreme      ? "unfinished_beyond_1e8"
                         : by_default ? "unfinished_by_default"
                                      : "unfinished_otherwise"] += 1;
      }
      report_.cases.push_back({.options = options_of(item),
                               .results = {{"outcome", outcomes[i] ? "completed" : outcomes[i].failure},
                                           {"steps", outcomes[i] ? outcomes[i]->solver.steps : 0}}});
    }
    elastica();
    compare("arm_scale", {1e5, 1e7}, off_known("arm_scale"));
    compare("rod_in_sleeve", {1e7}, off_known("rod_in_sleeve"));
    bent();
    compare("falling", {4e4}, off_known("falling"));
    wire();
    report_.measured["default_takes_the_better"] = static_cast<double>(better_) / judged_;
    for (const AxialStrain strain : strains) {
      report_.measured["error_over_default/" + std::string(to_string(strain))] = over_default_[strain].value();
    }
    report_.tables.push_back(std::move(errors_));
    report_.tables.push_back(std::move(wires_));
    report_.figures = {{.name = "errors",
                        .caption = "Error against the number of elements, by the slenderness",
                        .script = "errors.gp",
                        .variables = {{"folder", context_.folder.string()}}},
                       {.name = "wire",
                        .caption = "A steel wire with a sliding mass: position, steps, and energy that events move",
                        .script = "wire.gp",
                        .variables = {{"folder", context_.folder.string()}}}};
    return std::move(report_);
  }

 private:
  /// How far the joint is off where it is known to be at the end.
  std::function<double(const RunResult&, double, double)> off_known(const char* problem) const {
    return [known = reference_.at(problem).at("joint_position").get<double>()](const RunResult& run, double, double) {
      return std::abs(*run.samples.back().joint_position - known);
    };
  }
  std::vector<double> numbers(const char* key) const { return context_.config.at(key).get<std::vector<double>>(); }
  std::vector<int> meshes(const std::string& problem) const {
    return context_.config.at("elements").at(problem).get<std::vector<int>>();
  }

  static std::string key(const std::string& problem, double slenderness, ElementKind element, AxialStrain strain,
                         int elements) {
    return problem + "/" + number_text(slenderness) + "/" + std::string(to_string(element)) + "/" +
           std::string(to_string(strain)) + "/" + std::to_string(elements);
  }
  static std::string key_of(const Case& item) {
    const BeamSpec& beam = item.scene.beam;
    return key(item.problem, item.slenderness, beam.element, *beam.axial_strain, beam.elements);
  }
  static Json options_of(const Case& item) {
    const BeamSpec& beam = item.scene.beam;
    return {{"problem", item.problem},
            {"slenderness", item.slenderness},
            {"element", to_string(beam.element)},
            {"axial_strain", to_string(*beam.axial_strain)},
            {"elements", beam.elements}};
  }
  const RunResult* run_of(const std::string& problem, double slenderness, ElementKind element, AxialStrain strain,
                          int elements) const {
    const auto found = runs_.find(key(problem, slenderness, element, strain, elements));
    return found == runs_.end() ? nullptr : found->second;
  }

  const Case& case_of(const std::string& problem, double slenderness, ElementKind element, AxialStrain strain,
                      int elements) const {
    const std::string wanted = key(problem, slenderness, element, strain, elements);
    return *std::ranges::find_if(cases_, [&](const Case& item) { return key_of(item) == wanted; });
  }

  /// The scene of a problem, in the study's data, on all its meshes, by both elements and both strains.
  void add_meshes(const std::string& problem, double slenderness) {
    Scene scene = scene_from_json(context_.config.at("scenes").at(problem));
    if (problem == "elastica" || problem == "arm_scale") scene.beam.section.EA = slenderness;
    if (problem.starts_with("wire")) scene.beam.section.EA *= slenderness;
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      for (const AxialStrain strain : strains) {
        for (const int n : meshes(problem)) {
          Scene& item = cases_.emplace_back(Case{problem, slenderness, scene}).scene;
          item.beam.element = element;
          item.beam.axial_strain = strain;
          item.beam.elements = n;
          for (LoadSpec& load : item.loads) load.node = load.node == 0 ? 0 : n;
        }
      }
    }
  }

  /// Errors of all meshes; of a mesh the default's, which is one of the two, against both.
  template <class Error>
  void compare(const std::string& problem, const std::vector<double>& slendernesses, const Error& error) {
    for (const double slenderness : slendernesses) {
      for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
        for (const int n : meshes(problem)) {
          std::map<AxialStrain, double> errors;
          Scene plain;
          for (const Case& item : cases_) {
            if (item.problem == problem && item.slenderness == slenderness && item.scene.beam.elements == n) {
              plain = item.scene;
            }
          }
          plain.beam.axial_strain.reset();
          const AxialStrain taken = axial_strain(plain);
          for (const AxialStrain strain : strains) {
            const RunResult* const run = run_of(problem, slenderness, element, strain, n);
            if (run == nullptr) continue;
            errors[strain] = error(*run, slenderness, n);
            const std::string name = problem + "_" + number_text(slenderness) + "_" +
                                     (element == ElementKind::ale_ancf ? "ancf_" : "rancf_") +
                                     std::string(to_string(strain)) + "_n" + std::to_string(n);
            errors_.rows.push_back({problem, slenderness, to_string(element), to_string(strain), n,
                                    strain == taken ? 1 : 0, errors[strain]});
            report_.measured[name] = errors[strain];
            if (strain == taken)
              report_.measured["default/" + problem + "_" + number_text(slenderness) + "_" +
                               (element == ElementKind::ale_ancf ? "ancf_n" : "rancf_n") + std::to_string(n)] =
                  errors[strain];
          }
          if (errors.size() < 2) continue;
          for (const auto& [strain, value] : errors) over_default_[strain].add(value / errors[taken]);
          ++judged_;
          if (errors[taken] <= 1.1 * std::min(errors[AxialStrain::full], errors[AxialStrain::lobatto])) ++better_;
        }
      }
    }
  }

  void elastica() {
    const Scene scene = scene_from_json(context_.config.at("scenes").at("elastica"));
    const double EI = scene.beam.section.EI, force = scene.loads.front().magnitude.value;
    std::map<double, Elastica> exact;
    for (const double EA : numbers("slenderness")) exact[EA] = slender::elastica(EA, EI, force);
    const Point stiff = slender::elastica(1e14, EI, force).end;
    report_.measured["inextensible_y_off"] = stiff[1] - 0.8106090249;  // elliptic integrals
    const auto off = [&](const RunResult& run, double EA, double /*elements*/) {
      const Point &end = run.samples.back().end, &known = exact[EA].end;
      return portable::hypot(end[0] - known[0], end[1] - known[1]);
    };
    compare("elastica", numbers("slenderness"), off);
    for (const double EA : {1e6, 1e8}) {
      for (const AxialStrain strain : strains) {
        std::vector<double> levels, errors, slopes;
        for (const int n : meshes("elastica")) {
          if (n < 4) continue;
          const Case& item = case_of("elastica", EA, ElementKind::ale_ancf, strain, n);
          const RunResult* const run = run_of("elastica", EA, ElementKind::ale_ancf, strain, n);
          if (run == nullptr) return;
          constexpr int per_element = 8;
          levels.push_back(n);
          errors.push_back(off(*run, EA, n));
          slopes.push_back(
              slope_error(exact[EA], points_along(item.scene, run->configurations.back(), per_element), per_element));
        }
        const std::string name = "elastica_" + number_text(EA) + "_" + std::string(to_string(strain));
        for (const auto& [of, values] : {std::pair{name, errors}, {name + "_slopes", slopes}}) {
          report_.fits.push_back(
              fit_order(of, levels, values, {.floor = 1e-11, .rule = level_rule_of(context_.config, of)}));
        }
      }
    }
  }

  /// Frequencies about the bent elastica, the first six, against the finest mesh of sampled strain, whose own error is
  /// measured by the mesh before it.
  void bent() {
    const std::vector<int> ns = meshes("bent");
    const RunResult* const finest = run_of("bent", 1e8, ElementKind::ale_ancf, AxialStrain::lobatto, ns.back());
    const RunResult* const before = run_of("bent", 1e8, ElementKind::ale_ancf, AxialStrain::lobatto, ns[ns.size() - 2]);
    if (finest == nullptr || before == nullptr) return;
    const auto off = [&](const RunResult& run) {
      double most = 0;
      for (std::size_t i = 0; i < 6; ++i) {
        most = std::max(most, std::abs(run.frequencies[i] / finest->frequencies[i] - 1));
      }
      return most;
    };
    report_.measured["bent_reference_off"] = off(*before);
    for (const AxialStrain strain : strains) {
      for (const int n : ns) {
        const RunResult* const run = run_of("bent", 1e8, ElementKind::ale_ancf, strain, n);
        if (run == nullptr || run == finest) continue;
        report_.measured["bent_" + std::string(to_string(strain)) + "_n" + std::to_string(n)] = off(*run);
        errors_.rows.push_back(
            {"bent", 1e8, "ALE-ANCF", to_string(strain), n, strain == AxialStrain::lobatto ? 1 : 0, off(*run)});
      }
    }
  }

  void wire() {
    const std::vector<int> ns = meshes("wire");
    std::map<AxialStrain, double> limits;
    for (const AxialStrain strain : strains) {
      const RunResult* const run = run_of("wire_1e-5", 1, ElementKind::ale_ancf, strain, meshes("wire_1e-5").back());
      if (run == nullptr) return;
      limits[strain] = *run->samples.back().joint_position;
    }
    const double limit = (limits[AxialStrain::full] + limits[AxialStrain::lobatto]) / 2;
    report_.measured["wire_limit"] = limit;
    report_.measured["wire_limit_off"] = std::abs(limits[AxialStrain::full] - limit);
    for (const std::string problem : {"wire", "wire_1e-5"}) {
      for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
        for (const AxialStrain strain : strains) {
          for (const int n : meshes(problem)) {
            const RunResult* const run = run_of(problem, 1, element, strain, n);
            if (run == nullptr) continue;
            const double error = std::abs(*run->samples.back().joint_position - limit);
            const RunResult* const soft = run_of(problem, 0.01, element, strain, n);
            const double moved = moved_at_events(*run);
            const double ratio = soft != nullptr ? moved / moved_at_events(*soft) : std::nan("");
            wires_.rows.push_back({problem == "wire" ? 1e-4 : 1e-5, to_string(element), to_string(strain), n, error,
                                   run->solver.steps, moved, number_or_null(ratio)});
            const std::string name = problem + "_" + (element == ElementKind::ale_ancf ? "ancf_" : "rancf_") +
                                     std::string(to_string(strain)) + "_n" + std::to_string(n);
            report_.measured[name + "_error"] = error;
            report_.measured[name + "_steps"] = static_cast<double>(run->solver.steps);
            if (soft != nullptr) report_.measured[name + "_events_over_soft"] = ratio;
          }
        }
      }
    }
  }

  const StudyContext& context_;
  Json reference_;
  std::vector<Case> cases_;
  std::map<std::string, const RunResult*> runs_;
  std::map<AxialStrain, Mean> over_default_;
  int judged_ = 0, better_ = 0;
  Table errors_{
      .name = "errors",
      .caption =
          "Error of the end (elastica) or the joint (arm_scale, rod_in_sleeve, falling) [m], largest of the first "
          "six frequencies about a bent state (bent) [-]; slenderness is EA L^2/EI, of the rods in sleeves EA; "
          "`taken` is 1 for the strain that is the default there",
      .columns = {"problem", "slenderness", "element", "axial_strain", "elements", "taken", "error"}};
  Table wires_{.name = "wires",
               .caption =
                   "Steel wire of 1 mm radius with 20 g: error of the joint at 0.5 s [m], steps, strain energy that "
                   "events move [J], and that over the same of a wire with EA/100 and equal EI",
               .columns = {"accuracy", "element", "axial_strain", "elements", "error", "steps", "moved", "over_soft"}};
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace slender

Study slender_study();

Study slender_study() {
  return {.name = "slender", .title = "What slender beams cost, and how right they are", .run = slender::run};
}

}  // namespace vlbeam
