#include "scene/build_winch.hpp"

#include <limits>
#include <utility>

#include "mechanics/ropes/drum.hpp"
#include "scene/build.hpp"
#include "scene/stretch.hpp"
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

/// The stretch that a tension which is held gives the beam at the outlet; nothing where that is not given.
std::function<double(double t)> stretch_of(const SupportSpec& end, const Stiffness& axial) {
  if (!end.held_tension || end.winding != Winding::stretched) return {};
  return [pull = time_function(*end.held_tension), EA = axial.EA, law = axial.law](double t) {
    return stretch_under(pull(t).value, EA, law);
  };
}

/// Of its drum, as a mass that moves with the beam; it falls by what runs off.
Turning turning_of(const SupportSpec& end, double rhoA, double from, double outwards) {
  if (!end.drum || end.drum->inertia == 0) return {};
  return {.inertia = end.drum->inertia / (end.drum->radius * end.drum->radius),
          .by_length = -outwards * rhoA,
          .from = from,
          .stretched = end.winding == Winding::stretched};
}

/// How much beam may run off it [m]; nothing where none is wound up on it.
std::optional<double> stored_on(const SupportSpec& end, double rhoA) {
  if (!end.drum || end.drum->inertia == 0) return std::nullopt;
  return end.drum->wound.value_or(end.drum->inertia / (end.drum->radius * end.drum->radius * rhoA));
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
  joint.law.turning = turning_of(end, model.section.rhoA, place.from, place.outwards());
  typename Drum<D>::Law law{.section = model.axis_section(),
                            .winding = end.winding,
                            .element_length = standard_length(scene),
                            .push = push_of(end),
                            .line = model.loads.line_force,
                            .stop = stop_of(end),
                            .stretch = stretch_of(end, model.section.stiffness)};
  if (const auto stored = stored_on(end, model.section.rhoA)) law.store = typename Drum<D>::Store{*stored};
  model.parts.push_back(std::make_shared<Drum<D>>(place, std::move(law)));
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
  const BeamSection section = model.axis_section();
  Vec<double, D> line = Vec<double, D>::Zero();
  if (model.loads.line_force) line = model.loads.line_force(t);
  const double potential = potential_fed<D>(section.rhoA, gravity, line, joint.position);
  const Winding winding = end.feed ? Winding::unstretched : end.winding;
  Vec<double, D> slope = joint.slope;
  if (const auto given = stretch_of(end, section.stiffness)) slope = given(t) * Vec<double, D>::UnitX();
  const ComingIn<double, D> matter(section, winding, sample.rate, slope);
  double push = 0;  // on the beam, along what is paid out, less what comes in brings
  if (end.feed) {
    push = out * forces.guiding[static_cast<std::size_t>(joint.index)] - matter.kinetic - potential;
  } else {
    const Turning& turning = model.joints[static_cast<std::size_t>(joint.index)].law.turning;
    const auto& accelerations = forces.mark_accelerations;
    const double a = at_start ? accelerations.front() : accelerations.back();
    push = push_of(end)(t).value * matter.stretch -
           out * (turning.against<D>(joint.x, joint.slope) * a +
                  turning.lag<D>(joint.x, joint.rate, joint.slope, joint.slope_rate));
    if (const auto stop = stop_of(end)) push += stop->push(sample.length) - stop->drag(sample.length, sample.rate);
  }
  sample.tension = winding == Winding::stretched
                       ? -push / matter.stretch
                       : outlet_tension<D>(section, push + matter.kinetic, sample.rate, joint.slope);
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
