// What converge says of scenes whose answers are known, and what it says where there is none.
#include "tools/converge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/error.hpp"
#include "io/scene_json.hpp"
#include "scene/simulate.hpp"
#include "tests/folders.hpp"
#include "tools/scene_library.hpp"

namespace vlbeam {
namespace {

const std::filesystem::path source = test::source_folder();

Scene library_scene(const std::string& name) { return read_scene(source / "scenes" / (name + ".json")); }

// One wanted error for all scenes, chosen before any was converged to it.
constexpr double wanted = 1e-4;

std::vector<SceneAnswer> known_answers() {
  std::vector<SceneAnswer> answers = scene_answers(source / "reference" / "scenes.json");
  std::erase_if(answers, [](const SceneAnswer& answer) { return answer.kind == "self-convergence"; });
  return answers;
}

SceneAnswer known_answer(const std::string& scene) {
  const std::vector<SceneAnswer> answers = known_answers();
  return *std::ranges::find(answers, scene, &SceneAnswer::scene);
}

Convergence converged(const SceneAnswer& answer) {
  const Scene scene = library_scene(answer.scene);
  const auto at = scene.analysis == Analysis::dynamics ? std::optional(answer.t) : std::nullopt;
  return converge(scene, {.quantity = answer.quantity, .error = wanted, .relative = true, .at = at, .jobs = 2});
}

class ConvergedScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(ConvergedScenes, UncertaintyCoversTheTrueError) {
  const SceneAnswer answer = known_answer(GetParam());
  const Convergence found = converged(answer);
  const double error = std::abs(found.answer - answer.value);
  EXPECT_TRUE(found.reached) << found.reason;
  EXPECT_LE(error, found.uncertainty + answer.uncertainty);
  EXPECT_LE(found.uncertainty, wanted * std::abs(found.answer) * (1 + 1e-3));
  EXPECT_LE(found.cost, 15);
  EXPECT_TRUE(found.cheapest);
  std::cout << "error " << error << ", uncertainty " << found.uncertainty << ", cost " << found.cost << '\n';
}

INSTANTIATE_TEST_SUITE_P(All, ConvergedScenes, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const SceneAnswer& answer : known_answers()) names.push_back(answer.scene);
                           return names;
                         }()),
                         [](const auto& instance) { return instance.param; });

// Of scenes whose answers are known to a millionth: elsewhere an error says little of how close the uncertainty is.
TEST(Converge, MostUncertaintiesAreCloseToTheTrueError) {
  int known = 0, close = 0;
  for (const SceneAnswer& answer : known_answers()) {
    if (answer.uncertainty > 1e-6 * std::abs(answer.value)) continue;
    const Convergence found = converged(answer);
    const double error = std::abs(found.answer - answer.value);
    ++known;
    close += error > answer.uncertainty && found.uncertainty <= 20 * error ? 1 : 0;
  }
  EXPECT_GE(known, 10);
  EXPECT_GT(2 * close, known);
}

/// A cantilever of length 1 under P = EI: its tip sinks by 0.30172 (Mattiasson, Int. J. Numer. Meth. Eng. 17, 1981).
TEST(Converge, KnowsAnEquilibrium) {
  Scene scene = scene_from_json(Json::parse(R"({"analysis": "statics", "gravity": [0, 0],
    "beam": {"curve": {"type": "line", "end": [1, 0]}, "elements": 4,
             "section": {"type": "stiffness", "EA": 1e7, "EI": 1, "rhoA": 1}},
    "supports": [{"at": "start", "type": "clamp"}],
    "loads": [{"node": 4, "type": "force", "direction": [0, -1], "magnitude": {"value": 1}}]})"));
  const Convergence found = converge(scene, {.quantity = "end.y", .error = 1e-6});
  EXPECT_TRUE(found.reached) << found.reason;
  EXPECT_NEAR(found.answer, -0.30172, found.uncertainty + 5e-6);
  EXPECT_LE(found.uncertainty, 1e-6);
  EXPECT_TRUE(found.parts[0] && !found.parts[1] && found.parts[2]) << "mesh and quadrature, no time";
  EXPECT_EQ(found.t, 1);
  EXPECT_NE(convergence_summary(scene, found).find("end.y of the equilibrium: "), std::string::npos);
  EXPECT_EQ(convergence_table(scene, found).find("rtol"), std::string::npos);
  EXPECT_THROW(converge(scene, {.quantity = "end.y", .error = 1e-6, .at = 1.0}), InvalidInput);
}

