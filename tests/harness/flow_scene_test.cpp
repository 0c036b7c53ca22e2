#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "core/error.hpp"
#include "io/scene_json.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/simulate.hpp"
#include "scene/validate.hpp"
#include "tests/harness/report_of.hpp"

namespace vlbeam {
namespace {

/// A soft shaft that is fed through a guide while it spins, with a load of every kind.
Json shaft() {
  return parse_json(R"({
    "schema": "vlbeam.scene/1", "dimension": 3, "gravity": [0, -4, 0], "gravity_ramp": 0.02,
    "beam": {"curve": {"type": "line", "start": [0, 0, 0], "end": [0, 0, 1]},
             "section": {"type": "circle", "radius": 0.02},
             "material": {"density": 1300, "youngs_modulus": 1e6, "poisson_ratio": 0.4},
             "elements": 6, "element": "ALE-ANCF"},
    "supports": [{"at": "start", "type": "pin"}],
    "spin": {"angles": "hermite", "drives": [{"node": 0, "angle": {"rate": 6, "amplitude": 0.1, "frequency": 3}}]},
    "flow": {"nodes": [{"node": 0, "x": {"rate": -0.7}}, {"node": 2, "x": {"value": 0.3, "rate": -0.7}, "support": "slide"},
                       {"node": 6, "x": {"value": 1}}]},
    "loads": [{"type": "force", "node": 6, "magnitude": {"value": 0.5, "ramp": 0.03}, "direction": [1, 0, 0],
               "turn": {"rate": 9}},
              {"type": "follower", "at": "point", "x": {"value": 0.5, "rate": 2}, "magnitude": {"value": -0.3}},
              {"type": "torque", "node": 6, "magnitude": {"value": -0.1}},
              {"type": "force", "at": "beam", "magnitude": {"amplitude": 2, "frequency": 4}, "direction": [0, 1, 0]},
              {"type": "torque", "at": "beam", "magnitude": {"value": 0.02}}],
    "integrator": {"type": "fehlberg78", "rtol": 1e-11, "atol": 1e-11},
    "duration": 0.1, "output": {"interval": 0.02, "configurations": [0.05]}
  })");
}

TEST(FlowScene, EchoReadsBackAsTheSameScene) {
  const Json echo = scene_to_json(scene_from_json(shaft()));
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);
  EXPECT_EQ(echo.at("loads").at(1).at("x").at("rate"), 2);
  EXPECT_EQ(echo.at("flow").at("nodes").at(1).at("support"), "slide");
  EXPECT_FALSE(echo.at("loads").at(1).contains("direction"));
}

TEST(FlowScene, KeepsEnergyByItsLedger) {
  const Scene scene = scene_from_json(shaft());
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const FlowSample& last = *result.samples.back().flow;
  EXPECT_GT(std::abs(last.ledger.ends), 1e-2);
  EXPECT_LE(result.max_energy_drift, 1e-9 * std::abs(last.ledger.ends));
  EXPECT_LE(energy_ledger(result).largest_unexplained, 1e-6 * std::abs(last.ledger.ends));
  EXPECT_NEAR(last.mass, result.samples.front().flow->mass + last.ledger.mass, 1e-12);
  EXPECT_NEAR((*last.end_angles)[0], 0.6, 0.1);
  ASSERT_EQ(last.loads.size(), 3U);  // the distributed ones have no place
  ASSERT_EQ(result.configurations.size(), 1U);
  EXPECT_EQ(result.configurations[0].angles.size(), 7U);
  const Json samples = report_of(scene, result)["samples"];
  EXPECT_EQ(samples["flow"]["loads"][0].size(), 3U);
  EXPECT_EQ(samples["flow"]["drive_torques"][0].size(), 1U);
  EXPECT_TRUE(samples["reactions"].contains("node_2"));
}

