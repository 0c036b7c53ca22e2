#include "studies/app/commands.hpp"

#include <algorithm>
#include <iostream>
#include <thread>

#include "core/error.hpp"
#include "core/scene/names.hpp"
#include "core/scene/simulate.hpp"
#include "studies/app/registry.hpp"
#include "studies/app/run_outputs.hpp"
#include "studies/harness/claims.hpp"
#include "studies/harness/files.hpp"
#include "studies/harness/interrupt.hpp"
#include "studies/harness/messages.hpp"
#include "studies/harness/progress.hpp"
#include "studies/harness/provenance.hpp"
#include "studies/harness/run_report.hpp"
#include "studies/harness/scene_json.hpp"
#include "studies/harness/schema.hpp"
#include "studies/harness/studies_folder.hpp"

namespace vlbeam {
namespace {

/// The studies' folder; says so where it is not the one that came along with the program.
std::filesystem::path studies_folder(const std::string& given, const std::string& study) {
  const StudiesFolder folder = find_studies_folder(given, study + "/gates.json");
  if (folder.of_the_build) {
    std::cerr << "vlbeam: studies are read from " << printable(folder.path.string())
              << ", which this program was built from; --studies names another folder\n";
  }
  return folder.path;
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const std::string report = arguments.report.value_or(""), csv = arguments.csv.value_or("");
  if (arguments.report && report.empty()) check_writable("--report", report);
  if (arguments.csv && csv.empty()) check_writable("--csv", csv);
  RunOutputs outputs(arguments.scene, report, csv, arguments.force);
  const Scene scene = read_scene(arguments.scene);

  install_interrupt_handler();
  RunResult result;
  {
    Progress progress(printable(scene.title.empty() ? arguments.scene : scene.title));
    result = simulate(scene, [&](double t) {
      progress.update(t / scene.duration, "t = " + std::to_string(t) + " s");
      return !interrupted();
    });
  }

  // What goes into files first: who reads from standard output may be gone.
  const auto write_report = [&] {
    outputs.write(report, result.status, [&](const TextSink& sink) {
      write_run_report(scene, result, {{"provenance", provenance()}, {"timing", run_timing(result.timing)}}, sink);
    });
  };
  if (report != "-") write_report();
  outputs.write(csv, result.status, [&](const TextSink& sink) { write_samples_csv(scene, result, sink); });
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
    std::cerr << "vlbeam: interrupted\n";
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
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

  install_interrupt_handler();
  const StudyVerdict verdict = run_study(study, {.profile = *profile,
                                                 .out = out,
                                                 .sources = studies_folder(arguments.studies, study.name),
                                                 .jobs = arguments.jobs > 0 ? arguments.jobs : processors,
                                                 .force = arguments.force});
  if (verdict.status == "interrupted") {
    std::cerr << "vlbeam: study " << study.name << " interrupted; nothing in " << printable(out) << " has changed\n";
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
  if (fs::exists(sources / "claims.json")) files.push_back(sources / "claims.json");
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

int list_command(bool names_only) {
  for (const Study& study : all_studies()) {
    std::cout << study.name << (names_only ? "" : "  " + study.title) << '\n';
  }
  return done;
}

int schema_command(const std::string& of) {
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
