#include "studies/harness/gates.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"

namespace vlbeam {
namespace {

Json report() {
  return {{"schema_version", "vlbeam.study/1"},
          {"study", "test"},
          {"profile", "ci"},
          {"status", "completed"},
          {"measured", {{"drift", 1e-10}, {"events", 18}, {"lost", nullptr}}},
          {"cases", Json::array({{{"options", Json::object()}, {"results", {{"steps", 7}}}}})},
          {"fits", Json::array({fit_to_json(fit_order("tip", {5, 10, 20}, {1e-2, 6.25e-4, 3.9e-5}))})}};
}

Json gate(Json rule) {
  rule["name"] = "gate";
  if (!rule.contains("kind")) rule["kind"] = "exact";
  if (!rule.contains("guards")) rule["reason"] = "a test";
  return {{"schema", "vlbeam.gates/1"}, {"gates", Json::array({rule})}};
}

bool passes(const Json& rule) {
  const auto verdicts = evaluate_gates(gate(rule), report());
  EXPECT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts.at(0).failure.empty(), verdicts.at(0).passed);
  return verdicts.at(0).passed;
}

TEST(Gates, BoundsHoldAndFail) {
  EXPECT_TRUE(passes({{"quantity", "drift"}, {"max", 1e-9}}));
  EXPECT_FALSE(passes({{"quantity", "drift"}, {"max", 1e-11}}));
  EXPECT_TRUE(passes({{"quantity", "drift"}, {"min", 1e-11}}));
  EXPECT_FALSE(passes({{"quantity", "drift"}, {"min", 1e-9}}));
  EXPECT_TRUE(passes({{"quantity", "drift"}, {"min", 0}, {"max", 1}}));
  EXPECT_FALSE(passes({{"quantity", "drift"}, {"min", 1}, {"max", 2}}));
  EXPECT_TRUE(passes({{"quantity", "events"}, {"equals", 18}}));
  EXPECT_FALSE(passes({{"quantity", "events"}, {"equals", 17}}));
  EXPECT_TRUE(passes({{"quantity", "events"}, {"equals", 17}, {"tolerance", 1}}));
  EXPECT_TRUE(passes({{"quantity", "/cases/0/results/steps"}, {"equals", 7}}));
}

TEST(Gates, WhatIsNotThereFails) {
  EXPECT_FALSE(passes({{"quantity", "drfit"}, {"max", 1}}));
  EXPECT_FALSE(passes({{"quantity", "lost"}, {"max", 1}}));
  EXPECT_FALSE(passes({{"quantity", "/cases/1/results/steps"}, {"max", 100}}));
  EXPECT_FALSE(
      passes({{"fit", "middle"}, {"order", {{"expected", 4}, {"tolerance", 9}, {"at_most", 9}, {"finest_error", 9}}}}));
}

TEST(Gates, OrderRuleIsAppliedToTheFitOfThisName) {
  EXPECT_TRUE(passes(
      {{"fit", "tip"}, {"order", {{"expected", 4}, {"tolerance", 0.1}, {"at_most", 4.2}, {"finest_error", 1e-4}}}}));
  EXPECT_FALSE(passes(
      {{"fit", "tip"}, {"order", {{"expected", 4}, {"tolerance", 0.1}, {"at_most", 4.2}, {"finest_error", 1e-5}}}}));
  EXPECT_FALSE(
      passes({{"fit", "tip"}, {"order", {{"expected", 5}, {"tolerance", 0.1}, {"at_most", 6}, {"finest_error", 1}}}}));
}

TEST(Gates, ProfilesChooseWhatIsEvaluated) {
  EXPECT_TRUE(evaluate_gates(gate({{"quantity", "drift"}, {"max", 0}, {"profiles", {"full"}}}), report()).empty());
  EXPECT_FALSE(passes({{"quantity", "drift"}, {"max", 0}, {"profiles", {"full", "ci"}}}));
}

TEST(Gates, AReportThatIsNotCompletedFails) {
  Json failed = report();
  failed["status"] = "failed";
  EXPECT_FALSE(all_passed(evaluate_gates(gate({{"quantity", "drift"}, {"max", 1}}), failed)));
  EXPECT_FALSE(all_passed(evaluate_gates(gate({{"quantity", "drift"}, {"max", 1}}), Json::object())));
}

TEST(Gates, AFileThatIsNotUnderstoodIsRefused) {
  const auto refused = [](const Json& rule, const std::string& field) {
    try {
      evaluate_gates(gate(rule), report());
      ADD_FAILURE() << rule << " was accepted";
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.field, field);
    }
  };
  refused({{"quantity", "drift"}}, "/gates/0");
  refused({{"max", 1}}, "/gates/0");
  refused({{"quantity", "drift"}, {"fit", "tip"}, {"max", 1}}, "/gates/0");
  refused({{"quantity", "drift"}, {"maximum", 1}}, "/gates/0/maximum");
  refused({{"quantity", "drift"}, {"max", "1"}}, "/gates/0/max");
  refused({{"quantity", "drift"}, {"max", 1}, {"tolerance", 1}}, "/gates/0/tolerance");
  refused({{"quantity", "drift"}, {"max", 1}, {"profiles", {"fast"}}}, "/gates/0/profiles");
  refused({{"fit", "tip"}, {"order", {{"expected", 4}}}}, "/gates/0/order/tolerance");
  refused({{"quantity", "drift"}, {"max", 1}, {"kind", "measured"}}, "/gates/0/kind");
  refused({{"quantity", "drift"}, {"max", 1}, {"kind", "regression"}}, "/gates/0");
  refused({{"quantity", "drift"}, {"max", 1}, {"guards", "it"}}, "/gates/0");
  refused({{"quantity", "drift"}, {"max", 1}, {"kind", "self"}}, "/gates/0/uncertainty");
  refused({{"quantity", "drift"}, {"max", 1}, {"uncertainty", true}}, "/gates/0/uncertainty");

