#include "io/scene_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/names.hpp"
#include "tests/harness/example_scene.hpp"

namespace vlbeam {
namespace {

using testing::HasSubstr;

std::optional<InvalidInput> error_of(const Json& json) {
  try {
    scene_from_json(json);
  } catch (const InvalidInput& error) {
    return error;
  }
  return std::nullopt;
}

/// The example with one value changed (or added) at a JSON pointer.
struct BadScene {
  const char* pointer;
  const char* value;  ///< JSON
  const char* field = pointer;
  const char* message = "";

  friend void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.pointer << " = " << bad.value; }
};

TEST(SceneJson, ReadsEveryKey) {
  const Scene scene = scene_from_json(example_scene());
  EXPECT_EQ(scene.title, "Falling beam with a sliding mass");
  EXPECT_EQ(scene.dimension, 2);
  EXPECT_EQ(scene.gravity, (Point{0, -9.81, 0}));
  EXPECT_EQ(scene.gravity_ramp, 0.1);
  EXPECT_EQ(scene.beam.curve.end, (Point{1, 0, 0}));
  EXPECT_EQ(scene.beam.quadrature_points, 5);
  EXPECT_EQ(scene.start.type, SupportType::clamp);
  EXPECT_EQ(scene.start.clamp, ClampType::full);
  EXPECT_EQ(scene.end.type, SupportType::free);
  EXPECT_EQ(scene.sliding_mass->velocity, 0.5);
  EXPECT_EQ(scene.sliding_mass->separation_distance, 0.002);
  EXPECT_EQ(scene.sliding_mass->friction->coefficient, 0.2);
  EXPECT_EQ(scene.formulation, Formulation::virtual_work);
  EXPECT_EQ(scene.integrator.type, IntegratorType::cash_karp);
  EXPECT_EQ(scene.integrator.atol, 1e-8);
  EXPECT_EQ(scene.output.configurations, (std::vector<double>{0, 0.25, 0.5}));
}

TEST(SceneJson, DefaultsMayBeLeftOut) {
  const Scene scene = parse_scene(R"({"beam": {}, "duration": 0.5})");
  EXPECT_FALSE(scene.sliding_mass.has_value());
  EXPECT_EQ(scene.beam.elements, Scene{}.beam.elements);
  Scene chosen;
  chosen.integrator = automatic_integrator(chosen);
  EXPECT_EQ(scene_to_json(scene), scene_to_json(chosen));
}

TEST(SceneJson, EchoReadsBackAsTheSameScene) {
  const Json echo = scene_to_json(scene_from_json(example_scene()));
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);
  EXPECT_EQ(echo["supports"][0]["at"], "start");
  EXPECT_EQ(echo["supports"][1], (Json{{"at", "end"}, {"type", "free"}}));
}

TEST(SceneJson, EchoHoldsWhatTheFileLeftOut) {
  const Json echo = scene_to_json(parse_scene(R"({"sliding_mass": {"mass": 1, "position": 0.3},
                                                  "beam": {"curve": {"end": [2, 0]}}, "duration": 1})"));
  EXPECT_EQ(echo["integrator"]["type"], "generalized-alpha");
  EXPECT_EQ(echo["sliding_mass"]["separation_distance"], 2e-3);
  EXPECT_EQ(echo["beam"]["quadrature_points"], 10) << "the element's default, not its placeholder 0";
  EXPECT_EQ(echo["beam"]["polynomial_points"], 5);
  const Json rope = scene_to_json(parse_scene(R"({"beam": {"compression": "none",
      "section": {"type": "stiffness", "EA": 1e5, "EI": 0, "rhoA": 0.1}}, "duration": 1})"));
  EXPECT_EQ(rope["beam"]["polynomial_points"], 10) << "its law is no polynomial";
  EXPECT_FALSE(echo["beam"]["section"].contains("EA"));
}

