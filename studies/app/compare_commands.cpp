// `vlbeam compare` and `score`: a run beside another one, or beside an answer.
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "io/run_file.hpp"
#include "studies/app/command.hpp"
#include "studies/harness/source_folder.hpp"
#include "tools/compare_runs.hpp"
#include "tools/score.hpp"

namespace vlbeam {
namespace {

/// Throws InvalidInput where a report cannot be written, or would replace what it is made of.
void check_result_file(const std::string& report, const std::vector<std::string>& sources) {
  if (report.empty() || report == "-") return;
  check_writable("--report", report);
  for (const std::string& source : sources) {
    if (same_file(report, source)) {
      throw InvalidInput("--report", "\"" + report + "\"", "it must not be what is read: give another name");
    }
  }
}

struct CompareArguments {
  std::string a, b;           ///< reports of runs
  std::optional<double> tol;  ///< [m]
  std::string report;         ///< empty for none; "-" is standard output
};

int carry_out(const CompareArguments& arguments) {
  if (arguments.tol && !(*arguments.tol >= 0))
    throw InvalidInput("--tol", std::to_string(*arguments.tol), "it must be >= 0");
  check_result_file(arguments.report, {arguments.a, arguments.b});
  const Json comparison = compare_runs(read_run_file(arguments.a), read_run_file(arguments.b),
                                       arguments.tol.value_or(std::numeric_limits<double>::infinity()));
  if (!arguments.report.empty()) write_text(arguments.report, pretty(comparison));
  if (arguments.report != "-") std::cout << printable(comparison_text(comparison), Lines::several);
  return comparison.at("within").get<bool>() || !arguments.tol ? done : gate_failed;
}

struct ScoreArguments {
  std::string name;                  ///< of the case, or a folder of trajectories; empty to list the cases
  std::string csv;                   ///< empty for a folder
  std::string kit;                   ///< folder to write scenes and answers into; empty for none
  std::vector<std::string> columns;  ///< "ours=theirs"
  std::string report;                ///< as of CompareArguments
  std::string references;            ///< empty: the folder beside the program, or it was built from
};

int carry_out(const ScoreArguments& arguments) {
  const auto cases =
      find_source_folder("reference", arguments.references, "cases/falling_beam_engineering.json").path / "cases";
  if (!arguments.kit.empty()) write_kit(cases, arguments.kit);
  if (arguments.name.empty()) {
    std::cout << cases_text(cases);
    return done;
  }
  const bool is_folder = arguments.csv.empty();
  if (is_folder && !std::filesystem::is_directory(arguments.name)) {
    throw InvalidInput(
        "score", "\"" + arguments.name + "\"",
        "a case goes with a trajectory (CSV file), a folder holds several; vlbeam score lists the cases");
  }
  check_result_file(arguments.report, {is_folder ? arguments.name : arguments.csv});
  if (!is_folder) check_result_file(arguments.report, {(cases / (arguments.name + ".json")).string()});
  const Json score = is_folder ? score_folder(cases, arguments.name, arguments.columns)
                               : score_trajectory(read_case(cases, arguments.name), arguments.csv, arguments.columns);
  if (!arguments.report.empty()) write_text(arguments.report, pretty(score));
  if (arguments.report != "-") {
    std::cout << printable(is_folder ? score_table(score) : score_text(score), Lines::several);
  }
  return done;
}

}  // namespace

Command compare_command() {
  return {.name = "compare",
          .help = "What differs between two runs, and how far apart they are",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<CompareArguments>();
            app.add_option("a", arguments->a, "Report of a run")->required();
            app.add_option("b", arguments->b, "Report of another")->required();
            app.add_option("--tol", arguments->tol, "Distance of positions [m] beyond which the exit code is 1");
            app.add_option("--report", arguments->report, "Write it (JSON) here; - is standard output");
            return [arguments] { return carry_out(*arguments); };
          },
          .examples = "  vlbeam compare a.json b.json --tol 1e-6\n"};
}

Command score_command() {
  return {
      .name = "score",
      .help = "The errors of another code's trajectory",
      .options = [](CLI::App& app) -> std::function<int()> {
        const auto arguments = std::make_shared<ScoreArguments>();
        app.add_option("case", arguments->name,
                       "Name of a case, or a folder with trajectories CASE_METHOD_N40.csv; none lists the cases");
        app.add_option("trajectory", arguments->csv, "CSV file: t and any of the case's columns");
        app.add_option("--kit", arguments->kit, "Write scenes and answers of all cases into this folder");
        app.add_option("--column", arguments->columns, "A column that is called otherwise: ours=theirs");
        app.add_option("--report", arguments->report, "Write it (JSON) here; - is standard output");
        app.add_option("--reference", arguments->references,
                       "Folder reference/ (default: beside the program, else where it was built)");
        return [arguments] { return carry_out(*arguments); };
      },
      .examples =
          "  vlbeam score                                              the cases, and to what they are known\n"
          "  vlbeam score --kit kit                                    their scenes and answers, to compute elsewhere\n"
          "  vlbeam score falling_beam_engineering their.csv\n"
          "  vlbeam score theirs/                                      errors and orders of all trajectories in a "
          "folder\n"
          "  vlbeam score falling_beam_engineering their.csv --column joint_position=s --column t=time\n"};
}

}  // namespace vlbeam
