// Scenes of several beams and bodies: what may stand in them, what comes out, and answers from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/quantity.hpp"
#include "io/run_outcome.hpp"
#include "io/run_report.hpp"
#include "io/scene_json.hpp"
#include "scene/assembly.hpp"
#include "scene/simulate.hpp"
#include "tests/folders.hpp"
#include "tools/checked_run.hpp"

namespace vlbeam::test {
namespace {

const std::filesystem::path source = source_folder();

Json crane() { return parse_json(read_text(source / "scenes" / "trolley_and_hook.json")); }

double last(const Scene& scene, const RunResult& result, const std::string& quantity) {
  return find_quantity(scene, quantity).of(result.samples.back());
}

/// The error of a scene that is changed at a pointer; an empty field where there is none.
InvalidInput error_of(const char* at, const Json& value) {
  Json json = crane();
  json[Json::json_pointer(at)] = value;
  try {
    scene_from_json(json);
  } catch (const InvalidInput& error) {
    return error;
  }
  return {"", "", ""};
}

TEST(AssemblyScene, ReadsBackAsItIsWritten) {
  for (const char* name :
       {"trolley_and_hook", "slider_crank", "double_atwood", "cable_robot", "cable_robot_in_space"}) {
    const Scene scene = read_scene(source / "scenes" / (std::string(name) + ".json"));
    const Json written = scene_to_json(scene);
    EXPECT_EQ(scene_to_json(scene_from_json(written)), written) << name;
  }
}

TEST(AssemblyScene, LoadsAccelerateABody) {
  Json json = crane();
  json["gravity"] = {0, 0};
  json["bodies"].push_back(
      {{"name", "disc"},
       {"mass", 2},
       {"inertia", 0.5},
       {"position", {20, 0}},
       {"loads", Json::array({{{"type", "force"}, {"magnitude", Json::object({{"rate", 10}})}, {"direction", {0, 1}}},
                              {{"type", "torque"}, {"magnitude", Json::object({{"value", 3}})}}})}});
  json["duration"] = 1;
  json.erase("output");
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene_to_json(scene_from_json(scene_to_json(scene))), scene_to_json(scene));
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const BodySample& disc = result.samples.back().assembly->bodies.back();
  EXPECT_NEAR(disc.position[1], 10.0 / 2 / 6, 1e-4);
  EXPECT_NEAR(disc.rotation[2] * std::numbers::pi / 180, 3 / 0.5 / 2, 1e-4);
}

TEST(AssemblyScene, ALinkHoldsTheNodeOfAMaterialCoordinate) {
  Json json = parse_json(R"({
    "analysis": "statics",
    "beams": [{"name": "girder", "elements": 8, "curve": {"start": [0, 0], "end": [20, 0]},
               "section": {"type": "stiffness", "EA": 4e9, "EI": 6e8, "rhoA": 250},
               "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "slide"}]}],
    "bodies": [{"name": "load", "mass": 500, "position": [15, 0]}],
    "links": [{"name": "hook", "type": "pin", "between": [{"beam": "girder", "at": {"x": 15}}, {"body": "load"}]}]})");
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene.assembly->links[0].between[0].joint, 6);
  EXPECT_EQ(scene_to_json(scene_from_json(scene_to_json(scene))), scene_to_json(scene));
  json["links"][0]["between"][0]["at"]["x"] = 14;
  try {
    scene_from_json(json);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/links/0/between/0/at/x");
    EXPECT_THAT(error.allowed, testing::HasSubstr("a multiple of 2.5 m"));
  }
}

TEST(AssemblyScene, WrongInputIsNamedWhereItStands) {
  const auto field = [](const char* at, const Json& value) { return error_of(at, value).field; };
  EXPECT_EQ(field("/beams/1/name", "jib"), "/beams/1/name") << "two of one name";
  EXPECT_EQ(field("/beams/1/name", "energy"), "/beams/1/name") << "a quantity of the whole";
  EXPECT_EQ(field("/beams/0/elements", 0), "/beams/0/elements");
  EXPECT_EQ(field("/beams/0/elementz", 3), "/beams/0/elementz");
  EXPECT_THAT(error_of("/beams/0/suports", Json::array()).allowed, testing::HasSubstr("is \"supports\""));
  EXPECT_EQ(field("/length_control", {{"max_length", -1}}), "/length_control/max_length") << "of the whole";
  EXPECT_EQ(field("/beams/0/length_control", {{"max_length", -1}}), "/beams/0/length_control/max_length");
  EXPECT_EQ(field("/beams/0/supports/0/type", "nail"), "/beams/0/supports/0/type");
  EXPECT_EQ(field("/beams/0/sliding_joints/0/mass", -1), "/beams/0/sliding_joints/0/mass");
  EXPECT_EQ(field("/bodies/0/mass", 0), "/bodies/0/mass");
  EXPECT_EQ(field("/bodies/0/inertia", -1), "/bodies/0/inertia");
  EXPECT_EQ(field("/bodies/0/colour", "red"), "/bodies/0/colour");
  EXPECT_EQ(field("/links/0/type", "weld"), "/links/0/type");
  EXPECT_EQ(field("/links/0/between/0/beam", "boom"), "/links/0/between/0/beam");
  EXPECT_EQ(field("/links/0/between/0/joint", 1), "/links/0/between/0/joint");
  EXPECT_EQ(field("/links/1/between/1/point", "ear"), "/links/1/between/1/point");
  EXPECT_EQ(field("/integrator", {{"type", "bulirsch-stoer"}}), "/integrator/type");
  EXPECT_EQ(field("/beam", Json::object()), "/beam") << "a beam beside beams";
  EXPECT_EQ(field("/beams/1/supports", {{{"at", "start"}, {"type", "pin"}}}), "/links/0/between/1") << "held twice";
  EXPECT_EQ(field("/checked", true), "/checked");
  EXPECT_EQ(field("/supports", Json::array()), "/supports") << "whose?";
}

TEST(AssemblyScene, LinksThatDoNotMeetSayByHowMuch) {
  const InvalidInput apart = error_of("/bodies/0/position", {3, -4.7});
  EXPECT_EQ(apart.field, "/links/1/between");
  EXPECT_THAT(apart.value, testing::HasSubstr("0.3 m apart"));
  Json json = crane();
  json["bodies"][0]["velocity"] = {0.25, 0};
  const Scene torn = scene_from_json(json);
  try {
    simulate(torn);
    FAIL() << "it starts torn";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/links/1/between");
    EXPECT_THAT(error.value, testing::HasSubstr("0.25 m/s"));
  }
}

TEST(AssemblyScene, ASchemaHasItsKeys) {
  const Json json = scene_to_json(scene_from_json(crane()));
  EXPECT_TRUE(json.contains("bodies"));
  EXPECT_FALSE(json.contains("beam"));
  EXPECT_EQ(json.at("beams").at(0).at("name"), "jib");
}

TEST(AssemblyScene, QuantitiesGoByTheirNames) {
  Json json = crane();
  json["duration"] = 0.4;
  json["output"] = {{"interval", 0.1}, {"configurations", {0, 0.4}}, {"extremes", true}};
  const Scene scene = scene_from_json(json);
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_NEAR(last(scene, result, "jib.joint 0.position"), 3.0436224, 1e-7) << "its ramp's integral";
  EXPECT_GT(last(scene, result, "hook.position.x"), 3);
  EXPECT_LT(last(scene, result, "hook.position.x"), 3.002) << "it lags behind";
  EXPECT_NEAR(last(scene, result, "jib.joint 0.place.x"), 3.0436224, 1e-4);
  EXPECT_GT(last(scene, result, "rope.axial_force.max"), 1000);
  EXPECT_GT(last(scene, result, "hook.position.x.largest"), 3);
  EXPECT_LT(last(scene, result, "jib.bending_moment.min"), -1000);
  EXPECT_EQ(result.configurations.size(), 4U) << "of two beams";
  EXPECT_EQ(result.configurations[1].beam, "rope");
  std::string report;
  write_run_report(scene, result, Json::object(), [&](std::string_view piece) { report += piece; });
  const Json read = parse_json(report);
  EXPECT_EQ(read.at("samples").at("hook").at("position").size(), result.samples.size());
  EXPECT_EQ(read.at("configurations").at(1).at("beam"), "rope");
  const RunOutcome back = outcome_from_bytes(to_bytes({.result = result, .thrown = {}}));
  EXPECT_EQ(last(scene, back.result, "hook.position.x"), last(scene, result, "hook.position.x"));
}

// The beam pulls at what slides on it with the weight of all that hangs there.
TEST(AssemblyScene, AJointBearsWhatItsLinkCarries) {
  Json json = crane();
  json["analysis"] = "statics";
  json["statics"] = {{"steps", 2}};
  for (const char* key : {"duration", "gravity_ramp", "output"}) json.erase(key);
  json["beams"][0]["sliding_joints"][0].erase("x");
  const Scene scene = scene_from_json(json);
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const double weight = (100 + 500 + 0.5 * 4) * 9.81, at = 3, jib = 60 * 9.81;
  EXPECT_NEAR(last(scene, result, "trolley.force.y"), (500 + 0.5 * 4) * -9.81, 1e-6 * weight);
  EXPECT_NEAR(last(scene, result, "jib.contact.force.y"), weight, 1e-6 * weight) << "what the jib bears it up with";
  EXPECT_NEAR(last(scene, result, "jib.joint 0.position"), at, 1e-12);
  EXPECT_NEAR(last(scene, result, "jib.bending_moment.min"), -(weight * at + jib * 50), 1e-3 * weight * at);
}

TEST(AssemblyScene, APortalFrameHasItsFrequencies) {
  const Json right = parse_json(read_text(source / "reference" / "assemblies.json")).at("portal");
  const double h = right.at("height"), w = right.at("width");
  const auto frequencies = [&](int elements) {
    const auto beam = [&](const char* name, const Json& from, const Json& to, const char* section) {
      Json of = right.at(section);
      of["type"] = "stiffness";
      return Json{{"name", name}, {"curve", {{"start", from}, {"end", to}}}, {"elements", elements}, {"section", of}};
    };
    Json left = beam("left", {0, 0}, {0, h}, "column"), end = beam("right", {w, 0}, {w, h}, "column");
    left["supports"] = end["supports"] = {{{"at", "start"}, {"type", "clamp"}}};
    const auto corner = [](const char* name, const char* column, const char* at) {
      return Json{{"name", name},
                  {"type", "clamp"},
                  {"between", {{{"beam", column}, {"at", "end"}}, {{"beam", "top"}, {"at", at}}}}};
    };
    const Json scene = {{"analysis", "statics"},
                        {"gravity", {0, 0}},
                        {"statics", {{"steps", 1}, {"frequencies", 5}}},
                        {"beams", {left, beam("top", {0, h}, {w, h}, "beam"), end}},
                        {"links", {corner("a", "left", "start"), corner("b", "right", "end")}}};
    return simulate(scene_from_json(scene)).frequencies;
  };
  const auto coarse = frequencies(4), fine = frequencies(8);
  ASSERT_EQ(fine.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const double exact = right.at("frequencies").at(i);
    EXPECT_NEAR(fine[i] / exact, 1, 5e-4) << i;
    EXPECT_NEAR(std::log2((coarse[i] - exact) / (fine[i] - exact)), 4, 0.25) << "order, mode " << i;
  }
}

TEST(AssemblyScene, APlatformHangsOnCatenaries) {
  const Json right = parse_json(read_text(source / "reference" / "assemblies.json")).at("platform");
  const double reach = right.at("reach"), height = right.at("height");
  const auto half = right.at("half").get<std::vector<double>>();
  Json scene = {{"dimension", 3}, {"gravity", {0, 0, -9.81}}, {"analysis", "statics"}, {"statics", {{"steps", 4}}}};
  Json body = {{"name", "platform"}, {"mass", right.at("mass")}, {"inertia", {2, 2, 3}}, {"position", {0, 0, height}}};
  for (int k = 0; k < 8; ++k) {
    const double x = k % 2 == 0 ? 1 : -1, y = k / 2 % 2 == 0 ? 1 : -1, z = k < 4 ? 1 : -1;
    const std::string number = std::to_string(k);
    const Json corner = {half[0] * x, half[1] * y, half[2] * z};
    body["points"]["corner " + number] = corner;
    scene["beams"].push_back(
        {{"name", "rope " + number},
         {"curve",
          {{"start", {reach * x, reach * y, right.at("anchors").at(k < 4 ? 0 : 1)}},
           {"end", {half[0] * x, half[1] * y, height + half[2] * z}}}},
         {"elements", 10},
         {"section", {{"type", "stiffness"}, {"EA", right.at("EA")}, {"EI", 0}, {"rhoA", right.at("rhoA")}}},
         {"supports", {{{"at", "start"}, {"type", "pin"}}}}});
    scene["links"].push_back(
        {{"name", "eye " + number},
         {"type", "pin"},
         {"between",
          {{{"beam", "rope " + number}, {"at", "end"}}, {{"body", "platform"}, {"point", "corner " + number}}}}});
  }
  scene["bodies"] = {body};
  const Scene ropes = scene_from_json(scene);
  const RunResult result = simulate(ropes);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_NEAR(last(ropes, result, "platform.position.z"), right.at("z"), 1e-6);
  EXPECT_NEAR(last(ropes, result, "platform.position.x"), 0, 1e-9);
  const auto pull = [&](const std::string& link) {
    double sum = 0;
    for (const char* axis : {"x", "y", "z"}) sum += std::pow(last(ropes, result, link + ".force." + axis), 2);
    return std::sqrt(sum);
  };
  EXPECT_NEAR(pull("eye 0") / right.at("upper").get<double>(), 1, 1e-5);
  EXPECT_NEAR(pull("eye 6") / right.at("lower").get<double>(), 1, 1e-5);
}

TEST(AssemblyScene, ARunKnowsItsError) {
  Json json = crane();
  json["duration"] = 1;
  json["output"] = {{"interval", 0.05}};
  const Scene scene = scene_from_json(json);
  const RunResult result = checked_run(scene, {}, {}, 2);
  ASSERT_TRUE(result.error);
  ASSERT_TRUE(result.error->time);
  ASSERT_TRUE(result.error->mesh);
  EXPECT_LT(*result.error->time, 1e-3);
  EXPECT_LT(*result.error->mesh, 1e-2);
}

/// Between the rows of a table, x first: the polynomial through the six nearest.
double interpolated(const Json& rows, double x) {
  const double first = rows.at(0).at(0), apart = rows.at(1).at(0).get<double>() - first;
  const auto most = static_cast<int>(rows.size()) - 6;
  const int from = std::clamp(static_cast<int>((x - first) / apart) - 2, 0, most);
  double sum = 0;
  for (int i = from; i < from + 6; ++i) {
    double part = rows.at(static_cast<std::size_t>(i)).at(1);
    for (int j = from; j < from + 6; ++j) {
      if (j != i) part *= (x - (first + j * apart)) / ((i - j) * apart);
    }
    sum += part;
  }
  return sum;
}

/// Lee's frame: how far loads are from those of its path, and the largest on the way.
struct LeesFrame {
  double off = 0, limit = 0, way = 0;
  int compared = 0;

