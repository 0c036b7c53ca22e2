#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/names.hpp"
#include "scene/simulate.hpp"
#include "studies/harness/gates.hpp"
#include "studies/harness/report.hpp"
#include "tools/sweep.hpp"

namespace vlbeam {

/// Which of a study's two sweeps is run.
enum class Profile { ci, full };
constexpr auto names(Profile) { return std::to_array<Named<Profile>>({{Profile::ci, "ci"}, {Profile::full, "full"}}); }

/// Data, folder and threads of a study.
struct StudyContext {
  std::string study;
  Profile profile = Profile::full;
  std::filesystem::path folder;  ///< the study's sources: study.cpp, study.json, gates.json, *.gp
  Json config;                   ///< study.json for the profile: the sweep as data
  int jobs = 1;

  /// Runs independent cases on the study's threads; see harness/sweep.hpp. Results do not depend on the threads.
  template <class Case, class Run, class Cost>
  auto sweep(const std::vector<Case>& cases, const Run& run, const Cost& cost) const {
    return vlbeam::sweep(study, cases, jobs, run, cost);
  }
  template <class Case, class Run>
  auto sweep(const std::vector<Case>& cases, const Run& run) const {
    return sweep(cases, run, [](const Case&) { return 1; });
  }

  /// Pass to simulate(): a run ends early once the user interrupts the study.
  static ProgressCallback until_interrupted();

  /// Calls simulate(). The run ends early if the user interrupts the study, and goes on where an earlier one ended. It
  /// is a process of its own if the study has a program for that. A crash throws std::runtime_error, and costs one
  /// case.
  static RunResult simulate_until_interrupted(const Scene& scene);

  /// The same; a run that breaks down or is interrupted throws std::runtime_error, so that a case of a sweep fails.
  static RunResult simulate_to_the_end(const Scene& scene);
};

/// One study: a question answered by a sweep of runs.
struct Study {
  std::string name;   ///< its folder under studies/ and the stem of its files
  std::string title;  ///< its question in a line
  StudyReport (*run)(const StudyContext&) = nullptr;
  bool measures_time = false;  ///< runs one case at a time, after the others
};

/// How a study is to be run.
struct StudyRun {
  Profile profile = Profile::full;
  std::filesystem::path out;      ///< folder of the files written
  std::filesystem::path sources;  ///< holds the study's folder
  int jobs = 1;
  bool force = false;        ///< a study that failed may replace an earlier completed one
  std::string program = {};  ///< runs each scene in a process of its own, see KeptRuns; empty: in this one
};

/// Result of a study.
struct StudyVerdict {
  std::string status;  ///< completed | failed | interrupted
  std::string failure = {};
  std::vector<GateVerdict> gates = {};
  std::filesystem::path report = {};  ///< written
};

/// Runs a study and writes its files: tables and figures, then the report, all of them at the end. A study that fails
/// is reported as NAME.failed.json beside an earlier completed report. A study that is interrupted leaves all files as
/// they are. Throws InvalidInput for data that is not understood, before anything is written.
StudyVerdict run_study(const Study& study, const StudyRun& run);

/// Judges a written report anew by the gates that stand in the study's folder now.
std::vector<GateVerdict> judge_report(const Json& report, const std::filesystem::path& sources);

}  // namespace vlbeam
