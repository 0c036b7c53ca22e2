// `vlbeam plot`: figures of reports.
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/run_file.hpp"
#include "studies/app/command.hpp"
#include "tools/plot.hpp"

namespace vlbeam {
namespace {

struct PlotArguments {
  std::string report;
  std::string what;                     ///< empty: the shapes, or the quantities
  std::vector<std::string> quantities;  ///< against time
  std::string figure;
  Look look;
};

int carry_out(const PlotArguments& arguments) {
  check_writable("-o", arguments.figure);
  if (same_file(arguments.report, arguments.figure)) {
    throw InvalidInput("-o", "\"" + arguments.figure + "\"", "it must not be the report: give another name");
  }
  const Json json = read_json(arguments.report);
  if (json.is_object() && json.value("schema_version", "") == "vlbeam.converge/1") {
    if (!arguments.what.empty() || !arguments.quantities.empty()) {
      throw InvalidInput("--what", "\"" + arguments.what + "\"", "a report of converge has one figure: leave it out");
    }
    plot_convergence(json, arguments.look, arguments.figure);
    return done;
  }
  if (!arguments.what.empty() && !arguments.quantities.empty()) {
    throw InvalidInput("--quantity", "this option", "it draws against time by itself: leave out --what");
  }
  const std::string what = arguments.what.empty() && arguments.quantities.empty() ? "shape" : arguments.what;
  const RunFile run = read_run_file(arguments.report);
  plot_run(run, what, arguments.quantities, arguments.look, arguments.figure);
  constexpr std::size_t smooth = 25;  // frames
  if (const std::size_t frames = run.configurations().size(); what == "animation" && frames < smooth) {
    std::cerr << frames << (frames == 1 ? " frame" : " frames") << ": for a smooth motion, run the scene with "
              << (run.scene.analysis == Analysis::statics ? "more /statics/steps\n" : "--frames 100\n");
  }
  return done;
}

}  // namespace

Command plot_command() {
  return {.name = "plot",
          .help = "Draw the report of a run or of converge, with gnuplot",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<PlotArguments>();
            app.add_option("report", arguments->report, "Report file")->required();
            app.add_option(
                "--what", arguments->what,
                "shape (default), energy, tip, joint; along the beam strain, tension, curvature, moment, shear and "
                "torque; these with -field over the beam and time, with -envelope least and largest; or animation");
            app.add_option("--quantity", arguments->quantities, "Draw quantities of one unit against time instead");
            app.add_option("-o,--out", arguments->figure,
                           "Figure: a name ending in .svg, .png or .pdf; an animation .gif or .mp4")
                ->required();
            app.add_flag("--column", arguments->look.column,
                         "As wide as a journal's column, 84 mm, with letters of 8 pt");
            app.add_flag("--bare", arguments->look.bare, "No title");
            return [arguments] { return carry_out(*arguments); };
          },
          .examples =
              "  vlbeam run scene.json --report r.json                     a plot is of a report, not of a scene\n"
              "  vlbeam plot r.json -o shapes.svg\n"
              "  vlbeam plot r.json --what energy -o energy.png\n"
              "  vlbeam plot r.json --column --bare -o figure.pdf          for a paper\n"
              "  vlbeam plot r.json --quantity end.x --quantity end.y -o end.svg\n"};
}

}  // namespace vlbeam
