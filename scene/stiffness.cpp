#include "scene/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "scene/build.hpp"
#include "scene/names.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

// Of one cubic element with free ends and consistent mass: squares of the largest frequency, for l = EA = EI = rhoA
// = 1.
constexpr double axial = 170.12490249604053;  // the larger root of x^2 - 180 x + 1680
constexpr double sampled_axial = 378.91574157749403;
constexpr double bending = 8400;

constexpr double many_steps = 1e4;
constexpr double too_many_steps = 1e5;  // seconds of a run
constexpr double short_share = 20;      // of the longest step: shorter ones are short
constexpr double near = 0.6;            // of the limit: a mean step as long is held by stability at least now and then

/// Mean step times largest frequency of runs that stability limits, measured on steel wires at tolerances of 1e-9 to
/// 1e-3; 0 for methods that it does not limit.
double stability_limit(IntegratorType type) {
  switch (type) {
    case IntegratorType::dopri5:
    case IntegratorType::cash_karp:
    case IntegratorType::arkode:
      return 1.6;
    case IntegratorType::fehlberg78:
      return 3.4;
    case IntegratorType::bulirsch_stoer:
      return 4;
    default:
      return 0;
  }
}

/// Largest angular frequencies of an element of mean length with free ends [rad/s].
struct ElementFrequencies {
  double axial, bending;
};
ElementFrequencies element_frequencies(const Scene& scene) {
  const BeamSection section = build_section(scene);
  const double l = beam_length(scene) / scene.beam.elements;
  const double stretching = axial_strain(scene) == AxialStrain::lobatto ? sampled_axial : axial;
  return {std::sqrt(stretching * section.stiffness.EA / section.rhoA) / l,
          std::sqrt(bending * section.stiffness.EI / section.rhoA) / (l * l)};
}

}  // namespace

double largest_frequency(const Scene& scene) {
  const ElementFrequencies of = element_frequencies(scene);
  return std::max(of.axial, of.bending);
}

double mean_largest_frequency(const Scene& scene) {
  const ElementFrequencies of = element_frequencies(scene);
  const auto& control = scene.length_control;
  const bool remeshed = control.enabled && (!sliding_joints(scene).empty() || fed(scene));
  if (!remeshed) return std::max(of.axial, of.bending);
  // the shorter element at a joint that passes has each length from `least` L_std to L_std for as long
  const double least = 2 - control.upper * (1 + control.hysteresis);
  return std::max(of.axial * portable::log(1 / least) / (1 - least), of.bending / least);
}

std::optional<Warning> stability_warning(const Scene& scene, const RunResult& result) {
  const auto steps = static_cast<double>(result.solver.steps);
  const double limit = stability_limit(scene.integrator.type);
  const double many = scene.integrator.automatic ? too_many_steps : many_steps;
  if (limit == 0 || steps < many || result.samples.empty()) return std::nullopt;
  const double reached = result.status == RunStatus::failed ? result.failure_time : result.samples.back().t;
  const double share = reached / steps * largest_frequency(scene) / limit;
  if (share < near) return std::nullopt;
  std::ostringstream message;
  message.precision(2);
  message << "stability, not accuracy, limits the steps of " << to_string(scene.integrator.type) << ": "
          << result.solver.steps << " of " << reached / steps << " s, where the fastest wave in an element allows "
          << limit / largest_frequency(scene) << " s";
  return Warning{WarningKind::stability_limits_steps, message.str(),
                 std::string("/integrator/type \"generalized-alpha\", whose steps no wave limits") +
                     (scene.integrator.automatic ? "" : ", or \"integrator\": \"auto\"")};
}

std::string why_slow(const Scene& scene, double step) {
  std::ostringstream why;
  why.precision(2);
  const double limit = stability_limit(scene.integrator.type);
  if (limit > 0 && step * largest_frequency(scene) >= near * limit) {
    why << "waves in the elements limit the step: " << step << " s; generalized-alpha has no such limit";
  } else if (scene.integrator.adaptive && step < scene.integrator.step / short_share) {
    why << "vibrations limit the step: " << step << " s; "
        << (scene.integrator.error_estimate == ErrorEstimate::all ? "error_estimate filtered, " : "")
        << "a coarser accuracy or material damping would help";
  }
  return why.str();
}

}  // namespace vlbeam
