#include "scene/validate_feed.hpp"

#include <cmath>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/integrator_type.hpp"
#include "scene/options.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

constexpr int instants = 1000;         // at which the way of a feed is looked at
constexpr double most_elements = 1e6;  // as there may be at the start

/// What a scene that is fed is made of.
void check_parts(const Scene& scene, const std::string& at) {
  const auto& control = scene.length_control;
  const auto integrator = [&](const std::string& who) {
    refuse("/integrator/type", quoted(scene.integrator.type), who + ": take any other");
  };
  if (scene.spin) refuse("/spin", "this key", "it does not go together with " + at);
  if (flows(scene)) refuse(at, "this key", "it goes together with neither /flow nor rotary inertia");
  if (scene.analysis == Analysis::statics) refuse(at, "this key", "statics knows none: leave it out");
  if (scene.beam.element == ElementKind::rancf || scene.beam.element == ElementKind::ancf) {
    refuse("/beam/element", quoted(scene.beam.element),
           "a feed needs an element of variable length: \"ALE-RANCF\" or \"ALE-ANCF\"");
  }
  if (has_rest_shape(scene)) {
    refuse("/beam/rest_shape", quoted(scene.beam.rest_shape),
           "what is fed in is straight and unstrained, and so must be the beam at rest: take \"paper\"");
  }
  if (axis_form(scene) == AxisForm::exact && scene.beam.curve.type != CurveType::line) {
    refuse("/beam/axis", "\"exact\"", "with a feed it must be \"even\"");
  }
  if (scene.formulation != Formulation::variational) {
    refuse("/formulation", quoted(scene.formulation),
           "with a feed it must be \"variational\": the virtual work has no balance of energy where the beam comes in");
  }
  if (control.velocities == VelocityTransfer::conservative) {
    refuse("/length_control/velocities", "\"conservative\"", "with a feed take \"projected\"");
  }
  if (control.end_merge.value_or(0) > 0) {
    refuse("/length_control/end_merge", number_text(*control.end_merge), "with a feed it must be 0");
  }
  if (control.enabled && control.lower == 0.0) {
    refuse("/length_control/lower", "0", "with a feed it must be > 0: its element merges by itself");
  }
  const auto joints = sliding_joints(scene);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].at_support == AtSupport::stop) continue;
    refuse(joint_key(scene, i) + "/at_support", quoted(joints[i].at_support), "with a feed it must be \"stop\"");
  }
  if (scene.integrator.type == IntegratorType::energy_momentum) integrator("it keeps an energy that a feed changes");
  if (scene.integrator.type == IntegratorType::ida) integrator("it knows no feed");
}

/// An end whose length is an unknown.
void check_winding(const Scene& scene, const std::string& at) {
  const IntegratorType type = scene.integrator.type;
  if (type == IntegratorType::rosenbrock4 || type == IntegratorType::cvode) {
    refuse("/integrator/type", quoted(type), "it knows no " + at + ": take an explicit one, or \"generalized-alpha\"");
  }
  if (starts_in_equilibrium(scene) && static_joints(scene) == StaticJoints::released) {
    refuse("/statics/joints", "\"released\"", "what is at " + at + " is held until t = 0: leave it out");
  }
}

/// What is wound up has its share of the inertia.
void check_wound(const Scene& scene, const DrumSpec& drum, const std::string& at) {
  if (!drum.wound) return;
  const double least = build_section(scene.beam).rhoA * *drum.wound * drum.radius * drum.radius;
  if (drum.inertia >= least * (1 - 1e-12)) return;
  refuse(at + "/inertia", number_text(drum.inertia),
         "the " + number_text(*drum.wound) + " m wound up have " + number_text(least) +
             " kg m^2 at that radius, and are part of it");
}

void check_end_stop(const SupportSpec& end, const std::string& at) {
  const EndStopSpec& stop = *end.end_stop;
  if (!end.winds_freely()) refuse(at, "this key", "it stops a winch with a \"drum\" or a \"held_tension\"");
  if (!stop.least && !stop.most) refuse(at, "neither least nor most", "give one of them, or both [m]");
  if (stop.least && *stop.least > 0) {
    refuse(at + "/least", number_text(*stop.least), "at t = 0 nothing is paid out: it must be at most 0 [m]");
  }
  if (stop.most && *stop.most < 0) {
    refuse(at + "/most", number_text(*stop.most), "at t = 0 nothing is paid out: it must be at least 0 [m]");
  }
}

