#include "scene/stiffness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/automatic_integrator.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/wire.hpp"

namespace vlbeam::test {
namespace {

bool warned(const RunResult& result) {
  return std::ranges::any_of(
      result.warnings, [](const Warning& warning) { return warning.kind == WarningKind::stability_limits_steps; });
}

TEST(Stiffness, FrequencyIsThatOfOneElement) {
  // EI/(EA l^2) = (r/l)^2/4 is small: waves along the axis
  const double speed = std::sqrt(rubber / 7200);
  Scene at_all_points = wire(rubber);
  at_all_points.beam.axial_strain = AxialStrain::full;
  EXPECT_NEAR(largest_frequency(at_all_points), std::sqrt(170.1249) * speed / 0.1, 1e-3);
  EXPECT_NEAR(largest_frequency(wire(rubber)), std::sqrt(378.91574) * speed / 0.1, 1e-3) << "its stretch is sampled";
  Scene thick = wire(rubber);
  thick.beam.section.radius = 0.1;
  EXPECT_NEAR(largest_frequency(thick), std::sqrt(8400.0) * speed * 0.05 / 0.01, 1e-2);
}

// As the mass passes, the shorter element beside it is any part of L_std from a half on: bending waves there are up to
// four times as fast, in the mean twice.
TEST(Stiffness, APassingMassShortensElements) {
  Scene bead;
  bead.beam.section = {.type = Section::Type::stiffness};
  bead.beam.section.rhoA = 1;
  bead.beam.section.EA = bead.beam.section.EI = 1e6;
  bead.sliding_mass = SlidingMassSpec{};
  const auto& control = bead.length_control;
  const double least = 2 - control.upper * (1 + control.hysteresis);
  double mean = 0;
  constexpr int lengths = 1000;
  for (int i = 0; i < lengths; ++i) mean += std::pow(least + (1 - least) * (i + 0.5) / lengths, -2) / lengths;
  EXPECT_NEAR(mean_largest_frequency(bead) / largest_frequency(bead), mean, 1e-5 * mean);
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

TEST(Stiffness, SlowRunsSayWhatLimitsThem) {
  Scene scene = wire(steel);
  EXPECT_NE(why_slow(scene, 1.5 / largest_frequency(scene)).find("generalized-alpha"), std::string::npos);
  EXPECT_TRUE(why_slow(scene, 0.1 / largest_frequency(scene)).empty()) << "accuracy does";
  scene.integrator = automatic_integrator(scene);
  EXPECT_TRUE(why_slow(scene, scene.integrator.step / 2).empty());
  EXPECT_EQ(why_slow(scene, scene.integrator.step / 100).find("filtered"), std::string::npos) << "it is";
  scene.integrator.error_estimate = ErrorEstimate::all;
  EXPECT_NE(why_slow(scene, scene.integrator.step / 100).find("filtered"), std::string::npos);
}

}  // namespace
}  // namespace vlbeam::test