TEST(Converge, KnowsNaturalFrequencies) {
  Scene scene = scene_from_json(Json::parse(R"({"analysis": "statics", "gravity": [0, 0],
    "beam": {"curve": {"type": "line", "end": [1, 0]}, "elements": 4,
             "section": {"type": "stiffness", "EA": 1e7, "EI": 2, "rhoA": 3}},
    "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "pin"}]})"));
  const double pi = std::acos(-1.0);
  for (const int mode : {1, 2}) {
    const std::string name = "frequencies." + std::to_string(mode - 1);
    const Convergence found = converge(scene, {.quantity = name, .error = 1e-5, .relative = true});
    const double exact = pi / 2 * mode * mode * std::sqrt(2.0 / 3);  // of a beam between two pins [Hz]
    EXPECT_TRUE(found.reached) << found.reason;
    EXPECT_EQ(found.unit, "Hz");
    EXPECT_NEAR(found.answer, exact, found.uncertainty);
    EXPECT_LE(found.uncertainty, 1e-5 * exact);
  }
  EXPECT_THROW(converge(scene, {.quantity = "frequencies.first", .error = 1e-3}), InvalidInput);
  scene.analysis = Analysis::dynamics;
  scene.duration = 1;
  EXPECT_THROW(converge(scene, {.quantity = "frequencies.0", .error = 1e-3}), InvalidInput);
}

TEST(Converge, TheCheapestSettingKeepsTheError) {
  Scene scene = library_scene("pendulum");
  scene.beam.axial_strain = AxialStrain::full;  // the other needs no finer mesh
  const Convergence found = converge(scene, {.quantity = "end.y", .error = 1e-3});
  ASSERT_TRUE(found.cheapest);
  const SceneAnswer answer = known_answer("pendulum");
  for (const ConvergeLevel& level : found.levels) {
    if (level.setting == *found.cheapest) {
      EXPECT_LE(std::abs(level.value - answer.value), 1e-3);
    }
  }
  EXPECT_LT(found.cheapest->elements, found.finest.elements);
}

TEST(Converge, SaysWhatItKnowsWhenTheTimeIsUsedUp) {
  Scene scene = library_scene("falling_beam");
  scene.duration = 0.4;
  scene.output.configurations.clear();
  const ConvergeOptions options{.quantity = "end.y", .error = 1e-9, .jobs = 2};
  ConvergeOptions none = options, some = options;
  none.seconds = 1e-6;
  const Convergence nothing = converge(scene, none);
  EXPECT_FALSE(nothing.reached);
  EXPECT_TRUE(std::isnan(nothing.answer) && std::isnan(nothing.uncertainty));
  EXPECT_EQ(nothing.reason, "the 1e-06 s allowed are used up");
  some.seconds = 2;
  const Convergence something = converge(scene, some);
  EXPECT_FALSE(something.reached);
  EXPECT_EQ(something.reason, "the 2 s allowed are used up");
  if (!std::isnan(something.answer)) {
    EXPECT_GT(something.uncertainty, 1e-9);
    EXPECT_NEAR(something.answer, simulate(scene).samples.back().end[1], 1e-2);
  }
}

TEST(Converge, DoesNotDependOnJobs) {
  const Scene scene = library_scene("moving_string");
  const ConvergeOptions options{.quantity = "load0_y", .error = 1e-3, .relative = true};
  ConvergeOptions two = options;
  two.jobs = 2;
  EXPECT_EQ(convergence_to_json(scene, converge(scene, options)), convergence_to_json(scene, converge(scene, two)));
}