/// One end.
void check_end(const Scene& scene, const std::string& support, const SupportSpec& end) {
  if (!end.pays_out()) {
    if (end.end_stop) refuse(support + "/end_stop", "this key", "there is no winch there: leave it out");
    return;
  }
  const std::string at = support + (end.feed ? "/feed" : end.drum ? "/drum" : "/held_tension");
  if ((end.feed ? 1 : 0) + (end.drum ? 1 : 0) + (end.held_tension ? 1 : 0) > 1) {
    refuse(at, "this key", "\"feed\", \"held_tension\" and \"drum\" say the same thing: give one of them");
  }
  if (end.end_stop) check_end_stop(end, support + "/end_stop");
  if (end.type != SupportType::clamp && end.type != SupportType::pin) {
    refuse(support + "/type", quoted(end.type), "beam is fed through a \"clamp\" or a \"pin\"");
  }
  check_parts(scene, at);
  if (end.drum) check_wound(scene, *end.drum, at);
  if (end.winds_freely()) return check_winding(scene, at);
  if (end.feed->value != 0 && end.feed->ramp == 0) {
    refuse(
        at + "/value", number_text(end.feed->value),
        "what has come in counts from t = 0, so that a constant does nothing: it must be 0, or beside a ramp > 0 [s]");
  }
  const double rate = feed_rate(end),
               largest = std::abs(end.feed->rate) + std::abs(end.feed->amplitude * end.feed->frequency);
  if (!scene.initial_velocity && std::abs(rate) > 1e-12 * largest) {
    refuse(
        at, "a velocity of " + number_text(rate) + " m/s at t = 0",
        "the beam starts from rest: give it a \"rate_ramp\" > 0 [s], or /initial_velocity, the beam's along its axis");
  }
  if (starts_in_equilibrium(scene) && std::abs(rate) > 1e-12 * largest) {
    refuse(at, "a velocity of " + number_text(rate) + " m/s at t = 0",
           "what starts from an equilibrium is at rest: give it a \"rate_ramp\" > 0 [s]");
  }
}

/// What is left of the beam, and what stands on it.
void check_way(const Scene& scene) {
  const auto ends = beam_ends(scene);
  const double length = beam_length(scene);
  if (scene.start.winds_freely() || scene.end.winds_freely()) return;  // nobody knows
  const std::string fed = scene.start.feed ? "/supports/at=start/feed" : "/supports/at=end/feed";
  const InitialNodes nodes = place_nodes(scene, build_axis<3>(scene).breaks());
  for (int i = 0; i <= instants; ++i) {
    const double t = scene.duration * i / instants;
    const auto [first, last] = ends(t);
    if (!(last - first > 0)) {
      refuse(fed, "a winch that has drawn in all of the beam at t = " + number_text(t) + " s",
             "it must draw in less than the beam's " + number_text(length) + " m within /duration");
    }
    if (!((last - first) / standard_length(scene) <= most_elements)) {
      refuse(fed, number_text(last - first) + " m of beam at t = " + number_text(t) + " s",
             "there can be at most " + number_text(most_elements * standard_length(scene)) + " m: 1e6 elements");
    }
    const double slack = 1e-9 * standard_length(scene);
    for (std::size_t k = 0; k < scene.point_masses.size(); ++k) {
      const double x = nodes.x[static_cast<std::size_t>(nodes.masses[k])];
      if (x >= first - slack && x <= last + slack) continue;
      const auto& mass = scene.point_masses[k];
      refuse("/point_masses/" + std::to_string(k) + (mass.position ? "/position" : "/node"),
             mass.position ? number_text(*mass.position) : std::to_string(mass.node),
             "the beam is drawn in there, at t = " + number_text(t) + " s: a mass does not pass a feed");
    }
  }
}

}  // namespace

double feed_rate(const SupportSpec& end) { return end.feed ? time_function(*end.feed)(0).rate : 0; }

std::function<std::pair<double, double>(double t)> beam_ends(const Scene& scene) {
  const auto length_in = [](const SupportSpec& end) -> std::function<double(double)> {
    if (!end.feed) return [](double) { return 0; };
    return [feed = time_function(*end.feed)](double t) { return feed(t).value - feed(0).value; };
  };
  return [at_start = length_in(scene.start), at_end = length_in(scene.end), length = beam_length(scene)](double t) {
    return std::pair{-at_start(t), length + at_end(t)};
  };
}

void validate_feeds(const Scene& scene) {
  check_end(scene, "/supports/at=start", scene.start);
  check_end(scene, "/supports/at=end", scene.end);
  if (fed(scene)) check_way(scene);
}

}  // namespace vlbeam
