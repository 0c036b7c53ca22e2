// The end of a run: it is reached, and decides nothing about the steps before it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support/second_order_oscillator.hpp"

namespace vlbeam::test {
namespace {

struct End {
  std::size_t steps = 0;
  double q = 0, sampled = 0;  ///< at the end, and at the first sample
};

End run_to(double t_end, double sample_at, double dies_at) {
  SecondOrderOscillator ode(dies_at);
  IntegrationOptions options;
  options.type = IntegrationMethod::generalized_alpha;
  options.generalized_alpha.adaptive = true;
  options.generalized_alpha.step = 0.3;
  options.generalized_alpha.first_step = 1e-3;
  options.generalized_alpha.tolerances = {1e-5, 1e-5};
  SolverCounters counters;
  Eigen::VectorXd y = Eigen::Vector2d(1, 0);
  double t = 0;
  EXPECT_TRUE(integrate(ode, y, t, t_end, {sample_at}, options, counters));
  EXPECT_EQ(t, t_end);
  return {counters.steps, y[0], ode.samples.front().y[0]};
}

TEST(EndOfRun, IsReachedWhereNothingIsBehindIt) {
  for (const double end : {0.5, 1.0, 2.7}) {
    const End free = run_to(end, end, never), mortal = run_to(end, end, end);
    EXPECT_NEAR(mortal.q, std::cos(end), 1e-3);
    EXPECT_NEAR(mortal.q, free.q, 1e-5);
    EXPECT_LE(mortal.steps, free.steps + 12);
  }
}

TEST(EndOfRun, DecidesNothingAboutTheStepBefore) {
  for (int i = 1; i <= 200; ++i) {
    const double end = 0.02 * i;
    EXPECT_EQ(run_to(end, end, never).q, run_to(2 * end, end, never).sampled) << end;
  }
}

}  // namespace
}  // namespace vlbeam::test
