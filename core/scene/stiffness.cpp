#include "core/scene/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "core/scene/build.hpp"
#include "core/scene/names.hpp"
#include "core/scene/validate.hpp"

namespace vlbeam {
namespace {

// Of one cubic element with free ends and consistent mass: squares of the largest frequency, for l = EA = EI = rhoA
// = 1.
constexpr double axial = 170.12490249604053;  // the larger root of x^2 - 180 x + 1680
constexpr double bending = 8400;

constexpr double many_steps = 1e4;
constexpr double too_many_steps = 1e5;  // seconds of a run
constexpr double near = 0.6;            // of the limit: a mean step as long is held by stability at least now and then
constexpr double worth_while = 20;      // explicit steps that an implicit one must replace
constexpr double automatic_tolerance = 1e-7;  // of the beam's length, for implicit steps
constexpr double steps_a_period = 250;        // of a vibration: generalized-alpha is off by 1e-4 radians a radian
constexpr double steps_of_motion = 500;       // of the run, or of a swing under gravity
constexpr double steps_of_fading = 10;        // while friction passes through where it fades
constexpr double damping_limit = 3.3;         // step times c omega^2 of dopri5, on the real axis

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
  const BeamSection section = build_section(scene.beam);
  const double l = beam_length(scene) / scene.beam.elements;
  return {std::sqrt(axial * section.stiffness.EA / section.rhoA) / l,
          std::sqrt(bending * section.stiffness.EI / section.rhoA) / (l * l)};
}

/// Rounded down, to be read.
double two_digits(double value) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  const double unit = portable::pow(10, std::floor(portable::log10(value)) - 1);
  std::ostringstream text;
  text.precision(2);
  text << std::floor(value / unit * (1 + 1e-12)) * unit;
  return std::stod(text.str());
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

double longest_implicit_step(const Scene& scene) {
  const BeamSection section = build_section(scene.beam);
  const double L = beam_length(scene), turn = 2 * std::numbers::pi;
  double step = scene.duration / steps_of_motion;
  const auto at_most = [&step](double time) {
    if (time > 0) step = std::min(step, time);
  };
  const bool one_end = (scene.start.type == SupportType::free) != (scene.end.type == SupportType::free);
  const bool held_between = std::ranges::any_of(
      scene.sliding_joints, [](const SlidingJointSpec& joint) { return joint.support != SupportType::free; });
  const bool cantilever =
      one_end && !held_between && (scene.start.type == SupportType::clamp || scene.end.type == SupportType::clamp);
  const double root = cantilever ? 1.8751040687119611 : 4.7300407448627040;  // of cosh cos = -1 or 1
  at_most(turn * L * L / (root * root) * std::sqrt(section.rhoA / section.stiffness.EI) / steps_a_period);
  if (scene.spin) {
    const SpinSection spin = build_spin(scene.beam);
    if (spin.GIp > 0) at_most(2 * L * std::sqrt(spin.rhoIp / spin.GIp) / steps_a_period);
    for (const auto& drive : scene.spin->drives) at_most(1 / std::abs(drive.angle.frequency) / steps_a_period);
  }
  const double g = Eigen::Map<const Eigen::Vector3d>(scene.gravity.data()).norm();
  at_most(turn * std::sqrt(L / g) / steps_of_motion);
  for (const SlidingJointSpec& joint : sliding_joints(scene)) {
    if (!joint.friction) continue;
    at_most(joint.friction->velocity / (joint.friction->coefficient * g) / steps_of_fading);
  }
  const auto driven = [&](const TimeSpec& f) { at_most(1 / std::abs(f.frequency) / steps_a_period); };
  for (const LoadSpec& load : scene.loads) {
    driven(load.magnitude);
    driven(load.turn);
    driven(load.x);
    at_most(turn / std::abs(load.turn.rate) / steps_a_period);
  }
  for (const SupportSpec* support : {&scene.start, &scene.end}) {
    if (support->feed) driven(*support->feed);
    if (!support->motion) continue;
    driven(support->motion->displacement);
    if (support->motion->angle) driven(*support->motion->angle);
  }
  for (const SlidingJointSpec& joint : scene.sliding_joints) {
    if (joint.x) driven(*joint.x);
    if (joint.motion) driven(joint.motion->displacement);
  }
  return step;
}

IntegratorSpec automatic_integrator(const Scene& scene) {
  IntegratorSpec dopri5;
  dopri5.automatic = true;
  IntegratorSpec implicit = dopri5;
  implicit.type = IntegratorType::generalized_alpha;
  implicit.step = two_digits(longest_implicit_step(scene));
  const double fastest = mean_largest_frequency(scene);
  const double damped = damping_limit / (scene.beam.material.damping * fastest * fastest);
  const double explicit_step = std::min(stability_limit(IntegratorType::dopri5) / fastest, damped);
  if (!(implicit.step >= worth_while * explicit_step && scene.duration >= too_many_steps * explicit_step))
    return dopri5;
  implicit.adaptive = true;
  implicit.rtol = automatic_tolerance;
  const double length = two_digits(automatic_tolerance * beam_length(scene));
  implicit.atol_by_kind.emplace();
  implicit.atol_by_kind->length = length;
  implicit.atol_by_kind->velocity = two_digits(length / implicit.step);
  Scene tried = scene;
  tried.integrator = implicit;
  try {
    validate(tried);
  } catch (const InvalidInput&) {
    return dopri5;
  }
  return implicit;
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

}  // namespace vlbeam
