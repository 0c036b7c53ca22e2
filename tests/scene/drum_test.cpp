// Winches that pay out what their drum wants: by a motor, or to hold a tension.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/energy_ledger.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double earth = 9.81;

/// A weight that hangs on a rope from a drum, light and stiff.
Scene on_a_drum(double inertia, double torque) {
  Scene scene;
  scene.beam.curve.end = {0, -2, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 0, .rhoA = 1e-5};
  scene.beam.elements = 4;
  scene.start.type = SupportType::pin;
  scene.start.drum = DrumSpec{.radius = 0.2, .inertia = inertia, .torque = {.value = torque}};
  scene.point_masses = {{4, 2}};
  scene.duration = 0.6;
  scene.output.interval = 0.1;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.rtol = 1e-9;
  scene.integrator.atol = 1e-7;
  scene.integrator.step = 5e-3;
  return scene;
}

// m g + M/r moves m + I/r^2, as long as that is slower than what falls freely: a rope does not push.
TEST(Drum, AWeightUnwindsItAgainstItsInertiaAndItsMotor) {
  for (const double torque : {0.0, -1.5, 1.5, -6.0}) {
    const RunResult run = test::completed(on_a_drum(0.04, torque));
    const double a = (2 * earth + torque / 0.2) / (2 + 1);
    for (const Sample& sample : run.samples) {
      // it starts unstretched, and swings by 4e-5
      EXPECT_NEAR(sample.winches[0]->length, a / 2 * sample.t * sample.t, 1e-4) << torque << " " << sample.t;
      EXPECT_NEAR(sample.end[1], -2 - sample.winches[0]->length, 1e-3);
    }
    EXPECT_LE(run.max_energy_drift, 2e-4 * run.max_kinetic);
  }
}

TEST(Drum, AHeldTensionIsTheOneThatLiftsAWeight) {
  for (const double pull : {2 * earth, 30.0}) {
    Scene scene = on_a_drum(0, 0);
    scene.start.drum.reset();
    scene.start.held_tension = TimeSpec{.value = pull};
    scene.initial_shape = InitialShape::equilibrium;
    const RunResult run = test::completed(scene);
    const double a = earth - pull / 2;
    EXPECT_NEAR(run.samples.back().winches[0]->length, a / 2 * 0.36, 1e-3);
  }
}

// The whole rope, heavy and slack in no place, from either end, through events: what the drum supplies is booked.
TEST(Drum, TheLedgerClosesByEveryMethodAndFromBothEnds) {
  for (const bool at_start : {true, false}) {
    Scene scene;
    scene.beam.section = {.type = Section::Type::stiffness, .EA = 3000, .EI = 0.5, .rhoA = 1};
    scene.beam.curve.end = {1, 0, 0};
    if (!at_start) std::swap(scene.beam.curve.start, scene.beam.curve.end);
    scene.beam.elements = 6;
    SupportSpec& winch = at_start ? scene.start : scene.end;
    winch.type = SupportType::clamp;
    winch.drum = DrumSpec{.radius = 0.1, .inertia = 0.01, .torque = {.value = 0.5, .rate = -3}};
    scene.duration = 0.5;
    test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
    const RunResult run = test::completed(scene);
    EXPECT_GE(run.events.size(), 1U);
    EXPECT_LE(run.max_energy_drift, 1e-8 * run.max_kinetic);
    EXPECT_LE(energy_ledger(run).largest_unexplained, 1e-4 * run.max_kinetic) << "in reports, too";
    const double paid = run.samples.back().winches[at_start ? 0 : 1]->length;
    EXPECT_GT(std::abs(paid), 0.2);
    Scene implicit = scene;
    implicit.integrator.type = IntegratorType::generalized_alpha;
    implicit.integrator.step = 1e-4;
    EXPECT_NEAR(test::completed(implicit).samples.back().winches[at_start ? 0 : 1]->length, paid, 1e-4);
  }
}

// Buoyancy and loads along the beam, where the drum stands far from the origin.
TEST(Drum, DoesNotKnowWhereTheOriginIs) {
  Scene scene = on_a_drum(0.04, -1.5);
  scene.beam.section.rhoA = 0.2;
  scene.fluid = FluidSpec{.density = 1000, .area = 1e-4};
  LoadSpec wind;
  wind.at = LoadPlace::beam;
  wind.magnitude.value = 0.3;
  wind.direction = {1, 0, 0};
  scene.loads = {wind};
  scene.initial_shape = InitialShape::equilibrium;
  Scene moved = scene;
  moved.beam.curve.start = {3, 40, 0};
  moved.beam.curve.end = {3, 38, 0};
  const RunResult here = test::completed(scene), there = test::completed(moved);
  EXPECT_NEAR(here.samples.back().winches[0]->length, there.samples.back().winches[0]->length, 1e-6);
  EXPECT_LE(there.max_energy_drift, 1e-4 * there.max_kinetic);
}

TEST(Drum, IsOneOfThreeWaysAndNeedsAHold) {
  Scene scene = on_a_drum(0.04, 0);
  scene.start.feed = TimeSpec{};
  EXPECT_EQ(test::refused(scene), "/supports/at=start/feed");
  scene = on_a_drum(0.04, 0);
  scene.start.type = SupportType::free;
  EXPECT_EQ(test::refused(scene), "/supports/at=start/type");
  scene = on_a_drum(0.04, 0);
  scene.start.drum->radius = 0;
  EXPECT_EQ(test::refused(scene), "/supports/at=start/drum/radius");
  scene = on_a_drum(0.04, 0);
  scene.integrator = {};
  scene.integrator.type = IntegratorType::rosenbrock4;
  EXPECT_EQ(test::refused(scene), "/integrator/type");
}

}  // namespace
}  // namespace vlbeam
