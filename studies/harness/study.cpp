#include "studies/harness/study.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "core/scene/names.hpp"
#include "studies/harness/files.hpp"
#include "studies/harness/interrupt.hpp"
#include "studies/harness/provenance.hpp"

namespace vlbeam {
namespace {

Json read_json(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  try {
    return parse_json(text);
  } catch (const InvalidInput& error) {
    throw InvalidInput(path.string() + " " + error.field, error.value, error.allowed);
  }
}

std::vector<GateVerdict> evaluate(const std::filesystem::path& gates_file, const Json& report) {
  const Json gates = read_json(gates_file);
  try {
    return evaluate_gates(gates, report);
  } catch (const InvalidInput& error) {
    throw InvalidInput(gates_file.string() + " " + error.field, error.value, error.allowed);
  }
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

}  // namespace

ProgressCallback StudyContext::until_interrupted() {
  return [](double) { return !interrupted(); };
}

RunResult StudyContext::simulate_to_the_end(const Scene& scene) {
  RunResult result = simulate(scene, until_interrupted());
  if (result.status == RunStatus::failed) {
    throw std::runtime_error("t = " + std::to_string(result.failure_time) + " s: " + result.failure);
  }
  if (result.status == RunStatus::interrupted) throw std::runtime_error("interrupted");
  return result;
}

StudyVerdict run_study(const Study& study, Profile profile, const std::filesystem::path& out, int jobs,
                       const std::filesystem::path& sources) {
  StudyContext context;
  context.study = study.name;
  context.profile = profile;
  context.folder = sources / study.name;
  context.jobs = study.measures_time ? 1 : jobs;
  const std::string profile_name(to_string(profile));
  context.config = read_json(context.folder / ("study." + profile_name + ".json"));
  const std::filesystem::path gates_file = context.folder / "gates.json";
  evaluate(gates_file, Json::object());  // a typing error should show before the runs, not after

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
    fail(error.what());
  }
  const auto failed = std::ranges::count_if(report.cases, [](const StudyCase& c) { return !c.failure.empty(); });
  if (failed > 0) fail(std::to_string(failed) + " of " + std::to_string(report.cases.size()) + " cases failed");

  const ReportFiles files{.out = out, .study = study.name};
  if (const std::string problem = write_tables_and_figures(report, context, files); !problem.empty()) fail(problem);
  if (interrupted()) verdict.status = "interrupted";

  Json json = report_to_json(report, files, profile_name, verdict.status, verdict.failure);
  verdict.gates = evaluate(gates_file, json);
  json["gates"] = gates_to_json(verdict.gates);
  write_text(files.timing(), pretty({{"study", study.name},
                                     {"profile", profile_name},
                                     {"jobs", context.jobs},
                                     {"provenance", provenance()},
                                     {"timing", report.timing}}));
  write_text(files.report(), pretty(json));
  return verdict;
}

std::vector<GateVerdict> judge_report(const Json& report, const std::filesystem::path& sources) {
  if (!report.is_object() || report.value("schema_version", "") != "vlbeam.study/1" || !report.contains("study") ||
      !report.at("study").is_string()) {
    throw InvalidInput("/schema_version", "this file", "it must be the report of a study, \"vlbeam.study/1\"");
  }
  return evaluate(sources / report.at("study").get<std::string>() / "gates.json", report);
}

std::filesystem::path studies_folder() { return std::filesystem::path(VLBEAM_SOURCE_DIR) / "studies"; }

}  // namespace vlbeam
