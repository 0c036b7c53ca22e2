#include "studies/harness/study.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "io/provenance.hpp"
#include "scene/names.hpp"
#include "tools/interrupt.hpp"
#include "tools/kept_runs.hpp"

namespace vlbeam {
namespace {

std::vector<GateVerdict> evaluate(const std::filesystem::path& gates_file, const Json& report) {
  const Json gates = read_json(gates_file);
  return naming_file(gates_file, [&] { return evaluate_gates(gates, report); });
}

/// Writes tables, then the figures drawn from them; says what went wrong with a figure.
std::string write_tables_and_figures(const StudyReport& report, const StudyContext& context, const ReportFiles& files) {
  for (const Table& table : report.tables) write_text(files.table(table), table_csv(table));
  std::string failures;
  for (const Figure& figure : report.figures) {
    GnuplotVariables variables = figure.variables;
    variables["data"] = (files.out / (files.study + "_")).string();
    try {
      draw_figure(context.folder / figure.script, files.figure(figure), variables);
    } catch (const std::runtime_error& error) {
      failures += (failures.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  return failures;
}

/// A folder in which a study's files wait until all of them are there.
class Staging {
 public:
  Staging(const std::filesystem::path& out, const std::string& study)
      : out_(out), folder_(out / ("." + study + "." + std::to_string(::getpid()) + ".part")) {
    std::filesystem::create_directories(folder_);
    remove_forsaken(study);
  }
  ~Staging() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// Moves all files to where they belong, `last` after the others.
  void publish(const std::filesystem::path& last) const {
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file() && entry.path() != last) files.push_back(entry.path());
    }
    files.push_back(last);
    for (const fs::path& file : files) {
      const fs::path target = out_ / file.lexically_relative(folder_);
      fs::create_directories(target.parent_path());
      fs::rename(file, target);
    }
  }

 private:
  /// What a killed process has left behind.
  void remove_forsaken(const std::string& study) const {
    namespace fs = std::filesystem;
    const std::string start = "." + study + ".", end = ".part";
    std::vector<fs::path> forsaken;
    for (const auto& entry : fs::directory_iterator(out_)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(start) || !name.ends_with(end)) continue;
      const int process = std::atoi(name.c_str() + start.size());
      if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) forsaken.push_back(entry.path());
    }
    std::error_code ignored;
    for (const fs::path& folder : forsaken) fs::remove_all(folder, ignored);
  }

  std::filesystem::path out_, folder_;
};

bool is_completed(const std::filesystem::path& report) {
  std::error_code error;
  if (!std::filesystem::exists(report, error)) return false;
  try {
    return read_json(report).value("status", "") == "completed";
  } catch (const std::exception&) {
    return false;
  }
}

/// A study's data hold its whole sweep, and under "ci" what the small one changes of it (a merge patch, RFC 7396).
Json sweep_of(Profile profile, Json data) {
  const Json small = data.value("ci", Json::object());
  data.erase("ci");
  if (profile == Profile::ci) data.merge_patch(small);
  return data;
}

}  // namespace

ProgressCallback StudyContext::until_interrupted() {
  return [](double) { return !interrupted(); };
}

RunResult StudyContext::simulate_until_interrupted(const Scene& scene) {
  return simulate_kept(scene, until_interrupted());
}

RunResult StudyContext::simulate_to_the_end(const Scene& scene) {
  RunResult result = simulate_until_interrupted(scene);
  if (result.status == RunStatus::failed) {
    throw std::runtime_error("t = " + std::to_string(result.failure_time) + " s: " + result.failure);
  }
  if (result.status == RunStatus::interrupted) throw std::runtime_error("interrupted");
  return result;
}

StudyVerdict run_study(const Study& study, const StudyRun& run) {
  StudyContext context;
  context.study = study.name;
  context.profile = run.profile;
  context.folder = run.sources / study.name;
  context.jobs = study.measures_time ? 1 : run.jobs;
  const std::string profile_name(to_string(run.profile));
  context.config = sweep_of(run.profile, read_json(context.folder / "study.json"));
  const std::filesystem::path gates_file = context.folder / "gates.json";
  evaluate(gates_file, Json::object());  // a typing error should show before the runs, not after
  const ReportFiles files{.out = run.out, .study = study.name};
  check_writable("--out", files.report());
  check_own("--out", files.report(), "\"vlbeam.study/1\"");

  const KeptRuns kept(run.out / ("." + study.name + "." + profile_name + ".kept"), run.program);
  StudyReport report;
  StudyVerdict verdict{.status = "completed"};
  const auto fail = [&verdict](const std::string& why) {
    verdict.status = "failed";
    verdict.failure += (verdict.failure.empty() ? "" : "\n") + why;
  };
  try {
    report = study.run(context);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::exception& error) {
    fail(explained(error));
  }
  if (interrupted()) return {.status = "interrupted"};
  const auto failed = std::ranges::count_if(report.cases, [](const StudyCase& c) { return !c.failure.empty(); });
  if (failed > 0) fail(std::to_string(failed) + " of " + std::to_string(report.cases.size()) + " cases failed");

  const Staging staging(run.out, study.name);
  const ReportFiles staged{.out = staging.folder(), .study = study.name};
  if (const std::string problem = write_tables_and_figures(report, context, staged); !problem.empty()) fail(problem);
  if (interrupted()) return {.status = "interrupted"};

  Json json = report_to_json(report, staged, profile_name, verdict.status, verdict.failure);
  verdict.gates = evaluate(gates_file, json);
  json["gate_kinds"] = kinds_to_json(verdict.gates);
  json["gates"] = gates_to_json(verdict.gates);
  const std::filesystem::path beside = run.out / (study.name + ".failed.json");
  if (verdict.status == "failed" && !run.force && is_completed(files.report())) {
    write_text(beside, pretty(json));
    verdict.report = beside;
    return verdict;
  }
  write_text(staged.timing(), pretty({{"study", study.name},
                                      {"profile", profile_name},
                                      {"jobs", context.jobs},
                                      {"provenance", provenance()},
                                      {"timing", report.timing}}));
  write_text(staged.report(), pretty(json));
  staging.publish(staged.report());
  kept.discard();
  std::filesystem::remove(beside);
  verdict.report = files.report();
  return verdict;
}

std::vector<GateVerdict> judge_report(const Json& report, const std::filesystem::path& sources) {
  if (!report.is_object() || report.value("schema_version", "") != "vlbeam.study/1" || !report.contains("study") ||
      !report.at("study").is_string()) {
    throw InvalidInput("/schema_version", "this file", "it must be the report of a study, \"vlbeam.study/1\"");
  }
  return evaluate(sources / report.at("study").get<std::string>() / "gates.json", report);
}

}  // namespace vlbeam
