// What a run has come to, as one process tells another. That results are the same is tested with processes: kept_runs.
#include "io/run_outcome.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "core/error.hpp"
#include "io/scene_json.hpp"
#include "scene/simulate.hpp"

namespace vlbeam {
namespace {

RunResult told(const std::function<RunResult()>& run) {
  return outcome_from_bytes(to_bytes(RunOutcome::of(run))).get();
}

TEST(RunOutcome, OfInputThatIsRefusedIsTheSame) {
  try {
    told([]() -> RunResult { refuse("/beam/elements", "0", "at least 1"); });
    FAIL() << "it was refused";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/beam/elements");
    EXPECT_EQ(error.value, "0");
    EXPECT_EQ(error.allowed, "at least 1");
  }
}

TEST(RunOutcome, OfOtherExceptionsSaysTheSame) {
  const auto says = [](const std::function<RunResult()>& run) -> std::string {
    try {
      told(run);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_EQ(says([]() -> RunResult { throw std::domain_error("no such merge"); }), "no such merge");
  EXPECT_EQ(says([]() -> RunResult { throw std::bad_alloc(); }).substr(0, 14), "out of memory:");
}

TEST(RunOutcome, ThatIsNotWholeIsNoOutcome) {
  const Scene scene = parse_scene(R"({"beam": {"elements": 6}, "supports": [{"at": "start", "type": "clamp"}],
    "sliding_mass": {"mass": 0.8, "position": 0.1}, "duration": 0.05, "output": {"interval": 0.05}})");
  const std::string bytes = to_bytes(RunOutcome::of([&] { return simulate(scene); }));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(outcome_from_bytes(bytes.substr(0, size)), std::out_of_range) << size;
  }
  EXPECT_THROW(outcome_from_bytes(bytes + "x"), std::out_of_range);
}

}  // namespace
}  // namespace vlbeam
