#include <exception>
#include <iostream>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "studies/app/commands.hpp"
#include "studies/harness/interrupt.hpp"

namespace {

vlbeam::ExitCode dispatch(int argc, char** argv) {
  CLI::App app(
      "vlbeam: verification and convergence of variable-length beam finite elements\n"
      "Exit codes: 0 done and gates held, 1 a gate failed, 2 bad input, 3 the computation failed");
  app.require_subcommand(1);

  vlbeam::RunArguments run_arguments;
  CLI::App* run = app.add_subcommand("run", "Run a scene");
  run->add_option("scene", run_arguments.scene, "Scene file; - reads standard input")->required();
  run->add_option("--report", run_arguments.report, "Write the report (JSON) here; - is standard output");
  run->add_option("--csv", run_arguments.csv, "Write the samples (CSV) here; - is standard output");

  vlbeam::StudyArguments study_arguments;
  CLI::App* study = app.add_subcommand("study", "Run a study and write its report, tables and figures");
  study->add_option("name", study_arguments.name, "Name of the study, see list")->required();
  study->add_option("--profile", study_arguments.profile, "full, or ci for the small one")->capture_default_str();
  study->add_option("--out", study_arguments.out, "Folder to write to (default: reports, with ci build/reports-ci)");
  study->add_option("--jobs,-j", study_arguments.jobs, "Runs at a time (default: one a processor)")
      ->check(CLI::NonNegativeNumber);

  bool names_only = false;
  CLI::App* list = app.add_subcommand("list", "List the studies");
  list->add_flag("--names", names_only, "Names only");

  vlbeam::GateArguments gate_arguments;
  CLI::App* gate = app.add_subcommand("gate", "Judge reports of studies by their gates");
  gate->add_option("reports", gate_arguments.reports, "Report files (default: reports/NAME.json of every study)");

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
  return vlbeam::schema_command(schema_of);
}

}  // namespace

int main(int argc, char** argv) {
  vlbeam::install_interrupt_handler();
  try {
    return dispatch(argc, argv);
  } catch (const vlbeam::InvalidInput& error) {
    std::cerr << "vlbeam: " << error.what() << '\n';
    return vlbeam::bad_input;
  } catch (const std::exception& error) {
    std::cerr << "vlbeam: " << error.what() << '\n';
    return vlbeam::computation_failed;
  }
}
