#include "studies/harness/claims.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/harness/temporary_folder.hpp"

namespace vlbeam {
namespace {

Json parse(const std::string& text) { return parse_json(text); }

class Claims : public ::testing::Test {
 protected:
  Claims() {
    write(report_);
    folder_.write("other.json", R"({"measured": {"count": 18}, "gates": [{"kind": "self"}]})");
  }
  void write(const Json& report) { folder_.write("test.json", report.dump()); }

  ClaimsVerdict check(const std::string& document, const Json& claims) {
    ReportFolder reports(folder_.path());
    Json file = {{"schema", "vlbeam.claims/1"}, {"study", "test"}, {"document", "README.md"}, {"claims", claims}};
    if (!given_.empty()) file["given"] = given_;
    if (!checked_.empty()) file["checked"] = checked_;
    return check_claims(file, document, reports);
  }
  double value(const std::string& json) {
    ReportFolder reports(folder_.path());
    return claimed_value(parse(json), "test", reports);
  }

  Json report_ = parse(R"({"measured": {"drift": 1.2345e-9, "big_a": 2.5, "big_b": 40, "long": 0.71248813},
      "cases": [{"results": {"steps": 7}}],
      "tables": [{"name": "errors", "columns": ["element", "N", "error"],
                  "rows": [["A", 5, 0.5], ["A", 10, 0.125], ["B", 5, 0.75], ["B", 10, null]]}],
      "fits": [{"quantity": "tip", "slope": 2.04, "pairwise_orders": [2.1, 1.9]}],
      "grid_convergence": [{"quantity": "x", "uncertainty": 3e-6}],
      "gates": [{"kind": "exact"}, {"kind": "exact"}, {"kind": "regression"}]})");
  TemporaryFolder folder_;
  Json given_, checked_;
};

TEST_F(Claims, ValuesComeFromAnyPlaceOfAReport) {
  EXPECT_EQ(value(R"("drift")"), 1.2345e-9);
  EXPECT_EQ(value(R"("/cases/0/results/steps")"), 7);
  EXPECT_EQ(value(R"("other:count")"), 18);
  EXPECT_EQ(value(R"({"table": "errors", "column": "error", "where": {"element": "A", "N": 10}})"), 0.125);
  EXPECT_EQ(value(R"({"max": [{"table": "errors", "column": "error", "where": {"element": "A"}}]})"), 0.5);
  EXPECT_EQ(value(R"({"fit": "tip", "key": "slope"})"), 2.04);
  EXPECT_EQ(value(R"({"fit": "tip", "pair": 1})"), 1.9);
  EXPECT_EQ(value(R"({"convergence": "x", "key": "uncertainty"})"), 3e-6);
  EXPECT_EQ(value(R"({"gates": "exact"})"), 2);
  EXPECT_EQ(value(R"({"gates": "all", "in": "*"})"), 4);
  EXPECT_EQ(value(R"({"min": ["big_*"]})"), 2.5);
  EXPECT_EQ(value(R"({"ratio": ["big_b", {"sum": ["big_a", 1.5]}]})"), 10);
  EXPECT_EQ(value(R"({"product": ["big_a", {"abs": {"difference": ["big_a", "big_b"]}}]})"), 2.5 * 37.5);
  for (const char* wrong :
       {R"("drfit")", R"("big_*")", R"({"ratio": ["drift"]})", R"({"table": "errors", "column": "n"})",
        R"({"fit": "top", "key": "slope"})", R"({"mean": ["drift"]})", "null",
        R"({"table": "errors", "column": "error", "where": {"element": "B", "N": 10}})"}) {
    EXPECT_THROW(value(wrong), InvalidInput) << wrong;
  }
}

TEST_F(Claims, NumbersAreWrittenAsProseDoes) {
  EXPECT_EQ(number_like(0.06137, "0.061"), "0.061");
  EXPECT_EQ(number_like(1.2345e-9, "9e-7"), "1e-9");
  EXPECT_EQ(number_like(1.2345e-9, "1.0e-7"), "1.2e-9");
  EXPECT_EQ(number_like(12780, "1e3"), "1e4");
  EXPECT_EQ(number_like(18, "3"), "18");
  EXPECT_EQ(number_like(-0.8021099, "0.802110"), "-0.802110");
}

TEST_F(Claims, ProseThatSaysWhatTheReportSaysPassesOnceItIsRecorded) {
  const std::string text = "The drift is\n  1.2e-9, the position 0.712488.";
  Json claims = parse(R"([{"text": "drift is {}, the position {}", "values": ["drift", "long"]}])");
  EXPECT_EQ(check(text, claims).failures.size(), 2U) << "nothing is recorded";
  claims = check(text, claims).claims.at("claims");
  EXPECT_TRUE(check(text, claims).failures.empty());
  EXPECT_EQ(check(text, claims).numbers, 2U);
  EXPECT_EQ(check(text, claims).document, text);
}

TEST_F(Claims, OnePercentIsNoticedWhateverIsWritten) {
  for (const std::string written : {"1e-9", "1.2e-9", "1.23e-9"}) {
    const std::string text = "drift " + written;
    Json claims = parse(R"([{"text": "drift {}", "values": ["drift"]}])");
    claims = check(text, claims).claims.at("claims");
    EXPECT_TRUE(check(text, claims).failures.empty()) << written;
    for (const double factor : {0.99, 1.01}) {
      Json changed = report_;
      changed["measured"]["drift"] = 1.2345e-9 * factor;
      write(changed);
      EXPECT_EQ(check(text, claims).failures.size(), 1U) << written << " times " << factor;
    }
    write(report_);
  }
}

// 1.2345e-9 is noise: on another machine it may be another number below the bound.
TEST_F(Claims, NoiseIsClaimedAsABound) {
  const Json claims = parse(R"([{"text": "drifts by at most {} J", "values": [{"at_most": "drift"}]}])");
  EXPECT_TRUE(check("It drifts by at most 1e-8 J.", claims).failures.empty());
  report_["measured"]["drift"] = -9e-9;
  write(report_);
  EXPECT_TRUE(check("It drifts by at most 1e-8 J.", claims).failures.empty());
  report_["measured"]["drift"] = -1.2e-8;
  write(report_);
  const ClaimsVerdict verdict = check("It drifts by at most 1e-8 J.", claims);
  EXPECT_EQ(verdict.failures.size(), 1U);
  EXPECT_EQ(verdict.document, "It drifts by at most 1e-7 J.");
}

TEST_F(Claims, TheRewrittenDocumentHolds) {
  const std::string text = "Drift 9.9e-9 over\n18 meshes; slope 3.00, steps 7.";
  Json claims = parse(R"([{"text": "slope {}", "values": [{"fit": "tip", "key": "slope"}]},
                          {"text": "Drift {} over {} meshes", "values": ["drift", "other:count"]},
                          {"text": "steps {}", "values": ["/cases/0/results/steps"]}])");
  const auto first = check(text, claims);
  EXPECT_EQ(first.document, "Drift 1.2e-9 over\n18 meshes; slope 2.04, steps 7.");
  EXPECT_TRUE(check(first.document, first.claims.at("claims")).failures.empty());
}

