// Beams with frames whose material damps.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/simulate.hpp"
#include "tests/core/support/by_greens_law.hpp"

namespace vlbeam::test {
namespace {

RunResult run(const Scene& scene) {
  RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  return result;
}

/// A rod without inertia to speak of, as a torque sets in: its angle grows like 1 - exp(-t/c).
TEST(FramesDamped, ARodCreepsIntoItsTwist) {
  Scene scene = test::by_greens_law();
  scene.dimension = 3;
  scene.gravity = {};
  scene.beam.space_law = SpaceLaw::frames;
  scene.beam.strain_law = StrainLaw::engineering;  // with the other one a twist lengthens the rod
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e4, .EI = 5, .rhoA = 1, .GIp = 4, .rhoIp = 4e-6};
  scene.beam.material.damping = 0.1;
  scene.beam.elements = 4;
  scene.start = {.type = SupportType::clamp, .clamp = ClampType::full};
  scene.loads = {{.type = LoadType::torque, .node = 4, .x = {}, .magnitude = {.value = 3}, .turn = {}}};
  scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 2.5e-5};
  scene.output.interval = 0.05;
  scene.duration = 0.3;
  const RunResult result = run(scene);
  const double whole = 3 * 3 / (2 * 4.0);
  for (const Sample& sample : result.samples) {
    const double share = 1 - std::exp(-sample.t / 0.1);
    EXPECT_NEAR(sample.energy.torsion, whole * share * share, 2e-5 * whole) << sample.t;
  }
}

/// A cantilever in the plane on which a mass may slide, as the plane's own law has it, and with frames.
Scene cantilever(bool frames, StrainLaw law, bool mass) {
  Scene scene = test::by_greens_law();
  scene.gravity = {0, -9.81, 0};
  scene.beam.strain_law = law;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e3, .EI = 2, .rhoA = 1};
  scene.beam.material.damping = 0.03;
  scene.beam.elements = 16;
  scene.start = {.type = SupportType::clamp, .clamp = ClampType::full};
  scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 5e-4};
  scene.duration = 0.4;
  if (mass) {
    scene.sliding_mass.emplace();
    scene.sliding_mass->mass = 0.5;
    scene.sliding_mass->position = 0.4;
    scene.sliding_mass->velocity = 0.6;
  }
  if (frames) {
    scene.dimension = 3;
    scene.beam.space_law = SpaceLaw::frames;
    scene.beam.section.GIp = 2;
    scene.beam.section.rhoIp = 1e-3;
  }
  return scene;
}

TEST(FramesDamped, InThePlaneTheyAreTheLawOfThePlane) {
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    for (const bool mass : {false, true}) {
      const RunResult plane = run(cantilever(false, law, mass)), frames = run(cantilever(true, law, mass));
      EXPECT_EQ(plane.events.size(), frames.events.size());
      const Sample &a = plane.samples.back(), &b = frames.samples.back();
      const double sinks = std::abs(a.end[1]);
      EXPECT_GT(sinks, 0.1);
      EXPECT_NEAR(a.end[1], b.end[1], 1e-4 * sinks);
      EXPECT_GT(a.energy.dissipated, 0.05 * plane.max_kinetic);
      EXPECT_NEAR(a.energy.dissipated, b.energy.dissipated, 1e-3 * a.energy.dissipated);
      if (mass) {
        EXPECT_GE(plane.events.size(), 1U);
        EXPECT_NEAR(*a.joint_position, *b.joint_position, 1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
