#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <iostream>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "studies/app/commands.hpp"
#include "studies/harness/interrupt.hpp"
#include "studies/harness/messages.hpp"

namespace {

int dispatch(int argc, char** argv) {
  CLI::App app(
      "vlbeam: verification and convergence of variable-length beam finite elements\n"
      "Exit codes: 0 done and gates held, 1 a gate failed, 2 bad input, 3 the computation failed or a file could not "
      "be "
      "written, 128 + n stopped by signal n (130 for Ctrl-C)");
  app.require_subcommand(1);

  vlbeam::RunArguments run_arguments;
  CLI::App* run = app.add_subcommand("run", "Run a scene");
  run->add_option("scene", run_arguments.scene, "Scene file; - reads standard input")->required();
  run->add_option("--report", run_arguments.report, "Write the report (JSON) here; - is standard output");
  run->add_option("--csv", run_arguments.csv, "Write the samples (CSV) here; - is standard output");
  run->add_flag("--force", run_arguments.force, "A run that fails may replace an earlier result");
  run->add_flag("--quiet,-q", run_arguments.quiet, "No summary on standard error");

  vlbeam::StudyArguments study_arguments;
  CLI::App* study = app.add_subcommand("study", "Run a study and write its report, tables and figures");
  study->add_option("name", study_arguments.name, "Name of the study, see list")->required();
  study->add_option("--profile", study_arguments.profile, "full, or ci for the small one")->capture_default_str();
  study->add_option("--out", study_arguments.out, "Folder to write to (default: reports, with ci build/reports-ci)");
  study->add_option("--jobs,-j", study_arguments.jobs, "Runs at a time (default: one a processor)")
      ->check(CLI::NonNegativeNumber);
  study->add_flag("--force", study_arguments.force, "A study that fails may replace an earlier report");

  bool names_only = false;
  CLI::App* list = app.add_subcommand("list", "List the studies");
  list->add_flag("--names", names_only, "Names only");

  vlbeam::GateArguments gate_arguments;
  CLI::App* gate = app.add_subcommand("gate", "Judge reports of studies by their gates");
  gate->add_option("reports", gate_arguments.reports, "Report files (default: reports/NAME.json of every study)");

  gate->add_flag("--update", gate_arguments.update, "Write the verdicts into the reports");

  vlbeam::ClaimsArguments claims_arguments;
  CLI::App* claims = app.add_subcommand("claims", "Compare the numbers in the READMEs with the reports");
  claims->add_option("--reports", claims_arguments.reports, "Folder of the reports")->capture_default_str();
  claims->add_flag("--write", claims_arguments.write, "Write the reports' numbers into the READMEs");

  const char* studies_help =
      "Folder studies/ with data, gates and scripts (default: beside the program, else where it was built)";
  study->add_option("--studies", study_arguments.studies, studies_help);
  gate->add_option("--studies", gate_arguments.studies, studies_help);
  claims->add_option("--studies", claims_arguments.studies, studies_help);

  std::string schema_of;
  CLI::App* schema = app.add_subcommand("schema", "Print a JSON Schema");
  schema->add_option("of", schema_of, "scene, run, study or gates")->required();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? vlbeam::done : vlbeam::bad_input;
  }
  if (*run) return vlbeam::run_command(run_arguments);
  if (*study) return vlbeam::study_command(study_arguments);
  if (*list) return vlbeam::list_command(names_only);
  if (*gate) return vlbeam::gate_command(gate_arguments);
  if (*claims) return vlbeam::claims_command(claims_arguments);
  return vlbeam::schema_command(schema_of);
}

int answer(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const vlbeam::InvalidInput& error) {
    std::cerr << "vlbeam: " << vlbeam::printable(error.what()) << '\n';
    return vlbeam::bad_input;
  } catch (const std::exception& error) {
    std::cerr << "vlbeam: " << vlbeam::printable(vlbeam::explained(error), vlbeam::Lines::several) << '\n';
  }
  return vlbeam::computation_failed;
}

/// Gives the standard streams that the caller has closed something to read from or to fail on: a file opened later
/// would else take their place.
void open_standard_streams() {
  for (int descriptor = ::open("/dev/null", O_RDONLY); descriptor >= 0; descriptor = ::open("/dev/null", O_RDONLY)) {
    if (descriptor <= STDERR_FILENO) continue;
    ::close(descriptor);
    return;
  }
}

bool is_closed(int descriptor) { return (::fcntl(descriptor, F_GETFL) & O_ACCMODE) == O_RDONLY; }

/// Whether all that was sent to a standard stream has arrived.
bool arrived(std::ostream& stream, std::FILE* file) {
  return static_cast<bool>(stream.flush()) && std::fflush(file) == 0 && std::ferror(file) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  vlbeam::ignore_file_size_signal();
  const int code = answer(argc, argv);
  if (!arrived(std::cout, stdout)) {
    std::cerr << "vlbeam: cannot write to standard output\n";
    return code == vlbeam::done ? vlbeam::computation_failed : code;
  }
  const bool unheard = !is_closed(STDERR_FILENO) && !arrived(std::cerr, stderr);
  return code == vlbeam::done && unheard ? vlbeam::computation_failed : code;
}