TEST_F(Claims, EveryNumberIsClaimedOrGiven) {
  const Json none = Json::array();
  EXPECT_EQ(check("3 meshes, `N80`, x_4, dopri5 and [a](b3.md)", none).failures.size(), 1U);
  given_ = parse(R"(["{} meshes"])");
  EXPECT_TRUE(check("3 meshes", none).failures.empty());
  EXPECT_EQ(check("3 meshes, 4 runs", none).failures.size(), 1U);
  EXPECT_EQ(check("no number", none).failures.size(), 1U) << "what is given must be there";
  checked_ = parse(R"(["Finding"])");
  given_ = Json::array();
  EXPECT_TRUE(check("## Method\n3 meshes\n", none).failures.empty());
  EXPECT_EQ(check("## Method\n3 meshes\n## Finding\n4 runs\n## Limits\n5\n", none).failures.size(), 1U);
}

TEST_F(Claims, AClaimThatIsNotInTheTextOrTwiceFails) {
  const Json claims = parse(R"([{"text": "drift {}", "values": ["drift"], "recorded": [1.2345e-9]}])");
  EXPECT_FALSE(check("drift 1.2e-9", claims).failures.size());
  EXPECT_EQ(check("no number", claims).failures.size(), 1U);
  EXPECT_FALSE(check("drift 1.2e-9, drift 1.2e-9", claims).failures.empty());
}

TEST_F(Claims, ATextThatBeginsWithANumberBeginsWithAllOfIt) {
  report_["measured"]["below"] = -0.25;
  write(report_);
  const auto failures = [&](const std::string& text, const char* claims) {
    return check(text, parse(claims)).failures.size();
  };
  EXPECT_EQ(failures("off by 1.2e-9 m", R"([{"text": "{} m", "values": ["drift"], "recorded": [1.2345e-9]}])"), 0U);
  EXPECT_EQ(failures("off by -0.25 m", R"([{"text": "{} m", "values": ["below"], "recorded": [-0.25]}])"), 0U);
  EXPECT_EQ(failures("2.5-40 m", R"([{"text": "{}-{} m", "values": ["big_a", "big_b"], "recorded": [2.5, 40]}])"), 0U);
}

TEST_F(Claims, AFileThatIsNotUnderstoodIsRefused) {
  for (const char* wrong : {R"([{"text": "drift {}", "values": []}])", R"([{"text": "drift", "values": []}])",
                            R"([{"values": ["drift"]}])"}) {
    EXPECT_THROW(check("drift 1", parse(wrong)), InvalidInput) << wrong;
  }
}

TEST_F(Claims, TheFileIsWrittenOneClaimALine) {
  const Json claims = parse(R"({"schema": "vlbeam.claims/1", "claims": [{"text": "a {}", "values": ["x"]}]})");
  EXPECT_EQ(parse(claims_text(claims)), claims);
  EXPECT_NE(claims_text(claims).find("\n    {\"text\":\"a {}\""), std::string::npos);
}

}  // namespace
}  // namespace vlbeam
