// Beams in space whose sections have frames: an arc across its plane, a bend that goes far, a rod rolled up to a helix,
// buckling, frequencies of straight, twisted and curved beams, a shaft fed through two clamps, a free beam that
// tumbles.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "io/files.hpp"
#include "io/scene_json.hpp"
#include "scene/build.hpp"
#include "scene/options.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {
namespace space {
namespace {

using std::numbers::pi;

struct Case {
  std::string problem;
  double torsion = 0;  ///< GIp/EI, of the arc
  int elements = 0;
  Scene scene;
};

/// Of the equilibrium of a scene under its loads and turned ends times a factor.
bool is_stable(Scene scene, double factor) {
  for (LoadSpec& load : scene.loads) load.magnitude.value *= factor;
  if (scene.end.motion) scene.end.motion->angle->value *= factor;
  const RunResult run = simulate(scene, StudyContext::until_interrupted());
  return run.status == RunStatus::completed && run.samples.back().equilibrium->negative_pivots == 0;
}

double critical_factor(const Scene& scene, double low, double high) {
  constexpr int halvings = 24;
  if (!is_stable(scene, low) || is_stable(scene, high)) return std::nan("");
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (is_stable(scene, middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}
std::vector<double> numbers_of(const Point& point) { return {point.begin(), point.end()}; }

class Report {
 public:
  explicit Report(const StudyContext& context) : context_(context) {}

  StudyReport operator()() {
    quarter_arc();
    polynomial_arc();
    bend();
    helix();
    spring();
    buckling();
    modes();
    arc_modes();
    twisted_modes();
    fed();
    tumbling();
    report_.tables.push_back(std::move(arcs_));
    report_.tables.push_back(std::move(buckled_));
    report_.tables.push_back(std::move(steps_));
    report_.tables.push_back(std::move(arc_modes_));
    report_.tables.push_back(std::move(twisted_));
    report_.tables.push_back(std::move(fed_));
    report_.tables.push_back(std::move(shapes_));
    report_.figures = {
        {.name = "errors",
         .caption = "A quarter arc across its plane: error of its end against mesh and torsional stiffness; a "
                    "driven free arc; a shaft under torque; a shaft that runs through two clamps",
         .script = "errors.gp",
         .variables = {{"folder", context_.folder.string()}}},
        {.name = "shapes",
         .caption = "A rod that a moment rolls up to a helix, and the bend of 45 degrees, in perspective",
         .script = "shapes.gp",
         .variables = {{"folder", context_.folder.string()}}}};
    return std::move(report_);
  }

 private:
  std::vector<int> meshes(const char* problem) const {
    return context_.config.at("elements").at(problem).get<std::vector<int>>();
  }
  Scene scene_of(const char* problem, int elements) const {
    Scene scene = scene_from_json(context_.config.at("scenes").at(problem));
    for (LoadSpec& load : scene.loads) load.node = load.node == 0 ? 0 : elements;
    scene.beam.elements = elements;
    return scene;
  }
  Json reference(const char* file) const {
    return parse_json(read_text(context_.folder.parent_path().parent_path() / "reference" / file));
  }
  void keep(const Json& options, const Json& results) {
    report_.cases.push_back({.options = options, .results = results});
  }

  /// Keeps error(n) of each mesh, and fits their order.
  template <class Error>
  void refine(const std::string& problem, const std::vector<int>& elements, const Error& error,
              const OrderFitOptions& options = {}) {
    std::vector<double> levels, errors;
    for (const int n : elements) {
      levels.push_back(n);
      errors.push_back(error(n));
      report_.measured[problem + "_n" + std::to_string(n)] = errors.back();
      keep({{"problem", problem}, {"elements", n}}, {{"error", errors.back()}});
    }
    report_.fits.push_back(fit_order(problem, levels, errors, options));
  }

  /// Keeps five of the equilibria of a path, to be drawn.
  void draw(const char* problem, const RunResult& run) {
    const auto& all = run.configurations;
    constexpr std::array<double, 5> shares{0, 0.125, 0.25, 0.5, 1};
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const auto at = static_cast<std::size_t>(shares[i] * static_cast<double>(all.size() - 1));
      for (const Point& r : all[at].r) shapes_.rows.push_back({problem, i, r[0], r[1], r[2]});
    }
  }

  /// Bending and torsion of a curved beam (Castigliano): P R^3 (pi/4/EI + (3 pi/4 - 2)/GIp).
  static double exact_arc(const Scene& scene) {
    const Section& section = scene.beam.section;
    return scene.loads.front().magnitude.value * (pi / 4 / section.EI + (3 * pi / 4 - 2) / section.GIp);
  }

  void quarter_arc() {
    std::vector<Case> cases;
    const auto torsions = context_.config.at("torsion").get<std::vector<double>>();
    for (const double torsion : torsions) {
      for (const int n : meshes("quarter_arc")) {
        Case& item = cases.emplace_back(Case{"quarter_arc", torsion, n, scene_of("quarter_arc", n)});
        item.scene.beam.section.GIp = torsion * item.scene.beam.section.EI;
        item.scene.loads.front().magnitude.value *= std::sqrt(std::min(1.0, torsion));  // small, however soft it is
      }
    }
    const auto runs =
        context_.sweep(cases, [](const Case& item) { return StudyContext::simulate_to_the_end(item.scene); });
    std::vector<double> levels, errors;
    double worst = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Case& item = cases[i];
      const double error = std::abs(runs[i]->samples.back().end[2] / exact_arc(item.scene) - 1);
      const std::string name = "quarter_arc_" + number_text(item.torsion);
      arcs_.rows.push_back({item.torsion, item.elements, error});
      report_.measured[name + "_n" + std::to_string(item.elements)] = error;
      keep({{"problem", item.problem}, {"torsion", item.torsion}, {"elements", item.elements}}, {{"error", error}});
      if (item.elements == 8) worst = std::max(worst, error);
      levels.push_back(item.elements);
      errors.push_back(error);
      if (item.elements != meshes("quarter_arc").back()) continue;
      report_.fits.push_back(
          fit_order(name, levels, errors, {.floor = 1e-8, .rule = level_rule_of(context_.config, name)}));
      levels.clear();
      errors.clear();
    }
    report_.measured["quarter_arc_worst_n8"] = worst;
  }

  /// The same on elements without weights, which know the arc to their order only.
  void polynomial_arc() {
    const auto error = [&](int n) {
      Scene scene = scene_of("quarter_arc", n);
      scene.beam.element = ElementKind::ale_ancf;
      return std::abs(StudyContext::simulate_to_the_end(scene).samples.back().end[2] / exact_arc(scene) - 1);
    };
    refine("polynomial_arc", meshes("quarter_arc"), error, {.floor = 1e-8});
  }

  /// A spring of whole turns under a small force along its axis, which a moment brings there: the wire bears P R about
  /// the direction that it goes round, P R^2 L (cos^2/GIp + sin^2/EI) of its angle to the turns (Castigliano).
  void spring() {
    const Scene scene = scene_of("spring", 1);
    const CurveSpec& curve = scene.beam.curve;
    const Section& s = scene.beam.section;
    const double turns = (curve.to_degrees - curve.from_degrees) / 360, round = 2 * pi * curve.radius,
                 wire = std::sqrt(round * round + curve.pitch * curve.pitch), flat = round / wire,
                 steep = curve.pitch / wire, force = scene.loads.front().magnitude.value;
    const double exact =
        force * curve.radius * curve.radius * turns * wire * (flat * flat / s.GIp + steep * steep / s.EI);
    const auto error = [&](int n) {
      const RunResult run = StudyContext::simulate_to_the_end(scene_of("spring", n));
      return std::abs((run.samples.back().end[2] - turns * curve.pitch) / exact - 1);
    };
    refine("spring", meshes("spring"), error, {.floor = 1e-7});
  }

  /// Bathe & Bolourchi (1979). Published elements shear; the known end is of an independent static code without shear.
  void bend() {
    const auto known = context_.config.at("bend_end").get<std::vector<double>>();
    std::vector<double> finest;
    for (const int n : meshes("bend")) {
      const RunResult run = StudyContext::simulate_to_the_end(scene_of("bend", n));
      const std::vector<double> end = numbers_of(run.samples.back().end);
      double most = 0;
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(end[c] - known[c]));
      report_.measured["bend_n" + std::to_string(n)] = most;
      if (n == meshes("bend").back()) draw("bend", run);
      report_.measured["bend_change_n" + std::to_string(n)] = finest.empty() ? 0 : distance(end, finest);
      keep({{"problem", "bend"}, {"elements", n}}, {{"end", end}, {"off", most}});
      finest = end;
    }
  }