// Beyond the whip every mesh goes its own way.
TEST(Converge, SaysWhereItCannotBeReachedAndUntilWhen) {
  Scene scene = library_scene("falling_beam");
  scene.beam.elements = 5;
  scene.beam.element = ElementKind::ale_ancf;
  scene.duration = 0.6;
  scene.output.configurations.clear();
  const Convergence found =
      converge(scene, {.quantity = "end.y", .error = 1e-2, .horizon = true, .jobs = 2, .most_elements = 20});
  EXPECT_FALSE(found.reached);
  EXPECT_FALSE(found.reason.empty());
  EXPECT_GT(found.uncertainty, 1e-2);
  EXPECT_GE(found.predictable_until, 0.1);
  EXPECT_LE(found.predictable_until, 0.5);
  ASSERT_TRUE(found.horizon);
  EXPECT_GE(*found.horizon, found.predictable_until) << "the data are known better than the mesh";
  EXPECT_FALSE(found.cheapest);
}

// The mass runs into the far support, which ends every run, on every mesh.
TEST(Converge, GivesUpWhereFinerMeshesFailToo) {
  Scene scene = library_scene("incline");
  scene.sliding_mass->position = 0.9;
  const Convergence found = converge(scene, {.quantity = "joint_position", .error = 1e-3});
  EXPECT_FALSE(found.reached);
  EXPECT_NE(found.reason.find("finer meshes fail, too"), std::string::npos) << found.reason;
  EXPECT_TRUE(std::isnan(found.answer));
  EXPECT_LE(found.finest.elements, 4 * scene.beam.elements);
}

TEST(Converge, NodesNameTheSamePointsOnEveryMesh) {
  const Scene scene = library_scene("drill_stem");
  Setting setting = setting_of(scene);
  setting.elements = 48;
  const Scene finer = with_setting(scene, setting);
  EXPECT_EQ(finer.flow->nodes[1].node, 2 * scene.flow->nodes[1].node);
  EXPECT_EQ(finer.loads[0].node, 48);
  setting.elements = 25;
  EXPECT_THROW(with_setting(scene, setting), InvalidInput);
}

TEST(Converge, PointMassesStayOnTheirPoints) {
  Scene scene = library_scene("pendulum");
  scene.point_masses = {{scene.beam.elements, 0.1}};
  Setting setting = setting_of(scene);
  setting.elements *= 2;
  EXPECT_EQ(with_setting(scene, setting).point_masses.front().node, 2 * scene.beam.elements);
}

// Where the longest step allowed holds, tolerances alone would refine nothing and time would seem free of error.
TEST(Converge, TheLongestStepIsRefinedWithTheTolerance) {
  Scene scene = library_scene("pendulum");
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.automatic = false;
  scene.integrator.rtol = scene.integrator.atol = 1e-3;
  scene.integrator.step = 1e-2;
  Setting setting = setting_of(scene);
  setting.accuracy /= 1000;
  EXPECT_NEAR(with_setting(scene, setting).integrator.step, 1e-3, 1e-15);
  const Convergence found = converge(scene, {.quantity = "end.y", .error = 1e-4});
  const Convergence exact = converge(library_scene("pendulum"), {.quantity = "end.y", .error = 1e-6});
  EXPECT_TRUE(found.reached) << found.reason;
  EXPECT_LE(std::abs(found.answer - exact.answer), found.uncertainty + exact.uncertainty);
}

TEST(Converge, RefusesWhatItCannotShow) {
  const Scene scene = library_scene("pulled_bar");
  const auto field_of = [&](const ConvergeOptions& options) {
    try {
      converge(scene, options);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string();
  };
  EXPECT_EQ(field_of({.quantity = "end.z", .error = 1e-3}), "--quantity");
  EXPECT_EQ(field_of({.quantity = "joint_position", .error = 1e-3}), "--quantity") << "never there";
  EXPECT_EQ(field_of({.quantity = "end.x", .error = 0}), "--error");
  EXPECT_EQ(field_of({.quantity = "end.x", .error = std::nan("")}), "--error");
  EXPECT_EQ(field_of({.quantity = "end.x", .error = 1e-17}), "--error") << "below rounding";
  EXPECT_EQ(field_of({.quantity = "end.x", .error = 1e-15, .relative = true}), "--error");
  EXPECT_EQ(field_of({.quantity = "end.y", .error = 1e-3, .relative = true}), "--relative") << "of zero";
  EXPECT_EQ(field_of({.quantity = "end.x", .error = 1e-3, .at = 2}), "--at");
}

}  // namespace
}  // namespace vlbeam
