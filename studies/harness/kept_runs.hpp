#pragma once

#include <filesystem>

#include "core/scene/simulate.hpp"

namespace vlbeam {

/// A folder in which the runs of a study leave checkpoints, when they end and when they are interrupted: a study that
/// is begun again repeats no run that it has finished, and goes on with those that it has not. There is one at a time,
/// from its making until its end; simulate_kept() uses it, from any thread.
class KeptRuns {
 public:
  explicit KeptRuns(std::filesystem::path folder);
  ~KeptRuns();
  KeptRuns(const KeptRuns&) = delete;
  KeptRuns& operator=(const KeptRuns&) = delete;

  /// The study is complete: nobody needs them any more.
  void discard() const;
};

/// simulate(), from what was kept of this scene, if something was: with the digits of a run that never stopped. Without
/// a folder, and of what has no checkpoints (statics, SUNDIALS), it is simulate() alone.
RunResult simulate_kept(const Scene& scene, const ProgressCallback& progress);

}  // namespace vlbeam