  /// The moment M at its end is that all along a rod, which so winds about it: EI t' = M x t, however it twists.
  void helix() {
    const Scene scene = scene_of("helix", 1);
    const LoadSpec& load = scene.loads.front();
    const Vec<double, 3> axis = vector_of<3>(load.direction).normalized(), along = vector_of<3>(scene.beam.curve.end);
    const double length = along.norm(), turns = load.magnitude.value / scene.beam.section.EI;
    const Vec<double, 3> kept = axis * axis.dot(along) / length, u = along / length - kept, v = axis.cross(u);
    const Vec<double, 3> exact =
        kept * length + (portable::sin(turns * length) * u + (1 - portable::cos(turns * length)) * v) / turns;
    const auto error = [&](int n) {
      const RunResult run = StudyContext::simulate_to_the_end(scene_of("helix", n));
      if (n == meshes("helix").back()) draw("helix", run);
      return (vector_of<3>(run.samples.back().end) - exact).norm() / length;
    };
    refine("helix", meshes("helix"), error);
  }

  void buckling() {
    // M L/EI of a shaft between clamps (Greenhill 1883); P L^2/sqrt(EI_z GIp) of a narrow strip (Michell, Prandtl 1899)
    for (const auto& [problem, known] : {std::pair{"greenhill", 8.986818916}, {"strip", 4.0126}}) {
      for (const int n : meshes(problem)) {
        const double critical = critical_factor(scene_of(problem, n), 0.6 * known, 1.6 * known);
        const double off = std::abs(critical / known - 1);
        report_.measured[std::string(problem) + "_n" + std::to_string(n)] = off;
        buckled_.rows.push_back({problem, n, critical, off});
        keep({{"problem", problem}, {"elements", n}}, {{"critical", critical}});
      }
    }
  }

