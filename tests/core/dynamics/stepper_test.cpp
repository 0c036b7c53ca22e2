#include "mechanics/time/stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/core/support/function_ode.hpp"

namespace vlbeam::test {
namespace {

/// y'' = -y + (1 - pi^2) cos(pi t): depends on time by itself.
FunctionOde forced_oscillator() {
  constexpr double w = std::numbers::pi;
  return {2, [](const Eigen::VectorXd& y, double t) -> Eigen::VectorXd {
            return Eigen::Vector2d(y[1], -y[0] + (1 - w * w) * std::cos(w * t));
          }};
}

/// Error at t = 2 of the forced oscillator after `steps` equal steps; from (2, 0) it is cos t + cos(pi t).
double error_of_equal_steps(IntegrationMethod type, int steps) {
  auto ode = forced_oscillator();
  const auto stepper = make_odeint_stepper(type, {1, 1}, 2.0 / steps);  // any step will do
  Eigen::VectorXd y = Eigen::Vector2d(2, 0);
  double t = 0;
  for (int i = 0; i < steps; ++i) {
    double dt = 2.0 / steps;
    EXPECT_TRUE(stepper->try_step(ode, y, t, dt));
  }
  EXPECT_NEAR(t, 2, 1e-14);
  constexpr double w = std::numbers::pi;
  return std::hypot(y[0] - std::cos(2) - std::cos(w * 2), y[1] + std::sin(2) + w * std::sin(w * 2));
}

struct MethodOrder {
  IntegrationMethod type;
  double order;
  int coarsest;  ///< steps; four times as many still err well above roundoff
};

class StepperOrder : public ::testing::TestWithParam<MethodOrder> {};

TEST_P(StepperOrder, IsThatOfTheMethod) {
  const auto [type, order, n] = GetParam();
  const double coarse = error_of_equal_steps(type, n), middle = error_of_equal_steps(type, 2 * n),
               fine = error_of_equal_steps(type, 4 * n);
  EXPECT_NEAR(std::log2(coarse / middle), order, 0.4);
  EXPECT_NEAR(std::log2(middle / fine), order, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Odeint, StepperOrder,
                         ::testing::Values(MethodOrder{IntegrationMethod::dopri5, 5, 16},
                                           MethodOrder{IntegrationMethod::cash_karp, 5, 16},
                                           MethodOrder{IntegrationMethod::fehlberg78, 8, 6},
                                           MethodOrder{IntegrationMethod::adams_bashforth_moulton, 5, 64},
                                           MethodOrder{IntegrationMethod::rosenbrock4, 4, 16}));

TEST(Stepper, ARejectedStepChangesNothingButItsLength) {
  for (const IntegrationMethod type : integrators) {
    auto ode = oscillator();
    const auto stepper = make_odeint_stepper(type, {1e-13, 1e-13}, 1);
    Eigen::VectorXd y = Eigen::Vector2d(1, 0);
    double t = 0.5, dt = 40;
    EXPECT_FALSE(stepper->try_step(ode, y, t, dt));
    EXPECT_EQ(y, Eigen::Vector2d(1, 0));
    EXPECT_EQ(t, 0.5);
    EXPECT_LT(dt, 40);
    EXPECT_GT(dt, 0);
  }
}

TEST(Stepper, AfterAResetItsDigitsAreThoseOfANewOne) {
  std::vector<IntegrationMethod> types(integrators.begin(), integrators.end());
  types.push_back(IntegrationMethod::adams_bashforth_moulton);
  for (const IntegrationMethod type : types) {
    auto ode = oscillator();
    const auto used = make_odeint_stepper(type, {1e-9, 1e-9}, 0.01);
    const auto fresh = make_odeint_stepper(type, {1e-9, 1e-9}, 0.01);
    Eigen::VectorXd y = Eigen::Vector2d(3, 4);
    double t = 0, dt = 0.1;
    used->try_step(ode, y, t, dt);
    used->reset();
    Eigen::VectorXd a = Eigen::Vector2d(1, 0), b = a;
    double t_a = 0, dt_a = 0.1, t_b = 0, dt_b = 0.1;
    EXPECT_EQ(used->try_step(ode, a, t_a, dt_a), fresh->try_step(ode, b, t_b, dt_b));
    EXPECT_EQ(a, b);
    EXPECT_EQ(t_a, t_b);
    EXPECT_EQ(dt_a, dt_b);
  }
}

}  // namespace
}  // namespace vlbeam::test