TEST(SceneJson, SectionByStiffness) {
  Json json = example_scene();
  json["beam"]["section"] = {{"type", "stiffness"}, {"EA", 100}, {"EI", 0}, {"rhoA", 2}};
  json["beam"]["material"] = {{"damping", 0.01}};
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene.beam.section.type, Section::Type::stiffness);
  EXPECT_EQ(scene.beam.section.EA, 100);
  EXPECT_FALSE(scene_to_json(scene)["beam"]["material"].contains("density"));
}

TEST(SceneJson, AProfileHasANameOrSizes) {
  const Json named = {{"duration", 1}, {"beam", {{"section", {{"type", "profile"}, {"standard", "IPE 300"}}}}}};
  const Scene scene = scene_from_json(named);
  EXPECT_EQ(to_string(scene.beam.section.standard.value()), "IPE 300");
  EXPECT_EQ(scene_to_json(scene_from_json(scene_to_json(scene))), scene_to_json(scene));
  Json both = named;
  both["beam"]["section"]["width"] = 0.15;
  try {
    scene_from_json(both);
    FAIL() << "a name and a size";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/beam/section/width");
    EXPECT_NE(std::string(error.what()).find("not beside \"standard\""), std::string::npos) << error.what();
  }
}

TEST(SceneJson, SectionsStandInPlaceOfOne) {
  Json json = example_scene();
  json["beam"].erase("section");
  json["beam"].erase("material");
  const Json chain = {{"type", "chain"}, {"diameter", 0.02}};
  json["beam"]["sections"] = {{{"to", 0.5}, {"section", chain}},
                              {{"section", {{"type", "stiffness"}, {"EA", 1e5}, {"EI", 0}, {"rhoA", 1}}},
                               {"drag", {{"quadratic", {{"normal", 2}}}}}}};
  const Scene scene = scene_from_json(json);
  ASSERT_EQ(scene.beam.sections.size(), 2U);
  EXPECT_EQ(scene.beam.sections[0].to, 0.5);
  EXPECT_EQ(scene.beam.sections[0].section.type, Section::Type::chain);
  EXPECT_FALSE(scene.beam.sections[1].to);
  EXPECT_EQ(scene.beam.sections[1].drag->quadratic.normal, 2);
  const Json echo = scene_to_json(scene);
  EXPECT_FALSE(echo["beam"].contains("section"));
  EXPECT_FALSE(echo["beam"]["material"].contains("density"));
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);
  json["beam"]["section"] = chain;
  EXPECT_EQ(error_of(json)->field, "/beam/section");
  json["beam"].erase("section");
  json["beam"]["sections"][0]["section"]["diametre"] = 1;
  EXPECT_EQ(error_of(json)->field, "/beam/sections/0/section/diametre");
  json["beam"]["sections"][0]["section"] = {{"type", "chain"}};
  EXPECT_EQ(error_of(json)->field, "/beam/sections/0/section/diameter");
}

TEST(SceneJson, AutoStandsForTheIntegratorThatTheEchoShows) {
  Json json = {{"beam", {{"material", {{"youngs_modulus", 2.1e11}}}}}, {"duration", 0.5}, {"integrator", "auto"}};
  EXPECT_EQ(scene_to_json(scene_from_json(json))["integrator"]["type"], "generalized-alpha");
  const Json echo = scene_to_json(scene_from_json(json));
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo) << "it says all that was chosen";
  json["integrator"] = Json::object();
  EXPECT_EQ(scene_to_json(scene_from_json(json)), echo) << "nothing is asked for";
  json["integrator"] = {{"accuracy", 1e-4}};
  EXPECT_EQ(scene_to_json(scene_from_json(json)), echo);
  json["integrator"] = {{"accuracy", 1e-3}};
  EXPECT_GT(scene_from_json(json).integrator.step, echo["integrator"]["step"]);
  for (const Json& wrong :
       {Json{{"accuracy", 1e-4}, {"step", 1e-3}}, Json{{"accuracy", 0}}, Json{{"accuracy", "high"}}}) {
    json["integrator"] = wrong;
    EXPECT_THROW(scene_from_json(json), InvalidInput) << wrong;
  }
  json["integrator"] = "fast";
  EXPECT_THROW(scene_from_json(json), InvalidInput);
  json["integrator"] = {{"type", "auto"}};
  EXPECT_THROW(scene_from_json(json), InvalidInput);
}

