#include "tools/sweep.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

#include "tools/progress.hpp"

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

TEST(Progress, TellsWhatIsLeftByHowFastItGoes) {
  TimeLeft evenly;
  EXPECT_FALSE(evenly.estimate());
  for (int i = 0; i <= 10; ++i) evenly.seen(i, 0.02 * i);
  EXPECT_NEAR(*evenly.estimate(), 40, 1e-9);

  TimeLeft restarted;  // at 0.8, and 0.01 a second from there
  for (int i = 0; i <= 10; ++i) restarted.seen(3 + i, 0.8 + 0.01 * i);
  EXPECT_NEAR(*restarted.estimate(), 10, 1e-9);

  TimeLeft slower;  // a tenth in 10 s, then a tenth in 100 s
  for (int i = 0; i <= 10; ++i) slower.seen(i, 0.01 * i);
  for (int i = 1; i <= 100; ++i) slower.seen(10 + i, 0.1 + 0.001 * i);
  EXPECT_NEAR(*slower.estimate(), 800, 1);

  TimeLeft waiting;  // nothing has ended for a while
  waiting.seen(0, 0);
  waiting.seen(10, 0.5);
  for (int i = 11; i <= 40; ++i) waiting.seen(i, 0.5);
  EXPECT_NEAR(*waiting.estimate(), 40, 1e-9);
}

}  // namespace
}  // namespace vlbeam
