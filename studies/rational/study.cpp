// When does the rational element pay? Both elements side by side, at rest and in motion.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/geometry/elementary.hpp"
#include "io/scene_json.hpp"
#include "scene/build.hpp"
#include "tools/measures.hpp"
#include "tools/rigid_wire.hpp"
#include "tools/scene_sweep.hpp"

namespace vlbeam {
namespace {

/// One run of a problem; `item.sweep` says which element it has: "polynomial", "frozen" or "transported" (rational).
struct Case {
  std::string problem;
  SceneCase item;
};

constexpr std::array kinds{"polynomial", "frozen", "transported"};

std::vector<Case> read_cases(const Json& config) {
  std::vector<Case> cases;
  for (const auto& [problem, scenes] : config.at("problems").items()) {
    for (SceneCase& item : read_scene_cases(scenes)) cases.push_back({problem, std::move(item)});
  }
  return cases;
}

double cost(const Case& c) {
  const Scene& scene = c.item.scene;
  const double n = scene.beam.elements;
  return scene.integrator.type == IntegratorType::dopri5 ? n * n : 10 * n;
}

/// Largest error of the bead's arc length over the samples, over the length of the wire.
double wire_error(const Scene& scene, const RunResult& run) {
  std::vector<double> times;
  for (const Sample& sample : run.samples) times.push_back(sample.t);
  const auto exact = on_rigid_arc(scene, times);
  double largest = 0;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const auto& x = run.samples[i].joint_position;
    largest = std::max(largest, x ? std::abs(*x - exact[i]) / beam_length(scene) : 1.0);
  }
  return largest;
}

/// Largest error of positions over the samples against another run, over the length of the beam.
double largest_error(const Scene& scene, const RunResult& run, const RunResult& reference) {
  double largest = 0;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    largest = std::max(largest, position_error(run.samples[i], reference.samples[i]));
  }
  return largest / beam_length(scene);
}