TEST(SceneJson, TheIntegratorLeftOutIsAuto) {
  Json json = {{"beam", {{"material", {{"youngs_modulus", 2.1e11}}}}}, {"duration", 0.5}};
  EXPECT_EQ(scene_from_json(json).integrator.type, IntegratorType::generalized_alpha);
  json["integrator"] = {{"rtol", 1e-6}};
  EXPECT_EQ(scene_from_json(json).integrator.type, IntegratorType::dopri5) << "tolerances are an explicit method's";
  json["integrator"] = {{"type", "dopri5"}};
  EXPECT_EQ(scene_from_json(json).integrator.type, IntegratorType::dopri5);
}

/// A mass on a semicircle with nothing but what the scene needs.
Json bead_on_semicircle() {
  return parse_json(R"({"beam": {"curve": {"type": "arc", "center": [0, 0], "radius": 2, "from_degrees": 180,
                                           "to_degrees": 360}},
                        "sliding_mass": {"mass": 0.8, "position": 0.4}, "duration": 1})");
}

TEST(SceneJson, DefaultsDependOnTheScene) {
  Json json = bead_on_semicircle();
  const Json curved = scene_to_json(scene_from_json(json));
  EXPECT_EQ(curved["setting"], "default");
  EXPECT_EQ(curved["formulation"], "variational");
  EXPECT_EQ(curved["weights"], "transported");
  EXPECT_EQ(curved["beam"]["rest_shape"], "as-built");
  EXPECT_EQ(curved["beam"]["axis"], "even");
  EXPECT_EQ(curved["beam"]["axial_strain"], "lobatto") << "elements are longer than five radii";
  EXPECT_EQ(curved["length_control"]["cut"], "relaxed");
  EXPECT_EQ(curved["length_control"]["merge"], "relaxed");
  Json full = json;
  full["beam"]["axial_strain"] = "full";
  full = scene_to_json(scene_from_json(full));
  EXPECT_EQ(full["length_control"]["cut"], "exact");
  EXPECT_EQ(full["length_control"]["merge"], "rest-arc");
  EXPECT_EQ(curved["length_control"]["velocities"], "projected");
  EXPECT_EQ(curved["length_control"]["end_merge"], 0.5);
  json["beam"].erase("curve");
  const Json straight = scene_to_json(scene_from_json(json));
  EXPECT_EQ(straight["weights"], "frozen");
  EXPECT_EQ(straight["length_control"]["merge"], "point-fit");
}

TEST(SceneJson, ThePapersSettingDecidesWhatIsLeftOut) {
  Json json = bead_on_semicircle();
  json["setting"] = "ding-ouyang-2022";
  const Json echo = scene_to_json(scene_from_json(json));
  EXPECT_EQ(echo["setting"], "ding-ouyang-2022");
  EXPECT_EQ(echo["formulation"], "virtual-work");
  EXPECT_EQ(echo["weights"], "frozen");
  EXPECT_EQ(echo["beam"]["element"], "ALE-RANCF");
  EXPECT_EQ(echo["beam"]["rest_shape"], "paper");
  EXPECT_EQ(echo["beam"]["axis"], "exact");
  EXPECT_EQ(echo["length_control"]["merge"], "point-fit");
  EXPECT_EQ(echo["length_control"]["velocities"], "nodal");
  EXPECT_EQ(echo["length_control"]["end_merge"], 0);
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);
}

