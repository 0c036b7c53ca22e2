#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/derived.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/names.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

constexpr double mass = 0.8, speed = 5, kinetic = mass * speed * speed / 2;

SlidingMassSpec sliding(double velocity) {
  SlidingMassSpec spec;
  spec.mass = mass;
  spec.position = 0.6;
  spec.velocity = velocity;
  return spec;
}

/// 0.8 kg at 5 m/s along a straight beam between two clamps, 0.4 m from the end towards which it goes.
Scene towards_the_end(int elements, AtSupport at_support, double restitution = 1) {
  Scene scene = test::by_greens_law();
  scene.gravity = {};
  scene.beam.section = {Section::Type::stiffness, 0, 1e4, 1e2, 1};
  scene.beam.elements = elements;
  scene.start = scene.end = {SupportType::clamp, ClampType::full};
  scene.sliding_mass = sliding(speed);
  scene.sliding_mass->at_support = at_support;
  scene.sliding_mass->restitution = restitution;
  scene.duration = 0.1;
  scene.output.interval = 0.002;
  return scene;
}

/// The same from the beam's other end.
Scene towards_the_start(Scene scene) {
  std::swap(scene.start, scene.end);
  scene.sliding_mass->position = 1 - scene.sliding_mass->position;
  scene.sliding_mass->velocity *= -1;
  return scene;
}

long count(const RunResult& result, EventType type) { return std::ranges::count(result.events, type, &Event::type); }

const Event& first(const RunResult& result, EventType type) {
  return *std::ranges::find(result.events, type, &Event::type);
}

struct ContactMethod {
  IntegratorType type;
  double step;
  double vibration = 1e-5;  ///< that nothing damps [m/s]
};
constexpr std::array<ContactMethod, 3> methods{{{IntegratorType::dopri5, 1e-3},
                                                {IntegratorType::generalized_alpha, 1e-3},
                                                {IntegratorType::energy_momentum, 5e-5, 2e-3}}};

TEST(Contact, IsTheSameOnEveryMeshAndWithEveryMethod) {
  for (const int elements : {8, 16, 64}) {
    for (const auto& [type, step, vibration] : methods) {
      for (const double e : {1.0, 0.5, 0.0}) {
        SCOPED_TRACE(std::to_string(elements) + " " + std::string(to_string(type)) + " " + std::to_string(e));
        Scene scene = towards_the_end(elements, e > 0 ? AtSupport::rebound : AtSupport::rest, e > 0 ? e : 1);
        scene.integrator.type = type;
        scene.integrator.step = step;
        scene.length_control.velocities = VelocityTransfer::conservative;
        const RunResult result = simulate(scene);
        ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
        ASSERT_EQ(count(result, EventType::contact), 1);
        const Event& hit = first(result, EventType::contact);
        EXPECT_NEAR(hit.t, 0.08, 1e-9);
        EXPECT_NEAR(hit.joint_position, 1, 1e-11);
        EXPECT_NEAR(hit.energy_jump.total(), (e * e - 1) * kinetic, 1e-6 * kinetic);
        for (const Sample& sample : result.samples) {
          if (std::abs(sample.t - hit.t) < 1e-9) continue;  // of that instant, before or behind
          EXPECT_NEAR(sample.energy.total(), (sample.t < hit.t ? 1 : e * e) * kinetic, 1e-6 * kinetic) << sample.t;
        }
        EXPECT_NEAR(*result.samples.back().joint_position, 1 - e * speed * 0.02, 1e-6);
        EXPECT_NEAR(result.samples.back().joint->velocity, -e * speed, vibration);
      }
    }
  }
}

TEST(Contact, StopsTheRunUnlessToldOtherwise) {
  const RunResult result = simulate(towards_the_end(8, AtSupport::stop));
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("the support at the beam's end"), std::string::npos) << result.failure;
  EXPECT_NEAR(result.failure_time, 0.08, 1e-9);
  EXPECT_EQ(result.samples.back().t, result.failure_time) << "the contact itself";
  EXPECT_NEAR(*result.samples.back().joint_position, 1, 1e-11);
  EXPECT_NEAR(result.samples.back().joint->velocity, speed, 1e-5);
  EXPECT_NEAR(result.samples.back().energy.total(), kinetic, 1e-6 * kinetic);
  EXPECT_NE(simulate(towards_the_start(towards_the_end(8, AtSupport::stop))).failure.find("the beam's start"),
            std::string::npos);
}