  explicit LeesFrame(int elements) {
    const Json right = parse_json(read_text(source / "reference" / "assemblies.json")).at("lee");
    const double L = right.at("length");
    const Json section = {{"type", "stiffness"}, {"EA", right.at("EA")}, {"EI", right.at("EI")}, {"rhoA", 1}};
    const auto member = [&](const char* name, const Json& from, const Json& to, const char* hinged) {
      return Json{{"name", name},
                  {"curve", {{"start", from}, {"end", to}}},
                  {"elements", elements},
                  {"section", section},
                  {"supports", {{{"at", hinged}, {"type", "pin"}}}}};
    };
    Json beam = member("beam", {0, L}, {L, L}, "end");
    const Json load = {{"value", 1.9}};
    beam["loads"] = {
        {{"type", "force"}, {"at", "node"}, {"node", elements / 5}, {"direction", {0, -1}}, {"magnitude", load}}};
    beam["places"] = {{{"name", "load"}, {"x", right.at("at")}}};
    const Json frame = {{"analysis", "statics"},
                        {"gravity", {0, 0}},
                        {"statics", {{"steps", 20}, {"control", "arc-length"}}},
                        {"beams", {member("column", {0, 0}, {0, L}, "start"), beam}},
                        {"links",
                         {{{"name", "corner"},
                           {"type", "clamp"},
                           {"between", {{{"beam", "column"}, {"at", "end"}}, {{"beam", "beam"}, {"at", "start"}}}}}}}};
    const Scene scene = scene_from_json(frame);
    const RunResult result = simulate(scene);
    EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
    const Quantity height = find_quantity(scene, "beam.places.load.position.y");
    for (const Sample& sample : result.samples) {
      const double force = 1.9 * sample.equilibrium->load_factor, now = L - height.of(sample);
      if (now > 54) break;  // the load soon goes back, and then on again: the table has one load a way
      if (now < 2) continue;
      way = now;
      limit = std::max(limit, force);
      off = std::max(off, std::abs(force - interpolated(right.at("path"), way)));
      ++compared;
    }
  }
};

TEST(AssemblyScene, LeesFrameFollowsItsPathPastTheLimit) {
  const LeesFrame frame(40);
  EXPECT_GE(frame.compared, 20);
  EXPECT_GT(frame.way, 52) << "past the limit, at 48.5";
  EXPECT_NEAR(frame.limit, 1.85560, 1e-3) << "between two of its points";
  EXPECT_LT(frame.off, 1e-6 * frame.limit);
}

Json bob_on_a_rod(const char* beam) {
  Json json = parse_json(R"({
    "analysis": "statics", "bodies": [{"name": "bob", "mass": 25, "position": [500, 0.2]}],
    "links": [{"name": "rod", "type": "distance", "between": [{"ground": [500, 0]}, {"body": "bob"}]}]})");
  json["beams"] = parse_json(beam);
  return json;
}

