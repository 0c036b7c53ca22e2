#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vlbeam {

/// What the program answers to its caller; where it was asked to stop, interrupted_exit_code().
enum ExitCode {
  done = 0,
  gate_failed = 1,
  bad_input = 2,
  computation_failed = 3,
};

struct RunArguments {
  std::string scene;                  ///< "-" is standard input
  std::optional<std::string> report;  ///< "-" is standard output
  std::optional<std::string> csv;
  bool force = false;  ///< a run that did not end well may replace an earlier result
  bool quiet = false;  ///< no summary on standard error
};

struct StudyArguments {
  std::string name;
  std::string profile = "full";
  std::string out;      ///< empty: reports, or build/reports-ci
  std::string studies;  ///< empty: the one beside the program, or it was built from
  int jobs = 0;         ///< 0: one a processor
  bool force = false;   ///< a study that failed may replace an earlier completed one
};

struct GateArguments {
  std::vector<std::string> reports;  ///< empty: reports/<study>.json of every study
  std::string studies;               ///< as of StudyArguments
  bool update = false;               ///< the reports get the verdicts of now
};

struct ClaimsArguments {
  std::string reports = "reports";
  std::string studies;  ///< as of StudyArguments
  bool write = false;   ///< the documents get the numbers of the reports
};

/// The commands of the program; each returns its exit code. They throw InvalidInput for what is not understood, before
/// any file is written.
int run_command(const RunArguments& arguments);
int study_command(const StudyArguments& arguments);
int gate_command(const GateArguments& arguments);
int claims_command(const ClaimsArguments& arguments);
int list_command(bool names_only);
int schema_command(const std::string& of);

}  // namespace vlbeam
