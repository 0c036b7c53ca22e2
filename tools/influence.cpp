#include "tools/influence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "io/json.hpp"
#include "io/quantity.hpp"
#include "scene/build.hpp"
#include "scene/derived.hpp"
#include "scene/options.hpp"
#include "scene/sections.hpp"
#include "scene/simulate.hpp"
#include "scene/validate.hpp"
#include "tools/interrupt.hpp"
#include "tools/sweep.hpp"

namespace vlbeam {
namespace {

constexpr double small_share = 1e-4;  // of what the beam weighs or bears: what is left of the square is 1e-8 of it
constexpr double usual_strain = 1e-3;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

double size(const Point& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

Point usual_direction(const Scene& scene) {
  if (size(scene.gravity) > 0) return scene.gravity;
  return scene.dimension == 2 ? Point{0, -1, 0} : Point{0, 0, -1};
}

/// A force that changes little: a share of the weight, or of what bends the beam by a usual strain.
double usual_force(const Scene& scene) {
  const BeamSection section = build_section(scene);
  const double length = beam_length(scene), weight = mean_mass(scene.beam, length) * length * size(scene.gravity);
  const double bends = section.stiffness.EI / (length * length), stretches = usual_strain * section.stiffness.EA;
  return small_share * (weight > 0 ? weight : bends > 0 ? bends : stretches);
}

/// Unit of a quantity over a newton.
std::string over_a_newton(const std::string& unit) {
  if (unit == "N") return "1";
  if (unit == "N m") return "m";
  return unit + "/N";
}

/// The nodes, and so many intervals between each two of them.
std::vector<double> places_of_load(const Scene& scene, int intervals) {
  const std::vector<double> breaks =
      scene.dimension == 2 ? build_axis<2>(scene).breaks() : build_axis<3>(scene).breaks();
  const std::vector<double> nodes = place_nodes(scene, breaks).x;
  std::vector<double> places{nodes.front()};
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    for (int i = 1; i <= intervals; ++i) {
      const double share = static_cast<double>(i) / intervals;
      places.push_back((1 - share) * nodes[k] + share * nodes[k + 1]);
    }
  }
  return places;
}

void sum_up(const std::vector<double>& x, Influence::Line& line) {
  line.least = line.largest = no_number;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double ordinate = line.ordinates[i];
    if (!std::isfinite(ordinate)) continue;
    if (!(line.least <= ordinate)) line.least = ordinate, line.at_least = x[i];
    if (!(line.largest >= ordinate)) line.largest = ordinate, line.at_largest = x[i];
  }
  line.area = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    line.area += (x[i] - x[i - 1]) * (line.ordinates[i] + line.ordinates[i - 1]) / 2;
  }
}

}  // namespace

Influence influence(const Scene& scene, const InfluenceOptions& options) {
  if (scene.analysis != Analysis::statics) {
    throw InvalidInput("/analysis", "\"dynamics\"", "influence lines are of a beam at rest: it must be \"statics\"");
  }
  if (scene.assembly) throw InvalidInput("/beams", "an array", "influence lines are of a scene with one beam");
  if (options.force && !(*options.force > 0 && std::isfinite(*options.force))) {
    throw InvalidInput("--force", number_text(*options.force), "it must be a number > 0 [N]");
  }
  const Point direction = options.direction.value_or(usual_direction(scene));
  if (!(size(direction) > 0)) throw InvalidInput("--direction", "no direction", "it must not be zero");
  std::vector<Quantity> quantities;
  for (const std::string& name : options.quantities) quantities.push_back(find_quantity(scene, name));

  Influence found;
  found.force = options.force.value_or(usual_force(scene));
  found.x = places_of_load(scene, options.intervals);

  struct Case {
    double x, force;
  };
  std::vector<Case> cases;
  for (const double x : found.x) {
    for (const double sign : {1.0, -1.0}) cases.push_back({x, sign * found.force});
  }
  const auto run = [&](const Case& item) {
    Scene loaded = scene;
    loaded.output.configurations.clear();
    LoadSpec& load = loaded.loads.emplace_back();
    const bool at_end = item.x == found.x.front() || item.x == found.x.back();
    load.at = at_end ? LoadPlace::node : LoadPlace::point;
    load.node = item.x == found.x.front() ? 0 : scene.beam.elements;
    load.x.value = item.x;
    load.magnitude.value = item.force;
    load.direction = direction;
    validate(loaded);
    const RunResult result = simulate(loaded, [](double) { return !interrupted(); });
    if (result.status != RunStatus::completed) throw ComputationFailed(result.failure, item.x);
    std::vector<double> values;
    for (const Quantity& quantity : quantities) values.push_back(quantity.of(result.samples.back()));
    return values;
  };
  const auto outcomes = sweep("influence", cases, options.jobs, run, [](const Case&) { return 1; });
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    auto& line = found.lines.emplace_back();
    line.quantity = quantities[q].name;
    line.unit = over_a_newton(quantities[q].unit);
    for (std::size_t i = 0; i < found.x.size(); ++i) {
      const auto &there = outcomes[2 * i], &back = outcomes[2 * i + 1];
      const bool both = there && back;
      if (!both && found.failure.empty()) found.failure = there ? back.failure : there.failure;
      line.ordinates.push_back(both ? ((*there)[q] - (*back)[q]) / (2 * found.force) : no_number);
    }
    sum_up(found.x, line);
  }
  return found;
}

std::string influence_table(const Influence& found) {
  std::string text = "x [m]";
  for (const auto& line : found.lines) text += "," + line.quantity + " [" + line.unit + "]";
  text += '\n';
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    text += number_text(found.x[i]);
    for (const auto& line : found.lines) {
      text += "," + (std::isfinite(line.ordinates[i]) ? number_text(line.ordinates[i]) : std::string());
    }
    text += '\n';
  }
  return text;
}

std::string influence_summary(const Influence& found) {
  std::ostringstream text;
  text << "Influence lines of one newton, by forces of " << in_digits(found.force, 3) << " N at " << found.x.size()
       << " places\n";
  for (const auto& line : found.lines) {
    text << "  " << line.quantity << " [" << line.unit << "]: at most " << in_digits(line.largest, 6)
         << " at x = " << in_digits(line.at_largest, 6) << " m, at least " << in_digits(line.least, 6) << " at "
         << in_digits(line.at_least, 6) << " m; area " << in_digits(line.area, 6) << '\n';
  }
  if (!found.failure.empty()) text << "  some ordinates are missing: " << found.failure << '\n';
  return text.str();
}

}  // namespace vlbeam