TEST(FlowScene, ImplicitMethodFindsTheSame) {
  Json json = shaft();
  const RunResult exact = simulate(scene_from_json(json));
  json["integrator"] = {{"type", "generalized-alpha"}, {"step", 1e-4}};
  const RunResult result = simulate(scene_from_json(json));
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(result.samples.back().end[i], exact.samples.back().end[i], 2e-5);
  const FlowSample::Ledger &book = result.samples.back().flow->ledger, &exact_book = exact.samples.back().flow->ledger;
  EXPECT_NEAR(book.ends, exact_book.ends, 1e-3 * std::abs(exact_book.ends));
  EXPECT_LE(result.max_energy_drift, 1e-3 * std::abs(exact_book.ends));
}

TEST(FlowScene, StartsFromTheSteadyFlow) {
  Json json = shaft();
  json["loads"] = Json::array();
  json.erase("spin");
  json["gravity_ramp"] = 0;
  json["gravity"] = {0, -0.01, 0};
  json["supports"] = {{{"at", "start"}, {"type", "pin"}}, {{"at", "end"}, {"type", "pin"}}};
  json["flow"] = {
      {"steady", true},
      {"tension", 30},
      {"nodes", {{{"node", 0}, {"x", {{"rate", -2}}}}, {{"node", 6}, {"x", {{"value", 0.975}, {"rate", -2}}}}}}};
  json["output"] = {{"interval", 0.05}, {"configurations", {0, 0.1}}};
  const RunResult result = simulate(scene_from_json(json));
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const auto& before = result.configurations.front().r[3];
  const auto& after = result.configurations.back().r[3];
  EXPECT_LT(before[1], -1e-6);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(before[i], after[i], 1e-9);

  json["flow"]["nodes"][0]["x"]["rate"] = json["flow"]["nodes"][1]["x"]["rate"] = -8;  // critical is about 4.5 m/s
  const RunResult none = simulate(scene_from_json(json));
  EXPECT_EQ(none.status, RunStatus::failed);
  EXPECT_THAT(none.failure, testing::HasSubstr("critical speed"));
}

TEST(FlowScene, LoadsWithoutFlowActOnAnOrdinaryBeam) {
  const Json json = parse_json(R"({
    "beam": {"section": {"type": "stiffness", "EA": 1e4, "EI": 10, "rhoA": 0.1}, "elements": 8, "element": "ANCF"},
    "gravity": [0, 0], "supports": [{"at": "start", "type": "clamp"}],
    "loads": [{"type": "force", "node": 8, "magnitude": {"value": -0.3}, "direction": [0, 2]}],
    "flow": {"steady": true}, "duration": 0.01
  })");
  Json still = json;
  still["beam"]["element"] = "ALE-ANCF";
  const RunResult result = simulate(scene_from_json(still));
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_NEAR(result.samples.back().end[1], -0.3 / (3 * 10), 1e-5);  // P l^3/(3 EI), less what large deflections take
}

struct BadFlow {
  const char* pointer;
  const char* value;  ///< JSON
  const char* field;

  friend void PrintTo(const BadFlow& bad, std::ostream* out) { *out << bad.pointer << " = " << bad.value; }
};

class BadFlowScene : public testing::TestWithParam<BadFlow> {};

TEST_P(BadFlowScene, NamesTheField) {
  Json json = shaft();
  json[Json::json_pointer(GetParam().pointer)] = parse_json(GetParam().value);
  try {
    validate(scene_from_json(json));
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, GetParam().field) << error.what();
  }
}

