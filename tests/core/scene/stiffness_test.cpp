#include "core/scene/stiffness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/simulate.hpp"

namespace vlbeam::test {
namespace {

Scene wire(double youngs_modulus) {
  Scene scene;
  scene.start.type = SupportType::clamp;
  scene.sliding_mass = SlidingMassSpec{};
  scene.beam.elements = 10;
  scene.beam.material.youngs_modulus = youngs_modulus;
  return scene;
}

constexpr double steel = 2.1e11, rubber = 2e7;

bool warned(const RunResult& result) {
  return std::ranges::any_of(
      result.warnings, [](const Warning& warning) { return warning.kind == WarningKind::stability_limits_steps; });
}

TEST(Stiffness, FrequencyIsThatOfOneElement) {
  // EI/(EA l^2) = (r/l)^2/4 is small: waves along the axis
  const double speed = std::sqrt(rubber / 7200);
  EXPECT_NEAR(largest_frequency(wire(rubber)), std::sqrt(170.1249) * speed / 0.1, 1e-3);
  Scene thick = wire(rubber);
  thick.beam.section.radius = 0.1;
  EXPECT_NEAR(largest_frequency(thick), std::sqrt(8400.0) * speed * 0.05 / 0.01, 1e-2);
}

TEST(Stiffness, AutoTakesTheImplicitMethodForSteel) {
  EXPECT_EQ(automatic_integrator(wire(steel)).type, IntegratorType::generalized_alpha);
  EXPECT_EQ(automatic_integrator(wire(rubber)).type, IntegratorType::dopri5);
  Scene brief = wire(steel);
  brief.duration = 1e-6;
  EXPECT_EQ(automatic_integrator(brief).type, IntegratorType::dopri5);
  Scene kinked = wire(steel);
  kinked.sliding_mass->slopes = JointSlopes::tangent;  // generalized-alpha would need multipliers
  EXPECT_EQ(automatic_integrator(kinked).type, IntegratorType::dopri5);
}

TEST(Stiffness, AutoChoosesImplicitStepsByTheBeamsLength) {
  const IntegratorSpec metres = automatic_integrator(wire(steel));
  EXPECT_TRUE(metres.adaptive && metres.automatic && metres.atol_by_kind);
  Scene longer = wire(steel);
  longer.beam.curve.end = {1000, 0};
  longer.beam.elements = 10000;
  EXPECT_NEAR(automatic_integrator(longer).atol_by_kind->length, 1000 * metres.atol_by_kind->length, 1e-12);
}

// As the mass passes, the shorter element beside it is any part of L_std from a half on: bending waves there are up to
// four times as fast, in the mean twice. By L_std alone dopri5 takes 714,000 steps here.
TEST(Stiffness, AutoKnowsThatAPassingMassShortensElements) {
  Scene bead;
  bead.beam.curve.type = CurveType::arc;
  bead.beam.curve.radius = 2;
  bead.beam.curve.from_degrees = 180;
  bead.beam.curve.to_degrees = 360;
  bead.beam.section = {.type = Section::Type::stiffness};
  bead.beam.section.rhoA = 1;
  bead.beam.section.EA = bead.beam.section.EI = 1e6;
  bead.beam.elements = 16;
  bead.start.type = bead.end.type = SupportType::clamp;
  bead.duration = 0.6;
  EXPECT_EQ(automatic_integrator(bead).type, IntegratorType::dopri5);
  bead.sliding_mass = SlidingMassSpec{};
  bead.sliding_mass->position = 0.4;
  EXPECT_EQ(automatic_integrator(bead).type, IntegratorType::generalized_alpha);
  const auto& control = bead.length_control;
  const double least = 2 - control.upper * (1 + control.hysteresis);
  double mean = 0;
  constexpr int lengths = 1000;
  for (int i = 0; i < lengths; ++i) mean += std::pow(least + (1 - least) * (i + 0.5) / lengths, -2) / lengths;
  EXPECT_NEAR(mean_largest_frequency(bead) / largest_frequency(bead), mean, 1e-5 * mean);
  bead.length_control.enabled = false;
  EXPECT_EQ(automatic_integrator(bead).type, IntegratorType::dopri5);
}

// All lengths and times a thousand times as long: the choice must not see it.
TEST(Stiffness, AutoChoosesAlikeInAllUnits) {
  Scene scene = wire(steel);
  const IntegratorSpec here = automatic_integrator(scene);
  scene.beam.curve.end[0] *= 1000;
  scene.beam.section.radius *= 1000;
  scene.gravity[1] /= 1000;
  scene.duration *= 1000;
  scene.sliding_mass->position *= 1000;
  const IntegratorSpec there = automatic_integrator(scene);
  EXPECT_EQ(there.type, IntegratorType::generalized_alpha);
  EXPECT_NEAR(there.step / here.step, 1000, 1e-6);
}

// Its own weight, let go: vibrations of 72 Hz and 0.16 mm.
TEST(Stiffness, AutoFollowsSmallVibrationsOfAStiffCantilever) {
  for (const double radius : {0.05, 0.01}) {
    Scene scene = wire(steel);
    scene.sliding_mass.reset();
    scene.beam.section.radius = radius;
    scene.duration = 0.5;
    scene.integrator = automatic_integrator(scene);
    const RunResult chosen = simulate(scene);
    scene.integrator = {};
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 1e-5;
    const RunResult fine = simulate(scene);
    double largest = 0, error = 0;
    for (std::size_t i = 0; i < fine.samples.size(); ++i) {
      largest = std::max(largest, std::abs(fine.samples[i].end[1]));
      error = std::max(error, std::abs(fine.samples[i].end[1] - chosen.samples[i].end[1]));
    }
    EXPECT_LE(error, 0.02 * largest) << radius;
  }
}

TEST(Stiffness, ARunWarnsWhereStabilityLimitsItsSteps) {
  Scene scene = wire(steel);
  scene.integrator.rtol = scene.integrator.atol = 1e-5;
  scene.duration = 0.04;
  scene.output.interval = 0.01;
  EXPECT_TRUE(warned(simulate(scene)));
  scene.integrator = automatic_integrator(scene);
  EXPECT_FALSE(warned(simulate(scene)));
}

TEST(Stiffness, ARunLimitedByAccuracyDoesNotWarn) {
  Scene scene = wire(rubber);
  scene.beam.elements = 20;
  scene.integrator.rtol = scene.integrator.atol = 1e-11;
  scene.duration = 0.2;
  const RunResult result = simulate(scene);
  EXPECT_GT(result.solver.steps, 1e4);
  EXPECT_FALSE(warned(result));
}

}  // namespace
}  // namespace vlbeam::test
