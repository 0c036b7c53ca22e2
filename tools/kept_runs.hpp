#pragma once

#include <filesystem>
#include <string>

#include "scene/simulate.hpp"

namespace vlbeam {

/// A folder in which the runs of a study leave checkpoints, when they end and when they are interrupted: a study that
/// is begun again repeats no run that it has finished, and goes on with those that it has not. There is one at a time,
/// from its making until its end; simulate_kept() uses it, from any thread.
class KeptRuns {
 public:
  /// With a `program` each run is a process of its own, which is to answer by answer_of_kept_run(): `PROGRAM kept-run
  /// FOLDER`. It must be of the same build. Empty: all runs are of this process.
  explicit KeptRuns(std::filesystem::path folder, std::string program = {});
  ~KeptRuns();
  KeptRuns(const KeptRuns&) = delete;
  KeptRuns& operator=(const KeptRuns&) = delete;

  /// Removes what was kept, once the study is complete.
  void discard() const;
};

/// simulate(), going on from what was kept of this scene, if anything, with the digits of a run that never stopped.
/// Without a folder, and for runs that have no checkpoints (statics, SUNDIALS), it is simulate() alone.
///
/// If the run is a process of its own, `progress` is asked several times a second, at t = 0, whether it goes on. Result
/// and InvalidInput are the same. Other exceptions become std::runtime_error with their text. A process that crashes,
/// or is ended, throws std::runtime_error, which says by what.
RunResult simulate_kept(const Scene& scene, const ProgressCallback& progress);

/// The process of such a run: reads `asked`, and returns what it has to write to standard output.
std::string answer_of_kept_run(const std::filesystem::path& folder, const std::string& asked,
                               const ProgressCallback& progress);

}  // namespace vlbeam
