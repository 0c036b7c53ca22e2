// What a study that was interrupted has finished is not computed again.
#include "tools/kept_runs.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "core/error.hpp"
#include "io/scene_json.hpp"
#include "tests/folders.hpp"
#include "tests/harness/program_of_runs.hpp"
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

/// Where each run is a process of its own.
class RunsApart : public KeptRunsTest {
 protected:
  static Scene of_library(const std::string& name, double longest) {
    Scene scene = read_scene(test::source_folder() / "scenes" / (name + ".json"));
    scene.duration = std::min(scene.duration, longest);
    scene.output.interval = std::min(scene.output.interval, longest / 2);
    std::erase_if(scene.output.configurations, [&](double t) { return t > scene.duration; });
    return scene;
  }
  /// What comes of it instead of a result.
  std::string says(const Scene& scene) {
    try {
      run(scene);
    } catch (const InvalidInput& error) {
      return error.field + " | " + error.value;
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing";
  }
};

TEST_F(RunsApart, GiveTheSameResults) {
  const KeptRuns kept(kept_, program_of_runs);
  for (const char* name : {"falling_beam", "semicircle", "two_trolleys", "sleeve", "drill_stem", "moving_string",
                           "cable_through_ring", "shallow_arch"}) {
    SCOPED_TRACE(name);
    const Scene scene = of_library(name, 0.1);
    expect_whole(scene, run(scene));
  }
}

TEST_F(RunsApart, FailAsTheyWould) {
  const KeptRuns kept(kept_, program_of_runs);
  Scene scene = of_library("falling_beam", 0.5);
  scene.length_control.enabled = false;  // the mass runs into a node
  scene.beam.elements = 6;
  scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 0.01};
  const RunResult result = run(scene);
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_EQ(result.failure, simulate(scene).failure);
  expect_whole(scene, result);
  scene.beam.elements = 0;
  EXPECT_EQ(says(scene), "/beam/elements | 0");
}

TEST_F(RunsApart, KnowWhoChoseTheIntegrator) {
  const KeptRuns kept(kept_, program_of_runs);
  Scene scene = parse_scene(R"({"beam": {"elements": 8, "section": {"radius": 0.01},
    "material": {"density": 7200, "youngs_modulus": 2e11}}, "duration": 0.1, "supports": [{"at": "start", "type": "clamp"}], "integrator": {"type": "dopri5"}, "output": {"interval": 0.05}})");
  for (const bool automatic : {false, true}) {
    scene.integrator.automatic = automatic;
    const RunResult result = run(scene);
    expect_whole(scene, result);
    EXPECT_EQ(result.warnings.empty(), automatic);
  }
}

TEST_F(RunsApart, AreNotRepeated) {
  const Scene scene = swinging(200);  // a second, several times what it takes to be asked
  const auto interrupted_at_once = [](double) { return false; };
  {
    const KeptRuns kept(kept_, program_of_runs);
    EXPECT_EQ(simulate_kept(scene, interrupted_at_once).status, RunStatus::interrupted);
    EXPECT_FALSE(std::filesystem::is_empty(kept_)) << "a checkpoint";
  }
  const KeptRuns kept(kept_);  // in this process, where steps can be counted
  expect_whole(scene, run(scene, 201));
  EXPECT_LT(steps_, 200000);
}

TEST_F(RunsApart, ThatCrashSayByWhat) {
  const Scene scene = swinging();
  for (const auto& [signal, how] : {std::pair{"SEGV", "its process ended by signal 11 (Segmentation fault)"},
                                    std::pair{"KILL",
                                              "its process ended by signal 9 (killed, as by the system where "
                                              "memory runs out)"}}) {
    const KeptRuns kept(kept_, crashing_program(folder_, "", signal));
    EXPECT_EQ(says(scene), how);
  }
  const KeptRuns kept(kept_, "/nowhere/vlbeam");
  EXPECT_EQ(says(scene), "its process ended with exit code 127: cannot start /nowhere/vlbeam");
}

}  // namespace
}  // namespace vlbeam
