// Friction in rings and sleeves: what presses is the reaction, and a cable that turns in a ring obeys the capstan law.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

/// A clamped beam that is drawn through a joint by what pulls at its end, rubbing.
Scene rubbing(SupportType support, ElementKind element = ElementKind::ale_ancf) {
  Scene scene;
  scene.gravity = {0, -9.81, 0};
  scene.beam.element = element;
  scene.beam.elements = 8;
  scene.beam.section.radius = 0.02;
  scene.beam.axial_strain = AxialStrain::full;
  scene.beam.material = {.density = 7200, .youngs_modulus = 2e7};
  scene.start.type = SupportType::clamp;
  SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
  joint.support = support;
  joint.position = 0.55;
  joint.friction = AxialFriction{0.4, 0.05};
  scene.loads = {
      {.node = 8, .x = {}, .magnitude = {.value = 200, .ramp = 0.05}, .direction = {0.8, -0.6, 0}, .turn = {}}};
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-12);
  scene.duration = 0.1;
  scene.output.interval = 0.01;
  return scene;
}

SlidingJointSpec mass_at(double position, double mass) {
  SlidingJointSpec joint;
  joint.position = position;
  joint.mass = mass;
  return joint;
}

TEST(HeldFriction, TakesTheEnergyThatIsMissing) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      for (const bool several : {false, true}) {
        Scene scene = rubbing(support, element);
        if (several) scene.sliding_joints.push_back(mass_at(0.8, 0.5));
        const RunResult run = test::completed(scene);
        const double loads = run.samples.back().flow->ledger.loads;
        EXPECT_GT(run.samples.back().energy.dissipated, 1e-3 * loads) << "it rubs";
        EXPECT_LT(run.max_energy_drift, 1e-9 * loads) << run.max_energy_drift;
      }
    }
  }
}

// What damping takes is found in the middle of a step, and friction with it, which needs the accelerations there.
TEST(HeldFriction, IsBookedBesideDamping) {
  Scene scene = rubbing(SupportType::pin);
  scene.beam.material.damping = 1e-4;
  scene.sliding_joints.push_back(mass_at(0.8, 2));
  scene.sliding_joints.back().friction = AxialFriction{0.4, 0.05};
  scene.integrator = IntegratorSpec{.type = IntegratorType::generalized_alpha, .step = 1e-4, .rho_inf = 1};
  const RunResult run = test::completed(scene);
  const double loads = run.samples.back().flow->ledger.loads;
  EXPECT_GT(run.samples.back().energy.dissipated, 1e-3 * loads) << "it rubs";
  EXPECT_LT(run.max_energy_drift, 1e-4 * loads);
}

TEST(HeldFriction, IsTheSameWithEveryIntegrator) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    for (const bool several : {false, true}) {
      Scene scene = rubbing(support);
      if (several) scene.sliding_joints.push_back(mass_at(0.8, 0.5));
      const auto place = [](const RunResult& run) { return *run.samples.back().joint_position; };
      const double exact = place(test::completed(scene));
      for (const Constraints constraints : {Constraints::eliminated, Constraints::multipliers}) {
        std::vector<double> errors;
        for (const double step : {1e-4, 5e-5}) {
          Scene implicit = scene;
          implicit.integrator.type = IntegratorType::generalized_alpha;
          implicit.integrator.step = step;
          implicit.constraints = constraints;
          errors.push_back(std::abs(place(test::completed(implicit)) - exact));
        }
        EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8) << errors[0] << ' ' << errors[1];
      }
      if (several) continue;
      Scene stiff = scene;
      stiff.integrator.type = IntegratorType::rosenbrock4;
      stiff.integrator.rtol = stiff.integrator.atol = 1e-8;
      EXPECT_NEAR(place(test::completed(stiff)), exact, 1e-6);
    }
  }
}

// A mass too heavy to move presses with what holds a ring; friction is among what it feels.
TEST(HeldFriction, IsTheLimitOfAHeavyMass) {
  for (const JointSlopes slopes : {JointSlopes::continuous, JointSlopes::free}) {
    Scene held = rubbing(SupportType::pin);
    held.gravity = {0, 0, 0};
    held.sliding_joints.front().slopes = slopes;
    Scene smooth = held;
    smooth.sliding_joints.front().friction.reset();
    const auto end = [](const Scene& scene) { return test::completed(scene).samples.back().end[0]; };
    const double rubbed = end(held);
    std::vector<double> differences;
    for (const double mass : {1e3, 1e4, 1e5}) {
      Scene scene = held;
      scene.sliding_joints.front().support = SupportType::free;
      scene.sliding_joints.front().mass = mass;
      differences.push_back(std::abs(end(scene) - rubbed));
    }
    EXPECT_NEAR(differences[0] / differences[1], 10, 0.5) << differences[0];
    EXPECT_NEAR(differences[1] / differences[2], 10, 0.5) << differences[1];
    EXPECT_GT(std::abs(end(smooth) - rubbed), 100 * differences[2]) << "friction matters";
  }
}