TEST(Contact, IsTheSameAtBothEndsAndWithAPin) {
  for (const auto type : {SupportType::clamp, SupportType::pin}) {
    for (const auto merge : {MergePolicy::point_fit, MergePolicy::unit, MergePolicy::least_change}) {
      Scene scene = towards_the_end(8, AtSupport::rebound, 0.5);
      scene.gravity = {0, -9.81, 0};
      scene.gravity_ramp = 0.05;
      scene.end.type = type;
      scene.length_control.merge = merge;
      set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
      const RunResult forward = simulate(scene);
      scene = towards_the_start(scene);
      std::swap(scene.beam.curve.start, scene.beam.curve.end);
      const RunResult backward = simulate(scene);
      ASSERT_EQ(forward.events.size(), backward.events.size());
      EXPECT_EQ(count(forward, EventType::contact), 1);
      // the point fit measures weights against the one at the far end, so its merges are not mirror images
      const double close = merge == MergePolicy::point_fit ? 1e-4 : 1e-7;
      for (std::size_t i = 0; i < forward.samples.size(); ++i) {
        const Sample &a = forward.samples[i], &b = backward.samples[i];
        EXPECT_NEAR(*a.joint_position, 1 - *b.joint_position, close) << a.t;
        EXPECT_NEAR((*a.mass_position)[1], (*b.mass_position)[1], close) << a.t;
      }
    }
  }
}

/// Gravity bends the beam a little under the mass: what holds on the straight one must hold nearly, with energy kept.
TEST(Contact, OfABentBeamConverges) {
  std::vector<double> times;
  for (const int elements : {8, 16, 32}) {
    for (const auto type : {IntegratorType::fehlberg78, IntegratorType::generalized_alpha}) {
      if (elements > 16 && type == IntegratorType::fehlberg78) continue;  // many steps
      Scene scene = towards_the_end(elements, AtSupport::rebound);
      scene.gravity = {0, -9.81, 0};
      scene.gravity_ramp = 0.05;
      scene.length_control.velocities = VelocityTransfer::projected;
      scene.integrator.step = 1e-4;
      scene.integrator.rho_inf = 1;
      set_tolerance(scene, type, 1e-9);
      const RunResult result = simulate(scene);
      ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
      ASSERT_EQ(count(result, EventType::contact), 1);
      times.push_back(first(result, EventType::contact).t);
      EXPECT_NEAR(first(result, EventType::contact).energy_jump.total(), 0, 1e-9 * kinetic);
      const double allowed = type == IntegratorType::fehlberg78 ? 1e-6 : 1e-4;
      EXPECT_LE(result.max_energy_drift, allowed * kinetic) << elements;
    }
  }
  for (const double t : times) EXPECT_NEAR(t, times.back(), 2e-5);
}

TEST(Contact, BouncesBackAndForthWithoutChatter) {
  for (const double end_merge : {0.05, 0.5, 0.9}) {
    Scene scene = towards_the_end(8, AtSupport::rebound);
    scene.length_control.end_merge = end_merge;
    scene.duration = 1;
    const RunResult result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    EXPECT_EQ(count(result, EventType::contact), 5) << "at 0.08 s and every 0.2 s from then on";
    EXPECT_EQ(count(result, EventType::end_merge), 5);
    EXPECT_EQ(count(result, EventType::end_cut), 5);
    EXPECT_NEAR(*result.samples.back().joint_position, 0.4, 1e-6);
    for (const Sample& sample : result.samples) EXPECT_NEAR(sample.energy.total(), kinetic, 1e-6 * kinetic);
  }
}

/// A beam that hangs from one clamp down to another; what falls along it bounces lower and lower, and rests.
Scene hanging(AtSupport at_support, double restitution) {
  Scene scene = towards_the_end(6, at_support, restitution);
  scene.beam.curve.start = {0, 1, 0};
  scene.beam.curve.end = {0, 0, 0};
  scene.beam.section = {Section::Type::stiffness, 0, 1e6, 1e2, 1};
  scene.gravity = {0, -9.81, 0};
  scene.sliding_mass->velocity = 0;
  scene.sliding_mass->position = 0.8;
  scene.duration = 0.8;
  scene.output.interval = 0.01;
  return scene;
}