TEST(SceneJson, WhatIsGivenWinsOverTheSetting) {
  Json json = bead_on_semicircle();
  json["setting"] = "ding-ouyang-2022";
  json["formulation"] = "variational";
  json["length_control"] = {{"velocities", "conservative"}};
  json["beam"]["rest_shape"] = "as-built";
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene.formulation, Formulation::variational);
  EXPECT_EQ(scene.length_control.velocities, VelocityTransfer::conservative);
  EXPECT_EQ(scene.length_control.end_merge, 0);
  EXPECT_EQ(scene_to_json(scene)["beam"]["axis"], "even") << "a mass on an as-built beam has no exact axis";
}

TEST(SceneJson, ThePapersSettingTakesPolynomialElements) {
  Json json = bead_on_semicircle();
  json["setting"] = "ding-ouyang-2022";
  json["beam"]["element"] = "ALE-ANCF";
  EXPECT_EQ(scene_to_json(scene_from_json(json))["beam"]["axis"], "even");
}

TEST(SceneJson, AnAbsoluteToleranceMayBeOneForEachKind) {
  Json json = example_scene();
  EXPECT_FALSE(scene_from_json(json).integrator.atol_by_kind);
  EXPECT_EQ(scene_to_json(scene_from_json(json))["integrator"]["atol"], 1e-8);
  json["integrator"]["atol"] = {{"length", 1e-8}, {"velocity", 1e-6}, {"spin", 1e-3}};
  const Scene scene = scene_from_json(json);
  ASSERT_TRUE(scene.integrator.atol_by_kind);
  EXPECT_EQ(scene.integrator.atol_by_kind->velocity, 1e-6);
  const Json echo = scene_to_json(scene);
  EXPECT_EQ(echo["integrator"]["atol"],
            (Json{{"length", 1e-8}, {"velocity", 1e-6}, {"angle", 1e-8 / 0.05}, {"spin", 1e-3}}));
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);
}

TEST(SceneJson, MethodsOfFixedStepShareTheirOption) {
  for (const char* type : {"adams-bashforth-moulton", "generalized-alpha"}) {
    Json json = example_scene();
    json["integrator"] = {{"type", type}, {"step", 1e-4}, {"locate_events", false}};
    const Scene scene = scene_from_json(json);
    EXPECT_EQ(scene.integrator.step, 1e-4);
    EXPECT_FALSE(scene.integrator.locate_events);
    EXPECT_EQ(scene_to_json(scene)["integrator"]["step"], 1e-4);
  }
  EXPECT_FALSE(scene_to_json(Scene{})["integrator"].contains("step"));
}

TEST(SceneJson, TheAxisOfARotationHasThreeComponentsInThePlaneToo) {
  Json json = example_scene();
  json["initial_velocity"] = {{"rotation", 2}, {"axis", {0, 0, 1}}};
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene.initial_velocity->axis, (Point{0, 0, 1}));
  EXPECT_EQ(scene_from_json(scene_to_json(scene)).initial_velocity->axis, (Point{0, 0, 1}));
}

TEST(SceneJson, SpatialScenesHaveThreeComponents) {
  Json json = example_scene();
  json["dimension"] = 3;
  EXPECT_EQ(error_of(json)->field, "/gravity");
  json["gravity"] = {0, 0, -9.81};
  json["beam"]["curve"] = {{"start", {0, 0, 0}}, {"end", {0, 1, 0}}};
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene.gravity[2], -9.81);
  EXPECT_EQ(scene_to_json(scene)["gravity"].size(), 3U);
}

class BadInput : public testing::TestWithParam<BadScene> {};

