#include "scene/build_winch.hpp"

#include <limits>

#include "core/parts/drum.hpp"
#include "scene/build.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

const SupportSpec& end_of(const Scene& scene, bool at_start) { return at_start ? scene.start : scene.end; }

/// Of a winch whose length is an unknown, on the beam [N].
TimeFunction push_of(const SupportSpec& end) {
  if (end.drum) {
    return [torque = time_function(end.drum->torque), radius = end.drum->radius](double t) -> Prescribed {
      return {torque(t).value / radius, 0, 0};
    };
  }
  return [pull = time_function(*end.held_tension)](double t) -> Prescribed { return {-pull(t).value, 0, 0}; };
}

/// Of its drum, as a mass that moves with the beam [kg].
double turning_of(const SupportSpec& end) {
  return end.drum ? end.drum->inertia / (end.drum->radius * end.drum->radius) : 0;
}

std::optional<EndStop> stop_of(const SupportSpec& end) {
  if (!end.end_stop) return std::nullopt;
  const EndStopSpec& spec = *end.end_stop;
  constexpr double never = std::numeric_limits<double>::infinity();
  return EndStop{spec.least.value_or(-never), spec.most.value_or(never), {spec.stiffness, spec.depth}, spec.damping};
}

}  // namespace

TimeFunction travelling(double from, const TimeFunction& way) {
  return [way, shift = from - way(0).value](double t) {
    Prescribed x = way(t);
    x.value += shift;
    return x;
  };
}

template <int D>
void add_winch(const Scene& scene, bool at_start, double length, BeamModel<D>& model) {
  const SupportSpec& end = end_of(scene, at_start);
  const typename Drum<D>::End place{at_start, at_start ? 0 : length};
  ModelJoint<D>& joint = model.joints.emplace_back();
  if (end.feed) {
    joint.x = travelling(place.from, [sign = place.outwards(), in = time_function(*end.feed)](double t) -> Prescribed {
      const Prescribed way = in(t);
      return {sign * way.value, sign * way.rate, sign * way.acceleration};
    });
    return;
  }
  joint.law.turning = turning_of(end);
  model.parts.push_back(
      std::make_shared<Drum<D>>(place, model.section.rhoA, push_of(end), model.loads.line_force, stop_of(end)));
}

template <int D>
WinchSample look_at_winch(const Scene& scene, bool at_start, const BeamModel<D>& model, const JointNow<D>& joint,
                          const OuterForces<D>& forces, const Vec<double, D>& gravity, double t) {
  const SupportSpec& end = end_of(scene, at_start);
  const typename Drum<D>::End place{at_start, at_start ? 0 : beam_length(scene)};
  const double out = place.outwards();
  WinchSample sample{};
  sample.length = out * (joint.x - place.from);
  sample.rate = out * joint.rate;
  double push = 0;  // on the beam, along what is paid out
  if (end.feed) {
    Vec<double, D> line = Vec<double, D>::Zero();
    if (model.loads.line_force) line = model.loads.line_force(t);
    push = out * forces.guiding[static_cast<std::size_t>(joint.index)] -
           energy_fed<D>(model.section.rhoA, joint.rate, gravity, line, joint.position);
  } else {
    const auto& accelerations = forces.mark_accelerations;
    push = push_of(end)(t).value - turning_of(end) * out * (at_start ? accelerations.front() : accelerations.back());
    if (const auto stop = stop_of(end)) push += stop->push(sample.length) - stop->drag(sample.length, sample.rate);
  }
  sample.tension = -push;
  sample.power = push * sample.rate;
  return sample;
}

template void add_winch(const Scene&, bool, double, BeamModel<2>&);
template void add_winch(const Scene&, bool, double, BeamModel<3>&);
template WinchSample look_at_winch(const Scene&, bool, const BeamModel<2>&, const JointNow<2>&, const OuterForces<2>&,
                                   const Vec<double, 2>&, double);
template WinchSample look_at_winch(const Scene&, bool, const BeamModel<3>&, const JointNow<3>&, const OuterForces<3>&,
                                   const Vec<double, 3>&, double);

}  // namespace vlbeam
