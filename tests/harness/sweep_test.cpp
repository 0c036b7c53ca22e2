#include "studies/harness/sweep.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

#include "studies/harness/progress.hpp"

namespace vlbeam {
namespace {

TEST(Sweep, OutcomesStandInTheOrderOfTheCasesForAnyNumberOfThreads) {
  std::vector<int> cases(100);
  std::iota(cases.begin(), cases.end(), 0);
  for (const int jobs : {1, 2, 7, 200}) {
    const auto outcomes = sweep(
        "test", cases, jobs, [](int n) { return n * n; }, [](int n) { return n % 10; });
    ASSERT_EQ(outcomes.size(), cases.size());
    for (const int n : cases) EXPECT_EQ(*outcomes[static_cast<std::size_t>(n)], n * n);
  }
}

TEST(Sweep, ACaseThatFailsIsRecordedAndTheOthersGoOn) {
  const auto run = [](int n) {
    if (n == 2) throw std::runtime_error("tangled mesh");
    return n;
  };
  const auto outcomes = sweep("test", std::vector<int>{1, 2, 3}, 2, run, [](int) { return 1; });
  EXPECT_TRUE(outcomes[0]);
  EXPECT_FALSE(outcomes[1]);
  EXPECT_EQ(outcomes[1].failure, "tangled mesh");
  EXPECT_TRUE(outcomes[2]);
  EXPECT_EQ(*outcomes[2], 3);
}

TEST(Sweep, TheMostCostlyStartFirst) {
  std::vector<int> started;
  sweep(
      "test", std::vector<int>{1, 3, 2}, 1,
      [&started](int n) {
        started.push_back(n);
        return n;
      },
      [](int n) { return n; });
  EXPECT_EQ(started, (std::vector<int>{3, 2, 1}));
}

TEST(Sweep, NoCasesAreNoTrouble) {
  EXPECT_TRUE(sweep(
                  "test", std::vector<int>{}, 4, [](int n) { return n; }, [](int) { return 1; })
                  .empty());
}

TEST(Progress, TellsTimeInWords) {
  EXPECT_EQ(duration_text(12.3), "12 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

}  // namespace
}  // namespace vlbeam