// A bob that stands on its rod falls a hundred times faster than the soft beam beside it swings: the three lowest
// eigenvalues do not show it.
TEST(AssemblyScene, StabilityIsThatOfTheStiffestToo) {
  Json json = bob_on_a_rod(R"([
    {"name": "beam", "elements": 8, "curve": {"start": [0, 0], "end": [0, -40]},
     "section": {"type": "stiffness", "EA": 1e5, "EI": 1e3, "rhoA": 1.8}, "supports": [{"at": "start", "type": "pin"}]}])");
  const auto falls = [&] {
    const RunResult result = simulate(scene_from_json(json));
    EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
    return result.samples.back().equilibrium->negative_pivots;
  };
  EXPECT_EQ(falls(), 1);
  json["bodies"][0]["position"][1] = -0.2;
  EXPECT_EQ(falls(), 0);
}

// Ropes that are drawn slack fall to where they hang on the way to the first equilibrium, and so does what stands.
TEST(AssemblyScene, WhatIsDrawnSlackGoesToAStableEquilibrium) {
  const Scene scene = scene_from_json(bob_on_a_rod(R"([
    {"name": "rope", "elements": 8, "curve": {"type": "polyline", "points": [[0, 0], [200, -20], [400, 0]]},
     "section": {"type": "stiffness", "EA": 3.6e7, "EI": 0, "rhoA": 1.8},
     "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "pin"}]}])"));
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_EQ(result.samples.back().equilibrium->negative_pivots, 0);
  EXPECT_NEAR(last(scene, result, "bob.position.y"), -0.2, 1e-8);
}

// In space a clamp holds the direction of a beam without frames, and nothing of its twist.
TEST(AssemblyScene, ACornerThatTurnsFreelyIsWarnedOf) {
  const Json json = parse_json(R"({
    "dimension": 3, "gravity": [0, 0, 0], "analysis": "statics",
    "beams": [{"name": "leg", "elements": 4, "curve": {"start": [0, 0, 0], "end": [10, 0, 0]},
               "section": {"type": "stiffness", "EA": 1e6, "EI": 1e3, "GIp": 1e3, "rhoA": 1},
               "supports": [{"at": "start", "type": "clamp"}]}],
    "bodies": [{"name": "knee", "mass": 1, "inertia": [1, 1, 1], "position": [10, 0, 0]}],
    "links": [{"name": "a", "type": "clamp", "between": [{"beam": "leg", "at": "end"}, {"body": "knee"}]}]})");
  const RunResult result = simulate(scene_from_json(json));
  EXPECT_TRUE(std::ranges::any_of(result.warnings, [](const Warning& w) { return w.kind == WarningKind::free_twist; }));
}