const BadFlow bad[] = {
    {"/sliding_mass", R"({"mass": 1, "position": 0.5})", "/sliding_mass"},
    {"/beam", R"({"curve": {"type": "arc", "center": [0,0,0], "radius": 1, "from_degrees": 0, "to_degrees": 90},
                  "rest_shape": "paper", "elements": 6})",
     "/flow/nodes"},  // they are not as far apart as it is long
    {"/beam", R"({"curve": {"type": "arc", "center": [0,0,0], "radius": 1, "from_degrees": 0, "to_degrees": 90},
                  "rest_shape": "paper", "rotary_inertia": "rayleigh", "elements": 6})",
     "/beam/curve/type"},
    {"/beam/section/radius", "0", "/beam/section/radius"},
    {"/beam/material/poisson_ratio", "0.5", "/beam/material/poisson_ratio"},
    {"/beam/material/poisson_ratio", "-1", "/beam/material/poisson_ratio"},
    {"/beam",
     R"({"curve": {"end": [0,0,1]}, "section": {"type": "stiffness", "EA": 1, "EI": 1, "rhoA": 1, "rhoIp": 1}})",
     "/beam/section/GIp"},
    {"/beam/element", R"("ANCF")", "/beam/element"},
    {"/beam/rotary_inertia", R"("katz")", "/beam/rotary_inertia"},
    {"/integrator", R"({"type": "rosenbrock4"})", "/integrator/type"},
    {"/integrator", R"({"type": "energy-momentum"})", "/integrator/type"},
    {"/constraints", R"("multipliers")", "/constraints"},
    {"/flow/nodes/0/node", "1", "/flow/nodes/0/node"},
    {"/flow/nodes/1/node", "0", "/flow/nodes/1/node"},
    {"/flow/nodes/2/node", "7", "/flow/nodes/2/node"},
    {"/flow/nodes/2/node", "5", "/flow/nodes"},
    {"/flow/nodes/0/support", R"("pin")", "/flow/nodes/0/support"},
    {"/flow/nodes/0/speed", "1", "/flow/nodes/0/speed"},
    {"/flow/nodes/2/x/value", "2", "/flow/nodes"},  // not the curve's length
    {"/flow/nodes/1/x/rate", "8", "/flow/nodes"},   // tangles at 0.0875 s
    {"/flow/nodes/1/x/ramp", "-1", "/flow/nodes/1/x/ramp"},
    {"/flow/tension", "-1e9", "/flow/tension"},
    {"/spin/drives/0/node", "9", "/spin/drives"},
    {"/spin/drives/1", R"({"node": 0})", "/spin/drives"},                        // driven twice
    {"/spin/drives/1", R"({"node": 4, "angle": {"rate": 5}})", "/spin/drives"},  // at two places, at two rates
    {"/spin/angles", R"("quartic")", "/spin/angles"},
    {"/loads/0/node", "7", "/loads/0/node"},
    {"/loads/1/x/rate", "20", "/loads"},  // leaves the beam
    {"/loads/1/at", R"("beam")", "/loads/1/x/value"},
    {"/loads/0/direction", "[0, 0, 0]", "/loads/0/direction"},
    {"/loads/0/magnitude", R"({"frequency": 3})", "/loads/0/magnitude"},
    {"/loads/2/node", "0", "/loads"},  // a torque where the angle is prescribed
    {"/loads/0", "7", "/loads/0"},
    {"/loads", "{}", "/loads"},
};
INSTANTIATE_TEST_SUITE_P(Flow, BadFlowScene, testing::ValuesIn(bad));

TEST(FlowScene, RotaryInertiaIsForWhatItHoldsFor) {
  Json json = shaft();
  json["beam"]["rotary_inertia"] = "gyroscopic";
  Scene scene = scene_from_json(json);
  const RunResult result = simulate(scene);
  EXPECT_LE(result.max_energy_drift, 1e-9 * std::abs(result.samples.back().flow->ledger.ends));
  scene.formulation = Formulation::virtual_work;
  EXPECT_THROW(validate(scene), InvalidInput);
  scene = scene_from_json(json);
  scene.spin.reset();
  scene.loads.clear();
  EXPECT_THROW(validate(scene), InvalidInput);
  Scene plain;
  plain.beam.rotary_inertia = BendingInertia::rayleigh;
  EXPECT_NO_THROW(validate(plain)) << "without spin, flow or loads";
  plain.beam.rotary_inertia = BendingInertia::gyroscopic;
  EXPECT_THROW(validate(plain), InvalidInput) << "needs a spin";
}

TEST(FlowScene, ATorqueNeedsSpin) {
  Json json = shaft();
  json.erase("spin");
  json["loads"].erase(4);
  try {
    scene_from_json(json);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/spin");
  }
}

}  // namespace
}  // namespace vlbeam