TEST_P(BadInput, NamesTheFieldTheValueAndWhatIsAllowed) {
  const BadScene& bad = GetParam();
  Json json = example_scene();
  json[Json::json_pointer(bad.pointer)] = parse_json(bad.value);
  const auto error = error_of(json);
  ASSERT_TRUE(error.has_value()) << bad.pointer << " = " << bad.value << " was accepted";
  EXPECT_EQ(error->field, bad.field);
  EXPECT_FALSE(error->value.empty());
  EXPECT_FALSE(error->allowed.empty());
  EXPECT_THAT(error->what(), HasSubstr(bad.message));
}

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, BadInput,
    testing::Values(
        BadScene{"/gravty", "[0, 0]", "/gravty", "nearest known key is \"gravity\""},
        BadScene{"/beam/elemnets", "5", "/beam/elemnets", "nearest known key is \"elements\""},
        BadScene{"/beam/material/youngs modulus", "5", "/beam/material/youngs modulus", "\"youngs_modulus\""},
        BadScene{"/sliding_mass/friction/mu", "0.1"}, BadScene{"/constraint", "\"eliminated\""},
        BadScene{"/integrator/atol", R"({"length": 1, "velocity": 1, "lenght": 1})", "/integrator/atol/lenght",
                 "\"length\" (known here: \"length\", \"velocity\", \"angle\", \"spin\", \"motion\")"},
        BadScene{"/integrator/atol", R"({"length": 1, "velocity": 1, "": 1})", "/integrator/atol/"},
        BadScene{"/supports/0/clmap", "\"full\"", "/supports/0/clmap", "\"clamp\""}, BadScene{"/a~1b", "1"},
        BadScene{"/beam/curve/radius", "1"}, BadScene{"/supports/0/at=start", "1"}));

INSTANTIATE_TEST_SUITE_P(
    MistypedValues, BadInput,
    testing::Values(
        BadScene{"/dimension", "\"2\""}, BadScene{"/dimension", "2.5"}, BadScene{"/dimension", "4"},
        BadScene{"/dimension", "4294967298"}, BadScene{"/title", "5"}, BadScene{"/schema", "\"vlbeam.scene/2\""},
        BadScene{"/gravity", "-9.81"}, BadScene{"/gravity", "[0, 0, -9.81]"}, BadScene{"/gravity", "[0, \"g\"]"},
        BadScene{"/gravity", "[0, null]"}, BadScene{"/duration", "\"NaN\""}, BadScene{"/duration", "null"},
        BadScene{"/beam", "[]"}, BadScene{"/beam/curve", "\"line\""}, BadScene{"/sliding_mass/friction", "0.1"},
        BadScene{"/beam/weights", "[1, 1, 1]"}, BadScene{"/beam/elements", "20.5"},
        BadScene{"/length_control/enabled", "1"}, BadScene{"/integrator/locate_events", "\"no\""},
        BadScene{"/supports", "{}"}, BadScene{"/supports/0", "\"clamp\""}, BadScene{"/sliding_mass", "null"},
        BadScene{"/integrator/atol", "\"tight\"", "/integrator/atol", "or an object"},
        BadScene{"/integrator/atol", "[1e-9]"}, BadScene{"/integrator/atol", "null"},
        BadScene{"/integrator/atol", "-1", "/integrator/atol", "> 0"},
        BadScene{"/integrator/atol", R"({"length": "m", "velocity": 1})", "/integrator/atol/length", "> 0"},
        BadScene{"/integrator/atol", R"({"length": 1, "velocity": 0})", "/integrator/atol/velocity", "> 0"},
        BadScene{"/integrator/atol", R"({"length": 1, "velocity": 1, "spin": -1})", "/integrator/atol/spin", "> 0"},
        BadScene{"/output/configurations", "0.5"}, BadScene{"/output/configurations", "[0, true]"}));

