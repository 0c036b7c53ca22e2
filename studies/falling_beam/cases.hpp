#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/harness/study.hpp"
#include "tools/scene_sweep.hpp"

/// The falling beam with a sliding mass (Ding & Ouyang 2022, §6.1): which scenes are run, and finding them again.
namespace vlbeam::falling_beam {

using Case = SceneCase;

inline constexpr auto direction = ClampType::direction;  // most sweeps clamp so

/// A case with what came out of it.
struct Run {
  std::string sweep;
  Scene scene;
  std::optional<RunResult> result;
  std::string failure;
  double seconds = 0;
};

/// What a run must be like. What is not set may be anything.
struct Wanted {
  std::optional<int> elements = {};
  std::optional<ElementKind> element = {};
  std::optional<ClampType> clamp = {};
  std::optional<int> points = {};
  std::optional<double> tolerance = {};
  std::optional<double> hysteresis = {};

  bool fits(const Scene& scene) const;
};

/// All runs of the study.
class Runs {
 public:
  explicit Runs(std::vector<Run> runs) : runs_(std::move(runs)) {}

  const std::vector<Run>& all() const { return runs_; }
  /// The runs of a sweep that fit and came to an end, in the order of the sweep.
  std::vector<const Run*> select(std::string_view sweep, const Wanted& wanted = {}) const;
  /// The first of them; nothing if there is none.
  const Run* find(std::string_view sweep, const Wanted& wanted = {}) const;

 private:
  std::vector<Run> runs_;
};

/// Runs them all on the study's threads.
Runs run_cases(const StudyContext& context, const std::vector<Case>& cases);

/// What the report keeps of each run.
std::vector<StudyCase> report_cases(const Runs& runs);

/// Wall times of each run.
Json timing(const Runs& runs);

}  // namespace vlbeam::falling_beam
