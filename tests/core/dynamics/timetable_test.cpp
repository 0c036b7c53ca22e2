// What is known beforehand of how equations change with time: steps end at corners, and none is longer than a change.
#include "mechanics/time/timetable.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/support/function_ode.hpp"

namespace vlbeam::test {
namespace {

constexpr double never_again = Timetable::never;

TEST(Timetable, LetsStepsEndAtCornersAndNoneBeLongerThanAStretchAllows) {
  const Timetable times({{0, 5, never_again}, {5, 5.1, 0.01}, {5.1, 5.2, 0.02}, {0, never_again, 0.5}});
  EXPECT_EQ(times.step(1, 0.1).length, 0.1);
  EXPECT_EQ(times.step(1, 7).length, 0.5) << "what goes on all the time";
  EXPECT_FALSE(times.step(1, 7).corner);
  EXPECT_NEAR(times.step(4.4, 0.5).length, 0.3, 1e-14) << "no sliver is left";
  const Timetable::Step last = times.step(4.7, 0.5);
  EXPECT_EQ(last.corner, 5);
  EXPECT_LT(4.7 + last.length, 5) << "the equations are those before the corner to its end";
  EXPECT_NEAR(4.7 + last.length, 5, 1e-13);
  EXPECT_EQ(times.step(5, 1).length, 0.01);
  EXPECT_EQ(times.step(5.1 * (1 - 1e-14), 1).length, 0.02) << "where rounding has it it is behind the corner";
  EXPECT_EQ(times.step(5.2, 3).length, 0.5);
  EXPECT_FALSE(times.step(5.2, 3).corner);
}

TEST(Timetable, TakesCornersThatRoundingTellsApartForOne) {
  const Timetable times({{0, 0.1 + 0.2, 0.1}, {0.3, 0.4, 0.001}});
  EXPECT_EQ(times.step(0.25, 0.1).corner, 0.3);
  EXPECT_EQ(times.step(0.3, 1).length, 0.001);
  EXPECT_EQ(times.step(0.1 + 0.2, 1).length, 0.001);
  EXPECT_EQ(times.step(0.4, 1).length, 1);
}

TEST(Timetable, OfNothingSaysNothing) {
  EXPECT_TRUE(Timetable().empty());
  EXPECT_TRUE(Timetable(std::vector<Timetable::Stretch>()).empty());
  EXPECT_EQ(Timetable().step(3, 0.25).length, 0.25);
}

/// The methods of Odeint, with the fixed one.
class Corners : public ::testing::TestWithParam<IntegrationMethod> {
 protected:
  void run(EventedOde& ode, double t_end, const Timetable& timetable, double tolerance) {
    options_.type = GetParam();
    options_.tolerances = {tolerance, tolerance};
    options_.timetable = timetable;
    options_.step = 0.07;
    double t = 0;
    EXPECT_TRUE(integrate(ode, y_, t, t_end, {}, options_, counters_));
  }

  Eigen::VectorXd y_;
  IntegrationOptions options_;
  SolverCounters counters_;
};

INSTANTIATE_TEST_SUITE_P(Methods, Corners,
                         ::testing::Values(IntegrationMethod::dopri5, IntegrationMethod::cash_karp,
                                           IntegrationMethod::fehlberg78, IntegrationMethod::bulirsch_stoer,
                                           IntegrationMethod::rosenbrock4, IntegrationMethod::adams_bashforth_moulton));

// The rate jumps at the corner: a step that sees both sides of it errs.
TEST_P(Corners, AreWhereARateMayJump) {
  FunctionOde ode(1, [](const Eigen::VectorXd&, double t) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, t < 1.03 ? 0.0 : 4.0);
  });
  y_ = Eigen::VectorXd::Zero(1);
  run(ode, 2, Timetable({{0, 1.03, never_again}}), 1e-9);
  // what rosenbrock4 takes of the rate of change is a difference that reaches over the corner
  const bool exactly = GetParam() != IntegrationMethod::rosenbrock4;
  EXPECT_NEAR(y_[0], 4 * 0.97, exactly ? 1e-12 : 1e-8);
  EXPECT_TRUE(counters_.rejected == 0 || !exactly);
}

// It is at rest until it is pushed, for as long as no step that has grown at rest would see.
TEST_P(Corners, AreNotSteppedOver) {
  for (const double width : {1e-4, 0.003, 0.2}) {
    const double from = 17.3, pi = 3.14159265358979;
    const auto push = [&](double t) {
      return t > from && t < from + width ? 1 - std::cos(2 * pi * (t - from) / width) : 0;
    };
    FunctionOde ode(2, [&](const Eigen::VectorXd& y, double t) -> Eigen::VectorXd {
      return Eigen::Vector2d(y[1], -1e-6 * y[0] + push(t) / width);
    });
    y_ = Eigen::VectorXd::Zero(2);
    counters_ = {};
    run(ode, 18, Timetable({{0, from, never_again}, {from, from + width, width / 10}}), 1e-7);
    EXPECT_NEAR(y_[1], 1, 1e-4) << width;
    EXPECT_LT(counters_.steps, 500U) << width;
  }
}

}  // namespace
}  // namespace vlbeam::test
