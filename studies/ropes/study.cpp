// Ropes: weights over a wheel, around a guide, hoisted, deployed, and hanging, with and without a ground to lie on.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/geometry/elementary.hpp"
#include "io/scene_json.hpp"
#include "scene/options.hpp"
#include "studies/ropes/catenaries.hpp"
#include "studies/ropes/closed_forms.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {
namespace ropes {
namespace {

constexpr int fewest_in_ring = 16;  // elements, on both sides of the ring together
constexpr double rounding = 1e-8;   // of strains, times EA over the pull

struct Case {
  double varied = 0;  ///< by the problem: mass a length, coefficient of friction, length hoisted, step, elements, ...
  Scene scene;
};

/// Relative errors of the cases of a problem.
struct Errors {
  std::vector<double> varied, values;
};

double size_of(const Point& pull) { return portable::hypot(pull[0], pull[1]); }
double angle_from_below(const Point& place) { return std::abs(portable::atan2(place[0], -place[1])); }

class Report {
 public:
  explicit Report(const StudyContext& context) : context_(context) {}

  StudyReport operator()() {
    atwood();
    capstan();
    hoist();
    tether();
    hanging();
    catenaries();
    mooring();
    for (Table* table : {&atwood_, &capstan_, &hoist_, &tether_, &hanging_, &catenaries_, &mooring_, &ground_}) {
      report_.tables.push_back(std::move(*table));
    }
    report_.figures = {
        {.name = "motions",
         .caption = "Ropes beside their closed forms: weights over a guide, friction around it, a "
                    "pendulum that is hoisted",
         .script = "motions.gp",
         .variables = {{"folder", context_.folder.string()}}},
        {.name = "errors",
         .caption = "Errors of ropes: angular momentum of a deployed tether against the step, pulls of "
                    "hanging ropes against the mesh",
         .script = "errors.gp",
         .variables = {{"folder", context_.folder.string()}}},
        {.name = "catenaries",
         .caption = "Hanging ropes of all stiffnesses against elastic catenaries: largest errors of shape "
                    "and tension; larger symbols are stiffer ropes",
         .script = "catenaries.gp",
         .variables = {{"folder", context_.folder.string()}}}};
    return std::move(report_);
  }

