#include <gtest/gtest.h>

#include "core/dynamics/kept_tangent.hpp"
#include "core/dynamics/shorter_steps.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// Lengths of steps that are all solved from `tried` on, in units of the whole one, until one is whole.
std::vector<double> until_whole(ShorterSteps& steps, double tried) {
  steps.failed(tried / 2);
  std::vector<double> lengths{tried / 2};
  for (steps.taken(1); lengths.back() < 1; steps.taken(1)) lengths.push_back(steps.longest(1));
  return lengths;
}

TEST(ShorterSteps, DoubleAfterFourOfALength) {
  ShorterSteps steps;
  EXPECT_EQ(steps.longest(1), 1);
  EXPECT_EQ(until_whole(steps, 0.5), (std::vector<double>{0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 0.5, 1}));
}

TEST(ShorterSteps, StayLongerWhereWholeOnesFailAgain) {
  ShorterSteps steps;
  EXPECT_EQ(until_whole(steps, 1).size(), 5U);
  EXPECT_EQ(until_whole(steps, 1).size(), 9U);
  EXPECT_EQ(until_whole(steps, 1).size(), 17U);
  for (int i = 0; i < 10; ++i) until_whole(steps, 1);
  EXPECT_EQ(until_whole(steps, 1).size(), 65U);
}

TEST(ShorterSteps, TakeHalvingsInARowForOneFailure) {
  ShorterSteps steps;
  for (const double half : {0.5, 0.25, 0.125}) steps.failed(half);
  EXPECT_EQ(until_whole(steps, 0.125).size(), 4U * 4 + 1);
}

TEST(ShorterSteps, ForgetOnceWholeStepsHaveGoneOn) {
  ShorterSteps steps;
  until_whole(steps, 1);
  for (int i = 0; i < 4; ++i) steps.taken(1);
  EXPECT_EQ(until_whole(steps, 1).size(), 5U);
}

TEST(KeptTangent, IsTriedMoreAndMoreRarelyWhileItFailsAtOnce) {
  KeptTangent tangent;
  std::vector<int> own;  // steps that make their own between two that try
  for (int tries = 0; tries < 8; ++tries) {
    tangent.kept(0.5, true);
    own.push_back(0);
    for (; tangent.is_old(); tangent.made(1e-4)) ++own.back();
  }
  EXPECT_EQ(own, (std::vector<int>{1, 2, 4, 8, 16, 32, 32, 32}));
}

TEST(KeptTangent, IsKeptAgainWhereItServedForAStep) {
  KeptTangent tangent;
  for (int tries = 0; tries < 3; ++tries) {
    tangent.kept(0.1, false);
    EXPECT_FALSE(tangent.is_old());
    tangent.kept(0.15, true);
    EXPECT_FALSE(tangent.is_old()) << "the one that was made on the way is new";
  }
}

TEST(KeptTangent, IsOldWhereItsContractionIs) {
  KeptTangent tangent;
  tangent.kept(0.1, false);
  tangent.kept(0.3, false);
  EXPECT_TRUE(tangent.is_old());
  tangent.made(1e-4);
  EXPECT_FALSE(tangent.is_old());
  tangent.made(1e-2);  // the next step would not be fast with it
  EXPECT_TRUE(tangent.is_old());
}

// Steps of 4 ms are too long for the waves that the joint makes from 0.4 s on. Those that were whole again behind each
// that failed made twice as many rejected steps as others, and 1 J out of nothing at the events.
TEST(ShorterSteps, KeepAFineMeshFromAStormOfRejectedSteps) {
  Scene scene = falling_beam(ElementKind::ale_rancf, 200);
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 4e-3;
  scene.duration = 0.6;
  scene.output.interval = 0.1;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_LE(10 * result.solver.rejected, result.solver.steps);
  EXPECT_LE(result.max_energy_drift, 1e-2 * result.max_kinetic);
}

}  // namespace
}  // namespace vlbeam::test
