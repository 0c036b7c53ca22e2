#include "scene/automatic_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "scene/assembly.hpp"
#include "scene/build.hpp"
#include "scene/options.hpp"
#include "scene/simulate.hpp"
#include "scene/stiffness.hpp"
#include "scene/time_function.hpp"
#include "scene/timetable.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// The longest step at an accuracy of 1e-4; it goes with the root of the accuracy, for the method is of second order.
constexpr double steps_a_swing = 650;     // under gravity, over the beam's length, or of what turns from the start
constexpr double steps_a_ramp = 80;       // of gravity; of what else grows, where that is all that happens
constexpr double steps_a_period = 160;    // of what is driven or loaded periodically
constexpr double steps_an_element = 5;    // while something that is driven passes it
constexpr double steps_of_fading = 10;    // while friction passes through where it fades
constexpr double steps_of_a_wave = 0.01;  // along the beam, where nothing drives it

// Tolerances of a step over the accuracy asked: errors of many steps add up, along a wave, or where a whip multiplies
// them.
constexpr double implicit_share = 0.028, explicit_share = 0.05;
constexpr double largest_explicit_tolerance = 1e-7;  // small motions included
// What Newton's iteration leaves of a step has one sign: it turns stiff rods, and pushes what slides along a curve.
constexpr double newton_share = 1e-4, relative_share = 1e-3;
constexpr double automatic_rho_inf = 0.8;  // what events put into fast vibrations dies out
constexpr double whole_motion = 0.1;       // of the beam's length: displacement from which tolerances hold in full
constexpr double least_tolerance = 1e-11, least_newton_tolerance = 1e-10, least_rtol = 1e-14;

// The trial, in evaluations of the equations.
constexpr double tangent_work = 5;
constexpr double explicit_work = 6.5, explicit_limit = 1.6;  // of a step of dopri5; mean step times largest frequency
constexpr double horizon = 100;   // of the usual longest steps: for as long the methods are compared
constexpr double hopeless = 2e4;  // work over the horizon, at the usual accuracy
constexpr double trial_steps = 60, trial_share = 0.1;  // of the horizon
constexpr double growth = 2.5;  // of implicit steps behind the trial: motion that has grown allows longer ones

/// Rounded down, to be read.
double two_digits(double value) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  const double unit = portable::pow(10, std::floor(portable::log10(value)) - 1);
  std::ostringstream text;
  text.precision(2);
  text << std::floor(value / unit * (1 + 1e-12)) * unit;
  return std::stod(text.str());
}

bool allows(const Scene& scene, const IntegratorSpec& integrator) {
  Scene tried = scene;
  tried.integrator = integrator;
  try {
    validate(tried);
  } catch (const InvalidInput&) {
    return false;
  }
  return true;
}

/// The beam's length [m], with what feeds bring in until they stop.
double whole_length(const Scene& scene) {
  if (scene.assembly) {
    double longest = 0;
    for (const auto& beam : scene.assembly->beams) longest = std::max(longest, whole_length(beam.scene));
    return longest;
  }
  double length = beam_length(scene);
  for (const SupportSpec* support : {&scene.start, &scene.end}) {
    if (!support->feed) continue;
    const TimeSpec& feed = *support->feed;
    if (feed.until) length += std::max(0.0, feed.rate * *feed.until);
    if (!feed.table.empty()) length += std::max(0.0, feed.table.back()[1] - feed.table.front()[1]);
  }
  return length;
}

