#include "scene/slack.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/build.hpp"
#include "scene/corners.hpp"
#include "scene/derived.hpp"
#include "scene/sections.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

// a narrower transition costs steps, wherever a taut rope swings until it is just slack
constexpr double of_everything = 0.03, at_most = 1e-3;
// what is drawn unstrained, and loaded little by little, pulls by 3/16 of the transition as it starts: a jolt
constexpr double of_what_grows = 1e-6;
constexpr double without_loads = 1e-9;

double size(const Point& p) { return std::hypot(p[0], p[1], p[2]); }

/// What a function of time comes up to, roughly.
double size(const TimeSpec& f, double duration) {
  double most = std::abs(f.value) + std::abs(f.rate) * duration + std::abs(f.acceleration) * duration * duration / 2 +
                std::abs(f.amplitude);
  for (const Point& pair : f.table) most = std::max(most, std::abs(pair[1]));
  return most;
}

/// Masses beside the beam's own [kg].
double lumped_mass(const Scene& scene) {
  double mass = 0;
  for (const PointMassSpec& point : scene.point_masses) mass += point.mass;
  for (const SlidingJointSpec& joint : sliding_joints(scene)) mass += joint.mass;
  for (const BlockSpec& block : scene.blocks) mass += block.mass;
  return mass;
}

/// Forces of the scene's loads and winches, one by one, added up [N].
double applied(const Scene& scene) {
  double force = 0;
  for (const LoadSpec& load : scene.loads) {
    if (load.type != LoadType::force) continue;
    const double length = load.at == LoadPlace::beam ? beam_length(scene) : 1;
    force += size(load.magnitude, scene.duration) * length;
  }
  for (const SupportSpec* end : {&scene.start, &scene.end}) {
    if (end->held_tension) force += size(*end->held_tension, scene.duration);
    if (end->drum) force += size(end->drum->torque, scene.duration) / end->drum->radius;
  }
  return force;
}

/// Whether the rope is drawn unstrained, and all that it bears grows from nothing.
bool is_loaded_gently(const Scene& scene) {
  const bool rests = !scene.initial_velocity &&
                     std::ranges::all_of(sliding_joints(scene), [](const auto& joint) { return joint.velocity == 0; });
  const bool weighs = size(scene.gravity) > 0 && scene.gravity_ramp == 0;
  if (scene.analysis == Analysis::statics || scene.initial_shape != InitialShape::built || !rests || weighs)
    return false;
  const auto grows = [](const TimeSpec& f) { return time_function(f)(0).value == 0; };
  const auto winch_grows = [&](const SupportSpec& end) {
    return (!end.held_tension || grows(*end.held_tension)) && (!end.drum || grows(end.drum->torque));
  };
  return winch_grows(scene.start) && winch_grows(scene.end) &&
         std::ranges::all_of(scene.loads, [&](const LoadSpec& load) { return grows(load.magnitude); });
}

}  // namespace

Compression compression(const Scene& scene) {
  const bool knows_none =
      scene.analysis == Analysis::dynamics && scene.integrator.type == IntegratorType::energy_momentum;
  const bool slackens = is_rope(scene.beam) && !knows_none;
  return scene.beam.compression.value_or(slackens ? Compression::none : Compression::full);
}

double slack_over(const Scene& scene) {
  if (scene.beam.slack_over) return *scene.beam.slack_over;
  const double g = size(scene.gravity), length = beam_length(scene);
  const double own = mean_mass(scene.beam, length) * length * g;
  const double all = own + lumped_mass(scene) * g + applied(scene);
  const double share = is_loaded_gently(scene) ? of_what_grows : of_everything;
  return all > 0 ? std::min(share * all / stiffest_EA(scene.beam), at_most) : without_loads;
}

bool has_bare_end(const Scene& scene) {
  const auto bears = [&scene](int node, double x) {
    return std::ranges::any_of(scene.point_masses,
                               [&](const PointMassSpec& mass) {
                                 return mass.position
                                            ? std::abs(*mass.position - x) <= corner_rounding * beam_length(scene)
                                            : mass.node == node;
                               }) ||
           std::ranges::any_of(scene.loads, [&](const LoadSpec& load) {
             return load.type == LoadType::force && load.at == LoadPlace::node && load.node == node;
           });
  };
  return (scene.start.type == SupportType::free && !bears(0, 0)) ||
         (scene.end.type == SupportType::free && !bears(scene.beam.elements, beam_length(scene)));
}

}  // namespace vlbeam
