// Comparing runs, and other codes' trajectories with certified ones.
#include "tools/score.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/run_report.hpp"
#include "io/scene_json.hpp"
#include "scene/simulate.hpp"
#include "tests/harness/temporary_folder.hpp"
#include "tools/compare_runs.hpp"

namespace vlbeam {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

CertifiedCase line() {
  return {"line", "A line", "made up", {0, 0.1, 0.2}, {{"end_y", "m", {0, 1, 2}, {0.01, 0.01, 0.02}}}};
}

class Score : public testing::Test {
 protected:
  Json of(const std::string& csv, const std::vector<std::string>& renamed = {}) const {
    folder_.write("their.csv", csv);
    return score_trajectory(line(), folder_ / "their.csv", renamed);
  }
  std::string refusal(const std::string& csv, const std::vector<std::string>& renamed = {}) const {
    try {
      of(csv, renamed);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  }
  bool refuses(const std::string& csv, const std::string& part) const {
    return refusal(csv).find(part) != std::string::npos;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Score, IsTheErrorAgainstTheUncertainty) {
  const Json row = of("t,end_y\n0,0.005\n0.1,1.5\n0.2,2\n").at("columns")[0];
  EXPECT_EQ(row.at("compared"), 3);
  EXPECT_DOUBLE_EQ(row.at("largest_error"), 0.5);
  EXPECT_EQ(row.at("at"), 0.1);
  EXPECT_DOUBLE_EQ(row.at("rms_error"), std::sqrt((0.005 * 0.005 + 0.25) / 3));
  EXPECT_EQ(row.at("within_uncertainty"), 2);
  EXPECT_EQ(row.at("largest_uncertainty"), 0.02);
}

TEST_F(Score, TakesSubsetsGapsAndOtherNames) {
  const Json row = of("# a comment\nt [s],tip,other\n0,,7\n0.2,2,8\n", {"end_y=tip"}).at("columns")[0];
  EXPECT_EQ(row.at("compared"), 1);
  EXPECT_EQ(row.at("gaps"), 1);
  EXPECT_EQ(row.at("largest_error"), 0);
}

TEST_F(Score, LeavesOutWhatComesAfterTheCase) {
  const Json score = of("t,end_y\n0.2,2\n0.25,7\n0.3,8\n");
  EXPECT_EQ(score.at("rows_beyond_the_case"), 2);
  EXPECT_EQ(score.at("columns")[0].at("largest_error"), 0);
}

TEST_F(Score, LeavesOutTimesAtWhichTheCaseIsNotKnown) {
  const Json score = of("t,end_y\n0.1,1\n0.15,7\n0.2,2\n");
  EXPECT_EQ(score.at("rows_at_other_times"), 1);
  EXPECT_EQ(score.at("rows"), 2);
  EXPECT_EQ(score.at("columns")[0].at("largest_error"), 0);
}

TEST_F(Score, SaysInWordsWhetherAnErrorIsSeen) {
  EXPECT_EQ(of("t,end_y\n0.1,1.005\n").at("columns")[0].at("verdict"), "no error seen: below what is known (0.01 m)");
  EXPECT_EQ(of("t,end_y\n0.1,1.5\n").at("columns")[0].at("verdict"), "an error of 0.5 m");
}

TEST_F(Score, AColumnThatIsNearlyOneOfTheCaseIsRefused) {
  EXPECT_TRUE(refuses("t,end.y\n0,0\n", "is \"end_y\" meant?"));
  EXPECT_TRUE(refuses("t,other,edn_y\n0,0,0\n", "is \"end_y\" meant?"));
  EXPECT_FALSE(refuses("t,end_y,end_x\n0,0,0\n", "meant?"));
}

TEST(ScoreFolder, FindsTheOrderOfSeveralMeshes) {
  const TemporaryFolder folder;
  folder.write("cases/line.json", R"({"title": "A line", "source": "made up", "t": [0, 0.1],
      "columns": {"end_y": {"unit": "m", "values": [0, 1], "uncertainties": [1e-9, 1e-9]}}})");
  folder.write("cases/line_steep.json", R"({"title": "A steep line", "source": "made up", "t": [0, 0.1],
      "columns": {"end_y": {"unit": "m", "values": [0, 2], "uncertainties": [0.1, 0.1]}}})");
  for (const auto& [n, value] : {std::pair{10, "1.002048"}, {20, "1.000128"}, {40, "1.000008"}}) {
    folder.write("theirs/line_cubic_N" + std::to_string(n) + ".csv", std::string("t,end_y\n0.1,") + value + "\n");
  }
  folder.write("theirs/line_steep.csv", "t,end_y\n0.1,2.05\n");
  const Json scores = score_folder(folder / "cases", folder / "theirs", {});
  EXPECT_EQ(scores.at("trajectories").size(), 4U);
  ASSERT_EQ(scores.at("meshes").size(), 1U);
  const Json& meshes = scores.at("meshes")[0];
  EXPECT_EQ(meshes.at("elements"), Json::array({10, 20, 40}));
  EXPECT_NEAR(meshes.at("order"), 4, 1e-3);
  EXPECT_EQ(meshes.at("verdict"), "an error of 8e-06 m, of order 4");
  const std::string table = score_table(scores);
  EXPECT_NE(table.find("line_steep\n  end_y: no error seen"), std::string::npos) << table;
  EXPECT_NE(table.find("line, cubic\n  end_y: 0.002 (N = 10)"), std::string::npos) << table;
  folder.write("theirs/lime.csv", "t,end_y\n0.1,2.05\n");
  EXPECT_THROW(score_folder(folder / "cases", folder / "theirs", {}), InvalidInput);
  EXPECT_THROW(score_folder(folder / "cases", folder / "cases", {}), InvalidInput);
}

TEST_F(Score, RefusesWithLineAndColumn) {
  EXPECT_TRUE(refuses("t,end_y\n0,nan\n", "line 2, end_y"));
  EXPECT_TRUE(refuses("t,end_y\n0,0\n0.1,inf\n", "line 3, end_y"));
  EXPECT_TRUE(refuses("t,end_y\n0,1e\n", "line 2, end_y"));
  EXPECT_TRUE(refuses("t,end_y\n0\n", "1 cells"));
  EXPECT_TRUE(refuses("t,end_y\n0.05,0\n", "nothing is interpolated"));
  EXPECT_TRUE(refuses("t,end_y\n0.1,1\n0,0\n", "times must grow"));
  EXPECT_TRUE(refuses("t,end_y\n0.1,1\n0.1,0\n", "times must grow"));
  EXPECT_TRUE(refuses("t,end_y\n,1\n", "must have its time"));
  EXPECT_TRUE(refuses("t [ms],end_y\n0,1\n", "it must be s"));
  EXPECT_TRUE(refuses("t,end_y [mm]\n0,1\n", "it must be m"));
  EXPECT_TRUE(refuses("end_y\n1\n", "without a column t"));
  EXPECT_TRUE(refuses("t,tip\n0,1\n", "\"end_y\""));
  EXPECT_TRUE(refuses("t,end_y\n", "no numbers"));
  EXPECT_NE(refusal("t,tip\n0,1\n", {"end_y=top"}).find("--column"), std::string::npos);
}

TEST(Compare, SaysOptionsDistancesAndEvents) {
  const TemporaryFolder folder;
  const auto report = [&](const char* name, int elements, double interval) {
    Scene scene = parse_scene(R"({"beam": {"curve": {"type": "line", "start": [0, 0], "end": [1, 0]}},
      "supports": [{"at": "start", "type": "clamp"}], "sliding_mass": {"mass": 0.8, "position": 0.1},
      "duration": 0.3})");
    scene.beam.elements = elements;
    scene.output.interval = interval;
    const RunResult result = simulate(scene);
    write_file(folder / name, [&](const TextSink& sink) { write_run_report(scene, result, Json::object(), sink); });
    return read_run_file(folder / name);
  };
  const RunFile a = report("a.json", 10, 0.1), b = report("b.json", 12, 0.05);
  const Json same = compare_runs(a, a, 0);
  EXPECT_TRUE(same.at("within"));
  EXPECT_EQ(same.at("largest_distance"), 0);
  EXPECT_TRUE(same.at("options").empty());
  const Json two = compare_runs(a, b, 1e-9);
  EXPECT_FALSE(two.at("within"));
  EXPECT_EQ(two.at("common_samples"), 4);
  EXPECT_EQ(two.at("apart_from"), 0.1);
  bool elements = false;
  for (const Json& option : two.at("options")) elements = elements || option.at("option") == "/beam/elements";
  EXPECT_TRUE(elements);
  EXPECT_GT(two.at("largest_distance"), 1e-6);
  EXPECT_LT(two.at("largest_distance"), 1e-1);
  EXPECT_TRUE(compare_runs(a, b, infinite).at("within"));
  EXPECT_FALSE(two.at("events").empty());
}

}  // namespace
}  // namespace vlbeam
