#include "studies/harness/report.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "studies/harness/run_report.hpp"
#include "studies/harness/scene_json.hpp"
#include "tests/harness/example_scene.hpp"

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
  on_beam.energy = {.kinetic = 1, .axial = 2, .bending = 3, .gravity = -4, .dissipated = 0.5};
  Sample left = on_beam;
  left.t = 0.005;
  left.joint_position.reset();
  result.samples = {on_beam, left};
  result.status = RunStatus::separated;
  return result;
}

TEST(RunReport, SamplesAreColumns) {
  const Scene scene = scene_from_json(example_scene());
  const Json report = run_report(scene, small_run());
  EXPECT_EQ(report["status"], "separated");
  EXPECT_EQ(report["samples"]["t"], (Json{0.0, 0.005}));
  EXPECT_EQ(report["samples"]["joint_position"], (Json{0.25, nullptr}));
  EXPECT_EQ(report["samples"]["end"][0], (Json{1.0, -0.5})) << "a planar scene has two components";
  EXPECT_EQ(report["samples"]["energy"]["total"][0], 2.5);
  EXPECT_EQ(report["scene"], scene_to_json(scene));
  EXPECT_FALSE(report.contains("failure"));
}

TEST(RunReport, AFailureSaysWhenAndWhat) {
  RunResult result = small_run();
  result.status = RunStatus::failed;
  result.failure = "step underflow";
  result.failure_time = 0.3;
  const Json report = run_report(Scene{}, result);
  EXPECT_EQ(report["failure"], (Json{{"message", "step underflow"}, {"t", 0.3}}));
  EXPECT_EQ(report["samples"]["t"].size(), 2U) << "what was computed is kept";
}

TEST(SamplesCsv, HasOneLineASample) {
  const std::string csv = samples_csv(scene_from_json(example_scene()), small_run());
  EXPECT_EQ(csv,
            "t,joint_position,mass_x,mass_y,end_x,end_y,beam_length,beam_length_rate,energy_kinetic,energy_axial,"
            "energy_bending,"
            "energy_torsion,energy_gravity,energy_dissipated,energy_total,momentum_x,momentum_y\n"
            "0,0.25,0.25,0,1,-0.5,0,0,1,2,3,0,-4,0.5,2.5,0,0\n"
            "0.005,,0.25,0,1,-0.5,0,0,1,2,3,0,-4,0.5,2.5,0,0\n");
}

}  // namespace
}  // namespace vlbeam
