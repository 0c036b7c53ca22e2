// How many Gauss points an element needs: polynomial and rational, as an integral and in the motion of the falling
// beam.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>

#include "core/element/moving_element.hpp"
#include "core/element/quadrature.hpp"
#include "core/geometry/elementary.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "tools/measures.hpp"
#include "tools/scene_sweep.hpp"

namespace vlbeam {
namespace quadrature {
namespace {

constexpr int exact_points = 25;

/// The strain energy of one bent and stretched element, with weights (1, ratio, ratio, 1) or (1, ratio, 1/ratio, 1), by
/// as many points.
struct Integral {
  double axial, bending;
};

Integral strain_energy(double ratio, bool skew, int points) {
  const NodalCubic<double, 2> e{{0, 0}, {1, 0.3}, {1, 0}, {1, -0.4}};
  const auto curve = RationalCubic<double, 2>::from_nodal(e, 1, {1, ratio, skew ? 1 / ratio : ratio, 1});
  Integral sum{0, 0};
  for (const auto& [u, weight] : gauss_legendre(points)) {
    const auto r = curve.evaluate(u);
    const ElasticStress<double, 2> elastic(r[1], r[2], {1, 1});
    sum.axial += weight * elastic.axial;
    sum.bending += weight * elastic.bending;
  }
  return sum;
}

std::string key_of(const SceneCase& item) {
  const std::string element = item.scene.beam.element == ElementKind::ale_ancf ? "ancf" : "rancf";
  return (item.sweep == "unequal" ? "unequal" : element) + "_n" + std::to_string(item.scene.beam.elements);
}

double cost(const SceneCase& item) {
  return portable::pow(item.scene.beam.elements, 2) * quadrature_points(item.scene);
}

class Report {
 public:
  Report(const StudyContext& context, const std::vector<SceneCase>& cases)
      : config_(context.config),
        folder_(context.folder.string()),
        cases_(cases),
        outcomes_(context.sweep(
            cases, [](const SceneCase& item) { return StudyContext::simulate_to_the_end(item.scene); }, cost)) {}

  StudyReport operator()() {
    add_integrals();
    add_motion();
    report_.figures = {{.name = "quadrature",
                        .caption = "Error of one element's strain energy, and of the falling beam, against the points",
                        .script = "quadrature.gp",
                        .variables = {{"folder", folder_}}}};
    return std::move(report_);
  }

 private:
  void add_integrals() {
    Table table{.name = "integrals",
                .caption =
                    "One element with weights (1, ratio, ratio, 1) or, skew, (1, ratio, 1/ratio, 1): relative error of "
                    "its axial and its bending energy by so many points, against 25",
                .columns = {"skew", "ratio", "points", "axial", "bending"}};
    for (const bool skew : {false, true}) {
      for (const double ratio : config_.at("integrals").at("ratios").get<std::vector<double>>()) {
        const Integral exact = strain_energy(ratio, skew, exact_points);
        for (const int points : config_.at("integrals").at("points").get<std::vector<int>>()) {
          const Integral sum = strain_energy(ratio, skew, points);
          const double axial = std::abs(sum.axial / exact.axial - 1),
                       bending = std::abs(sum.bending / exact.bending - 1);
          table.rows.push_back({skew ? 1 : 0, ratio, points, axial, bending});
          if (ratio == 1 && points == 5) report_.measured["polynomial_axial_5_points"] = axial;
          if (ratio == 2 && !skew && points == 5) report_.measured["rational_axial_5_points"] = axial;
          if (ratio == 2 && !skew && points == 10) report_.measured["rational_axial_10_points"] = axial;
        }
      }
    }
    report_.tables.push_back(std::move(table));
  }

  const RunResult* exact_of(const SceneCase& item) const {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (outcomes_[i] && quadrature_points(cases_[i].scene) == exact_points && key_of(cases_[i]) == key_of(item)) {
        return &*outcomes_[i];
      }
    }
    return nullptr;
  }

  void add_motion() {
    Table table{.name = "motion",
                .caption =
                    "Falling beam: error over L at the end against 25 points on the same mesh, drift of the total "
                    "energy between events over the largest kinetic energy, evaluations of the equations",
                .columns = {"case", "points", "error", "drift", "rhs_evaluations"}};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const SceneCase& item = cases_[i];
      const int points = quadrature_points(item.scene);
      StudyCase entry{.options = {{"sweep", item.sweep},
                                  {"element", to_string(item.scene.beam.element)},
                                  {"elements", item.scene.beam.elements},
                                  {"points", points}},
                      .results = {},
                      .failure = outcomes_[i].failure};
      if (outcomes_[i]) {
        const RunResult& run = *outcomes_[i];
        const RunResult* exact = exact_of(item);
        const double error = exact ? position_error(run, *exact, run.samples.back().t) : std::nan("");
        const double drift = run.max_energy_drift / run.max_kinetic;
        entry.results = {
            {"drift", drift}, {"events", run.events.size()}, {"rhs_evaluations", run.solver.rhs_evaluations}};
        if (std::isfinite(error) && points != exact_points) {
          table.rows.push_back({key_of(item), points, error, drift, run.solver.rhs_evaluations});
          report_.measured["error_" + key_of(item) + "_" + std::to_string(points)] = error;
        }
        auto& most = report_.measured["largest_drift"];
        most = std::max(most, drift);
      }
      report_.cases.push_back(std::move(entry));
    }
    report_.tables.push_back(std::move(table));
  }

  const Json& config_;
  std::string folder_;
  const std::vector<SceneCase>& cases_;
  std::vector<Outcome<RunResult>> outcomes_;
  StudyReport report_;
};

StudyReport run(const StudyContext& context) {
  const auto cases = read_scene_cases(context.config);
  return Report(context, cases)();
}

}  // namespace
}  // namespace quadrature

Study quadrature_study();

Study quadrature_study() {
  return {.name = "quadrature", .title = "How many Gauss points an element needs", .run = quadrature::run};
}

}  // namespace vlbeam