// A stiff rod that slides through a sleeve under its own weight slows down by mu g.
TEST(HeldFriction, SlowsARodInASleeveByTheWeightOnIt) {
  constexpr double mu = 0.2, g = 9.81, speed = 1, ramp = 0.1;
  Scene scene;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.curve.start = {-2, 0, 0};
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.elements = 10;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e7, .EI = 1e6, .rhoA = 1};
  scene.gravity = {0, -g, 0};
  scene.gravity_ramp = ramp;
  scene.initial_velocity = {.translation = {speed, 0, 0}};
  SlidingJointSpec& sleeve = scene.sliding_joints.emplace_back();
  sleeve.support = SupportType::clamp;
  sleeve.position = 2;
  sleeve.friction = AxialFriction{mu, 1e-4};
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 5e-4;
  scene.integrator.rho_inf = 0.5;
  scene.output.interval = 0.05;
  const double stop = speed / (mu * g) + ramp / 2;  // half of the weight while it grows
  scene.duration = stop + 0.2;
  const RunResult run = test::completed(scene);
  const double start = *run.samples.front().joint_position;
  for (const Sample& sample : run.samples) {
    if (sample.t < 2 * ramp) continue;
    const double left = std::max(0.0, stop - sample.t);
    EXPECT_NEAR(sample.joint->velocity, -mu * g * left, 2e-3 * speed) << sample.t;
  }
  EXPECT_GT(start - *run.samples.back().joint_position, 0.2);
  EXPECT_NEAR(run.samples.back().energy.dissipated, 4 * speed * speed / 2, 1e-2) << "all of its kinetic energy";
}

// A light cable between a dead load and an end that is drawn around a ring: the ratio of its tensions is e^(mu phi),
// whichever way it goes.
TEST(HeldFriction, HoldsACableLikeACapstan) {
  constexpr double mu = 0.3, load = 10, density = 1e-4;
  for (const int dimension : {2, 3}) {
    Scene scene;
    scene.dimension = dimension;
    scene.gravity = {0, 0, 0};
    scene.beam.element = ElementKind::ale_ancf;
    scene.beam.curve.start = {-2, 0, 0};
    scene.beam.curve.end = {1, 0, 0};
    scene.beam.elements = 12;
    scene.beam.section = {.type = Section::Type::stiffness, .EA = 1000, .EI = 0, .rhoA = density};
    scene.end.type = SupportType::pin;
    scene.end.motion = {.direction = {-0.6, 0.8, 0}, .displacement = {.rate = 1, .ramp = 0.5}};
    scene.loads = {
        {.node = 0, .x = {}, .magnitude = {.value = load, .ramp = 0.1}, .direction = {-1, 0, 0}, .turn = {}}};
    SlidingJointSpec& ring = scene.sliding_joints.emplace_back();
    ring.support = SupportType::pin;
    ring.position = 2;
    ring.slopes = JointSlopes::free;
    ring.friction = AxialFriction{mu, 1e-3};
    scene.integrator = {};
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 1e-3;
    scene.integrator.rho_inf = 0;
    scene.constraints = Constraints::multipliers;
    scene.duration = 2;
    scene.output.interval = 0.1;
    const RunResult run = test::completed(scene);
    int slackens = 0, draws = 0;
    for (const Sample& sample : run.samples) {
      const double rate = sample.joint->velocity;
      if (sample.t < 0.25 || std::abs(rate) < 0.05) continue;
      const double turn = std::atan2(sample.end[1], sample.end[0]);
      const double pull = std::hypot(sample.reactions[1].position[0], sample.reactions[1].position[1]);
      const double flux = density * rate * rate;  // the belt runs
      const double expected = flux + (load - flux) * std::exp((rate < 0 ? mu : -mu) * turn);
      EXPECT_NEAR(pull / expected, 1, sample.t < 0.7 ? 1e-3 : 1e-4) << sample.t;  // it swings at first
      ++(rate < 0 ? draws : slackens);
    }
    EXPECT_GT(slackens, 0);
    EXPECT_GT(draws, 8);
  }
}

TEST(HeldFriction, DoesNotGoWithOneTensionOnBothSides) {
  Scene scene = rubbing(SupportType::pin);
  scene.sliding_joints.front().slopes = JointSlopes::equal_stretch;
  try {
    simulate(scene);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/sliding_joints/0/slopes");
  }
}

}  // namespace
}  // namespace vlbeam