// Clamped ends of one section that go on straight are one beam.
/// A trolley with a rope passes a pier of its girder, and a cart follows it.
TEST(AssemblyScene, AGirderMayHaveAPierAndACart) {
  Json json = Json::parse(R"({"gravity": [0, -9.81], "gravity_ramp": 0.2, "duration": 0.5,
    "beams": [
      {"name": "girder", "curve": {"type": "line", "start": [0, 0], "end": [8, 0]}, "elements": 8,
       "section": {"type": "stiffness", "EA": 1e6, "EI": 1e5, "rhoA": 20},
       "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "slide"}, {"at": {"x": 4}, "type": "roller", "name": "pier"}],
       "vehicles": [{"name": "cart", "x": {"value": -1, "rate": 5},
                     "axles": [{"sprung_mass": 50, "mass": 5, "stiffness": 2e4, "damping": 200}]}],
       "sliding_joints": [{"position": 3.4, "mass": 20, "x": {"rate": 3, "rate_ramp": 0.1}}]},
      {"name": "rope", "curve": {"type": "line", "start": [3.4, 0], "end": [3.4, -3]}, "elements": 4,
       "section": {"type": "stiffness", "EA": 2e4, "EI": 0, "rhoA": 0.5}, "point_masses": [{"node": 4, "mass": 50}]}],
    "links": [{"name": "hang", "type": "pin", "between": [{"beam": "girder", "joint": 0}, {"beam": "rope", "at": "start"}]}],
    "integrator": {"type": "dopri5", "rtol": 1e-7, "atol": 1e-8}})");
  const Scene scene = scene_from_json(json);
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  EXPECT_LT(run.max_energy_drift, 1e-6 * run.max_kinetic);
  EXPECT_GT(last(scene, run, "girder.joint_position"), 4.5) << "it has passed the pier";
  EXPECT_NEAR(last(scene, run, "girder.supports.pier.position.y"), 0, 1e-9);
  EXPECT_GT(last(scene, run, "girder.supports.pier.force.y"), 0);
  EXPECT_GT(last(scene, run, "girder.vehicles.cart.axle_0.force"), 0);

  json.erase("duration");
  json.erase("gravity_ramp");
  json.erase("integrator");
  json["analysis"] = "statics";
  json["beams"][0].erase("vehicles");
  json["beams"][0]["sliding_joints"][0].erase("x");
  try {
    scene_from_json(json);
    FAIL() << "statics of several beams knows no roller";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/beams/0/supports");
  }
}