 private:
  template <class Change>
  std::vector<Case> cases_of(const char* problem, const Change& change) const {
    std::vector<Case> cases;
    for (const double value : context_.config.at("sweeps").at(problem).get<std::vector<double>>()) {
      Case& item = cases.emplace_back(Case{value, scene_from_json(context_.config.at("scenes").at(problem))});
      change(item.scene, value);
    }
    return cases;
  }
  /// Runs a problem once a value of its sweep, and measures the errors.
  template <class Change, class Measure>
  Errors each(const char* problem, const char* varied, const Change& change, const Measure& measure) {
    const auto cases = cases_of(problem, change);
    const auto runs =
        context_.sweep(cases, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); });
    Errors errors;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      errors.varied.push_back(cases[i].varied);
      errors.values.push_back(measure(cases[i], *runs[i]));
      report_.cases.push_back({.options = {{"problem", problem}, {varied, cases[i].varied}},
                               .results = {{"error", errors.values.back()}, {"steps", runs[i]->solver.steps}}});
      report_.measured[problem + ("_" + number_text(cases[i].varied))] = errors.values.back();
    }
    report_.measured[problem] = std::ranges::max(errors.values);
    report_.measured[problem + std::string("_finest")] = errors.values.back();
    return errors;
  }
  void fit(const char* problem, const Errors& errors, double floor) {
    report_.fits.push_back(fit_order(problem, errors.varied, errors.values,
                                     {.floor = floor, .rule = level_rule_of(context_.config, problem)}));
  }

  /// Of the way at the end, relative to it.
  void atwood() {
    each(
        "atwood", "rhoA", [](Scene& scene, double rhoA) { scene.beam.section.rhoA = rhoA; },
        [&](const Case& item, const RunResult& run) {
          const double half = *run.samples.front().joint_position;
          const AtwoodMachine exact{.heavy = item.scene.point_masses[1].mass,
                                    .light = item.scene.point_masses[0].mass,
                                    .rope = item.varied * 2 * half,
                                    .length = 2 * half};
          double error = 0;
          for (const Sample& sample : run.samples) {
            const double way = half - *sample.joint_position;
            error = std::abs(way - exact.way(sample.t));
            atwood_.rows.push_back({item.varied, sample.t, way, exact.way(sample.t)});
          }
          return error / exact.way(run.samples.back().t);
        });
  }

  /// The worst over all angles around the guide, once the rope slips.
  void capstan() {
    const double load = 10;
    each(
        "capstan", "coefficient",
        [&](Scene& scene, double mu) {
          scene.sliding_joints.front().friction->coefficient = mu;
          scene.loads.front().magnitude.value = load;
        },
        [&](const Case& item, const RunResult& run) {
          double worst = 0;
          for (const Sample& sample : run.samples) {
            if (sample.t < context_.config.at("slips_from").get<double>()) continue;
            const double angle = portable::atan2(sample.end[1], sample.end[0]);
            const double ratio = size_of(sample.reactions[1].position) / load;
            const double exact = portable::exp(item.varied * angle);
            worst = std::max(worst, std::abs(ratio / exact - 1));
            capstan_.rows.push_back({item.varied, angle, ratio, exact});
          }
          return worst;
        });
  }

  /// The amplitude behind the hoist over that before it.
  void hoist() {
    each(
        "hoist", "hoisted", [](Scene& scene, double length) { scene.start.feed->table[1][1] = -length; },
        [&](const Case& item, const RunResult& run) {
          const Sample& first = run.samples.front();
          const double before = angle_from_below(first.end);
          double after = 0;
          const double end = item.scene.start.feed->table[1][0];
          for (const Sample& sample : run.samples) {
            if (sample.t > end + 1) after = std::max(after, angle_from_below(sample.end));
          }
          const double length = size_of(first.end), shorter = length / (length - item.varied);
          const double exact = portable::pow(shorter, 0.75);
          hoist_.rows.push_back({shorter, after / before, exact});
          return std::abs(after / before / exact - 1);
        });
  }

  /// The largest change of the angular momentum, relative to it.
  void tether() {
    const Errors errors = each(
        "tether", "step", [](Scene& scene, double step) { scene.integrator.step = step; },
        [&](const Case& item, const RunResult& run) {
          const double first = run.samples.front().angular_momentum[2];
          double worst = 0;
          for (const Sample& sample : run.samples) {
            worst = std::max(worst, std::abs(sample.angular_momentum[2] / first - 1));
          }
          tether_.rows.push_back({item.varied, worst});
          return worst;
        });
    fit("tether", errors, 1e-10);
  }

  /// Of the pull at the lower or the right support, relative to the closed form.
  template <class Change>
  Errors pulls(const char* problem, const char* varied, const Pull& exact, Table& table, const Change& change) {
    return each(problem, varied, change, [&](const Case& item, const RunResult& run) {
      const Point& pull = run.samples.back().reactions[1].position;
      const double across = std::abs(std::abs(pull[0]) / exact.along - 1),
                   up = std::abs(std::abs(pull[1]) / exact.up - 1), error = std::max(across, up);
      table.rows.push_back({item.varied, std::abs(pull[0]), std::abs(pull[1]), error});
      return error;
    });
  }
  void hanging() {
    const Pull exact = hanging_rope(scene_from_json(context_.config.at("scenes").at("hanging")));
    fit("hanging", pulls("hanging", "elements", exact, hanging_, set_elements), rounding);
  }
  /// Shape and tension along ropes of all stiffnesses, on few elements and on many.
  void catenaries() {
    struct Cell {
      std::size_t hanging;
      double stiffness;
      int elements;
    };
    const Json& sweep = context_.config.at("sweeps").at("catenaries");
    const auto elements = sweep.at("elements").get<std::vector<int>>();
    std::vector<Cell> cells;
    for (std::size_t hanging = 0; hanging < hangings.size(); ++hanging) {
      for (const double stiffness : sweep.at("stiffness").get<std::vector<double>>()) {
        for (const int n : elements) cells.push_back({hanging, stiffness, n});
      }
    }
    const auto rope_of = [](const Cell& c) {
      return HangingRope(static_cast<Hanging>(c.hanging), c.stiffness, c.elements);
    };
    const auto runs = context_.sweep(
        cells, [&](const Cell& cell) { return StudyContext::simulate_to_the_end(rope_of(cell).scene()); });
    double shape = 0, tension = 0, warned = 0, failed = 0;
    std::map<std::string, Errors> by_hanging;
    std::map<int, double> in_ring;  // by elements
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Cell& cell = cells[i];
      const std::string& name = hangings[cell.hanging];
      StudyCase& seen = report_.cases.emplace_back();
      seen.options = {
          {"problem", "catenaries"}, {"hanging", name}, {"stiffness", cell.stiffness}, {"elements", cell.elements}};
      if (!runs[i]) {
        ++failed;
        seen.results = {{"failure", runs[i].failure}};
        continue;
      }
      const CatenaryError error = rope_of(cell).error_of(*runs[i]);
      double& worst_shape = cell.hanging == static_cast<std::size_t>(Hanging::ring) ? in_ring[cell.elements] : shape;
      worst_shape = std::max(worst_shape, error.shape);
      tension = std::max(tension, error.tension);
      warned += static_cast<double>(runs[i]->warnings.size());
      catenaries_.rows.push_back({static_cast<double>(cell.hanging), cell.stiffness, static_cast<double>(cell.elements),
                                  error.shape, error.tension});
      seen.results = {{"shape", error.shape}, {"tension", error.tension}};
      Errors& worst = by_hanging[name];
      if (worst.varied.empty()) {
        worst.varied.assign(elements.begin(), elements.end());
        worst.values.assign(elements.size(), 0);
      }
      double& of_mesh = worst.values[i % elements.size()];
      of_mesh = std::max(of_mesh, error.shape);
    }
    report_.measured["catenaries_shape"] = shape;
    double shape_in_ring = 0;
    for (const auto& [n, error] : in_ring) {
      report_.measured["catenaries_shape_in_ring_" + std::to_string(n)] = error;
      if (n >= fewest_in_ring) shape_in_ring = std::max(shape_in_ring, error);
    }
    report_.measured["catenaries_shape_in_ring"] = shape_in_ring;
    report_.measured["catenaries_tension"] = tension;
    report_.measured["catenaries_amiss"] = warned + failed;
    fit("catenaries_held", by_hanging.at("held"), rounding);
    fit("catenaries_ring", by_hanging.at("ring"), rounding);
  }
  void mooring() {
    const Pull exact = rope_from_the_ground(scene_from_json(context_.config.at("scenes").at("mooring")));
    pulls("mooring", "elements", exact, mooring_, set_elements);
    pulls("ground", "stiffness", exact, ground_, [](Scene& scene, double k) { scene.ground->stiffness = k; });
  }
  static void set_elements(Scene& scene, double n) { scene.beam.elements = static_cast<int>(std::lround(n)); }

  const StudyContext& context_;
  Table atwood_{.name = "atwood",
                .caption = "Weights on a rope over a guide: the rope's mass a length [kg/m], time [s], way [m]",
                .columns = {"rhoA", "t", "way", "exact"}};
  Table capstan_{.name = "capstan",
                 .caption = "Ratio of the tensions on the two sides of a guide, against the angle around it [rad]",
                 .columns = {"coefficient", "angle", "ratio", "exact"}};
  Table hoist_{.name = "hoist",
               .caption = "Amplitude of a pendulum that was hoisted, over that before, against the ratio of lengths",
               .columns = {"lengths", "amplitudes", "exact"}};
  Table tether_{.name = "tether",
                .caption = "A tether deployed from a hub that spins: change of angular momentum against the step [s]",
                .columns = {"step", "change"}};
  Table hanging_{.name = "hanging",
                 .caption = "A rope between two supports: pull [N] and its error, against the mesh",
                 .columns = {"elements", "along", "up", "error"}};
  Table catenaries_{
      .name = "catenaries",
      .caption =
          "Ropes between two pins (0), with a free end (1), through a ring (2): errors of the shape, over "
          "the length, and of the tension, over the largest one, by stiffness EA over the weight",
      .columns = {"hanging", "stiffness", "elements", "shape", "tension"}};
  Table mooring_{.name = "mooring",
                 .caption = "A chain from the ground to a fairlead: pull [N] and its error, against the mesh",
                 .columns = {"elements", "along", "up", "error"}};
  Table ground_{.name = "ground",
                .caption =
                    "The same chain on the finest mesh: pull [N] and its error, against the stiffness of the "
                    "ground [N/m^2]",
                .columns = {"stiffness", "along", "up", "error"}};
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace ropes

Study ropes_study();

Study ropes_study() { return {.name = "ropes", .title = "Ropes move and hang as closed forms say", .run = ropes::run}; }

}  // namespace vlbeam