/// That of longest_implicit_step() by what drives the beam or turns it; infinite where nothing does [s].
double longest_driven_step(const Scene& scene) {
  double step = std::numeric_limits<double>::infinity();
  const auto at_most = [&step](double time) {
    if (time > 0) step = std::min(step, time);
  };
  if (scene.assembly) {
    for (std::size_t i = 0; i < scene.assembly->beams.size(); ++i) at_most(longest_driven_step(beam_scene(scene, i)));
    for (const BodySpec& body : scene.assembly->bodies) {
      at_most(turn / Eigen::Map<const Eigen::Vector3d>(body.angular_velocity.data()).norm() / steps_a_swing);
      for (const BodyLoadSpec& load : body.loads) at_most(1 / std::abs(load.magnitude.frequency) / steps_a_period);
    }
    return step;
  }
  const double L = whole_length(scene), element = standard_length(scene);
  const auto driven = [&](const TimeSpec& f) { at_most(1 / std::abs(f.frequency) / steps_a_period); };
  const auto passing = [&](const TimeSpec& x) {
    driven(x);
    at_most(element / (std::abs(x.rate) + steepest(x) + turn * std::abs(x.frequency * x.amplitude)) / steps_an_element);
  };
  const double g = Eigen::Map<const Eigen::Vector3d>(scene.gravity.data()).norm();
  at_most(turn * std::sqrt(L / g) / steps_a_swing);
  at_most(scene.gravity_ramp / steps_a_ramp);  // what has begun to move then goes on as fast
  if (scene.initial_velocity) at_most(turn / std::abs(scene.initial_velocity->rotation) / steps_a_swing);
  for (const SlidingJointSpec& joint : sliding_joints(scene)) {
    at_most(element / std::abs(joint.velocity) / steps_an_element);
    if (joint.friction) at_most(joint.friction->velocity / (joint.friction->coefficient * g) / steps_of_fading);
    if (joint.x) passing(*joint.x);
    if (joint.motion) joint.motion->each_way([&](const char*, const TimeSpec& way) { driven(way); });
  }
  for (const LoadSpec& load : scene.loads) {
    driven(load.magnitude);
    driven(load.turn);
    at_most(turn / std::abs(load.turn.rate) / steps_a_period);
    passing(load.x);
  }
  for (const SupportSpec* support : {&scene.start, &scene.end}) {
    if (support->feed) passing(*support->feed);
    if (!support->motion) continue;
    support->motion->each_way([&](const char*, const TimeSpec& way) { driven(way); });
    if (support->motion->angle) driven(*support->motion->angle);
  }
  if (scene.spin) {
    for (const auto& drive : scene.spin->drives) driven(drive.angle);
  }
  if (scene.flow) {
    for (const auto& node : scene.flow->nodes) passing(node.x);
  }
  return step;
}

/// In which what moves goes on moving, as far as that can be foreseen: the longest step, but of a beam that nothing
/// drives a tenth of it, ten times that of a wave along it [s].
double followed_time(const Scene& scene) {
  const double driven = longest_driven_step(scene);
  return std::isfinite(driven) ? driven : 0.1 * longest_implicit_step(scene);
}

IntegratorSpec implicit_method(const Scene& scene, double accuracy) {
  IntegratorSpec spec;
  spec.automatic = true;
  spec.accuracy = accuracy;
  spec.type = IntegratorType::generalized_alpha;
  spec.adaptive = true;
  spec.error_estimate = ErrorEstimate::filtered;
  spec.step = std::min(two_digits(longest_implicit_step(scene) * std::sqrt(accuracy / usual_accuracy)), scene.duration);
  spec.rho_inf = automatic_rho_inf;
  spec.newton_tolerance = two_digits(std::clamp(newton_share * accuracy, least_newton_tolerance, 1e-2));
  // what errors of steps add up to falls with the power 2/3 of their tolerance
  const double share = implicit_share * std::min(1.0, portable::pow(accuracy / usual_accuracy, 0.75));
  const double length = whole_length(scene), allowed = std::max(share * accuracy, least_tolerance) * length;
  // next to nothing, for positions have no size of their own: it keeps its ratio where tolerances are refined
  spec.rtol = two_digits(std::max(relative_share * allowed / length, least_rtol));
  spec.atol_by_kind = AbsoluteTolerances{.length = two_digits(allowed),
                                         .velocity = two_digits(allowed / followed_time(scene)),
                                         .angle = {},
                                         .spin = {},
                                         .motion = two_digits(whole_motion * length)};
  return spec;
}

IntegratorSpec explicit_method(const Scene& scene, double accuracy) {
  IntegratorSpec spec;
  spec.automatic = true;
  spec.accuracy = accuracy;
  spec.rtol = std::clamp(explicit_share * accuracy, least_tolerance, largest_explicit_tolerance);
  const double length = spec.rtol * whole_length(scene);
  const double swing = steps_a_swing * longest_implicit_step(scene);  // an error of a velocity acts for a part of it
  spec.atol_by_kind = AbsoluteTolerances{.length = length, .velocity = turn / swing * length, .angle = {}, .spin = {}};
  return spec;
}

