#include "studies/harness/study.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/error.hpp"
#include "studies/harness/files.hpp"
#include "tests/harness/temporary_folder.hpp"

namespace vlbeam {
namespace {

/// A study of the midpoint rule on the integral of x^2 over [0, 1].
StudyReport midpoint_study(const StudyContext& context) {
  StudyReport report;
  const auto counts = context.config.at("intervals").get<std::vector<double>>();
  const auto outcomes = context.sweep(counts, [](double n) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += (i + 0.5) / n * ((i + 0.5) / n) / n;
    return std::abs(sum - 1.0 / 3);
  });
  std::vector<double> errors;
  Table table{.name = "errors", .caption = "error of the midpoint rule", .columns = {"n", "error"}};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    report.cases.push_back({.options = {{"n", counts[i]}}, .results = {{"error", *outcomes[i]}}});
    table.rows.push_back({counts[i], *outcomes[i]});
    errors.push_back(*outcomes[i]);
  }
  report.fits = {fit_order("error", counts, errors)};
  report.measured["finest"] = errors.back();
  report.tables = {table};
  report.figures = {{.name = "convergence", .caption = "error", .script = "convergence.gp"}};
  report.timing["seconds"] = outcomes[0].seconds;
  return report;
}

class StudyFolder : public testing::Test {
 protected:
  StudyFolder() {
    folder_.write("studies/midpoint/study.ci.json", R"({"intervals": [4, 8, 16, 32]})");
    folder_.write("studies/midpoint/convergence.gp",
                  "set terminal svg\nset output output\nset datafile separator comma\nset logscale\n"
                  "plot data.'errors.csv' using 1:2 skip 1\n");
    gates(0.1);
  }

  void gates(double finest) {
    folder_.write("studies/midpoint/gates.json",
                  R"({"schema": "vlbeam.gates/1", "gates": [
                      {"name": "order", "kind": "exact", "fit": "error", "reason": "the midpoint rule is of second order",
                       "order": {"expected": 2, "tolerance": 0.1, "at_most": 2.1, "finest_error": 1e-3}},
                      {"name": "finest", "kind": "exact", "quantity": "finest", "reason": "test", "max": )" +
                      std::to_string(finest) + "}]}");
  }

  StudyVerdict run(StudyReport (*body)(const StudyContext&), int jobs = 2) const {
    return run_study({.name = "midpoint", .title = "", .run = body},
                     {.profile = Profile::ci, .out = folder_ / "out", .sources = folder_ / "studies", .jobs = jobs});
  }
  std::string text(const std::string& file) const { return read_text(folder_ / file); }

  TemporaryFolder folder_;
};

TEST_F(StudyFolder, WritesReportTablesAndFigures) {
  const StudyVerdict verdict = run(midpoint_study);
  EXPECT_EQ(verdict.status, "completed") << verdict.failure;
  EXPECT_EQ(verdict.gates.size(), 2U);
  EXPECT_TRUE(all_passed(verdict.gates));
  for (const char* file : {"out/midpoint.json", "out/midpoint.timing.json", "out/midpoint_errors.csv",
                           "out/figures/midpoint_convergence.svg"}) {
    EXPECT_EQ(folder_.files().count(file), 1U) << file;
  }
  const Json report = parse_json(text("out/midpoint.json"));
  EXPECT_EQ(report["cases"].size(), 4U);
  EXPECT_EQ(report["figures"][0]["file"], "figures/midpoint_convergence.svg");
  EXPECT_FALSE(report.contains("provenance"));
  EXPECT_TRUE(parse_json(text("out/midpoint.timing.json"))["provenance"].contains("commit"));
}

TEST_F(StudyFolder, TheReportIsTheSameForAnyNumberOfThreads) {
  run(midpoint_study, 1);
  const std::string first = text("out/midpoint.json");
  run(midpoint_study, 3);
  EXPECT_EQ(text("out/midpoint.json"), first);
}

TEST_F(StudyFolder, AWrittenReportIsJudgedByTheGatesThatStandNow) {
  run(midpoint_study);
  const Json report = parse_json(text("out/midpoint.json"));
  EXPECT_TRUE(all_passed(judge_report(report, folder_ / "studies")));
  gates(1e-6);
  EXPECT_FALSE(all_passed(judge_report(report, folder_ / "studies")));
  EXPECT_THROW(judge_report(Json::object(), folder_ / "studies"), InvalidInput);
}

TEST_F(StudyFolder, AFailedCaseFailsTheStudyAndIsReported) {
  const StudyVerdict verdict = run([](const StudyContext& context) {
    StudyReport report = midpoint_study(context);
    report.cases[1].failure = "step underflow";
    return report;
  });
  EXPECT_EQ(verdict.status, "failed");
  EXPECT_FALSE(all_passed(verdict.gates));
  EXPECT_EQ(parse_json(text("out/midpoint.json"))["cases"][1]["failure"], "step underflow");
}

TEST_F(StudyFolder, AStudyThatBreaksDownIsReported) {
  const StudyVerdict verdict = run([](const StudyContext&) -> StudyReport { throw std::runtime_error("broke down"); });
  EXPECT_EQ(verdict.status, "failed");
  EXPECT_EQ(parse_json(text("out/midpoint.json"))["failure"], "broke down");
}

TEST_F(StudyFolder, AFailedStudyLeavesAnEarlierResult) {
  run(midpoint_study);
  const std::string report = text("out/midpoint.json"), table = text("out/midpoint_errors.csv");
  const auto broken = [](const StudyContext& context) {
    StudyReport half = midpoint_study(context);
    half.tables[0].rows.clear();
    half.cases[0].failure = "out of memory";
    return half;
  };
  const StudyVerdict failed = run(broken);
  EXPECT_EQ(failed.report.filename(), "midpoint.failed.json");
  EXPECT_EQ(text("out/midpoint.json"), report);
  EXPECT_EQ(text("out/midpoint_errors.csv"), table);
  EXPECT_EQ(parse_json(text("out/midpoint.failed.json"))["status"], "failed");
  run(midpoint_study);
  EXPECT_EQ(folder_.files().count("out/midpoint.failed.json"), 0U) << "it no longer fails";
  EXPECT_EQ(text("out/midpoint.json"), report);
}

TEST_F(StudyFolder, WhatAKilledProcessLeftIsRemoved) {
  folder_.write("out/.midpoint.999999999.part/midpoint.json", "part");
  folder_.write("out/.midpoint.1.part/midpoint.json", "of a process that runs");
  run(midpoint_study);
  EXPECT_EQ(folder_.files().count("out/.midpoint.999999999.part/midpoint.json"), 0U);
  EXPECT_EQ(folder_.files().count("out/.midpoint.1.part/midpoint.json"), 1U);
}

TEST_F(StudyFolder, AFigureThatCannotBeDrawnFailsTheStudy) {
  folder_.write("studies/midpoint/convergence.gp", "plott\n");
  EXPECT_EQ(run(midpoint_study).status, "failed");
}

TEST_F(StudyFolder, DataThatIsNotUnderstoodLeavesNoReport) {
  folder_.write("studies/midpoint/study.ci.json", "{");
  EXPECT_THROW(run(midpoint_study), InvalidInput);
  folder_.write("studies/midpoint/gates.json", "{}");
  EXPECT_THROW(run(midpoint_study), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace vlbeam
