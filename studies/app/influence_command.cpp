// `vlbeam influence`: influence lines of a beam at rest.
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/scene_json.hpp"
#include "studies/app/command.hpp"
#include "studies/app/run_outputs.hpp"
#include "tools/influence.hpp"
#include "tools/interrupt.hpp"
#include "tools/plot.hpp"

namespace vlbeam {
namespace {

struct InfluenceArguments {
  std::string scene;                    ///< "-" is standard input
  std::vector<std::string> quantities;  ///< at least one
  std::optional<double> force;          ///< [N]
  std::vector<double> direction;        ///< empty: along gravity
  int intervals = 1;                    ///< an element
  std::string csv, figure;              ///< empty for none; "-" is standard output
  int jobs = 0;                         ///< 0: one a processor
};

int carry_out(const InfluenceArguments& arguments) {
  RunOutputs outputs({{"the scene", arguments.scene}}, {{"--csv", arguments.csv}, {"--figure", arguments.figure}},
                     true);
  const Scene scene = read_scene(arguments.scene);
  install_interrupt_handler();
  InfluenceOptions options{.quantities = arguments.quantities,
                           .force = arguments.force,
                           .intervals = arguments.intervals,
                           .jobs = jobs_or_processors(arguments.jobs)};
  if (!arguments.direction.empty()) {
    if (arguments.direction.size() != static_cast<std::size_t>(scene.dimension)) {
      throw InvalidInput("--direction", std::to_string(arguments.direction.size()) + " components",
                         "it must have " + std::to_string(scene.dimension) + ", as the scene has dimensions");
    }
    std::copy(arguments.direction.begin(), arguments.direction.end(), options.direction.emplace().begin());
  }
  const Influence found = influence(scene, options);
  if (interrupted()) {
    std::cerr << "vlbeam: interrupted; nothing was written\n";
    return interrupted_exit_code();
  }
  const auto status = RunStatus::completed;
  outputs.write(arguments.csv, status, [&](const TextSink& sink) { sink(influence_table(found)); });
  outputs.write_with(arguments.figure, status,
                     [&](const std::filesystem::path& file) { plot_influence(scene.title, found, {}, file); });
  std::cerr << influence_summary(found);
  outputs.tell();
  return outputs.all_written() && found.failure.empty() ? done : computation_failed;
}

}  // namespace

Command influence_command() {
  return {
      .name = "influence",
      .help = "Influence lines: what a load of one newton does, wherever it stands on a beam at rest",
      .options = [](CLI::App& app) -> std::function<int()> {
        const auto arguments = std::make_shared<InfluenceArguments>();
        app.add_option("scene", arguments->scene, "Scene file, of statics; - reads standard input")->required();
        app.add_option(
               "--quantity", arguments->quantities,
               "As samples name it: places.mid.bending_moment, reactions.start.position.y; may be given several times")
            ->required();
        app.add_option("--force", arguments->force,
                       "Load by which the beam is disturbed [N] (default: small beside its weight)");
        app.add_option("--direction", arguments->direction, "Of the load (default: along gravity)")->expected(2, 3);
        app.add_option("--intervals", arguments->intervals, "An element, at whose ends the load stands")
            ->check(CLI::Range(1, 100))
            ->capture_default_str();
        app.add_option("--csv", arguments->csv, "Write the ordinates (CSV) here; - is standard output");
        app.add_option("--figure", arguments->figure, "Draw them here (SVG or PNG)");
        app.add_option("--jobs,-j", arguments->jobs, "Runs at a time (default: one a processor)")
            ->check(CLI::NonNegativeNumber);
        return [arguments] { return carry_out(*arguments); };
      },
      .examples =
          "  vlbeam influence bridge.json --quantity places.mid.bending_moment --csv - --figure moment.svg\n"
          "  vlbeam influence bridge.json --quantity reactions.start.position.y --intervals 4\n"};
}

}  // namespace vlbeam