INSTANTIATE_TEST_SUITE_P(
    UnknownChoices, BadInput,
    testing::Values(BadScene{"/beam/element", "\"ALE_RANCF\"", "/beam/element", "\"ALE-RANCF\", \"ALE-ANCF\""},
                    BadScene{"/beam/curve/type", "\"spiral\"", "/beam/curve/type", "\"line\""},
                    BadScene{"/beam/section/type", "\"square\"", "/beam/section/type",
                             "\"circle\", \"rectangle\", \"stiffness\""},
                    BadScene{"/setting", "\"paper\"", "/setting", "\"ding-ouyang-2022\""},
                    BadScene{"/beam/rest_shape", "\"as_built\""}, BadScene{"/beam/strain_law", "\"seed\""},
                    BadScene{"/formulation", "\"virtual work\""}, BadScene{"/weights", "\"moving\""},
                    BadScene{"/integrator/type", "\"rk4\"", "/integrator/type", "\"bulirsch-stoer\""},
                    BadScene{"/length_control/merge", "\"none\""}, BadScene{"/length_control/merge", "\"own\""},
                    BadScene{"/sliding_mass/slopes", "\"kinked\"", "/sliding_mass/slopes", "\"equal-stretch\""},
                    BadScene{"/supports/0/at", "\"middle\"", "/supports/0/at", "\"start\", \"end\""},
                    BadScene{"/supports/0/type", "\"weld\""}, BadScene{"/supports/0/clamp", "\"half\""}));

INSTANTIATE_TEST_SUITE_P(
    WrongCompany, BadInput,
    testing::Values(BadScene{"/beam/section/EA", "5", "/beam/section/EA", "/beam/section/type is \"stiffness\""},
                    BadScene{"/supports/0/type", "\"pin\"", "/supports/0/clamp", "/supports/0/type is \"clamp\""},
                    BadScene{"/integrator/step", "0.1", "/integrator/step",
                             "/integrator/type is \"adams-bashforth-moulton\" or \"generalized-alpha\""},
                    BadScene{"/integrator/rho_inf", "0.5", "/integrator/rho_inf"},
                    BadScene{"/beam/section", R"({"type": "stiffness", "EA": 1, "EI": 1, "rhoA": 1})",
                             "/beam/material/density"},
                    BadScene{"/beam/section", R"({"type": "stiffness", "EA": 1, "EI": 1, "rhoA": 1, "radius": 1})",
                             "/beam/section/radius"},
                    BadScene{"/supports/1", R"({"at": "start", "type": "pin"})", "/supports/1/at"}));

INSTANTIATE_TEST_SUITE_P(
    MissingKeys, BadInput,
    testing::Values(
        BadScene{"/beam/curve", R"({"type": "line", "start": [1, 2]})", "/beam/curve/end", "missing"},
        BadScene{"/sliding_mass", R"({"position": 0.1})", "/sliding_mass/mass", "missing"},
        BadScene{"/sliding_mass", R"({"mass": 0.1})", "/sliding_mass/position", "missing"},
        BadScene{"/sliding_mass/friction", R"({"velocity": 0.1})", "/sliding_mass/friction/coefficient", "missing"},
        BadScene{"/beam/section", R"({"type": "stiffness", "EA": 1, "EI": 1})", "/beam/section/rhoA", "missing"},
        BadScene{"/integrator/atol", "{}", "/integrator/atol/length", "missing"},
        BadScene{"/integrator/atol", R"({"length": 1e-9})", "/integrator/atol/velocity", "missing"},
        BadScene{"/supports/0", R"({"at": "start"})", "/supports/0/type", "missing"},
        BadScene{"/supports/0", R"({"type": "pin"})", "/supports/0/at", "missing"}));