  /// A straight cantilever of length 1 with two bending stiffnesses.
  void modes() {
    const double first = 3.5160152685;  // of cos x cosh x = -1, squared
    for (const int n : meshes("modes")) {
      const Scene scene = scene_of("modes", n);
      const Section& s = scene.beam.section;
      const RunResult run = StudyContext::simulate_to_the_end(scene);
      std::vector<double> exact{first / (2 * pi) * std::sqrt(*s.EI_y / s.rhoA),
                                first / (2 * pi) * std::sqrt(*s.EI_z / s.rhoA), std::sqrt(s.GIp / s.rhoIp) / 4};
      std::ranges::sort(exact);
      double most = 0;
      for (std::size_t i = 0; i < exact.size(); ++i) most = std::max(most, std::abs(run.frequencies[i] / exact[i] - 1));
      report_.measured["modes_n" + std::to_string(n)] = most;
      keep({{"problem", "modes"}, {"elements", n}}, {{"frequencies", run.frequencies}, {"off", most}});
    }
  }

  /// A clamped arc, against the linear equations of a curved beam.
  void arc_modes() {
    const Json known = reference("arc_frequencies.json");
    struct Mode {
      double frequency;
      std::size_t kind;
    };
    const std::array<const char*, 2> kinds{"in_plane", "across"};
    std::vector<Mode> exact;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      for (const double f : known.at(kinds[kind]).get<std::vector<double>>()) exact.push_back({f, kind});
    }
    std::ranges::sort(exact, {}, &Mode::frequency);
    std::vector<double> levels;
    std::array<std::vector<double>, 2> errors;
    for (const int n : meshes("arc_modes")) {
      const Scene scene = scene_of("arc_modes", n);
      const RunResult run = StudyContext::simulate_to_the_end(scene);
      std::array<double, 2> most{};
      for (std::size_t i = 0; i < run.frequencies.size(); ++i) {
        double& of_kind = most[exact[i].kind];
        of_kind = std::max(of_kind, std::abs(run.frequencies[i] / exact[i].frequency - 1));
      }
      levels.push_back(n);
      for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        errors[kind].push_back(most[kind]);
        report_.measured["arc_" + std::string(kinds[kind]) + "_n" + std::to_string(n)] = most[kind];
      }
      arc_modes_.rows.push_back({n, most[0], most[1]});
      keep({{"problem", "arc_modes"}, {"elements", n}}, {{"frequencies", run.frequencies}});
    }
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      report_.fits.push_back(fit_order("arc_" + std::string(kinds[kind]), levels, errors[kind]));
    }
  }

  /// A shaft between clamps one of which turns, against the equation of a beam under torque.
  void twisted_modes() {
    const Json known = reference("shaft_frequencies.json");
    const auto torques = known.at("torques").get<std::vector<double>>(),
               exact = known.at("frequencies").get<std::vector<double>>();
    const int n = meshes("twisted").back();
    double most = 0;
    for (std::size_t i = 0; i < torques.size(); ++i) {
      Scene scene = scene_of("twisted", n);
      scene.end.motion->angle->value *= torques[i];
      const RunResult run = StudyContext::simulate_to_the_end(scene);
      const double off = std::abs(run.frequencies.front() / exact[i] - 1),
                   apart = std::abs(run.frequencies[1] / run.frequencies[0] - 1);
      most = std::max({most, off, apart});
      twisted_.rows.push_back({torques[i], run.frequencies.front(), exact[i], off});
      keep({{"problem", "twisted"}, {"torque", torques[i]}}, {{"frequencies", run.frequencies}, {"off", off}});
    }
    report_.measured["twisted"] = most;
  }

  /// A shaft that runs at v through two clamps, under an even torque that has grown slowly: it twists 1/(1 - v^2/c^2)
  /// times as far as one at rest, c^2 = GIp/rhoIp, for its spin rides along.
  void fed() {
    const auto speeds = context_.config.at("speeds").get<std::vector<double>>();
    struct Run {
      double speed;
      int elements;
      Scene scene;
    };
    std::vector<Run> cases;
    for (const double speed : speeds) {
      for (const int n : meshes("fed")) {
        Run& item = cases.emplace_back(Run{speed, n, scene_of("fed", n)});
        const Section& s = item.scene.beam.section;
        const double v = speed * std::sqrt(s.GIp / s.rhoIp);
        item.scene.initial_velocity = InitialVelocitySpec{.translation = {v, 0, 0}};
        item.scene.start.feed = TimeSpec{.rate = v};
        item.scene.end.feed = TimeSpec{.rate = -v};
      }
    }
    const auto runs =
        context_.sweep(cases, [](const Run& item) { return StudyContext::simulate_to_the_end(item.scene); });
    std::vector<double> levels, errors;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Run& item = cases[i];
      const TimeSpec& torque = item.scene.loads.front().magnitude;
      const double exact =
          torque.value * torque.value / (24 * item.scene.beam.section.GIp) / std::pow(1 - item.speed * item.speed, 2);
      double sum = 0;
      int count = 0;
      for (const Sample& sample : runs[i]->samples) {
        if (sample.t < torque.ramp) continue;
        sum += sample.energy.torsion;
        ++count;
      }
      const double error = std::abs(sum / count / exact - 1);
      fed_.rows.push_back({item.speed, item.elements, sum / count, exact, error});
      keep({{"problem", "fed"}, {"speed", item.speed}, {"elements", item.elements}},
           {{"torsion", sum / count}, {"error", error}, {"events", runs[i]->events.size()}});
      if (item.speed != speeds.back()) continue;
      levels.push_back(item.elements);
      errors.push_back(error);
      report_.measured["fed_n" + std::to_string(item.elements)] = error;
    }
    report_.fits.push_back(fit_order("fed", levels, errors));
  }

  void tumbling() {
    const Scene free = scene_of("tumbling", 4), driven = scene_of("driven", 4);
    const RunResult fine = StudyContext::simulate_to_the_end(free);
    const Sample &first = fine.samples.front(), &last = fine.samples.back();
    const std::vector<double> none(3, 0);
    const auto drift = [&](const auto& before, const auto& after) {
      const std::vector<double> a(before.begin(), before.end()), b(after.begin(), after.end());
      return distance(a, b) / distance(a, none);
    };
    report_.measured["tumbling_momentum"] = drift(first.momentum, last.momentum);
    report_.measured["tumbling_angular_momentum"] = drift(first.angular_momentum, last.angular_momentum);
    report_.measured["tumbling_energy"] = fine.max_energy_drift / first.energy.total();
    const RunResult reference = StudyContext::simulate_to_the_end(driven);
    report_.measured["driven_energy"] = reference.max_energy_drift / reference.max_kinetic;
    keep({{"problem", "tumbling"}, {"integrator", to_string(free.integrator.type)}}, {{"steps", fine.solver.steps}});
    std::vector<double> levels, errors;
    for (const double step : context_.config.at("steps").get<std::vector<double>>()) {
      Scene scene = driven;
      scene.integrator.type = IntegratorType::generalized_alpha;
      scene.integrator.step = step;
      const RunResult run = StudyContext::simulate_to_the_end(scene);
      const double error = distance(numbers_of(run.samples.back().end), numbers_of(reference.samples.back().end));
      levels.push_back(1 / step);
      errors.push_back(error);
      steps_.rows.push_back({step, error});
      keep({{"problem", "driven"}, {"step", step}}, {{"error", error}});
    }
    report_.fits.push_back(fit_order("generalized_alpha", levels, errors));
  }

  const StudyContext& context_;
  Table arcs_{.name = "arcs",
              .caption = "Quarter arc across its plane: GIp/EI, elements, relative error of its end",
              .columns = {"torsion", "elements", "error"}};
  Table buckled_{.name = "buckled",
                 .caption = "Critical torque M L/EI between clamps, critical force P L^2/sqrt(EI_z GIp) of a strip",
                 .columns = {"problem", "elements", "critical", "off"}};
  Table steps_{.name = "steps",
               .caption = "A free arc that a force and a torque drive: error of its end [m] against the step [s]",
               .columns = {"step", "error"}};
  Table arc_modes_{.name = "arc_modes",
                   .caption =
                       "Clamped arc of 120 degrees: largest relative error of its first two frequencies in its "
                       "plane, of its first three across it",
                   .columns = {"elements", "in_plane", "across"}};
  Table twisted_{.name = "twisted",
                 .caption = "Shaft between clamps under the torque M L/EI: its first frequency [Hz], the exact one",
                 .columns = {"torque", "frequency", "exact", "off"}};
  Table fed_{.name = "fed",
             .caption =
                 "Shaft that runs at v through two clamps under an even torque: v/c, elements, energy of torsion [J], "
                 "the exact one",
             .columns = {"speed", "elements", "torsion", "exact", "error"}};
  Table shapes_{.name = "shapes",
                .caption = "Shapes on the way to the load, 0 to 4: nodes of the finest mesh [m]",
                .columns = {"problem", "shape", "x", "y", "z"}};
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace space

Study space_study();

Study space_study() {
  return {.name = "space", .title = "Beams in space bend about two axes and twist", .run = space::run};
}

}  // namespace vlbeam
