#pragma once

#include <string>
#include <vector>

namespace vlbeam {

/// What the program answers to its caller.
enum ExitCode {
  done = 0,
  gate_failed = 1,
  bad_input = 2,
  computation_failed = 3,
};

struct RunArguments {
  std::string scene;   ///< "-" is standard input
  std::string report;  ///< empty: a summary on standard output; "-" is standard output
  std::string csv;     ///< empty: none
};

struct StudyArguments {
  std::string name;
  std::string profile = "full";
  std::string out;  ///< empty: reports, or build/reports-ci
  int jobs = 0;     ///< 0: one a processor
};

struct GateArguments {
  std::vector<std::string> reports;  ///< empty: reports/<study>.json of every study
};

/// The commands of the program. They throw InvalidInput for what is not understood, before any file is written.
ExitCode run_command(const RunArguments& arguments);
ExitCode study_command(const StudyArguments& arguments);
ExitCode gate_command(const GateArguments& arguments);
ExitCode list_command(bool names_only);
ExitCode schema_command(const std::string& of);

}  // namespace vlbeam
