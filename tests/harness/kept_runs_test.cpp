// What a study that was interrupted has finished is not computed again.
#include "studies/harness/kept_runs.hpp"

#include <gtest/gtest.h>

#include "studies/harness/scene_json.hpp"
#include "tests/harness/report_of.hpp"
#include "tests/harness/temporary_folder.hpp"

namespace vlbeam {
namespace {

class KeptRunsTest : public ::testing::Test {
 protected:
  static Scene swinging(double duration = 0.1) {
    Json scene = parse_json(R"({"beam": {"elements": 4}, "supports": [{"at": "start", "type": "pin"}],
      "integrator": {"type": "generalized-alpha", "step": 1e-3}, "duration": 0.1, "output": {"interval": 0.02}})");
    scene["duration"] = duration;
    return scene_from_json(scene);
  }
  /// Runs it until `until`, and counts the steps.
  RunResult run(const Scene& scene, double until = 1) {
    steps_ = 0;
    return simulate_kept(scene, [&](double t) {
      ++steps_;
      return t < until;
    });
  }
  static void expect_whole(const Scene& scene, const RunResult& result) {
    EXPECT_EQ(Json::diff(report_of(scene, result), report_of(scene, simulate(scene))), Json::array());
  }

  TemporaryFolder folder_;
  std::filesystem::path kept_ = folder_ / "kept";
  int steps_ = 0;
};

TEST_F(KeptRunsTest, AreNotRepeated) {
  const Scene scene = swinging();
  const KeptRuns kept(kept_);
  expect_whole(scene, run(scene));
  EXPECT_EQ(steps_, 100);
  expect_whole(scene, run(scene));
  EXPECT_EQ(steps_, 0);
  run(swinging(0.2));
  EXPECT_EQ(steps_, 200);
}

TEST_F(KeptRunsTest, GoOnWhereTheyWereInterrupted) {
  const Scene scene = swinging();
  {
    const KeptRuns kept(kept_);
    EXPECT_EQ(run(scene, 0.0505).status, RunStatus::interrupted);
    EXPECT_EQ(steps_, 51);
  }
  const KeptRuns kept(kept_);
  expect_whole(scene, run(scene));
  EXPECT_EQ(steps_, 49);
}

TEST_F(KeptRunsTest, StartAnewWhereNothingIsKept) {
  const Scene scene = swinging();
  run(scene);
  EXPECT_EQ(steps_, 100);
  EXPECT_FALSE(exists(kept_));
  const KeptRuns kept(kept_);
  run(scene);
  for (const auto& entry : std::filesystem::directory_iterator(kept_)) std::ofstream(entry.path()) << "something else";
  expect_whole(scene, run(scene));
  EXPECT_EQ(steps_, 100);
  kept.discard();
  EXPECT_FALSE(exists(kept_));
  run(scene);
  EXPECT_EQ(steps_, 100);
}

}  // namespace
}  // namespace vlbeam
