#include <gtest/gtest.h>

#include "mechanics/time/kept_tangent.hpp"
#include "mechanics/time/shorter_steps.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// Lengths of steps from one that was `tried` in vain to before the next one that is whole, 1.
std::vector<double> until_whole(ShorterSteps& steps, double tried) {
  std::vector<double> lengths;
  double h = tried / 2;
  for (steps.failed(h); h < 1; h = steps.longest(1)) {
    lengths.push_back(h);
    steps.taken(h, 1);
  }
  return lengths;
}

TEST(ShorterSteps, AreWholeAtOnceBehindOneFailure) {
  ShorterSteps steps;
  EXPECT_EQ(steps.longest(1), 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(until_whole(steps, 1), std::vector<double>{0.5});
    steps.taken(1, 1);
  }
}

TEST(ShorterSteps, StayLongerWhereWholeOnesFailAgain) {
  ShorterSteps steps;
  std::vector<std::size_t> counts;
  for (int i = 0; i < 7; ++i) counts.push_back(until_whole(steps, 1).size());
  EXPECT_EQ(counts, (std::vector<std::size_t>{1, 4, 8, 16, 32, 64, 64}));
  steps.taken(1, 1);
  EXPECT_EQ(until_whole(steps, 1).size(), 1U);
}

TEST(ShorterSteps, DoubleAfterSomeOfALength) {
  ShorterSteps steps;
  until_whole(steps, 1);
  steps.failed(0.5);  // halvings in a row are one failure
  EXPECT_EQ(until_whole(steps, 0.5), (std::vector<double>{0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 0.5}));
}

TEST(KeptTangent, IsTriedMoreAndMoreRarelyWhileItFailsAtOnce) {
  KeptTangent tangent;
  std::vector<int> own;  // steps that make their own between two that try
  for (int tries = 0; tries < 8; ++tries) {
    tangent.kept(6, true);
    own.push_back(0);
    for (; tangent.is_old(); tangent.made(1e-4)) ++own.back();
  }
  EXPECT_EQ(own, (std::vector<int>{1, 2, 4, 8, 16, 32, 32, 32}));
}

TEST(KeptTangent, IsKeptAgainWhereItServedForAStep) {
  KeptTangent tangent;
  for (int tries = 0; tries < 3; ++tries) {
    tangent.kept(3, false);
    EXPECT_FALSE(tangent.is_old());
    tangent.kept(6, true);
    EXPECT_FALSE(tangent.is_old()) << "the one that was made on the way is new";
  }
}

TEST(KeptTangent, IsOldWhereItTakesAsLongAsANewOne) {
  KeptTangent tangent;
  tangent.kept(tangent_work - 1, false);
  EXPECT_FALSE(tangent.is_old());
  tangent.kept(tangent_work, false);
  EXPECT_TRUE(tangent.is_old());
  tangent.made(1e-4);
  EXPECT_FALSE(tangent.is_old());
  tangent.made(1e-2);  // the next step would not be fast with it
  EXPECT_TRUE(tangent.is_old());
}

// Steps of 4 ms are too long for this mesh. When they were whole again behind each that failed, 1434 were rejected for
// 700 that were taken, and events made 1 J out of nothing.
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
  const auto& [given, error, newton, events] = result.solver.limited_by;
  EXPECT_EQ(given + newton + events, result.solver.steps);
  EXPECT_EQ(events, result.events.size());
  EXPECT_GT(newton, result.solver.rejected) << "they stay shorter for a while";
  EXPECT_EQ(error, 0U);
  EXPECT_EQ(result.solver.rejected_by, (StepsByLimit{0, 0, result.solver.rejected, 0}));
  EXPECT_LE(result.max_energy_drift, 1e-2 * result.max_kinetic);
}

}  // namespace
}  // namespace vlbeam::test