TEST(SceneJson, SupportsBetweenTheEndsStandAmongTheOthers) {
  Json json = Json::parse(R"({"beam": {"curve": {"type": "line", "end": [4, 0]}}, "duration": 0.1, "supports": [
    {"at": {"x": 1}, "type": "roller", "name": "pier"},
    {"at": "end", "type": "slide"},
    {"at": {"x": 3}, "type": "spring", "stiffness": 5, "to": [3, 1], "tension_only": true},
    {"at": "start", "type": "pin"}]})");
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene.end.type, SupportType::slide);
  EXPECT_EQ(scene.start.type, SupportType::pin);
  ASSERT_EQ(scene.bearings.size(), 2U);
  EXPECT_EQ(scene.bearings[0].name, "pier");
  EXPECT_EQ(scene.bearings[1].x, 3);
  EXPECT_EQ(*scene.bearings[1].to, (Point{3, 1, 0}));
  const Json echo = scene_to_json(scene);
  EXPECT_EQ(echo.at("supports").size(), 4U);
  EXPECT_EQ(scene_to_json(scene_from_json(echo)), echo);

  json["supports"][0]["stiffness"] = 1;
  EXPECT_EQ(error_of(json)->field, "/supports/0/stiffness");
  json["supports"][0].erase("stiffness");
  json["supports"][2]["at"]["x"] = 4.5;
  EXPECT_EQ(error_of(json)->field, "/supports/2/at/x");
  json["supports"][2]["at"] = {{"y", 3}};
  EXPECT_EQ(error_of(json)->field, "/supports/2/at/y");
  json["supports"][2]["at"] = "middle";
  EXPECT_EQ(error_of(json)->field, "/supports/2/at");
  EXPECT_THAT(error_of(json)->allowed, HasSubstr(R"({"x": ...})"));
  json["supports"][2]["at"] = {{"x", 3}};
  json["supports"][3]["type"] = "roller";
  EXPECT_EQ(error_of(json)->field, "/supports/3/type");
  json["supports"][3]["type"] = "pin";
  json["bearings"] = Json::array();
  EXPECT_EQ(error_of(json)->field, "/bearings");
  EXPECT_EQ(error_of(json)->value, "an unknown key");
}

TEST(SceneJson, AWholeNumberMayBeWrittenInAnyWay) {
  EXPECT_EQ(parse_scene(R"({"beam": {"elements": 1e1}, "duration": 1})").beam.elements, 10);
  EXPECT_EQ(parse_scene(R"({"beam": {"elements": 10.0}, "duration": 1})").beam.elements, 10);
}

TEST(SceneJson, KnowsWhatAFileLeavesOutOfTheBeam) {
  const auto assumed = [](const std::string& beam) {
    return parse_scene(R"({"duration": 1, "beam": )" + beam + "}").assumed;
  };
  EXPECT_EQ(assumed("{}"), "/beam/section/radius, /beam/material/density and /beam/material/youngs_modulus");
  EXPECT_EQ(assumed(R"({"section": {"radius": 0.01}, "material": {"density": 7800}})"),
            "/beam/material/youngs_modulus");
  EXPECT_EQ(assumed(R"({"section": {"radius": 0.01}, "material": {"density": 7800, "youngs_modulus": 2e11}})"), "");
  EXPECT_EQ(assumed(R"({"section": {"type": "stiffness", "EA": 1e4, "EI": 1, "rhoA": 1}})"), "");
}

TEST(SceneJson, BeamAndDurationAreNeeded) {
  EXPECT_EQ(error_of(parse_json(R"({"duration": 1})"))->field, "/beam");
  EXPECT_EQ(error_of(parse_json(R"({"beam": {}})"))->field, "/duration");
}

TEST(SceneJson, WhatIsNotJsonIsRefused) {
  EXPECT_THROW(parse_scene(""), InvalidInput);
  EXPECT_THROW(parse_scene("{\"dimension\": 2"), InvalidInput);
  EXPECT_THROW(parse_scene("{\"duration\": NaN}"), InvalidInput);
  EXPECT_THROW(parse_scene("{\"duration\": 1e999}"), InvalidInput);
  EXPECT_THROW(parse_scene("[]"), InvalidInput);
  EXPECT_THROW(parse_scene("3"), InvalidInput);
}

}  // namespace
}  // namespace vlbeam
