// Every scene of scenes/ runs as it stands, and its number is what it should be.
#include "tools/scene_library.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/json.hpp"
#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "scene/simulate.hpp"
#include "tests/folders.hpp"

namespace vlbeam {

/// What the test runner calls a case: its bytes would be another name every time.
static void PrintTo(const SceneAnswer& answer, std::ostream* out) {
  *out << answer.quantity << " = " << answer.value << ", " << answer.kind;
}

namespace {

const std::filesystem::path source = test::source_folder();

// What a scene's own setting promises, for all scenes alike.
constexpr double promised = 1e-3;

std::vector<SceneAnswer> answers() { return scene_answers(source / "reference" / "scenes.json"); }

class LibraryScenes : public testing::TestWithParam<SceneAnswer> {};

TEST_P(LibraryScenes, KeepItsAnswer) {
  const SceneAnswer& answer = GetParam();
  Scene scene = read_scene(source / "scenes" / (answer.scene + ".json"));
  if (scene.analysis == Analysis::dynamics) {
    ASSERT_LE(answer.t, scene.duration);
    scene.duration = answer.t;
    std::erase_if(scene.output.configurations, [&](double t) { return t > answer.t; });
  }
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const double value = find_quantity(scene, answer.quantity).of(result.samples.back());
  const Sample& last = result.samples.back();
  EXPECT_DOUBLE_EQ(last.equilibrium ? last.equilibrium->load_factor : last.t, answer.t);
  EXPECT_LE(std::abs(value - answer.value), promised * std::abs(answer.value) + answer.uncertainty) << answer.source;
}

INSTANTIATE_TEST_SUITE_P(All, LibraryScenes, testing::ValuesIn(answers()),
                         [](const auto& instance) { return instance.param.scene; });

TEST(SceneLibrary, EverySceneHasAnAnswer) {
  const auto known = answers();
  const auto scenes = library_scenes(source / "scenes");
  EXPECT_GE(scenes.size(), 10U);
  for (const LibraryScene& scene : scenes) {
    EXPECT_NE(std::ranges::find(known, scene.name, &SceneAnswer::scene), known.end()) << scene.name;
    EXPECT_FALSE(scene.title.empty()) << scene.name;
  }
}

// Steps as long as these miss events that they foresee, and are taken again.
TEST(SceneLibrary, EventsDoNotDependOnTheEndOfTheRun) {
  for (const std::string name : {"semicircle", "ring", "suspended_beam", "falling_beam"}) {
    for (const double accuracy : {0.003, 0.01}) {
      Json json = parse_json(read_text(source / "scenes" / (name + ".json")));
      json["integrator"] = {{"accuracy", accuracy}};
      Scene scene = scene_from_json(json);
      const RunResult whole = simulate(scene);
      ASSERT_FALSE(whole.events.empty());
      for (std::size_t i = 0; i < whole.events.size(); ++i) {
        const double there = whole.events[i].t,
                     next = i + 1 < whole.events.size() ? whole.events[i + 1].t : scene.duration;
        if (next == there) continue;
        for (const double share : {0.1, 0.01}) {
          Scene part = scene;
          part.duration = there + share * (next - there);
          part.integrator.step = std::min(part.integrator.step, part.duration);
          std::erase_if(part.output.configurations, [&](double t) { return t > part.duration; });
          const RunResult result = simulate(part);
          ASSERT_EQ(result.events.size(), i + 1) << name << " " << accuracy << " " << part.duration;
          EXPECT_EQ(result.events.back().t, there) << name << " " << accuracy;
          EXPECT_EQ(result.events.back().type, whole.events[i].type);
        }
      }
    }
  }
}

TEST(SceneLibrary, NamesTheNearest) {
  try {
    library_scene_text(source / "scenes", "falling-baem");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(error.allowed.find("is \"falling_beam\""), std::string::npos) << error.what();
  }
}

TEST(Quantities, HaveNamesWithPointsAndOfColumns) {
  const Scene scene = read_scene(source / "scenes" / "falling_beam.json");
  Sample sample;
  sample.end = {3, 4, 0};
  sample.energy.bending = 5;
  EXPECT_EQ(find_quantity(scene, "end.y").of(sample), 4);
  EXPECT_EQ(find_quantity(scene, "end_y").of(sample), 4);
  EXPECT_EQ(find_quantity(scene, "energy.bending").of(sample), 5);
  EXPECT_TRUE(std::isnan(find_quantity(scene, "joint_position").of(sample)));
  EXPECT_EQ(find_quantity(scene, "angular_momentum").unit, "kg m^2/s");
  try {
    find_quantity(scene, "joint_postion");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "--quantity");
    EXPECT_NE(error.allowed.find("is \"joint_position\""), std::string::npos) << error.what();
  }
}

TEST(Quantities, HaveEachANameOfTheirOwn) {
  for (const LibraryScene& listed : library_scenes(source / "scenes")) {
    const std::string& name = listed.name;
    std::set<std::string> names;
    for (const Quantity& quantity : quantities(read_scene(source / "scenes" / (name + ".json")))) {
      EXPECT_TRUE(names.insert(quantity.column).second) << name << ": " << quantity.column;
      if (quantity.name != quantity.column) {
        EXPECT_TRUE(names.insert(quantity.name).second) << name << ": " << quantity.name;
      }
    }
  }
}

TEST(Quantities, HaveExtremesOverTimeWhereTheSceneKeepsThem) {
  Scene scene = read_scene(source / "scenes" / "pendulum.json");
  EXPECT_THROW(find_quantity(scene, "end.y.least"), InvalidInput);
  scene = keeping(scene, "end.y.least");
  EXPECT_TRUE(scene.output.extremes);
  scene.duration = 0.2;
  scene.output = {.interval = 0.1, .configurations = {}, .extremes = true};
  const RunResult result = simulate(scene);
  const Quantity least = find_quantity(scene, "end.y.least"), when = find_quantity(scene, "end.y.least_at");
  const Sample& last = result.samples.back();
  EXPECT_EQ(when.unit, "s");
  EXPECT_EQ(when.of(last), 0.2) << "it falls";
  EXPECT_EQ(least.of(last), find_quantity(scene, "end.y").of(last));
  EXPECT_EQ(find_quantity(scene, "end.y.largest_at").of(last), 0);
  EXPECT_THROW(find_quantity(scene, "end.w.least"), InvalidInput);
}

TEST(Quantities, ReadBackFromAReport) {
  const Json samples = parse_json(R"({"end": [[1, 2], [3, null]], "joint_position": [0.5, null],
                                      "energy": {"kinetic": [1, 2]}, "flow": {"loads": [[[1, 2], [3, 4]]]}})");
  const Scene falling = read_scene(source / "scenes" / "falling_beam.json");
  const auto y = find_quantity(falling, "end.y").of(samples);
  EXPECT_EQ(y[0], 2);
  EXPECT_TRUE(std::isnan(y[1]));
  EXPECT_TRUE(std::isnan(find_quantity(falling, "joint_position").of(samples)[1]));
  EXPECT_EQ(find_quantity(falling, "energy.kinetic").of(samples)[1], 2);
  const Scene loaded = read_scene(source / "scenes" / "moving_string.json");
  EXPECT_EQ(find_quantity(loaded, "load0_y").of(samples)[0], 2);
  EXPECT_THROW(find_quantity(falling, "beam_length").of(samples), InvalidInput);
}

}  // namespace
}  // namespace vlbeam
