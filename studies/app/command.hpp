#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace vlbeam {

/// What the program answers to its caller; where it was asked to stop, interrupted_exit_code().
enum ExitCode {
  done = 0,
  gate_failed = 1,
  bad_input = 2,
  computation_failed = 3,
};

/// A command of the program. What it does throws InvalidInput for what is not understood, before any file is written.
struct Command {
  std::string name, help;
  /// Adds its options; what is returned does the work once they are read, and returns the exit code.
  std::function<std::function<int()>(CLI::App&)> options;
  std::string examples;  ///< a line each; a command without any is not shown
};

// Each command, with its options and examples, stands in a file of its own or of its kin.
Command run_command();
Command study_command();
/// One run of a study, for the study's process: see KeptRuns.
Command kept_run_command();
Command list_command();
Command scene_command();
Command converge_command();
Command import_command();
Command influence_command();
Command sweep_command();
Command compare_command();
Command score_command();
Command plot_command();
Command gate_command();
Command claims_command();
Command schema_command();

int processors();
/// Jobs that an option asks for, 0 being one a processor.
int jobs_or_processors(int jobs);

}  // namespace vlbeam