  Json nameless = gate({{"quantity", "drift"}, {"max", 1}});
  nameless["gates"][0].erase("reason");
  EXPECT_THROW(evaluate_gates(nameless, report()), InvalidInput);
  Json twice = gate({{"quantity", "drift"}, {"max", 1}});
  twice["gates"].push_back(twice["gates"][0]);
  EXPECT_THROW(evaluate_gates(twice, report()), InvalidInput);
  EXPECT_THROW(evaluate_gates(Json{{"gates", Json::array()}}, report()), InvalidInput);
}

TEST(Gates, BoundsHoldForTheValueWithItsUncertainty) {
  EXPECT_TRUE(passes({{"quantity", "events"}, {"kind", "self"}, {"uncertainty", 1}, {"max", 19}}));
  EXPECT_FALSE(passes({{"quantity", "events"}, {"kind", "self"}, {"uncertainty", 1.5}, {"max", 19}}));
  EXPECT_FALSE(passes({{"quantity", "events"}, {"kind", "self"}, {"uncertainty", 1.5}, {"min", 17}}));
  EXPECT_FALSE(
      passes({{"quantity", "events"}, {"kind", "self"}, {"uncertainty", 1.5}, {"equals", 18}, {"tolerance", 1}}));
  EXPECT_TRUE(passes({{"quantity", "events"}, {"kind", "self"}, {"uncertainty", "drift"}, {"max", 18.1}}));
  EXPECT_FALSE(passes({{"quantity", "events"}, {"kind", "self"}, {"uncertainty", "drfit"}, {"max", 100}}));
}

TEST(Gates, KindsAreCounted) {
  Json two = gate({{"quantity", "drift"}, {"max", 1}});
  two["gates"].push_back(
      {{"name", "b"}, {"kind", "regression"}, {"guards", "the drift"}, {"quantity", "drift"}, {"max", 1}});
  const auto verdicts = evaluate_gates(two, report());
  EXPECT_EQ(kinds_text(verdicts), "1 exact, 0 independent, 0 self; 1 regression, which are no evidence");
  EXPECT_EQ(kinds_to_json(verdicts), (Json{{"exact", 1}, {"independent", 0}, {"self", 0}, {"regression", 1}}));
  const Json json = gates_to_json(verdicts);
  EXPECT_EQ(json[0].at("kind"), "exact");
  EXPECT_EQ(json[1].at("guards"), "the drift");
  EXPECT_FALSE(json[1].contains("reason"));
}

TEST(Gates, TextSaysHowManyWereEvaluated) {
  const auto verdicts = evaluate_gates(gate({{"quantity", "drift"}, {"max", 0}}), report());
  EXPECT_NE(gates_text("report", verdicts).find("1 gates evaluated, 1 failed"), std::string::npos);
}

}  // namespace
}  // namespace vlbeam