TEST(Contact, ComesToRestAfterBouncesThatGetLower) {
  const double g = 9.81, height = 0.2, e = 0.5, fall = std::sqrt(2 * height / g);
  const RunResult result = simulate(hanging(AtSupport::rebound, e));
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_NEAR(first(result, EventType::contact).t, fall, 1e-4 * fall);
  EXPECT_GE(count(result, EventType::contact), 10);
  EXPECT_LE(count(result, EventType::contact), 30);
  EXPECT_NEAR(std::ranges::find(result.events.rbegin(), result.events.rend(), EventType::contact, &Event::type)->t,
              fall * (1 + 2 * e / (1 - e)), 1e-3);
  EXPECT_EQ(*result.samples.back().joint_position, 1);
  EXPECT_EQ(result.samples.back().joint->velocity, 0);
  const Sample& last = result.samples.back();
  EXPECT_NEAR(last.joint->force[1], mass * g, 1e-6) << "a clamp does not move";
  const EnergyLedger ledger = energy_ledger(result);
  EXPECT_NEAR(ledger.at_contacts, -mass * g * height, 1e-3 * mass * g * height);
  EXPECT_LE(ledger.largest_unexplained, 1e-6);
  EXPECT_LE(ledger.event_jumps, 1e-3) << "impacts are no losses of length control";
}

TEST(Contact, OfFallingUnderGrowingGravityIsInTheLedger) {
  Scene scene = hanging(AtSupport::rest, 1);
  scene.gravity_ramp = 0.3;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  ASSERT_EQ(count(result, EventType::contact), 1);
  EXPECT_EQ(count(result, EventType::lift_off), 0) << "gravity presses it on";
  const EnergyLedger ledger = energy_ledger(result);
  const Event& hit = first(result, EventType::contact);
  EXPECT_LT(ledger.at_contacts, -0.1);
  EXPECT_EQ(ledger.at_contacts, hit.energy_jump.total());
  EXPECT_LE(ledger.largest_unexplained, 1e-5 * result.max_kinetic);
  EXPECT_LE(result.max_energy_drift, 1e-6 * result.max_kinetic);
}

/// Clamps that swing along the beam: what rests at one lifts off when their acceleration turns.
TEST(Contact, LiftsOffWhenItsForceTurns) {
  for (const auto& [type, step, vibration] :
       {ContactMethod{IntegratorType::dopri5, 1e-3}, ContactMethod{IntegratorType::generalized_alpha, 1e-4}}) {
    for (const bool at_end : {true, false}) {
      Scene scene = towards_the_end(6, AtSupport::rest);
      scene.beam.section = {Section::Type::stiffness, 0, 1e6, 1e2, 1};
      const double frequency = 2, omega = 2 * std::numbers::pi * frequency, amplitude = at_end ? 0.02 : -0.02;
      const SupportMotionSpec motion{
          {1, 0, 0}, {.value = amplitude, .amplitude = -amplitude, .frequency = frequency, .phase_degrees = 90}};
      scene.start.motion = scene.end.motion = motion;
      scene.sliding_mass->velocity = 2;
      scene.duration = 0.45;
      scene.integrator.type = type;
      scene.integrator.step = step;
      if (!at_end) scene = towards_the_start(scene);
      const RunResult result = simulate(scene);
      ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
      ASSERT_EQ(count(result, EventType::contact), 1);
      ASSERT_GE(count(result, EventType::lift_off), 1);
      const Event &hit = first(result, EventType::contact), &lift = first(result, EventType::lift_off);
      EXPECT_NEAR(lift.t, 1.5 * std::numbers::pi / omega, 2e-4);
      const double out = at_end ? 1 : -1;
      for (const Sample& sample : result.samples) {
        if (sample.t <= hit.t || sample.t >= lift.t) continue;
        const double expected = mass * amplitude * omega * omega * std::cos(omega * sample.t);
        EXPECT_LE(out * sample.joint->force[0], 1e-3) << "a support only pushes";
        EXPECT_NEAR(sample.joint->force[0], expected, 0.03) << sample.t;
      }
      // it goes on with the speed that the clamps had
      const Sample& last = result.samples.back();
      const double clamp = amplitude * omega * std::sin(omega * last.t);
      const double left_with = amplitude * omega * std::sin(omega * lift.t);
      EXPECT_NEAR(last.joint->velocity, left_with - clamp, 1e-3);
      const EnergyLedger ledger = energy_ledger(result);
      EXPECT_NEAR(ledger.unexplained, 0, 2e-5) << "what the clamps do in the impact is supplied";
      const double relative = 2 - std::abs(amplitude) * omega * std::sin(omega * hit.t);  // as the support sees it
      EXPECT_NEAR(ledger.at_contacts, -mass / 2 * relative * relative, 1e-3);
    }
  }
}

