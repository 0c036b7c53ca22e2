// Joints that run into each other, or into a support, are never passed: whatever their speed, the step and the distance
// at which they touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scene/automatic_integrator.hpp"
#include "scene/names.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

struct Collision {
  double distance, speed, mass_1, mass_2, restitution;
};

/// Two masses on a beam that is too stiff to take part.
Scene colliding(const Collision& of) {
  Scene scene;
  scene.gravity = {};
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e9, .EI = 1e7, .rhoA = 1};
  scene.start.type = scene.end.type = SupportType::clamp;
  scene.sliding_joints = {test::slider(0.4, of.mass_1, of.speed), test::slider(1.2, of.mass_2)};
  scene.contact = ContactSpec{AtSupport::rebound, of.restitution, of.distance};
  scene.duration = 0.92 / of.speed;
  scene.output.interval = scene.duration;
  return scene;
}

/// That they touched once, and have the velocities of a collision of two points.
void expect_one_collision(Scene scene, const Collision& of, const IntegratorSpec& integrator) {
  scene.integrator = integrator;
  const RunResult run = simulate(scene);
  const std::string name = std::string(to_string(integrator.type)) + " at a distance of " +
                           std::to_string(of.distance) + ", " + std::to_string(of.speed) + " m/s";
  // a step that is given, and much too long, may shake the short piece of beam between the two to pieces: it says so
  const bool given = integrator.type == IntegratorType::generalized_alpha && !integrator.adaptive;
  if (given && run.status == RunStatus::failed) return;
  ASSERT_EQ(run.status, RunStatus::completed) << name << ": " << run.failure;
  EXPECT_EQ(std::ranges::count(run.events, EventType::contact, &Event::type), 1) << name;
  const double common = of.mass_1 * of.speed / (of.mass_1 + of.mass_2);
  const double first = common - of.restitution * (of.speed - common), second = common * (1 + of.restitution);
  // by the ways since then: where their piece of beam is short, rounding of its strain shakes the velocities themselves
  const auto& joints = run.samples.back().joints;
  const double t = (0.8 - 0.1 * of.distance) / of.speed, since = scene.duration - t;
  const double share = given ? 1e-4 : 1e-5;
  EXPECT_NEAR((*joints[0].position - (1.2 - 0.1 * of.distance)) / since, first, share * of.speed) << name;
  EXPECT_NEAR((*joints[1].position - 1.2) / since, second, share * of.speed) << name;
}

// As they were when every second one was passed: steps are as long as nothing happens.
TEST(Collisions, AreNotSteppedOver) {
  std::mt19937 random(1);
  const auto between = [&random](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>()(random));
  };
  for (int i = 0; i < 24; ++i) {
    const Collision of{between(1e-4, 0.3), between(0.03, 30), between(0.3, 3), between(0.3, 3), between(0.3, 1)};
    const Scene scene = colliding(of);
    expect_one_collision(scene, of, automatic_integrator(scene));
    IntegratorSpec fixed;
    fixed.type = IntegratorType::generalized_alpha;
    fixed.step = scene.duration / between(2, 50);
    expect_one_collision(scene, of, fixed);
    fixed.adaptive = true;
    expect_one_collision(scene, of, fixed);
    IntegratorSpec explicit_one;
    explicit_one.rtol = explicit_one.atol = 1e-7;
    explicit_one.type = i % 2 == 0 ? IntegratorType::dopri5 : IntegratorType::fehlberg78;
    Scene soft = scene;  // waves in the piece of beam between the two limit their steps
    soft.beam.section.EA = 10;
    soft.beam.section.EI = 0.1;
    Collision wider = of;
    wider.distance = soft.contact->distance = std::max(0.01, of.distance);
    expect_one_collision(soft, wider, explicit_one);
  }
}

// A mass thrown up a slope turns back just beyond where it touches the one that rests there: within one step it is
// there and gone.
TEST(Collisions, AreSeenWhereStepsStartAndEndApart) {
  Collision of{0.05, 1, 1, 50, 1};
  Scene scene = colliding(of);
  scene.sliding_joints[1].x = TimeSpec{.rate = 1e-12};  // held where it is
  const double slope = 0.5, reach = 0.8 - 0.1 * of.distance;
  scene.gravity = {-slope, 0, 0};
  scene.sliding_joints[0].velocity = std::sqrt(2 * slope * (reach + 2e-4));  // it would come 0.2 mm too near
  const double turns = std::sqrt(2 * (reach + 2e-4) / slope);
  scene.duration = 1.5 * turns;
  scene.output.interval = scene.duration;
  for (const double steps : {40.0, 100.0}) {
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = scene.duration / steps;
    scene.integrator.rho_inf = 0.8;
    const RunResult run = test::completed(scene);
    EXPECT_EQ(std::ranges::count(run.events, EventType::contact, &Event::type), 1) << steps;
  }
}

}  // namespace
}  // namespace vlbeam