double work_of(const SolverCounters& solver) {
  return static_cast<double>(solver.rhs_evaluations) + tangent_work * static_cast<double>(solver.newton.tangents);
}

/// Work of a run until `until`, by its first instants; infinite where these break down.
double work_until(double until, Scene scene, const IntegratorSpec& integrator, double later_growth) {
  const double whole = scene.duration, end = trial_share * until;
  scene.duration = end;
  scene.output = {.interval = end, .configurations = {}};
  IntegratorSpec shorter = integrator;
  shorter.step = std::min(integrator.step, end);
  if (!allows(scene, shorter)) {  // what has not come by then may still come
    scene.duration = whole;
    scene.output.interval = whole;
  }
  scene.integrator = shorter;
  int steps = 0;
  double t = 0, last = 0;
  const RunResult result = simulate(scene, [&](double now) {
    last = now - t;
    t = now;
    return ++steps < trial_steps && now < end;
  });
  if (result.status == RunStatus::failed || steps == 0 || !(t > 0)) return std::numeric_limits<double>::infinity();
  const double work = work_of(result.solver), step = std::max(last, t / steps) * later_growth;
  return work + work / steps * std::max(0.0, until - t) / step;
}

}  // namespace

double longest_implicit_step(const Scene& scene) {
  const double driven = longest_driven_step(scene);
  if (std::isfinite(driven)) return driven;
  if (scene.assembly) {
    double step = driven;
    for (std::size_t i = 0; i < scene.assembly->beams.size(); ++i) {
      step = std::min(step, longest_implicit_step(beam_scene(scene, i)));
    }
    return step;
  }
  const BeamSection section = build_section(scene);
  const double waves = whole_length(scene) * std::sqrt(section.rhoA / section.stiffness.EA) / steps_of_a_wave;
  const double change = shortest_change(scene) / steps_a_ramp;
  return std::isfinite(change) ? std::max(waves, change) : waves;
}

IntegratorSpec automatic_integrator(const Scene& scene, double accuracy) {
  if (!(scene.duration > 0)) refuse("/duration", number_text(scene.duration), "it must be a number > 0 [s]");
  IntegratorSpec implicit;
  implicit.automatic = true;
  implicit.type = IntegratorType::generalized_alpha;
  implicit.step = scene.duration;
  Scene tried = scene;  // generalized-alpha knows all that a scene can have: what it refuses is wrong with the scene
  tried.integrator = implicit;
  validate(tried);
  implicit = implicit_method(scene, accuracy);
  if (scene.assembly) {
    implicit.reason = "links hold at positions with it alone";
    return implicit;
  }
  if (!allows(scene, IntegratorSpec{})) {
    implicit.reason = "explicit methods do not know all that the scene has";
    return implicit;
  }
  const double until = horizon * longest_implicit_step(scene);
  const double by_stability = explicit_work * until * mean_largest_frequency(scene) / explicit_limit;
  if (by_stability > hopeless * portable::pow(usual_accuracy / accuracy, 0.4)) {
    implicit.reason = "waves in the elements would force an explicit method to short steps";
    return implicit;
  }
  const IntegratorSpec dopri5 = explicit_method(scene, accuracy);
  const double explicit_cost = work_until(until, scene, dopri5, 1);
  const double implicit_cost = work_until(until, scene, implicit, growth);
  IntegratorSpec chosen = explicit_cost < implicit_cost ? dopri5 : implicit;
  std::ostringstream reason;
  reason.precision(2);
  reason << "by a trial of the first instants " << two_digits(std::min(explicit_cost, implicit_cost))
         << " evaluations for " << two_digits(until) << " s, where "
         << (explicit_cost < implicit_cost ? "generalized-alpha" : "dopri5") << " takes "
         << two_digits(std::max(explicit_cost, implicit_cost));
  chosen.reason = reason.str();
  return chosen;
}

}  // namespace vlbeam