/// The beam's forces on a mass inside its last element are those of the mass's motion, supports' those of all momentum.
TEST(Contact, ForcesNearTheEndAreThoseOfTheMotion) {
  Scene scene = towards_the_end(5, AtSupport::rebound);
  scene.beam.section = {Section::Type::stiffness, 0, 1e3, 1, 0.5};
  scene.gravity = {0, -9.81, 0};
  scene.sliding_mass->friction = AxialFriction{0.2, 0.1};
  scene.sliding_mass->position = 0.8;
  scene.sliding_mass->velocity = 2;
  scene.duration = 0.09;
  scene.output.interval = 3e-5;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-12);
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  ASSERT_EQ(count(result, EventType::contact), 0);
  const double merged = first(result, EventType::end_merge).t, h = scene.output.interval;
  const double weight = (mass + 0.5) * 9.81;
  int seen = 0;
  for (std::size_t i = 1; i + 1 < result.samples.size(); ++i) {
    const Sample &before = result.samples[i - 1], &now = result.samples[i], &after = result.samples[i + 1];
    if (before.t <= merged) continue;
    ++seen;
    for (std::size_t c = 0; c < 2; ++c) {
      const double a = ((*after.mass_position)[c] - 2 * (*now.mass_position)[c] + (*before.mass_position)[c]) / (h * h);
      EXPECT_NEAR(now.joint->force[c], mass * (a + (c == 1 ? 9.81 : 0)), 1e-2);
      const double push = now.reactions[0].position[c] + now.reactions[1].position[c] - (c == 1 ? weight : 0);
      EXPECT_NEAR(push, (after.momentum[c] - before.momentum[c]) / (2 * h), 2e-2);
    }
    EXPECT_NEAR(now.joint->velocity, (*after.joint_position - *before.joint_position) / (2 * h), 1e-4);
  }
  EXPECT_GT(seen, 500);
}

TEST(EndMerge, KeepsEnergyAndMomentaOfAFreeBeam) {
  Scene scene = test::by_greens_law();
  scene.gravity = {};
  scene.beam.section = {Section::Type::stiffness, 0, 300, 0.5, 0.5};
  scene.beam.elements = 6;
  scene.sliding_mass = sliding(3);
  scene.beam.curve = {.type = CurveType::arc, .radius = 1, .from_degrees = 90, .to_degrees = 40};
  scene.length_control.velocities = VelocityTransfer::conservative;
  scene.length_control.merge = MergePolicy::least_change;
  scene.duration = 0.3;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::separated) << result.failure;
  ASSERT_EQ(count(result, EventType::end_merge), 1);
  for (const Event& event : result.events) {
    EXPECT_LE(std::abs(event.discrete_jump), 1e-11 * result.max_kinetic) << to_string(event.type);
    for (const double jump : event.momentum_jump) EXPECT_LE(std::abs(jump), 1e-11) << to_string(event.type);
  }
  const Sample &start = result.samples.front(), &end = result.samples.back();
  EXPECT_NEAR(end.discrete_total, start.discrete_total, 1e-8 * result.max_kinetic);
  for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(end.momentum[c], start.momentum[c], 1e-9);
  EXPECT_NEAR(end.angular_momentum[2], start.angular_momentum[2], 1e-9);
  EXPECT_EQ(first(result, EventType::separation).energy_jump.total(), 0)
      << "the mass leaves a beam that stays as it is";
  EXPECT_NEAR(first(result, EventType::separation).joint_position, 0.999 * beam_length(scene), 1e-9);
}

/// When the mass leaves on 60 elements [s]: 0.71322 with ALE-ANCF, 0.71336 with ALE-RANCF.
constexpr double converged_exit = 0.7133;

TEST(EndMerge, LetsTheMassLeaveCoarseMeshes) {
  struct Case {
    ElementKind element;
    int elements;
    double within;  ///< of the converged time
  };
  for (const Case& at : {Case{ElementKind::ale_rancf, 10, 0.15}, Case{ElementKind::ale_ancf, 10, 0.15},
                         Case{ElementKind::ale_rancf, 14, 0.05}, Case{ElementKind::ale_rancf, 28, 0.01}}) {
    Scene scene = falling_beam(at.element, at.elements);
    scene.length_control.velocities = VelocityTransfer::projected;
    scene.duration = 0.75;
    const RunResult result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::separated) << result.failure;
    EXPECT_NEAR(first(result, EventType::separation).t, converged_exit, at.within * converged_exit) << at.elements;
  }
}

TEST(EndMerge, NeedsToBeThereOnCoarseMeshes) {
  Scene scene = falling_beam(ElementKind::ale_ancf, 10);
  scene.length_control.velocities = VelocityTransfer::projected;
  scene.duration = 0.75;
  scene.length_control.end_merge = 0;
  EXPECT_EQ(simulate(scene).status, RunStatus::completed) << "a vanishing element holds the mass";
}

}  // namespace
}  // namespace vlbeam::test
