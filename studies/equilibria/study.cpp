// Equilibria of beams and cables, stable or not, and their natural frequencies, against closed forms and shooting.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "io/files.hpp"

namespace vlbeam {
namespace equilibria {
namespace {

constexpr double pi = std::numbers::pi;

Scene beam(int elements, double EA, double EI) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.gravity = {};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = EI, .rhoA = 1};
  scene.beam.strain_law = StrainLaw::green;
  scene.beam.compression = Compression::full;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = elements;
  scene.beam.axial_strain = AxialStrain::full;  // orders are judged
  scene.start.type = SupportType::clamp;
  return scene;
}

LoadSpec at_node(LoadType type, int node, double magnitude, const Point& direction) {
  return {.type = type, .node = node, .x = {}, .magnitude = {.value = magnitude}, .direction = direction, .turn = {}};
}

/// An arc from (0, 0) to (1, 0) that rises by `rise`, or sags by minus that.
CurveSpec arc(double rise) {
  const double radius = (0.25 + rise * rise) / (2 * std::abs(rise)), side = rise > 0 ? 1 : -1;
  double half = portable::asin(0.5 / radius);
  if (std::abs(rise) > 0.5) half = pi - half;
  const double degrees = half * 180 / pi;
  return {.type = CurveType::arc,
          .center = {0.5, rise - side * radius, 0},
          .radius = radius,
          .from_degrees = side * (90 + degrees),
          .to_degrees = side * (90 - degrees)};
}

/// M = 2 pi EI/L at the end: nu = sqrt(1 + 2 M^2/(EA EI)), a circle of curvature M nu/EI (Green's law).
Scene roll_up(int n) {
  Scene scene = beam(n, 4e4, 100.0 / 3);
  scene.loads = {at_node(LoadType::moment, n, 2 * pi * 100 / 3, {1, 0, 0})};
  return scene;
}

double roll_up_error(const Scene& scene, const RunResult& result) {
  const double EA = scene.beam.section.EA, EI = scene.beam.section.EI, M = scene.loads[0].magnitude.value;
  const double stretch = std::sqrt(1 + 2 * M * M / (EA * EI)), curvature = M * stretch / EI, turn = curvature * stretch;
  const Point& end = result.samples.back().end;
  return portable::hypot(end[0] - portable::sin(turn) / curvature, end[1] - (1 - portable::cos(turn)) / curvature);
}

Scene elastica(int n) {
  Scene scene = beam(n, 1, 1);
  scene.beam.section = {.radius = 0.01};
  scene.loads = {at_node(LoadType::force, n, 0.2 * pi, {0, 1, 0})};  // P L^2/EI = 4
  return scene;
}

/// A cable of length 1.5 over a span of 1 under 1 N/m.
Scene cable(int n) {
  Scene scene = beam(n, 10, 0);
  scene.gravity = {0, -1, 0};
  const double half = 1.4957815682221;  // of the angle of the arc it starts from, sin(half)/half = 1/1.5
  const double radius = 0.75 / half;
  scene.beam.curve = arc(-radius * (1 - portable::cos(half)));
  scene.beam.strain_law = StrainLaw::engineering;
  scene.start.type = scene.end.type = SupportType::pin;
  scene.statics.steps = 4;
  return scene;
}

/// Height of the middle of the cable by Irvine's closed form, which has this law.
double irvine_height() {
  const double EA = 10, length = 1.5, weight = 1, V = weight * length / 2;
  const auto span = [&](double H) { return H * length / EA + 2 * H / weight * portable::asinh(V / H); };
  double low = 1e-3, high = 10;
  for (int i = 0; i < 200; ++i) (span((low + high) / 2) < 1 ? low : high) = (low + high) / 2;
  const double H = (low + high) / 2;
  return -(V * V / (2 * EA * weight) + (portable::hypot(H, V) - H) / weight);
}

Scene arch(int n, const Json& reference, int steps) {
  Scene scene = beam(n, reference.at("EA"), reference.at("EI"));
  scene.beam.curve = arc(reference.at("rise"));
  scene.start.type = scene.end.type = SupportType::pin;
  scene.loads = {at_node(LoadType::force, n / 2, reference.at("load"), {0, -1, 0})};
  scene.statics.steps = steps;
  scene.statics.control = LoadControl::arc_length;
  return scene;
}

/// The first extreme load of a path from sample `from` on, by the parabola through the three samples about it.
double extreme_load(const std::vector<Sample>& samples, bool largest, double load) {
  const auto factor = [&](std::size_t i) { return samples[i].equilibrium->load_factor; };
  const double sign = largest ? 1 : -1;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    if (sign * (factor(i) - factor(i - 1)) <= 0 || sign * (factor(i + 1) - factor(i)) > 0) continue;
    const auto height = [&](std::size_t k) { return samples[k].flow->loads[0][1]; };
    const double a = height(i - 1), b = height(i), c = height(i + 1), fa = factor(i - 1), fb = factor(i),
                 fc = factor(i + 1);
    const double first = (fb - fa) / (b - a), second = ((fc - fb) / (c - b) - first) / (c - a);
    const double at = (a + b) / 2 - first / (2 * second);
    return load * (fa + first * (at - a) + second * (at - a) * (at - b));
  }
  return std::nan("");
}

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context),
        reference_(parse_json(read_text(context.folder.parent_path().parent_path() / "reference" / "equilibria.json"))),
        elements_(context.config.at("elements").get<std::vector<int>>()) {}

  StudyReport operator()() {
    errors_of("roll_up", roll_up, roll_up_error, context_.config.at("floor"));
    const Json& tip = reference_.at("elastica");
    errors_of("elastica", elastica, [&](const Scene&, const RunResult& result) {
      const Point& end = result.samples.back().end;
      return portable::hypot(end[0] - tip.at("x").get<double>(), end[1] - tip.at("y").get<double>());
    });
    errors_of("catenary", cable, [](const Scene& scene, const RunResult& result) {
      const auto middle = static_cast<std::size_t>(scene.beam.elements) / 2;
      return std::abs(result.configurations.back().r[middle][1] - irvine_height());
    });
    arches();
    frequencies();
    column();
    report_.tables.push_back(std::move(errors_));
    const GnuplotVariables variables{{"folder", context_.folder.string()}};
    report_.figures = {
        {"arch", "Load against deflection of a shallow arch through its limit points", "arch.gp", variables},
        {"errors", "Error of equilibria and frequencies against the number of elements", "errors.gp", variables}};
    return std::move(report_);
  }

 private:
  /// A row of the table of errors for each mesh; with a floor of them, their order.
  void add(const std::string& name, const std::vector<int>& elements, const std::vector<double>& errors, double floor) {
    const std::vector<double> levels(elements.begin(), elements.end());
    for (std::size_t i = 0; i < errors.size(); ++i) {
      errors_.rows.push_back({name, elements[i], errors[i]});
      report_.cases.push_back(
          {.options = {{"case", name}, {"elements", elements[i]}}, .results = {{"error", errors[i]}}});
    }
    report_.measured[name + "_error"] = errors.back();
    if (floor == 0) return;
    report_.fits.push_back(
        fit_order(name, levels, errors, {.floor = floor, .rule = level_rule_of(context_.config, name)}));
  }

  template <class Make, class Error>
  void errors_of(const std::string& name, const Make& make, const Error& error, double floor = 0) {
    std::vector<double> errors;
    for (const int n : elements_) {
      const Scene scene = make(n);
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      errors.push_back(error(scene, result));
      report_.measured[name + "_negative_pivots"] = result.samples.back().equilibrium->negative_pivots;
    }
    add(name, elements_, errors, floor);
  }

  void arches() {
    const Json& known = reference_.at("arch");
    const int steps = context_.config.at("arch_steps");
    const double load = known.at("load");
    Table path{.name = "arch",
               .caption =
                   "Equilibria of a shallow arch: the load over its largest, the deflection of its middle, and in "
                   "how many directions the energy falls",
               .columns = {"elements", "deflection", "load", "falls"},
               .curve = true};
    std::vector<double> errors;
    for (const int n : elements_) {
      const RunResult result = StudyContext::simulate_to_the_end(arch(n, known, steps));
      const auto& samples = result.samples;
      errors.push_back(std::abs(samples.back().flow->loads[0][1] - known.at("height").get<double>()));
      if (n != elements_.back()) continue;
      report_.measured["arch_limit_off"] = extreme_load(samples, true, load) - known.at("limit").get<double>();
      report_.measured["arch_lower_limit_off"] =
          extreme_load(samples, false, load) - known.at("lower_limit").get<double>();
      report_.measured["arch_limit"] = extreme_load(samples, true, load);
      report_.measured["arch_lower_limit"] = extreme_load(samples, false, load);
      int wrong = 0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const double deflection = known.at("rise").get<double>() - samples[i].flow->loads[0][1];
        const int falls = samples[i].equilibrium->negative_pivots;
        path.rows.push_back({n, deflection, load * samples[i].equilibrium->load_factor, falls});
        if (i == 0 || i + 1 == samples.size()) continue;
        const bool rises = samples[i + 1].equilibrium->load_factor > samples[i].equilibrium->load_factor,
                   rose = samples[i].equilibrium->load_factor > samples[i - 1].equilibrium->load_factor;
        if (rises == rose && (falls == 0) != rises) ++wrong;
      }
      report_.measured["arch_wrong_verdicts"] = wrong;
    }
    add("arch", elements_, errors, context_.config.at("floor"));
    report_.tables.push_back(std::move(path));
  }

  void frequencies() {
    struct Case {
      const char* name;
      SupportType start, end;
      std::size_t rigid;
      double b;  ///< f = b^2/2 pi sqrt(EI/rhoA)/L^2
    };
    const auto meshes = context_.config.at("frequency_elements").get<std::vector<int>>();
    for (const Case& c : {Case{"pinned", SupportType::pin, SupportType::slide, 0, pi},
                          Case{"clamped", SupportType::clamp, SupportType::free, 0, 1.8751040687119611},
                          Case{"free", SupportType::free, SupportType::free, 3, 4.730040744862704}}) {
      std::vector<double> errors;
      for (const int n : meshes) {
        Scene scene = beam(n, 1e4, 1);
        scene.start.type = c.start;
        scene.end.type = c.end;
        scene.statics = {.steps = 1, .frequencies = 4};
        const RunResult result = StudyContext::simulate_to_the_end(scene);
        errors.push_back(std::abs(result.frequencies.at(c.rigid) * 2 * pi / (c.b * c.b) - 1));
      }
      add(c.name, meshes, errors, context_.config.at("floor_of_frequencies"));
    }
    // a chain under its weight, sqrt(g/L) j_n/2: what it stretches goes with 1/EA, and is extrapolated away
    constexpr std::array zeros{2.404825557695773, 5.520078110286311, 8.653727912911013};
    for (std::size_t mode = 0; mode < zeros.size(); ++mode) {
      std::array<double, 2> off{};
      for (const std::size_t i : {0, 1}) {
        Scene scene = beam(elements_.back(), i == 0 ? 1e5 : 2e5, 0);
        scene.gravity = {0, -1, 0};
        scene.beam.curve.end = {0, -1, 0};
        scene.start.type = SupportType::pin;
        scene.statics = {.steps = 1, .frequencies = 3};
        off[i] = StudyContext::simulate_to_the_end(scene).frequencies.at(mode) * 4 * pi / zeros[mode] - 1;
      }
      report_.measured["chain_mode" + std::to_string(mode + 1) + "_off"] = 2 * off[1] - off[0];
    }
  }

  /// A column under a load along it: the energy begins to fall at (2k - 1)^2 Euler loads.
  void column() {
    int wrong = 0;
    for (const double over : {0.99, 1.01, 8.9, 9.1, 24.5, 25.5}) {
      Scene scene = beam(elements_.back(), 1e8, 1);
      scene.loads = {at_node(LoadType::force, elements_.back(), over * pi * pi / 4, {-1, 0, 0})};
      const int falls = StudyContext::simulate_to_the_end(scene).samples.back().equilibrium->negative_pivots;
      const int expected = static_cast<int>((std::sqrt(over) + 1) / 2);
      if (falls != expected) ++wrong;
    }
    report_.measured["column_wrong_counts"] = wrong;
  }

  const StudyContext& context_;
  Json reference_;
  std::vector<int> elements_;
  StudyReport report_;
  Table errors_{.name = "errors",
                .caption = "Errors: of positions over the beam's length, of frequencies over themselves",
                .columns = {"case", "elements", "error"}};
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace equilibria

Study equilibria_study();

Study equilibria_study() {
  return {.name = "equilibria", .title = "Equilibria, their stability and natural frequencies", .run = equilibria::run};
}

}  // namespace vlbeam
