// Shapes that wait on disk are the ones that a result would have kept.
#include "io/shapes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "io/run_outcome.hpp"
#include "io/scene_json.hpp"
#include "scene/simulate.hpp"
#include "temporary_folder.hpp"

namespace vlbeam {
namespace {

Scene scene_with_shapes() {
  return parse_scene(R"({"beam": {"elements": 10}, "supports": [{"at": "start", "type": "clamp"}],
    "sliding_mass": {"mass": 0.8, "position": 0.1, "velocity": 3}, "duration": 0.1,
    "output": {"interval": 0.05, "configurations": [0, 0.01, 0.05, 0.1]}})");
}

std::vector<std::string> bytes_of_all(const Shapes& shapes) {
  std::vector<std::string> all;
  shapes([&all](const Configuration& shape) {
    std::string& bytes = all.emplace_back();
    write_bytes(shape, [&bytes](std::string_view piece) { bytes += piece; });
  });
  return all;
}

/// Another folder for temporary files, as long as it is there.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const std::string& folder) {
    if (const char* const name = std::getenv("TMPDIR")) before_ = name;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFilesIn() { before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1); }
  TemporaryFilesIn(const TemporaryFilesIn&) = delete;
  TemporaryFilesIn& operator=(const TemporaryFilesIn&) = delete;

 private:
  std::string before_;
};

TEST(ShapeSpool, ShowsWhatAResultWouldHaveKept) {
  const Scene scene = scene_with_shapes();
  const RunResult whole = simulate(scene);
  ASSERT_EQ(whole.configurations.size(), 4U);
  const auto expected = bytes_of_all(shapes_of(whole));

  const TemporaryFolder folder;
  const TemporaryFilesIn in(folder.path().string());
  ShapeSpool spool;
  const RunResult handed_on =
      simulate(scene, {}, nullptr, {.shape = [&spool](const Configuration& shape) { spool.add(shape); }});
  EXPECT_TRUE(handed_on.configurations.empty());
  EXPECT_EQ(handed_on.samples.size(), whole.samples.size());
  EXPECT_EQ(bytes_of_all(spool.shapes()), expected);
  EXPECT_EQ(bytes_of_all(spool.shapes()), expected) << "once more";
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "the file has no name";
}

TEST(ShapeSpool, KeepsInMemoryWhatItCannotWrite) {
  const RunResult whole = simulate(scene_with_shapes());
  const TemporaryFilesIn nowhere("/nonexistent");
  ShapeSpool spool;
  for (const Configuration& shape : whole.configurations) spool.add(shape);
  EXPECT_EQ(bytes_of_all(spool.shapes()), bytes_of_all(shapes_of(whole)));
}

TEST(RunOutput, LeavesOutTheShapesOfEvents) {
  const Scene scene = scene_with_shapes();
  const RunResult whole = simulate(scene), without = simulate(scene, {}, nullptr, {.event_shapes = false});
  ASSERT_FALSE(whole.events.empty());
  ASSERT_EQ(without.events.size(), whole.events.size());
  for (std::size_t i = 0; i < whole.events.size(); ++i) {
    EXPECT_FALSE(whole.events[i].before.x.empty());
    EXPECT_TRUE(without.events[i].before.x.empty() && without.events[i].after.x.empty());
    EXPECT_EQ(without.events[i].t, whole.events[i].t);
  }
  EXPECT_EQ(without.configurations.size(), whole.configurations.size());
}

}  // namespace
}  // namespace vlbeam
