// Sweeps of one's own scene: which cases there are, and that what was begun is gone on with, and nothing else.
#include "tools/own_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.hpp"
#include "io/files.hpp"
#include "tests/harness/temporary_folder.hpp"
#include "tools/subprocess.hpp"

namespace vlbeam {
namespace {

Json sweep_of(const Json& over) {
  Json json = parse_json(R"({"schema": "vlbeam.sweep/1", "quantities": ["end.y"],
    "scene": {"beam": {"elements": 2}, "duration": 0.01, "output": {"interval": 0.01}}})");
  json["over"] = over;
  return json;
}

SweepPlan plan_of(const TemporaryFolder& folder, const Json& json) {
  folder.write("sweep.json", pretty(json));
  return read_sweep(folder / "sweep.json");
}

std::string refusal(const Json& json) {
  const TemporaryFolder folder;
  try {
    plan_of(folder, json);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(OwnSweep, ProductsAndZips) {
  const TemporaryFolder folder;
  const Json over = {{"/beam/elements", {2, 3, 4}}, {"/duration", {0.01, 0.02, 0.03}}};
  const SweepPlan product = plan_of(folder, sweep_of(over));
  ASSERT_EQ(product.cases.size(), 9U);
  EXPECT_EQ(product.cases[1].options, (Json{{"/beam/elements", 2}, {"/duration", 0.02}}));
  EXPECT_EQ(product.cases[5].scene.at("beam").at("elements"), 3);
  Json zipped = sweep_of(over);
  zipped["combine"] = "zip";
  const SweepPlan zip = plan_of(folder, zipped);
  ASSERT_EQ(zip.cases.size(), 3U);
  EXPECT_EQ(zip.cases[2].options, (Json{{"/beam/elements", 4}, {"/duration", 0.03}}));
}

TEST(OwnSweep, RangesAndSharedValues) {
  const TemporaryFolder folder;
  const SweepPlan plan =
      plan_of(folder, sweep_of({{"/beam/elements", {{"from", 2}, {"to", 6}, {"count", 3}}},
                                {"/integrator/rtol /integrator/atol",
                                 {{"from", 1e-9}, {"to", 1e-6}, {"count", 4}, {"spacing", "logarithmic"}}}}));
  ASSERT_EQ(plan.cases.size(), 12U);
  EXPECT_EQ(plan.cases[4].scene.at("beam").at("elements"), 4) << "a whole number stays one";
  EXPECT_EQ(plan.cases[1].scene.at("integrator").at("rtol"), 1e-8);
  EXPECT_EQ(plan.cases[1].scene.at("integrator").at("atol"), 1e-8);
}

TEST(OwnSweep, RefusesWithTheKey) {
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const Json thousand = {{"from", 1}, {"to", 2}, {"count", 1000}};
  EXPECT_TRUE(has(refusal(sweep_of({{"/duration", thousand},
                                    {"/beam/material/density", thousand},
                                    {"/beam/material/youngs_modulus", thousand}})),
                  "1e+09 cases"));
  EXPECT_TRUE(has(refusal(sweep_of({{"/beam/elemnts", {2, 3}}})), "\"elements\""));
  EXPECT_TRUE(has(refusal(sweep_of({{"/beam/elements", {2, -3}}})), "case 1"));
  EXPECT_TRUE(has(refusal(sweep_of({{"/beam/elements", 3}})), "a list of values"));
  EXPECT_TRUE(has(refusal(sweep_of({{"/beam/elements", {{"from", 1}, {"to", 2}}}})), "/count"));
  EXPECT_TRUE(has(refusal(sweep_of({{"elements", {2}}})), "this pointer"));
  for (const std::string far : {"/loads/6666636666", "/loads/7/magnitude", "/supports/99999999999999999999/type"}) {
    EXPECT_TRUE(has(refusal(sweep_of({{far, {2}}})), "the next one")) << far;
  }
  Json json = sweep_of({{"/beam/elements", {2, 3}}, {"/duration", {0.01}}});
  json["combine"] = "zip";
  EXPECT_TRUE(has(refusal(json), "as many of each"));
  json["combine"] = "zap";
  EXPECT_TRUE(has(refusal(json), "/combine"));
  json = sweep_of({{"/beam/elements", {2}}});
  json["quantities"] = {"end.q"};
  EXPECT_TRUE(has(refusal(json), "nearest known quantity"));
  json["quantites"] = {"end.y"};
  EXPECT_TRUE(has(refusal(json), "\"quantities\""));
}

TEST(OwnSweep, GoesOnAndJoinsTheSameBits) {
  const TemporaryFolder folder;
  const SweepPlan plan = plan_of(folder, sweep_of({{"/beam/elements", {2, 3, 4}}}));
  const auto joined = [&](const std::string& name) {
    return read_text(folder / name / "sweep.json") + read_text(folder / name / "sweep.csv");
  };
  const SweepFolder forward(folder / "a", plan, false);
  for (const std::size_t i : {0, 1, 2}) EXPECT_TRUE(forward.run(i));
  EXPECT_EQ(forward.collect(), 0U);
  {
    const SweepFolder begun(folder / "b", plan, false);
    EXPECT_TRUE(begun.run(2));
    EXPECT_THROW(begun.collect(), std::runtime_error) << "two are missing";
  }
  const SweepFolder resumed(folder / "b", plan, false);
  EXPECT_EQ(resumed.missing(), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(resumed.run(1));
  EXPECT_TRUE(resumed.run(0));
  resumed.collect();
  EXPECT_EQ(joined("a"), joined("b"));
}

TEST(OwnSweep, AnotherSceneIsNoResume) {
  const TemporaryFolder folder;
  const SweepPlan plan = plan_of(folder, sweep_of({{"/beam/elements", {2, 3}}}));
  EXPECT_TRUE(SweepFolder(folder / "out", plan, false).run(0));
  Json changed = plan.file;
  changed["scene"]["duration"] = 0.02;
  const SweepPlan other = plan_of(folder, changed);
  EXPECT_THROW(SweepFolder(folder / "out", other, false), InvalidInput);
  EXPECT_EQ(SweepFolder(folder / "out", plan, false).missing().size(), 1U) << "nothing is lost";
  EXPECT_EQ(SweepFolder(folder / "out", other, true).missing().size(), 2U);
}

TEST(OwnSweep, ACrashIsOneCase) {
  const TemporaryFolder folder;
  const SweepPlan plan = plan_of(folder, sweep_of({{"/beam/elements", {2, 3}}}));
  const SweepFolder out(folder / "out", plan, false);
  out.note_crash(0, "ended by signal 11");
  EXPECT_TRUE(out.run(1));
  EXPECT_EQ(out.collect(), 1U);
  EXPECT_NE(read_text(folder / "out" / "sweep.csv").find("\n0,2,crashed,,,,\n1,3,completed,0.01,"), std::string::npos);
}

TEST(Subprocess, EndsWhatIsToStop) {
  const ProcessResult result = run_process({"sleep", "60"}, [] { return true; });
  EXPECT_EQ(result.signal, 15);
  EXPECT_EQ(result.exit_code, 143);
}

}  // namespace
}  // namespace vlbeam