TEST(AssemblyScene, ABeamInTwoPiecesIsOneBeam) {
  const Json section = {{"type", "stiffness"}, {"EA", 2000}, {"EI", 0.7}, {"rhoA", 1.3}};
  const Json clamp = {{{"at", "start"}, {"type", "clamp"}}};
  const Json method = {{"type", "generalized-alpha"}, {"step", 1e-3}, {"newton_tolerance", 1e-10}};
  Json whole = {{"beam", {{"curve", {{"end", {1, 0.2}}}}, {"elements", 8}, {"section", section}}},
                {"supports", clamp},
                {"integrator", method},
                {"duration", 0.3},
                {"output", {{"interval", 0.1}}}};
  Json pieces = whole;
  pieces.erase("beam");
  pieces.erase("supports");
  pieces["beams"] = {
      {{"name", "a"}, {"curve", {{"end", {0.5, 0.1}}}}, {"elements", 4}, {"section", section}, {"supports", clamp}},
      {{"name", "b"}, {"curve", {{"start", {0.5, 0.1}}, {"end", {1, 0.2}}}}, {"elements", 4}, {"section", section}}};
  pieces["links"] = {{{"name", "ab"},
                      {"type", "clamp"},
                      {"between", {{{"beam", "a"}, {"at", "end"}}, {{"beam", "b"}, {"at", "start"}}}}}};
  const Scene one = scene_from_json(whole), two = scene_from_json(pieces);
  const RunResult of_one = simulate(one), of_two = simulate(two);
  EXPECT_NEAR(last(one, of_one, "end.y"), last(two, of_two, "b.end.y"), 1e-9);
  EXPECT_NEAR(last(one, of_one, "end.x"), last(two, of_two, "b.end.x"), 1e-9);
}

}  // namespace
}  // namespace vlbeam::test
