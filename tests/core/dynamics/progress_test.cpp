// A run that does not get on ends, by what it has done and not by the clock.
#include "mechanics/time/progress.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "tests/core/support/function_ode.hpp"

namespace vlbeam::test {
namespace {

// It falls to 0, where its rate changes sign with it: every step that is longer than the tolerance errs.
TEST(Progress, EndsARunWhoseStepsStayTiny) {
  const auto stuck = [](double t_end, std::size_t& steps) -> std::string {
    FunctionOde ode(1, [](const Eigen::VectorXd& y, double) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, y[0] > 0 ? -1.0 : 1.0);
    });
    Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 0.3);
    double t = 0;
    IntegrationOptions options;
    options.tolerances = {1e-13, 1e-13};
    SolverCounters counters;
    try {
      integrate(ode, y, t, t_end, {}, options, counters);
    } catch (const ComputationFailed& failure) {
      steps = counters.steps;
      EXPECT_NEAR(failure.t, 0.3, 1e-6);
      return failure.what();
    }
    return "";
  };
  std::size_t once = 0, again = 0;
  const std::string why = stuck(1, once);
  EXPECT_NE(why.find("does not get on"), std::string::npos) << why;
  EXPECT_NE(why.find("the error tolerance"), std::string::npos) << why;
  EXPECT_EQ(stuck(1, again), why);
  EXPECT_EQ(once, again);
  EXPECT_LT(once, 200000U);
}

TEST(Progress, LetsARunTakeManyStepsThatGetOn) {
  SolverCounters counters;
  Progress progress(0, 1e3, 1e-6, counters);
  double t = 0;
  for (int i = 0; i < 300000; ++i, t += 2e-8) progress.tries(t, [] { return std::string(); });  // a fiftieth of it
  EXPECT_GT(t, 5e-3);
}

}  // namespace
}  // namespace vlbeam::test
