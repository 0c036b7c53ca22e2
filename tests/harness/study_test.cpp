#include "studies/harness/study.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/scene_json.hpp"
#include "tests/harness/program_of_runs.hpp"
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
    folder_.write("studies/midpoint/study.json", R"({"intervals": [4], "ci": {"intervals": [4, 8, 16, 32]}})");
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

  StudyVerdict run(StudyReport (*body)(const StudyContext&), int jobs = 2, Profile profile = Profile::ci) const {
    return run_study({.name = "midpoint", .title = "", .run = body},
                     {.profile = profile, .out = folder_ / "out", .sources = folder_ / "studies", .jobs = jobs});
  }
  std::string text(const std::string& file) const { return read_text(folder_ / file); }

  TemporaryFolder folder_;
};

TEST_F(StudyFolder, TheSmallSweepIsAPatchOfTheWholeOne) {
  folder_.write("studies/midpoint/study.json",
                R"({"elements": [4, 8, 16], "scenes": {"a": {"step": 1}, "b": {"step": 2}},
                    "ci": {"elements": [4], "scenes": {"a": {"step": 3}, "b": null}}})");
  static Json seen;
  const auto look = +[](const StudyContext& context) {
    seen = context.config;
    return StudyReport{};
  };
  run(look);
  EXPECT_EQ(seen.dump(), R"({"elements":[4],"scenes":{"a":{"step":3}}})");
  run(look, 1, Profile::full);
  EXPECT_EQ(seen.dump(), R"({"elements":[4,8,16],"scenes":{"a":{"step":1},"b":{"step":2}}})");
}

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

/// A beam that swings, on three meshes.
StudyReport swinging_study(const StudyContext& context) {
  const std::vector<int> meshes{4, 5, 6};
  const auto outcomes = context.sweep(meshes, [](int elements) {
    Scene scene =
        parse_scene(R"({"beam": {"elements": 4}, "supports": [{"at": "start", "type": "pin"}], "duration": 0.1,
                                  "integrator": {"type": "generalized-alpha"}, "output": {"interval": 0.05}})");
    scene.beam.elements = elements;
    return StudyContext::simulate_to_the_end(scene);
  });
  StudyReport report;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    report.cases.push_back({.options = {{"elements", meshes[i]}}, .results = {}, .failure = outcomes[i].failure});
    if (outcomes[i]) report.cases.back().results = {{"y", outcomes[i]->samples.back().end[1]}};
  }
  if (outcomes[0]) report.measured["y"] = outcomes[0]->samples.back().end[1];
  return report;
}

class StudyOfProcesses : public StudyFolder {
 protected:
  StudyOfProcesses() {
    folder_.write("studies/swinging/study.json", "{}");
    folder_.write("studies/swinging/gates.json", R"({"schema": "vlbeam.gates/1", "gates": [
      {"name": "tip", "kind": "exact", "quantity": "y", "reason": "the beam is 1 m long", "min": -1.1, "max": 0}]})");
  }
  /// Its report, after runs by processes of this program, or in this one.
  Json run(const std::string& program) const {
    run_study({.name = "swinging", .title = "", .run = swinging_study}, {.profile = Profile::ci,
                                                                         .out = folder_ / "out",
                                                                         .sources = folder_ / "studies",
                                                                         .jobs = 2,
                                                                         .force = true,
                                                                         .program = program});
    return parse_json(text("out/swinging.json"));
  }
};

TEST_F(StudyOfProcesses, HasTheSameReport) {
  const Json expected = run("");
  EXPECT_EQ(expected.at("status"), "completed");
  EXPECT_EQ(run(program_of_runs).dump(), expected.dump());
}

TEST_F(StudyOfProcesses, GoesOnWhereACaseCrashes) {
  const Json expected = run(""), report = run(crashing_program(folder_, R"("elements":5)", "SEGV"));
  EXPECT_EQ(report.at("status"), "failed");
  EXPECT_EQ(report.at("failure"), "1 of 3 cases failed");
  EXPECT_EQ(report.at("cases").at(1).at("failure"), "its process ended by signal 11 (Segmentation fault)");
  for (const std::size_t other : {0, 2}) EXPECT_EQ(report.at("cases").at(other), expected.at("cases").at(other));
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
  folder_.write("studies/midpoint/study.json", "{");
  EXPECT_THROW(run(midpoint_study), InvalidInput);
  folder_.write("studies/midpoint/gates.json", "{}");
  EXPECT_THROW(run(midpoint_study), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace vlbeam
