#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/error.hpp"
#include "io/scene_json.hpp"
#include "scene/simulate.hpp"
#include "tests/harness/report_of.hpp"

namespace vlbeam {
namespace {

/// A mass slides along a beam whose clamp is shaken.
Json shaken() {
  return parse_json(R"({
    "beam": {"elements": 5, "element": "ALE-ANCF"},
    "supports": [{"at": "end", "type": "free"},
                 {"at": "start", "type": "clamp",
                  "motion": {"direction": [0, 2], "amplitude": 0.03, "frequency": 4, "ramp": 0.1}}],
    "sliding_mass": {"mass": 0.8, "position": 0.1},
    "integrator": {"type": "fehlberg78", "rtol": 1e-12, "atol": 1e-12},
    "duration": 0.3, "output": {"interval": 0.05}
  })");
}

TEST(SupportMotionScene, EchoReadsBackAsTheSameScene) {
  const Json echo = scene_to_json(scene_from_json(shaken()));
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);
  EXPECT_EQ(echo["supports"][0]["motion"]["frequency"], 4);
  EXPECT_FALSE(echo["supports"][1].contains("motion"));
}

TEST(SupportMotionScene, ReportsTheEnergySupplied) {
  const Scene scene = scene_from_json(shaken());
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_LE(result.max_energy_drift, 1e-9 * result.max_kinetic);
  double most = 0;
  for (const Sample& sample : result.samples) most = std::max(most, std::abs(sample.energy.supplied));
  EXPECT_GT(most, 1e-2 * result.max_kinetic);
  const Json report = report_of(scene, result);
  EXPECT_EQ(report["samples"]["energy"]["supplied"].size(), result.samples.size());
  Json still = shaken();
  still["supports"][1].erase("motion");
  const Scene resting = scene_from_json(still);
  EXPECT_FALSE(report_of(resting, simulate(resting))["samples"]["energy"].contains("supplied"));
}

TEST(SupportMotionScene, ShakesTheConfiguredPoint) {
  Json json = shaken();
  json["output"]["configurations"] = {0.3};
  for (const char* constraints : {"eliminated", "multipliers"}) {
    json["constraints"] = constraints;
    json["integrator"] = {{"type", "generalized-alpha"}, {"step", 1e-3}};
    const RunResult result = simulate(scene_from_json(json));
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    const Point& support = result.configurations.front().r.front();
    EXPECT_NEAR(support[0], 0, 1e-15);
    EXPECT_NEAR(support[1], 0.03 * std::sin(2 * 3.14159265358979324 * 4 * 0.3), 1e-14);  // of a unit direction
  }
}

TEST(SupportMotionScene, AcceptsWhatStartsFromRest) {
  Json json = shaken();
  auto& motion = json["supports"][1]["motion"];
  motion["ramp"] = 0;
  motion["phase_degrees"] = 90;
  EXPECT_NO_THROW(scene_from_json(json));
  motion = {{"direction", {0, 1}}, {"acceleration", 2}};
  EXPECT_NO_THROW(scene_from_json(json));
}

/// Without a direction; with one it moves, too.
TEST(SupportMotionScene, TurnsTheClamp) {
  Json json = shaken();
  json["output"]["configurations"] = {0.3};
  json["supports"][1]["motion"] = parse_json(R"({"angle": {"value": 0.6, "ramp": 0.1, "until": 0.2}})");
  const Json echo = scene_to_json(scene_from_json(json));
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);
  for (const bool moves : {false, true}) {
    if (moves) json["supports"][1]["motion"].update(parse_json(R"({"direction": [0, 1], "value": 0.1, "ramp": 0.1})"));
    const RunResult result = simulate(scene_from_json(json));
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    const Point &r = result.configurations.front().r.front(), &r_x = result.configurations.front().r_x.front();
    EXPECT_NEAR(std::atan2(r_x[1], r_x[0]), 0.6, 1e-14);
    EXPECT_NEAR(r[1], moves ? 0.1 : 0, 1e-14);
    EXPECT_LE(result.max_energy_drift, 1e-9 * result.max_kinetic);
  }
}

struct Bad {
  const char* pointer;
  const char* value;  ///< JSON
  const char* field;

  friend void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.pointer << " = " << bad.value; }
};

class BadSupportMotion : public testing::TestWithParam<Bad> {};

TEST_P(BadSupportMotion, NamesTheField) {
  Json json = shaken();
  json[Json::json_pointer(GetParam().pointer)] = parse_json(GetParam().value);
  try {
    scene_from_json(json);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, GetParam().field) << error.what();
  }
}

const Bad bad[] = {
    {"/supports/1/motion", "0.1", "/supports/1/motion"},
    {"/supports/1/motion", R"({"amplitude": 1, "ramp": 1})", "/supports/1/motion/direction"},
    {"/supports/1/motion/direction", "[0, 0]", "/supports/1/motion/direction"},
    {"/supports/1/motion/direction", "[0, 0, 1]", "/supports/1/motion/direction"},
    {"/supports/1/motion/ramp", "-1", "/supports/1/motion/ramp"},
    {"/supports/1/motion/ramp", "0", "/supports/1/motion"},  // at full speed from the start
    {"/supports/1/motion/speed", "1", "/supports/1/motion/speed"},
    {"/supports/0/motion", R"({"direction": [0, 1], "acceleration": 1})", "/supports/0/motion"},  // a free end
    {"/supports/1", R"({"at": "start", "type": "slide", "motion": {"direction": [0, 1], "acceleration": 1}})",
     "/supports/1/motion"},
    {"/supports/1/motion", R"({"angle": {"rate": 1}})", "/supports/1/motion/angle"},
    {"/supports/1/motion", R"({"rate": 1, "angle": {"value": 1, "ramp": 1}})", "/supports/1/motion/direction"},
    {"/supports/1", R"({"at": "start", "type": "pin", "motion": {"angle": {"value": 1, "ramp": 1}}})",
     "/supports/1/motion/angle"},
    {"/integrator", R"({"type": "energy-momentum"})", "/integrator/type"},
    {"/length_control", R"({"velocities": "conservative"})", "/length_control/velocities"},
};
INSTANTIATE_TEST_SUITE_P(SupportMotion, BadSupportMotion, testing::ValuesIn(bad));

TEST(SupportMotionScene, GoesWithFlowButNotWithRotaryInertia) {
  Json json = shaken();
  json.erase("sliding_mass");
  json["flow"] = Json::object();
  EXPECT_NO_THROW(scene_from_json(json));
  json.erase("flow");
  json["beam"]["rotary_inertia"] = "rayleigh";
  try {
    scene_from_json(json);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/supports/1/motion") << error.what();
  }
}

}  // namespace
}  // namespace vlbeam