/// How far the elements of a beam at rest are from its axis C: across it, max |(r - C) x C'|, over the length of the
/// beam, and along it, max ||r_x| - 1|.
struct AtRest {
  double across = 0, uneven = 0;
};
AtRest at_rest(const Scene& scene) {
  const auto chain = build_chain<2>(scene);
  const auto axis = build_axis<2>(scene);
  AtRest largest;
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const auto at = chain.coordinates(k);
    const double l = at.x_b - at.x_a;
    const auto curve = RationalCubic<double, 2>::from_nodal(at.e, l, chain.mesh.weights[static_cast<std::size_t>(k)].w);
    for (int i = 0; i <= 50; ++i) {
      const double u = i / 50.0;
      const auto r = curve.evaluate(u);
      // An exact element may run ahead of the arc length: the point of C nearest to it.
      double x = at.x_a + u * l;
      for (int step = 0; step < 20; ++step) {
        x = std::clamp(x + axis.tangent(x).dot(r[0] - axis.position(x)), at.x_a, at.x_b);
      }
      const Vec<double, 2> off = r[0] - axis.position(x), t = axis.tangent(x);
      largest.across = std::max(largest.across, std::abs(off[0] * t[1] - off[1] * t[0]));
      largest.uneven = std::max(largest.uneven, std::abs(r[1].norm() / l - 1));
    }
  }
  largest.across /= axis.length();
  return largest;
}

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context),
        cases_(read_cases(context.config)),
        outcomes_(context.sweep(
            cases_, [](const Case& c) { return StudyContext::simulate_to_the_end(c.item.scene); }, cost)) {}

  StudyReport operator()() {
    add_cases();
    add_rest();
    for (const auto& [problem, scenes] : context_.config.at("problems").items()) add_problem(problem);
    report_.tables.push_back(std::move(meshes_));
    report_.figures = {{.name = "errors",
                        .caption = "Error against the number of elements and against work, both elements",
                        .script = "errors.gp",
                        .variables = {{"folder", context_.folder.string()}}},
                       {.name = "rest",
                        .caption = "Distance from the axis and evenness of elements at rest",
                        .script = "rest.gp",
                        .variables = {{"folder", context_.folder.string()}}}};
    return std::move(report_);
  }

 private:
  void add_cases() {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      StudyCase item{.options = {{"problem", cases_[i].problem},
                                 {"element", cases_[i].item.sweep},
                                 {"scene", scene_to_json(cases_[i].item.scene)}},
                     .results = {},
                     .failure = outcomes_[i].failure};
      if (outcomes_[i]) {
        const RunResult& run = *outcomes_[i];
        item.results = {{"joint_position", *run.samples.back().joint_position},
                        {"events", run.events.size()},
                        {"max_kinetic", run.max_kinetic},
                        {"rhs_evaluations", run.solver.rhs_evaluations}};
      }
      report_.cases.push_back(std::move(item));
    }
  }

  void add_rest() {
    const Json& rest = context_.config.at("rest");
    Table table{.name = "rest",
                .caption =
                    "Elements of a beam at rest: largest distance from its axis over the beam's length, and largest "
                    "||r_x| - 1|",
                .columns = {"curve", "kind", "elements", "across", "uneven"}};
    double exact = 0;
    for (const auto& [name, curve] : rest.at("curves").items()) {
      for (const char* kind : {"polynomial", "even", "exact"}) {
        std::vector<double> levels, across;
        for (const int n : rest.at("elements").get<std::vector<int>>()) {
          const bool polynomial = kind == std::string("polynomial");
          Json scene = rest.at("scene");
          scene["beam"]["curve"] = curve;
          scene["beam"]["elements"] = n;
          scene["beam"]["element"] = polynomial ? "ALE-ANCF" : "ALE-RANCF";
          scene["beam"]["axis"] = polynomial ? "even" : kind;
          const AtRest found = at_rest(scene_from_json(scene));
          table.rows.push_back({name, kind, n, found.across, found.uneven});
          levels.push_back(n);
          across.push_back(found.across);
          if (kind == std::string("exact")) exact = std::max(exact, found.across);
        }
        if (kind != std::string("exact")) {
          report_.fits.push_back(
              fit_order(name + ", " + kind + ", distance from the axis", levels, across, {.floor = 1e-14}));
        }
      }
    }
    report_.measured["across_exact"] = exact;
    report_.tables.push_back(std::move(table));
  }

  const RunResult* find(const std::string& problem, const std::string& kind, int elements) const {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Case& c = cases_[i];
      if (outcomes_[i] && c.problem == problem && c.item.sweep == kind && c.item.scene.beam.elements == elements) {
        return &*outcomes_[i];
      }
    }
    return nullptr;
  }

  /// Errors of all meshes: of the bead against a rigid wire; else against the finest polynomial mesh, known to what the
  /// finest rational one differs from it.
  void add_problem(const std::string& problem) {
    int finest = 0;
    const Scene* scene = nullptr;
    for (const Case& c : cases_) {
      if (c.problem != problem) continue;
      finest = std::max(finest, c.item.scene.beam.elements);
      scene = &c.item.scene;
    }
    const bool wire = scene->beam.curve.type == CurveType::arc;
    const RunResult* reference = find(problem, "polynomial", finest);
    const RunResult* other = find(problem, "frozen", finest);
    double floor = 0;
    if (!wire && reference && other) {
      floor = largest_error(*scene, *other, *reference);
      report_.measured["uncertainty_" + problem] = floor;
      report_.measured["end_" + problem] = *reference->samples.back().joint_position;
    }
    for (const std::string kind : kinds) {
      std::vector<double> levels, errors;
      std::map<int, double> jumps;
      for (std::size_t i = 0; i < cases_.size(); ++i) {
        const Case& c = cases_[i];
        if (c.problem != problem || c.item.sweep != kind || !outcomes_[i] || (!wire && !reference)) continue;
        const RunResult& run = *outcomes_[i];
        const int n = c.item.scene.beam.elements;
        const double work = static_cast<double>(run.solver.rhs_evaluations) * n;
        const double jump = event_energy(run).largest / run.max_kinetic;
        jumps[n] = jump;
        std::optional<double> error;
        if (wire) {
          error = wire_error(c.item.scene, run);
        } else if (n < finest) {
          error = largest_error(c.item.scene, run, *reference);
        }
        meshes_.rows.push_back({problem, kind, n, error ? Json(*error) : Json(), work, run.events.size(), jump});
        if (!error) continue;
        const std::string key = problem + "_" + kind + "_n" + std::to_string(n);
        report_.measured["error_" + key] = *error;
        levels.push_back(n);
        errors.push_back(*error);
      }
      if (jumps.contains(finest / 4)) {
        report_.measured["jump_order_" + problem + "_" + kind] =
            portable::log(jumps[finest / 4] / jumps[finest]) / portable::log(4);
      }
      if (levels.size() > 1) {
        report_.fits.push_back(fit_order(problem + ", " + kind, levels, errors,
                                         {.floor = floor, .rule = level_rule_of(context_.config, problem)}));
      }
    }
  }

  const StudyContext& context_;
  std::vector<Case> cases_;
  std::vector<Outcome<RunResult>> outcomes_;
  Table meshes_{.name = "meshes",
                .caption =
                    "Largest error of positions over the samples, over the beam's length; work: evaluations times "
                    "elements; events and their largest jump of energy by the 25-point rule over the largest kinetic "
                    "energy",
                .columns = {"problem", "kind", "elements", "error", "work", "events", "jump"}};
  StudyReport report_;
};

}  // namespace

Study rational_study();

Study rational_study() {
  return {.name = "rational", .title = "When does the rational element pay?", .run = [](const StudyContext& context) {
            return Report(context)();
          }};
}

}  // namespace vlbeam
