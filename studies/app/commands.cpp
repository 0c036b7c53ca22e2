#include "studies/app/commands.hpp"

#include <algorithm>
#include <iostream>
#include <thread>

#include "core/error.hpp"
#include "core/scene/names.hpp"
#include "core/scene/simulate.hpp"
#include "studies/app/registry.hpp"
#include "studies/harness/files.hpp"
#include "studies/harness/interrupt.hpp"
#include "studies/harness/progress.hpp"
#include "studies/harness/provenance.hpp"
#include "studies/harness/run_report.hpp"
#include "studies/harness/scene_json.hpp"
#include "studies/harness/schema.hpp"

namespace vlbeam {

ExitCode run_command(const RunArguments& arguments) {
  const Scene scene = parse_scene(read_text(arguments.scene));
  RunResult result;
  {
    Progress progress(scene.title.empty() ? arguments.scene : scene.title);
    result = simulate(scene, [&](double t) {
      progress.update(t / scene.duration, "t = " + std::to_string(t) + " s");
      return !interrupted();
    });
  }

  if (!arguments.csv.empty()) write_text(arguments.csv, samples_csv(scene, result));
  if (arguments.report.empty()) {
    if (arguments.csv != "-") std::cout << run_summary(scene, result);
  } else {
    Json report = run_report(scene, result);
    report["provenance"] = provenance();
    report["timing"] = run_timing(result.timing);
    write_text(arguments.report, pretty(report));
  }

  const bool whole = result.status == RunStatus::completed || result.status == RunStatus::separated;
  if (result.status == RunStatus::failed) {
    std::cerr << "vlbeam: the computation failed at t = " << result.failure_time << " s: " << result.failure << '\n';
  } else if (result.status == RunStatus::interrupted) {
    std::cerr << "vlbeam: interrupted\n";
  }
  return whole ? done : computation_failed;
}

ExitCode study_command(const StudyArguments& arguments) {
  const Study& study = find_study(arguments.name);
  const auto profile = from_string<Profile>(arguments.profile);
  if (!profile) throw InvalidInput("--profile", arguments.profile, "it must be ci or full");
  std::string out = arguments.out;
  if (out.empty()) out = *profile == Profile::full ? "reports" : "build/reports-ci";
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

  const StudyVerdict verdict =
      run_study(study, *profile, out, arguments.jobs > 0 ? arguments.jobs : processors, studies_folder());
  std::cout << gates_text(study.name + " (" + arguments.profile + "): " + verdict.status, verdict.gates);
  if (verdict.status != "completed") {
    std::cerr << "vlbeam: study " << study.name << " " << verdict.status << ": " << verdict.failure << '\n';
    return computation_failed;
  }
  return all_passed(verdict.gates) ? done : gate_failed;
}

ExitCode gate_command(const GateArguments& arguments) {
  std::vector<std::string> paths = arguments.reports;
  if (paths.empty()) {
    for (const Study& study : all_studies()) paths.push_back("reports/" + study.name + ".json");
  }
  std::size_t evaluated = 0;
  std::size_t failed = 0;
  std::string text;
  for (const std::string& path : paths) {
    const auto verdicts = judge_report(parse_json(read_text(path)), studies_folder());
    text += gates_text(path, verdicts);
    evaluated += verdicts.size();
    failed += static_cast<std::size_t>(
        std::ranges::count_if(verdicts, [](const GateVerdict& verdict) { return !verdict.passed; }));
  }
  std::cout << text << "All reports: " << evaluated << " gates evaluated, " << failed << " failed\n";
  return failed == 0 ? done : gate_failed;
}

ExitCode list_command(bool names_only) {
  for (const Study& study : all_studies()) {
    std::cout << study.name << (names_only ? "" : "  " + study.title) << '\n';
  }
  return done;
}

ExitCode schema_command(const std::string& of) {
  if (of == "scene") {
    std::cout << pretty(scene_schema());
  } else if (of == "run") {
    std::cout << pretty(run_schema());
  } else if (of == "study") {
    std::cout << pretty(study_schema());
  } else if (of == "gates") {
    std::cout << pretty(gates_schema());
  } else {
    throw InvalidInput("schema", "\"" + of + "\"", "there are: scene, run, study, gates");
  }
  return done;
}

}  // namespace vlbeam
