#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "io/messages.hpp"
#include "io/nearest.hpp"
#include "io/provenance.hpp"
#include "studies/app/commands.hpp"
#include "tools/interrupt.hpp"

namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 done and gates held, 1 a gate failed or the error wanted was not reached, 2 bad input,\n"
    "3 the computation failed or a file could not be written, 128 + n stopped by signal n (130 for Ctrl-C)";

/// Says which command was meant where the first word is none.
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string word = argv[1];
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == word) return;
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  vlbeam::refuse(
      "command", "\"" + word + "\"",
      "the nearest is \"" + vlbeam::nearest_of(word, known) + "\" (there are: " + vlbeam::quoted_list(known) + ")");
}

/// Says which option was meant where one is none of its command's.
void check_options(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    std::vector<std::string> known;
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    for (const std::string& word : command->remaining()) {
      if (!word.starts_with("--")) continue;
      const std::string name = word.substr(0, word.find('='));
      vlbeam::refuse("option", "\"" + name + "\"",
                     "the nearest of " + command->get_name() + " is \"" + vlbeam::nearest_of(name, known) + "\"");
    }
  }
}

int dispatch(int argc, char** argv) {
  CLI::App app("vlbeam: beams along which something slides, and how far their numbers can be trusted");
  app.set_version_flag("--version", vlbeam::provenance().at("program").get<std::string>());
  app.require_subcommand(1);

  vlbeam::RunArguments run_arguments;
  CLI::App* run = app.add_subcommand("run", "Run a scene");
  run->add_option("scene", run_arguments.scene, "Scene file; - reads standard input")->required();
  run->add_option("--report", run_arguments.report, "Write the report (JSON) here; - is standard output");
  run->add_option("--csv", run_arguments.csv, "Write the samples (CSV) here; - is standard output");
  run->add_option("--shape", run_arguments.shape,
                  "Write points along the axis (CSV) of the shapes kept; - is standard output");
  run->add_option("--vtk", run_arguments.vtk, "Write the shapes kept as a ParaView series into this folder");
  run->add_option("--points", run_arguments.points, "Intervals an element of --shape and --vtk")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  run->add_option("--frames", run_arguments.frames,
                  "Keep this many more shapes, evenly in time: for animations and fields")
      ->check(CLI::Range(2, 10000));
  run->add_flag("--extremes", run_arguments.extremes,
                "Largest and least value of each quantity over all steps, and when: in the summary and the report");
  CLI::Option* checkpoint = run->add_option("--checkpoint", run_arguments.checkpoint,
                                            "Write here what the run can go on from: when it is stopped, and --every");
  run->add_option("--every", run_arguments.every, "Simulated time between checkpoints [s]")
      ->check(CLI::PositiveNumber)
      ->needs(checkpoint);
  run->add_option("--restart", run_arguments.restart, "Go on from this checkpoint of the scene, with the same digits");
  run->add_option("--threads", run_arguments.threads,
                  "At work on a beam of more than about 1000 elements; digits do not depend on it (default: one a "
                  "processor, four at most)")
      ->check(CLI::Range(1, 1024));
  bool check = false, no_check = false;
  CLI::Option* with_check =
      run->add_flag("--check", check,
                    "Tell the error in time and of the mesh by companions, for a scene that names its integrator, too");
  run->add_flag("--no-check", no_check, "Run no companions, as runs with --checkpoint or --restart do")
      ->excludes(with_check);
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

  std::string kept_runs;
  CLI::App* kept_run = app.add_subcommand("kept-run", "")->group("");  // for studies: not shown
  kept_run->add_option("folder", kept_runs, "")->required();

  bool names_only = false;
  CLI::App* list = app.add_subcommand("list", "List the studies and the scenes");
  list->add_flag("--names", names_only, "Names of the studies only");

  std::string scene_name, scenes;
  CLI::App* scene = app.add_subcommand("scene", "Print an example scene, to run or to copy");
  scene->add_option("name", scene_name, "Name of the scene, see list")->required();
  for (CLI::App* command : {list, scene}) {
    command->add_option("--scenes", scenes, "Folder scenes/ (default: beside the program, else where it was built)");
  }

  vlbeam::ConvergeArguments converge_arguments;
  CLI::App* converge =
      app.add_subcommand("converge", "How far a number of a scene can be trusted, and what that costs");
  converge->add_option("scene", converge_arguments.scene, "Scene file; - reads standard input")->required();
  converge
      ->add_option("--quantity", converge_arguments.quantity,
                   "As samples name it: joint_position, end.y, energy.kinetic")
      ->required();
  converge->add_option("--error", converge_arguments.error, "Error wanted, in the quantity's unit")->required();
  converge->add_flag("--relative", converge_arguments.relative, "The error is one of the quantity's magnitude");
  converge->add_option("--at", converge_arguments.at, "Time [s] (default: the scene's duration)");
  converge->add_flag("--horizon", converge_arguments.horizon, "Also until when this motion can be predicted at all");
  converge->add_option("--report", converge_arguments.report, "Write the report (JSON) here; - is standard output");
  converge->add_option("--csv", converge_arguments.csv, "Write the table of work and precision (CSV) here");
  converge->add_option("--figure", converge_arguments.figure, "Draw it here (SVG or PNG)");
  converge->add_option("--jobs,-j", converge_arguments.jobs, "Runs at a time (default: one a processor)")
      ->check(CLI::NonNegativeNumber);
  converge->add_option("--limit", converge_arguments.limit, "Wall time, after which it says what it knows [s]")
      ->check(CLI::PositiveNumber);

  converge->add_flag("--quiet,-q", converge_arguments.quiet, "Nothing about the runs while they go on");

  vlbeam::ImportArguments import_arguments;
  CLI::App* import = app.add_subcommand("import", "Make a scene of another program's input; says what it left out");
  import->add_option("format", import_arguments.format, "moordyn: mooring lines, versions 1 and 2")
      ->required()
      ->check(CLI::IsMember({"moordyn"}));
  import->add_option("file", import_arguments.file, "Input file; - reads standard input")->required();
  import->add_option("-o,--out", import_arguments.out, "Write the scene (JSON) here; - is standard output")
      ->capture_default_str();

  vlbeam::InfluenceArguments influence_arguments;
  CLI::App* influence = app.add_subcommand(
      "influence", "Influence lines: what a load of one newton does, wherever it stands on a beam at rest");
  influence->add_option("scene", influence_arguments.scene, "Scene file, of statics; - reads standard input")
      ->required();
  influence
      ->add_option(
          "--quantity", influence_arguments.quantities,
          "As samples name it: places.mid.bending_moment, reactions.start.position.y; may be given several times")
      ->required();
  influence->add_option("--force", influence_arguments.force,
                        "Load by which the beam is disturbed [N] (default: small beside its weight)");
  influence->add_option("--direction", influence_arguments.direction, "Of the load (default: along gravity)")
      ->expected(2, 3);
  influence->add_option("--intervals", influence_arguments.intervals, "An element, at whose ends the load stands")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  influence->add_option("--csv", influence_arguments.csv, "Write the ordinates (CSV) here; - is standard output");
  influence->add_option("--figure", influence_arguments.figure, "Draw them here (SVG or PNG)");
  influence->add_option("--jobs,-j", influence_arguments.jobs, "Runs at a time (default: one a processor)")
      ->check(CLI::NonNegativeNumber);

  vlbeam::SweepArguments sweep_arguments;
  CLI::App* sweep =
      app.add_subcommand("sweep", "Run a scene for many values of its options; goes on where it was stopped");
  sweep->add_option("sweep", sweep_arguments.sweep, "Sweep file, see schema sweep")->required();
  sweep->add_option("--out", sweep_arguments.out,
                    "Folder of what its cases give (default: the file's name without .json)");
  sweep->add_option("--jobs,-j", sweep_arguments.jobs, "Processes at a time (default: one a processor)")
      ->check(CLI::NonNegativeNumber);
  sweep->add_option("--case", sweep_arguments.only, "Run this case only, and join nothing: for job arrays");
  sweep->add_flag("--collect", sweep_arguments.collect, "Run nothing, join the cases that are there");
  sweep->add_flag("--force", sweep_arguments.force, "Start anew where the folder holds another sweep");
  sweep->add_option("--memory", sweep_arguments.memory, "What each case may take [MB] (default: no limit)")
      ->check(CLI::NonNegativeNumber);

  vlbeam::CompareArguments compare_arguments;
  CLI::App* compare = app.add_subcommand("compare", "What differs between two runs, and how far apart they are");
  compare->add_option("a", compare_arguments.a, "Report of a run")->required();
  compare->add_option("b", compare_arguments.b, "Report of another")->required();
  compare->add_option("--tol", compare_arguments.tol, "Distance of positions [m] beyond which the exit code is 1");
  compare->add_option("--report", compare_arguments.report, "Write it (JSON) here; - is standard output");

  vlbeam::ScoreArguments score_arguments;
  CLI::App* score = app.add_subcommand("score", "The errors of another code's trajectory");
  score->add_option("case", score_arguments.name,
                    "Name of a case, or a folder with trajectories CASE_METHOD_N40.csv; none lists the cases");
  score->add_option("trajectory", score_arguments.csv, "CSV file: t and any of the case's columns");
  score->add_option("--kit", score_arguments.kit, "Write scenes and answers of all cases into this folder");
  score->add_option("--column", score_arguments.columns, "A column that is called otherwise: ours=theirs");
  score->add_option("--report", score_arguments.report, "Write it (JSON) here; - is standard output");
  score->add_option("--reference", score_arguments.references,
                    "Folder reference/ (default: beside the program, else where it was built)");

  vlbeam::PlotArguments plot_arguments;
  CLI::App* plot = app.add_subcommand("plot", "Draw the report of a run or of converge, with gnuplot");
  plot->add_option("report", plot_arguments.report, "Report file")->required();
  plot->add_option("--what", plot_arguments.what,
                   "shape (default), energy, tip, joint; along the beam strain, tension, curvature, moment, shear and "
                   "torque; these with -field over the beam and time, with -envelope least and largest; or animation");
  plot->add_option("--quantity", plot_arguments.quantities, "Draw quantities of one unit against time instead");
  plot->add_option("-o,--out", plot_arguments.figure,
                   "Figure: a name ending in .svg, .png or .pdf; an animation .gif or .mp4")
      ->required();
  plot->add_flag("--column", plot_arguments.look.column, "As wide as a journal's column, 84 mm, with letters of 8 pt");
  plot->add_flag("--bare", plot_arguments.look.bare, "No title");

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

  vlbeam::SchemaArguments schema_arguments;
  CLI::App* schema = app.add_subcommand("schema", "Print a JSON Schema");
  schema->add_option("of", schema_arguments.of, "scene, run, study, gates, converge or sweep")->required();
  schema->add_option("part", schema_arguments.part, "Only what is below this key: /beam/material");
  schema->add_flag("--text", schema_arguments.text, "A line a key, to read: what it may be, unit and default");

  const auto examples = [](CLI::App* command, const std::string& lines) {
    command->footer("Examples:\n" + lines + "\n" + exit_codes);
  };
  examples(&app,
           "  vlbeam scene falling_beam > scene.json                    print a scene to change\n"
           "  vlbeam run scene.json --report r.json --csv r.csv         run it\n"
           "  vlbeam plot r.json -o shapes.svg                          draw it\n"
           "  vlbeam converge scene.json --quantity end.y --error 1e-3  how far can that be trusted?\n"
           "  vlbeam schema scene --text                                every key, its unit, range and default\n"
           "  vlbeam COMMAND --help                                     options of a command, and examples\n");
  examples(
      run,
      "  vlbeam run scene.json                                     a summary only\n"
      "  vlbeam run scene.json --report r.json --csv r.csv         and what it is of\n"
      "  vlbeam run scene.json --shape shapes.csv --points 20      the axis at the times of output.configurations\n"
      "  vlbeam run scene.json --checkpoint c.json --every 0.5     a long run, which\n"
      "  vlbeam run scene.json --restart c.json --report r.json    goes on from there\n");
  examples(study,
           "  vlbeam study falling_beam                                 as its figures in reports/ are made\n"
           "  vlbeam study falling_beam --profile ci                    the small one\n");
  examples(list, "  vlbeam list\n");
  examples(scene, "  vlbeam scene falling_beam > scene.json\n");
  examples(converge,
           "  vlbeam converge scene.json --quantity end.y --error 1e-3\n"
           "  vlbeam converge scene.json --quantity end.y --error 1e-4 --relative --at 0.2 --limit 60\n"
           "  vlbeam converge scene.json --quantity energy.kinetic --error 1e-3 --report c.json --figure c.svg\n");
  examples(import,
           "  vlbeam import moordyn lines.txt -o lines.json\n"
           "  vlbeam import moordyn lines.txt | vlbeam run - --report lines.report.json\n");
  examples(influence,
           "  vlbeam influence bridge.json --quantity places.mid.bending_moment --csv - --figure moment.svg\n"
           "  vlbeam influence bridge.json --quantity reactions.start.position.y --intervals 4\n");
  examples(sweep,
           "  vlbeam sweep sweep.json                                   all cases, into sweep/\n"
           "  vlbeam sweep sweep.json --case 3                          one of them, as a job of a cluster\n"
           "  vlbeam sweep sweep.json --collect                         join those that are there\n");
  examples(compare, "  vlbeam compare a.json b.json --tol 1e-6\n");
  examples(
      score,
      "  vlbeam score                                              the cases, and to what they are known\n"
      "  vlbeam score falling_beam_engineering their.csv\n"
      "  vlbeam score theirs/                                      errors and orders of all trajectories in a folder\n"
      "  vlbeam score falling_beam_engineering their.csv --column joint_position=s --column t=time\n");
  examples(plot,
           "  vlbeam run scene.json --report r.json                     a plot is of a report, not of a scene\n"
           "  vlbeam plot r.json -o shapes.svg\n"
           "  vlbeam plot r.json --what energy -o energy.png\n"
           "  vlbeam plot r.json --column --bare -o figure.pdf          for a paper\n"
           "  vlbeam plot r.json --quantity end.x --quantity end.y -o end.svg\n");
  examples(gate, "  vlbeam gate                                               the reports in reports/\n");
  examples(claims, "  vlbeam claims\n");
  examples(schema,
           "  vlbeam schema scene --text                                every key, its unit, range and default\n"
           "  vlbeam schema scene /beam/material --text                 those of the material\n"
           "  vlbeam schema run                                         the JSON Schema of reports\n");

  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    check_options(app);
    return app.exit(error) == 0 ? vlbeam::done : vlbeam::bad_input;
  }
  if (check || no_check) run_arguments.check = check;
  if (*run) return vlbeam::run_command(run_arguments);
  if (*study) return vlbeam::study_command(study_arguments);
  if (*kept_run) return vlbeam::kept_run_command(kept_runs);
  if (*list) return vlbeam::list_command(names_only, scenes);
  if (*scene) return vlbeam::scene_command(scene_name, scenes);
  if (*converge) return vlbeam::converge_command(converge_arguments);
  if (*import) return vlbeam::import_command(import_arguments);
  if (*influence) return vlbeam::influence_command(influence_arguments);
  if (*sweep) return vlbeam::sweep_command(sweep_arguments);
  if (*compare) return vlbeam::compare_command(compare_arguments);
  if (*score) return vlbeam::score_command(score_arguments);
  if (*plot) return vlbeam::plot_command(plot_arguments);
  if (*gate) return vlbeam::gate_command(gate_arguments);
  if (*claims) return vlbeam::claims_command(claims_arguments);
  return vlbeam::schema_command(schema_arguments);
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
