#include "studies/harness/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "io/scene_json.hpp"
#include "tests/harness/example_scene.hpp"
#include "tests/harness/report_of.hpp"

namespace vlbeam {
namespace {

TEST(TableCsv, WritesNumbersInFullAndQuotesText) {
  const Table table{
      .name = "t",
      .caption = "",
      .columns = {"N", "error", "note"},
      .rows = {{5, 0.1 + 0.2, "a, \"b\""}, {10, nullptr, true}, {20, std::numeric_limits<double>::quiet_NaN(), ""}}};
  EXPECT_EQ(table_csv(table), "N,error,note\n5,0.30000000000000004,\"a, \"\"b\"\"\"\n10,,true\n20,,\n");
}

TEST(ReportJson, HoldsNothingMadeOfWallTimes) {
  StudyReport report;
  report.tables = {{.name = "speed", .caption = "", .columns = {"s"}, .rows = {{0.123}}, .timing = true},
                   {.name = "curve", .caption = "", .columns = {"t"}, .rows = {{1.0}}, .curve = true}};
  report.figures = {{.name = "speed", .caption = "", .script = "a.gp", .timing = true}};
  report.timing = {{"motion", 0.123}};
  const Json json = report_to_json(report, {.out = "reports", .study = "s"}, "full", "completed", "");
  EXPECT_EQ(json.dump().find("0.123"), std::string::npos);
  EXPECT_TRUE(json["figures"].empty());
  ASSERT_EQ(json["tables"].size(), 1U);
  EXPECT_EQ(json["tables"][0]["file"], "s_curve.csv");
  EXPECT_FALSE(json["tables"][0].contains("rows"));
}

RunResult small_run() {
  RunResult result;
  Sample on_beam;
  on_beam.joint_position = 0.25;
  on_beam.mass_position = Point{0.25, 0, 0};
  on_beam.end = {1, -0.5, 0};
  on_beam.joint = {3, {0.5, 2, 0}, 0.5, 2, 0};
  on_beam.energy = {.kinetic = 1, .axial = 2, .bending = 3, .gravity = -4, .dissipated = 0.5};
  Sample left = on_beam;
  left.t = 0.005;
  left.joint_position.reset();
  left.joint.reset();
  result.samples = {on_beam, left};
  result.status = RunStatus::separated;
  return result;
}

std::string csv_of(const Scene& scene, const RunResult& result) {
  std::string text;
  write_samples_csv(scene, result, [&text](std::string_view piece) { text += piece; });
  return text;
}

TEST(RunReport, SamplesAreColumns) {
  const Scene scene = scene_from_json(example_scene());
  const Json report = report_of(scene, small_run(), {{"timing", {{"motion", 0.5}}}});
  EXPECT_EQ(report["status"], "separated");
  EXPECT_EQ(report["samples"]["t"], (Json{0.0, 0.005}));
  EXPECT_TRUE(report["samples"]["t"][0].is_number_float());
  EXPECT_EQ(report["samples"]["joint_position"], (Json{0.25, nullptr}));
  EXPECT_EQ(report["samples"]["mass_position"][0], (Json{0.25, 0.0}));
  EXPECT_EQ(report["samples"]["end"][0], (Json{1.0, -0.5})) << "a planar scene has two components";
  EXPECT_EQ(report["samples"]["energy"]["total"][0], 2.5);
  EXPECT_EQ(report["samples"]["contact"]["force"], (Json{{0.5, 2.0}, nullptr}));
  EXPECT_EQ(report["samples"]["joint_velocity"], (Json{3.0, nullptr}));
  EXPECT_EQ(report["samples"]["reactions"]["start"]["position"].size(), 2U);
  EXPECT_FALSE(report["samples"]["reactions"].contains("end"));
  EXPECT_EQ(report["scene"], scene_to_json(scene));
  EXPECT_EQ(report["timing"]["motion"], 0.5);
  EXPECT_FALSE(report.contains("failure"));
}

TEST(RunReport, AFailureSaysWhenAndWhat) {
  RunResult result = small_run();
  result.status = RunStatus::failed;
  result.failure = "step underflow";
  result.failure_time = 0.3;
  const Json report = report_of(Scene{}, result);
  EXPECT_EQ(report["failure"], (Json{{"message", "step underflow"}, {"t", 0.3}}));
  EXPECT_EQ(report["samples"]["t"].size(), 2U) << "what was computed is kept";
  EXPECT_EQ(report["samples"]["reactions"], Json::object()) << "nothing holds this beam";
}

TEST(RunReport, WarningsSayWhatToTry) {
  RunResult result = small_run();
  result.warnings = {{WarningKind::energy_at_events, "much", "more elements"}};
  EXPECT_EQ(report_of(Scene{}, result)["warnings"],
            (Json{{{"kind", "energy-at-events"}, {"message", "much"}, {"remedy", "more elements"}}}));
  EXPECT_THAT(run_summary(Scene{}, result), testing::ContainsRegex("warning +much\n +try: more elements"));
}

TEST(RunReport, ARunWithoutSamplesIsOneToo) {
  RunResult result;
  result.status = RunStatus::failed;
  EXPECT_EQ(report_of(Scene{}, result)["samples"]["t"], Json::array());
  EXPECT_FALSE(run_summary(Scene{}, result).empty());
}

TEST(SamplesCsv, HasOneLineASampleAndUnits) {
  std::istringstream csv(csv_of(scene_from_json(example_scene()), small_run()));
  std::string head, first, second, more;
  std::getline(csv, head);
  std::getline(csv, first);
  std::getline(csv, second);
  EXPECT_FALSE(std::getline(csv, more));
  EXPECT_THAT(head, testing::StartsWith("t [s],joint_position [m],mass_x [m],mass_y [m],end_x [m],end_y [m],"
                                        "beam_length [m],beam_length_rate [m/s],energy_kinetic [J],energy_axial [J],"
                                        "energy_bending [J],energy_torsion [J],energy_gravity [J]"));
  EXPECT_THAT(head, testing::HasSubstr(",contact_x [N],contact_y [N],contact_tangential [N],contact_normal [N],"));
  EXPECT_THAT(first, testing::StartsWith("0,0.25,0.25,0,1,-0.5,0,0,1,2,3,0,-4,"));
  EXPECT_THAT(second, testing::StartsWith("0.005,,0.25,0,1,-0.5,"));
  for (const std::string& line : {first, second}) {
    EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(head, ','));
  }
}

}  // namespace
}  // namespace vlbeam
