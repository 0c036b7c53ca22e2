// A merge policy of the program that links the library.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

Scene falling(MergePolicy policy) {
  Scene scene = test::falling_beam(ElementKind::ale_rancf, 10);
  scene.length_control.merge = policy;
  scene.duration = 0.4;
  return scene;
}

TEST(MergeRule, GivesMergedElementsTheirWeights) {
  Scene scene = falling(MergePolicy::own);
  std::vector<LostNode> lost;
  scene.length_control.merge_rule = [&lost](const LostNode& node) {
    lost.push_back(node);
    return std::array<double, 3>{1, 1, 1};
  };
  const RunResult own = simulate(scene), unit = simulate(falling(MergePolicy::unit));
  ASSERT_EQ(own.status, RunStatus::completed) << own.failure;
  ASSERT_GT(own.events.size(), 0U);
  ASSERT_EQ(lost.size(), own.events.size());
  EXPECT_EQ(own.samples.back().end, unit.samples.back().end) << "unit weights by a rule are unit weights, bit by bit";
  for (std::size_t i = 0; i < lost.size(); ++i) {
    const LostNode& node = lost[i];
    const auto& x = own.events[i].before.x;
    EXPECT_LT(node.x_a, node.x);
    EXPECT_LT(node.x, node.x_b);
    const auto k = static_cast<std::size_t>(std::find(x.begin(), x.end(), node.x) - x.begin());
    ASSERT_LT(k, x.size()) << "it is one of the old nodes";
    EXPECT_EQ(node.r, own.events[i].before.r[k]);
    EXPECT_EQ(node.s, own.events[i].before.r_x[k]);
    EXPECT_EQ(node.s_b, own.events[i].before.r_x[k + 1]);
  }
}

TEST(MergeRule, ChangesTheShapeOfMergedElements) {
  Scene scene = falling(MergePolicy::own);
  scene.length_control.merge_rule = [](const LostNode&) { return std::array<double, 3>{0.9, 1.1, 1.2}; };
  const RunResult run = simulate(scene);
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events.front().weights, (std::array<double, 3>{0.9, 1.1, 1.2}));
}

TEST(MergeRule, ThatGivesNoWeightsEndsTheRun) {
  Scene scene = falling(MergePolicy::own);
  scene.length_control.merge_rule = [](const LostNode&) { return std::array<double, 3>{1, -0.5, 1}; };
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::failed);
  EXPECT_NE(run.failure.find("1, -0.5, 1"), std::string::npos) << run.failure;
  EXPECT_GT(run.failure_time, 0.1) << "the time of the first merge";
  EXPECT_FALSE(run.samples.empty());
}

TEST(MergeRule, IsRefusedWhereItCannotWork) {
  auto refused = [](const Scene& scene) {
    try {
      simulate(scene);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string();
  };
  EXPECT_EQ(refused(falling(MergePolicy::own)), "/length_control/merge") << "no rule";
  Scene scene = falling(MergePolicy::unit);
  scene.length_control.merge_rule = [](const LostNode&) { return std::array<double, 3>{1, 1, 1}; };
  EXPECT_EQ(refused(scene), "/length_control/merge") << "a rule that nobody asks";
  scene.length_control.merge = MergePolicy::own;
  scene.beam.element = ElementKind::ale_ancf;
  EXPECT_EQ(refused(scene), "/length_control/merge") << "no weights";
}

}  // namespace
}  // namespace vlbeam
