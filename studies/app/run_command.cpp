// `vlbeam run`: a scene, its companions, its files.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "core/pieces.hpp"
#include "io/checkpoint_file.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "io/provenance.hpp"
#include "io/run_report.hpp"
#include "io/scene_json.hpp"
#include "io/shapes.hpp"
#include "io/vtk.hpp"
#include "scene/simulate.hpp"
#include "scene/stiffness.hpp"
#include "studies/app/command.hpp"
#include "studies/app/run_outputs.hpp"
#include "tools/checked_run.hpp"
#include "tools/interrupt.hpp"
#include "tools/progress.hpp"

namespace vlbeam {
namespace {

struct RunArguments {
  std::string scene;                  ///< "-" is standard input
  std::optional<std::string> report;  ///< "-" is standard output
  std::optional<std::string> csv;
  std::string shape;                ///< points along the axis; empty for none
  std::string vtk;                  ///< folder of a ParaView series; empty for none
  std::string checkpoint, restart;  ///< files to go on from, to be written and to be read; empty for none
  std::optional<double> every;      ///< [s] between checkpoints; without it there is one of a run that is interrupted
  int points = 8;                   ///< intervals an element of these
  int frames = 0;                   ///< shapes to keep besides those of the scene, evenly in time
  int threads = 0;                  ///< at work on a long beam; 0: one a processor, four at most
  std::optional<bool> check;        ///< run companions that tell its error; else where the integrator is automatic
  bool extremes = false;            ///< of all quantities over all steps, whatever the scene says
  bool force = false;               ///< a run that did not end well may replace an earlier result
  bool quiet = false;               ///< no summary on standard error
};

/// Keeps shapes at times that are even, besides those of the scene; they change no digit of the motion.
void add_frames(Scene& scene, int frames) {
  std::vector<double>& times = scene.output.configurations;
  for (int k = 0; k < frames; ++k) times.push_back(k + 1 < frames ? scene.duration * k / (frames - 1) : scene.duration);
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

int carry_out(const RunArguments& arguments) {
  constexpr int most_threads = 4;  // the solution of a banded system, a quarter of the work, takes two
  const ThreadLimit threads(arguments.threads > 0 ? arguments.threads : std::min(processors(), most_threads));
  const std::string report = arguments.report.value_or(""), csv = arguments.csv.value_or("");
  if (arguments.report && report.empty()) check_writable("--report", report);
  if (arguments.csv && csv.empty()) check_writable("--csv", csv);
  RunOutputs outputs(
      {{"the scene", arguments.scene}},
      {{"--report", report}, {"--csv", csv}, {"--shape", arguments.shape}, {"--checkpoint", arguments.checkpoint}},
      arguments.force);
  // a checkpoint alone may replace the one that it follows
  const RunOutputs beside_restart({{"the checkpoint", arguments.restart}},
                                  {{"--report", report}, {"--csv", csv}, {"--shape", arguments.shape}},
                                  arguments.force);
  if (!arguments.vtk.empty()) check_vtk_folder("--vtk", arguments.vtk);
  Scene scene = read_scene(arguments.scene);
  const bool in_time = scene.analysis == Analysis::dynamics;
  if (arguments.extremes && !in_time) refuse("--extremes", "of a scene in statics", "they are over time: leave it out");
  scene.output.extremes = scene.output.extremes || arguments.extremes;
  if (arguments.frames > 0) {
    if (!in_time) refuse("--frames", std::to_string(arguments.frames), "statics keep every equilibrium: leave it out");
    add_frames(scene, arguments.frames);
  }
  if ((!arguments.shape.empty() || !arguments.vtk.empty()) && in_time && scene.output.configurations.empty()) {
    throw InvalidInput(arguments.shape.empty() ? "--vtk" : "--shape", "a scene that keeps no shapes",
                       "list the times of some in /output/configurations");
  }

  Checkpoints checkpoints;
  std::string not_kept;  // why the last one was not
  if (!arguments.restart.empty()) checkpoints.from = read_checkpoint(arguments.restart, scene);
  if (arguments.every) checkpoints.every = *arguments.every;
  if (arguments.checkpoint == "-") refuse("--checkpoint", "\"-\"", "it is written again and again: give a file");
  if (!arguments.checkpoint.empty()) {
    checkpoints.keep = [&](const Checkpoint& checkpoint) {
      try {
        write_checkpoint(arguments.checkpoint, scene, checkpoint);
        not_kept.clear();
      } catch (const std::runtime_error& error) {  // no reason to lose the run
        not_kept = error.what();
      }
    };
  }
  const bool goes_on = checkpoints.from || checkpoints.keep;
  if (goes_on && arguments.check.value_or(false)) {
    refuse("--check", "a run with checkpoints", "companions have none: leave out one of the two");
  }
  const bool checked = !goes_on && arguments.check.value_or(has_automatic_steps(scene));

  install_interrupt_handler();
  ShapeSpool spool;
  RunResult result;
  {
    Progress progress(printable(scene.title.empty() ? arguments.scene : scene.title));
    constexpr int many_steps = 2000;
    int steps = 0;
    double first_t = 0;  // behind the first of them: a run may go on from a checkpoint, or start by a search at t = 0
    const auto on_step = [&](double t) {
      if (t > 0 && ++steps == 1) first_t = t;
      progress.update(in_time ? t / scene.duration : t, [&] {
        if (!in_time) return "load factor " + std::to_string(t);
        const std::string slow = steps < many_steps ? "" : why_slow(scene, (t - first_t) / (steps - 1));
        return "t = " + std::to_string(t) + " s" + (slow.empty() ? "" : ", " + slow);
      });
      return !interrupted();
    };
    const RunOutput output{.shape = [&spool](const Configuration& shape) { spool.add(shape); }, .event_shapes = false};
    result = checked ? checked_run(scene, on_step, output, processors())
                     : simulate(scene, on_step, goes_on ? &checkpoints : nullptr, output);
  }
  const Shapes shapes = spool.shapes();
  if (!not_kept.empty()) outputs.attempt(arguments.checkpoint, [&] { throw std::runtime_error(not_kept); });

  // What goes into files first: who reads from standard output may be gone.
  const auto write_report = [&] {
    outputs.write(report, result.status, [&](const TextSink& sink) {
      write_run_report(scene, result, shapes, {{"provenance", provenance()}, {"timing", run_timing(result.timing)}},
                       sink);
    });
  };
  if (report != "-") write_report();
  outputs.write(csv, result.status, [&](const TextSink& sink) { write_samples_csv(scene, result, sink); });
  outputs.write_with(arguments.shape, result.status, [&](const std::filesystem::path& file) {
    write_shapes_csv(scene, shapes, arguments.points, file);
  });
  if (!arguments.vtk.empty()) {
    outputs.attempt(arguments.vtk, [&] { write_vtk(scene, shapes, arguments.points, arguments.vtk); });
  }
  if (report == "-") write_report();

  if (!arguments.quiet) {
    std::cerr << run_summary(scene, result);
    for (const std::string& file : outputs.written()) std::cerr << "  written         " << printable(file) << '\n';
  }
  for (const std::string& problem : outputs.problems()) std::cerr << "vlbeam: " << printable(problem) << '\n';
  if (result.status == RunStatus::failed) {
    std::cerr << "vlbeam: the computation failed at t = " << result.failure_time << " s: " << result.failure << '\n';
    return computation_failed;
  }
  if (result.status == RunStatus::interrupted) {
    std::cerr << "vlbeam: interrupted"
              << (checkpoints.keep && not_kept.empty() ? "; --restart " + arguments.checkpoint + " goes on" : "")
              << '\n';
    return interrupted_exit_code();
  }
  return outputs.all_written() ? done : computation_failed;
}

}  // namespace

Command run_command() {
  return {
      .name = "run",
      .help = "Run a scene",
      .options = [](CLI::App& app) -> std::function<int()> {
        const auto arguments = std::make_shared<RunArguments>();
        app.add_option("scene", arguments->scene, "Scene file; - reads standard input")->required();
        app.add_option("--report", arguments->report, "Write the report (JSON) here; - is standard output");
        app.add_option("--csv", arguments->csv, "Write the samples (CSV) here; - is standard output");
        app.add_option("--shape", arguments->shape,
                       "Write points along the axis (CSV) of the shapes kept; - is standard output");
        app.add_option("--vtk", arguments->vtk, "Write the shapes kept as a ParaView series into this folder");
        app.add_option("--points", arguments->points, "Intervals an element of --shape and --vtk")
            ->check(CLI::Range(1, 1000))
            ->capture_default_str();
        app.add_option("--frames", arguments->frames,
                       "Keep this many more shapes, evenly in time: for animations and fields")
            ->check(CLI::Range(2, 10000));
        app.add_flag(
            "--extremes", arguments->extremes,
            "Largest and least value of each quantity over all steps, and when: in the summary and the report");
        CLI::Option* checkpoint =
            app.add_option("--checkpoint", arguments->checkpoint,
                           "Write here what the run can go on from: when it is stopped, and --every");
        app.add_option("--every", arguments->every, "Simulated time between checkpoints [s]")
            ->check(CLI::PositiveNumber)
            ->needs(checkpoint);
        app.add_option("--restart", arguments->restart,
                       "Go on from this checkpoint of the scene, with the same digits");
        app.add_option("--threads", arguments->threads,
                       "At work on a beam of more than about 1000 elements; digits do not depend on it (default: one a "
                       "processor, four at most)")
            ->check(CLI::Range(1, 1024));
        CLI::Option* with_check = app.add_flag_callback(
            "--check", [arguments] { arguments->check = true; },
            "Tell the error in time and of the mesh by companions, for a scene that names its integrator, too");
        app.add_flag_callback(
               "--no-check", [arguments] { arguments->check = false; },
               "Run no companions, as runs with --checkpoint or --restart do")
            ->excludes(with_check);
        app.add_flag("--force", arguments->force, "A run that fails may replace an earlier result");
        app.add_flag("--quiet,-q", arguments->quiet, "No summary on standard error");
        return [arguments] { return carry_out(*arguments); };
      },
      .examples =
          "  vlbeam run scene.json                                     a summary only\n"
          "  vlbeam run scene.json --report r.json --csv r.csv         and what it is of\n"
          "  vlbeam run scene.json --shape shapes.csv --points 20      the axis at the times of output.configurations\n"
          "  vlbeam run scene.json --checkpoint c.json --every 0.5     a long run, which\n"
          "  vlbeam run scene.json --restart c.json --report r.json    goes on from there\n"};
}

}  // namespace vlbeam
