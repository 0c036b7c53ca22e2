#include "studies/app/commands.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <thread>

#include "core/error.hpp"
#include "core/pieces.hpp"
#include "io/checkpoint_file.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "io/moordyn.hpp"
#include "io/provenance.hpp"
#include "io/run_file.hpp"
#include "io/run_report.hpp"
#include "io/scene_json.hpp"
#include "io/schema.hpp"
#include "io/schema_text.hpp"
#include "io/shapes.hpp"
#include "io/vtk.hpp"
#include "scene/names.hpp"
#include "scene/simulate.hpp"
#include "scene/stiffness.hpp"
#include "scene/validate.hpp"
#include "studies/app/registry.hpp"
#include "studies/app/run_outputs.hpp"
#include "studies/harness/claims.hpp"
#include "studies/harness/source_folder.hpp"
#include "tools/checked_run.hpp"
#include "tools/compare_runs.hpp"
#include "tools/converge.hpp"
#include "tools/influence.hpp"
#include "tools/interrupt.hpp"
#include "tools/kept_runs.hpp"
#include "tools/own_sweep.hpp"
#include "tools/plot.hpp"
#include "tools/progress.hpp"
#include "tools/scene_library.hpp"
#include "tools/score.hpp"
#include "tools/subprocess.hpp"
#include "tools/sweep.hpp"

