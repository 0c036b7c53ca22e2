// `vlbeam converge`: how far a number can be trusted.
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/provenance.hpp"
#include "io/scene_json.hpp"
#include "studies/app/command.hpp"
#include "studies/app/run_outputs.hpp"
#include "tools/converge.hpp"
#include "tools/interrupt.hpp"
#include "tools/plot.hpp"
#include "tools/sweep.hpp"

namespace vlbeam {
namespace {

struct ConvergeArguments {
  std::string scene;  ///< "-" is standard input
  std::string quantity;
  double error = 0;
  bool relative = false;
  std::optional<double> at;
  bool horizon = false;
  std::string report, csv, figure;                         ///< empty for none; "-" is standard output
  int jobs = 0;                                            ///< 0: one a processor
  double limit = std::numeric_limits<double>::infinity();  ///< wall time [s]
  bool quiet = false;                                      ///< nothing while it computes
};

int carry_out(const ConvergeArguments& arguments) {
  RunOutputs outputs({{"the scene", arguments.scene}},
                     {{"--report", arguments.report}, {"--csv", arguments.csv}, {"--figure", arguments.figure}}, true);
  const Scene scene = read_scene(arguments.scene);
  install_interrupt_handler();
  const Convergence found = converge(scene, {.quantity = arguments.quantity,
                                             .error = arguments.error,
                                             .relative = arguments.relative,
                                             .at = arguments.at,
                                             .horizon = arguments.horizon,
                                             .jobs = jobs_or_processors(arguments.jobs),
                                             .seconds = arguments.limit,
                                             .on_level = [&](const ConvergeLevel& level) {
                                               if (!arguments.quiet)
                                                 std::cerr << level_line(scene, level) << std::flush;
                                             }});
  if (interrupted()) {
    if (!std::isnan(found.answer)) std::cerr << convergence_summary(scene, found);
    std::cerr << "vlbeam: interrupted; nothing was written\n";
    return interrupted_exit_code();
  }
  const Json report = convergence_to_json(scene, found);
  Json whole = report;
  whole["provenance"] = provenance();
  Json& seconds = whole["timing"]["seconds"] = Json::array();
  for (const ConvergeLevel& level : found.levels) seconds.push_back(level.seconds);
  const auto status = RunStatus::completed;
  outputs.write(arguments.csv, status, [&](const TextSink& sink) { sink(convergence_table(scene, found)); });
  outputs.write_with(arguments.figure, status,
                     [&](const std::filesystem::path& file) { plot_convergence(report, {}, file); });
  outputs.write(arguments.report, status, [&](const TextSink& sink) { sink(pretty(whole)); });
  std::cerr << convergence_summary(scene, found);
  outputs.tell();
  if (!outputs.all_written() || std::isnan(found.answer)) return computation_failed;
  return found.reached ? done : gate_failed;
}

}  // namespace

Command converge_command() {
  return {.name = "converge",
          .help = "How far a number of a scene can be trusted, and what that costs",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<ConvergeArguments>();
            app.add_option("scene", arguments->scene, "Scene file; - reads standard input")->required();
            app.add_option("--quantity", arguments->quantity,
                           "As samples name it: joint_position, end.y, energy.kinetic")
                ->required();
            app.add_option("--error", arguments->error, "Error wanted, in the quantity's unit")->required();
            app.add_flag("--relative", arguments->relative, "The error is one of the quantity's magnitude");
            app.add_option("--at", arguments->at, "Time [s] (default: the scene's duration)");
            app.add_flag("--horizon", arguments->horizon, "Also until when this motion can be predicted at all");
            app.add_option("--report", arguments->report, "Write the report (JSON) here; - is standard output");
            app.add_option("--csv", arguments->csv, "Write the table of work and precision (CSV) here");
            app.add_option("--figure", arguments->figure, "Draw it here (SVG or PNG)");
            app.add_option("--jobs,-j", arguments->jobs, "Runs at a time (default: one a processor)")
                ->check(CLI::NonNegativeNumber);
            app.add_option("--limit", arguments->limit, "Wall time, after which it says what it knows [s]")
                ->check(CLI::PositiveNumber);
            app.add_flag("--quiet,-q", arguments->quiet, "Nothing about the runs while they go on");
            return [arguments] { return carry_out(*arguments); };
          },
          .examples =
              "  vlbeam converge scene.json --quantity end.y --error 1e-3\n"
              "  vlbeam converge scene.json --quantity end.y --error 1e-4 --relative --at 0.2 --limit 60\n"
              "  vlbeam converge scene.json --quantity energy.kinetic --error 1e-3 --report c.json --figure c.svg\n"};
}

}  // namespace vlbeam