namespace vlbeam {
namespace {

/// A folder of the sources; says so where it is not the one that came along with the program.
std::filesystem::path source_folder(const std::string& name, const std::string& given, const std::string& marker) {
  const SourceFolder folder = find_source_folder(name, given, marker);
  if (folder.of_the_build) {
    std::cerr << "vlbeam: " << name << " are read from " << printable(folder.path.string())
              << ", which this program was built from; --" << name << " names another folder\n";
  }
  return folder.path;
}

std::filesystem::path studies_folder(const std::string& given, const std::string& study) {
  return source_folder("studies", given, study + "/gates.json");
}

/// Scenes are only printed: where they were read is of no account.
std::filesystem::path scenes_folder(const std::string& given) {
  return find_source_folder("scenes", given, "falling_beam.json").path;
}

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

/// Archive beyond that is an error of this process, no trouble of others.
void limit_memory(double megabytes) {
  const rlimit limit{static_cast<rlim_t>(megabytes * 1e6), static_cast<rlim_t>(megabytes * 1e6)};
  if (::setrlimit(RLIMIT_AS, &limit) != 0) throw std::runtime_error("cannot limit the memory of this case");
}

int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int jobs_or_processors(int jobs) { return jobs > 0 ? jobs : processors(); }

/// Keeps shapes at times that are even, besides those of the scene; they change no digit of the motion.
void add_frames(Scene& scene, int frames) {
  std::vector<double>& times = scene.output.configurations;
  for (int k = 0; k < frames; ++k) times.push_back(k + 1 < frames ? scene.duration * k / (frames - 1) : scene.duration);
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

}  // namespace

int run_command(const RunArguments& arguments) {
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

int study_command(const StudyArguments& arguments) {
  const Study& study = find_study(arguments.name);
  const auto profile = from_string<Profile>(arguments.profile);
  if (!profile) throw InvalidInput("--profile", arguments.profile, "it must be ci or full");
  std::string out = arguments.out;
  if (out.empty()) out = *profile == Profile::full ? "reports" : "build/reports-ci";
  install_interrupt_handler();
  const StudyVerdict verdict = run_study(study, {.profile = *profile,
                                                 .out = out,
                                                 .sources = studies_folder(arguments.studies, study.name),
                                                 .jobs = jobs_or_processors(arguments.jobs),
                                                 .force = arguments.force,
                                                 .program = this_program});
  if (verdict.status == "interrupted") {
    std::cerr << "vlbeam: study " << study.name << " interrupted; nothing in " << printable(out)
              << " has changed; the same command goes on\n";
    return interrupted_exit_code();
  }
  std::cout << gates_text(study.name + " (" + arguments.profile + "): " + verdict.status, verdict.gates);
  if (verdict.status != "completed") {
    std::cerr << "vlbeam: study " << study.name << " " << verdict.status << ": "
              << printable(verdict.failure, Lines::several) << "\n  written to " << printable(verdict.report.string())
              << '\n';
    return computation_failed;
  }
  return all_passed(verdict.gates) ? done : gate_failed;
}

int kept_run_command(const std::string& folder) {
  const ThreadLimit alone(1);  // others run beside this one
  install_interrupt_handler();
  end_with_parent();
  write_text("-", answer_of_kept_run(folder, read_text("-"), StudyContext::until_interrupted()));
  return interrupted() ? interrupted_exit_code() : done;
}

int gate_command(const GateArguments& arguments) {
  std::vector<std::string> paths = arguments.reports;
  if (paths.empty()) {
    for (const Study& study : all_studies()) paths.push_back("reports/" + study.name + ".json");
  }
  const std::filesystem::path sources = studies_folder(arguments.studies, all_studies().front().name);
  std::vector<GateVerdict> all;
  std::string text;
  for (const std::string& path : paths) {
    Json report = read_json(path);
    const auto verdicts = naming_file(path, [&] { return judge_report(report, sources); });
    if (arguments.update) {
      report["gate_kinds"] = kinds_to_json(verdicts);
      report["gates"] = gates_to_json(verdicts);
      write_text(path, pretty(report));
    }
    text += gates_text(printable(path), verdicts);
    all.insert(all.end(), verdicts.begin(), verdicts.end());
  }
  const auto failed = std::ranges::count_if(all, [](const GateVerdict& verdict) { return !verdict.passed; });
  std::cout << text << "All reports: " << all.size() << " gates evaluated, " << failed << " failed: " << kinds_text(all)
            << '\n';
  return failed == 0 ? done : gate_failed;
}

int claims_command(const ClaimsArguments& arguments) {
  namespace fs = std::filesystem;
  const fs::path sources = studies_folder(arguments.studies, all_studies().front().name);
  std::vector<fs::path> files;
  for (const char* const name : {"claims.json", "papers.claims.json"}) {  // of documents of several studies
    if (fs::exists(sources / name)) files.push_back(sources / name);
  }
  for (const Study& study : all_studies()) {
    if (const fs::path file = sources / study.name / "claims.json"; fs::exists(file)) files.push_back(file);
  }
  ReportFolder reports(arguments.reports);
  std::size_t numbers = 0, failures = 0;
  for (const fs::path& file : files) {
    const Json claims = read_json(file);
    const fs::path document = file.parent_path() / claims.value("document", "README.md");
    const std::string text = read_text(document);
    const ClaimsVerdict verdict = naming_file(file, [&] { return check_claims(claims, text, reports); });
    for (const std::string& failure : verdict.failures) {
      std::cout << printable(document.lexically_normal().string()) << ": " << printable(failure) << '\n';
    }
    numbers += verdict.numbers;
    failures += verdict.failures.size();
    if (!arguments.write) continue;
    if (verdict.document != text) write_text(document, verdict.document);
    if (const std::string anew = claims_text(verdict.claims); anew != read_text(file)) write_text(file, anew);
  }
  std::cout << "Documents: " << numbers << " numbers compared with reports, " << failures << " differences"
            << (arguments.write && failures > 0 ? "; numbers written anew, read what stands around them" : "") << '\n';
  return failures == 0 ? done : gate_failed;
}

int list_command(bool names_only, const std::string& scenes) {
  if (!names_only) std::cout << "Studies (vlbeam study NAME)\n";
  for (const Study& study : all_studies()) {
    std::cout << (names_only ? "" : "  ") << study.name << (names_only ? "" : "  " + study.title) << '\n';
  }
  if (names_only) return done;
  std::cout << "Scenes (vlbeam scene NAME)\n";
  for (const LibraryScene& scene : library_scenes(scenes_folder(scenes))) {
    std::cout << "  " << scene.name << "  " << printable(scene.title) << '\n';
  }
  return done;
}

int scene_command(const std::string& name, const std::string& scenes) {
  std::cout << library_scene_text(scenes_folder(scenes), name);
  return done;
}

int import_command(const ImportArguments& arguments) {
  RunOutputs outputs({{"the " + arguments.format + " file", arguments.file}}, {{"-o", arguments.out}}, true);
  const ImportedScene imported =
      naming_file(arguments.file, [&] { return scene_of_moordyn(read_text(arguments.file)); });
  validate(scene_from_json(imported.scene));
  outputs.write(arguments.out, RunStatus::completed, [&](const TextSink& sink) { sink(pretty(imported.scene)); });
  for (const std::string& what : imported.left_out) std::cerr << "  left out    " << printable(what) << '\n';
  for (const std::string& file : outputs.written()) std::cerr << "  written     " << printable(file) << '\n';
  for (const std::string& problem : outputs.problems()) std::cerr << "vlbeam: " << printable(problem) << '\n';
  return outputs.all_written() ? done : computation_failed;
}

int influence_command(const InfluenceArguments& arguments) {
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
  for (const std::string& file : outputs.written()) std::cerr << "  written     " << printable(file) << '\n';
  for (const std::string& problem : outputs.problems()) std::cerr << "vlbeam: " << printable(problem) << '\n';
  return outputs.all_written() && found.failure.empty() ? done : computation_failed;
}

int converge_command(const ConvergeArguments& arguments) {
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
  for (const std::string& file : outputs.written()) std::cerr << "  written     " << printable(file) << '\n';
  for (const std::string& problem : outputs.problems()) std::cerr << "vlbeam: " << printable(problem) << '\n';
  if (!outputs.all_written() || std::isnan(found.answer)) return computation_failed;
  return found.reached ? done : gate_failed;
}

int sweep_command(const SweepArguments& arguments) {
  namespace fs = std::filesystem;
  const fs::path out =
      arguments.out.empty() ? fs::path(arguments.sweep).replace_extension("") : fs::path(arguments.out);
  const SweepPlan plan = read_sweep(arguments.sweep);
  for (const char* name : {"plan.json", "sweep.csv", "sweep.json"}) {
    if (!same_file(arguments.sweep, out / name)) continue;
    throw InvalidInput("--out", "\"" + out.string() + "\"",
                       std::string("the sweep file itself stands there as ") + name + ": name another folder");
  }
  const SweepFolder folder(out, plan, arguments.force);
  install_interrupt_handler();
  if (arguments.only) {
    if (*arguments.only < 0 || static_cast<std::size_t>(*arguments.only) >= plan.cases.size()) {
      throw InvalidInput("--case", std::to_string(*arguments.only),
                         "this sweep has cases 0 to " + std::to_string(plan.cases.size() - 1));
    }
    if (arguments.memory > 0) limit_memory(arguments.memory);
    const ThreadLimit alone(1);  // others run beside this one
    const auto i = static_cast<std::size_t>(*arguments.only);
    const bool well = folder.has(i) || folder.run(i);
    if (interrupted()) return interrupted_exit_code();
    return well ? done : computation_failed;
  }
  if (!arguments.collect) {
    const std::vector<std::size_t> missing = folder.missing();
    run_tasks(
        "sweep", std::vector<double>(missing.size(), 1.0), jobs_or_processors(arguments.jobs), [&](std::size_t k) {
          // A process of its own: what becomes of it becomes of no other.
          const std::string number = std::to_string(missing[k]);
          const ProcessResult result = run_process({this_program, "sweep", arguments.sweep, "--out", out.string(),
                                                    "--case", number, "--memory", std::to_string(arguments.memory)},
                                                   interrupted);
          if (folder.has(missing[k]) || interrupted()) return;
          folder.note_crash(missing[k], how_it_ended(result));
        });
    if (interrupted()) {
      std::cerr << "vlbeam: interrupted; " << plan.cases.size() - folder.missing().size() << " of " << plan.cases.size()
                << " cases are there: the same command goes on\n";
      return interrupted_exit_code();
    }
  }
  const std::size_t unwell = folder.collect();
  std::cerr << plan.cases.size() << " cases, "
            << (unwell == 0 ? "all of them ended well" : std::to_string(unwell) + " did not end well")
            << "\n  written         " << printable((out / "sweep.csv").string()) << "\n  written         "
            << printable((out / "sweep.json").string()) << '\n';
  return unwell == 0 ? done : computation_failed;
}

int compare_command(const CompareArguments& arguments) {
  if (arguments.tol && !(*arguments.tol >= 0))
    throw InvalidInput("--tol", std::to_string(*arguments.tol), "it must be >= 0");
  check_result_file(arguments.report, {arguments.a, arguments.b});
  const Json comparison = compare_runs(read_run_file(arguments.a), read_run_file(arguments.b),
                                       arguments.tol.value_or(std::numeric_limits<double>::infinity()));
  if (!arguments.report.empty()) write_text(arguments.report, pretty(comparison));
  if (arguments.report != "-") std::cout << printable(comparison_text(comparison), Lines::several);
  return comparison.at("within").get<bool>() || !arguments.tol ? done : gate_failed;
}

int score_command(const ScoreArguments& arguments) {
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

int plot_command(const PlotArguments& arguments) {
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

int schema_command(const SchemaArguments& arguments) {
  const std::map<std::string, Json (*)()> all{{"scene", scene_schema},       {"run", run_schema},
                                              {"study", study_schema},       {"gates", gates_schema},
                                              {"converge", converge_schema}, {"sweep", sweep_schema}};
  const auto found = all.find(arguments.of);
  if (found == all.end()) {
    throw InvalidInput("schema", "\"" + arguments.of + "\"", "there are: scene, run, study, gates, converge, sweep");
  }
  const Json schema = part_of_schema(found->second(), arguments.part);
  std::cout << (arguments.text ? schema_text(schema, arguments.part) : pretty(schema));
  return done;
}

}  // namespace vlbeam
