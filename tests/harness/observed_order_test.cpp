#include "studies/harness/observed_order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace vlbeam {
namespace {

const OrderRule fourth{.expected = 4, .tolerance = 0.3, .at_most = 4.5, .finest_error = 1e-3};

std::vector<double> errors_of_order(double p, double constant, const std::vector<double>& h, double higher = 0) {
  std::vector<double> errors;
  for (const double step : h) errors.push_back(constant * std::pow(step, p) * (1 + higher * step));
  return errors;
}

TEST(ObservedOrder, IsExactForAPurePower) {
  const std::vector<double> h{0.4, 0.2, 0.1, 0.05, 0.03};
  const OrderFit fit = fit_order("e", h, errors_of_order(4, 3, h));
  ASSERT_EQ(fit.pairwise_orders.size(), 4U);
  for (const double order : fit.pairwise_orders) EXPECT_NEAR(order, 4, 1e-12);
  EXPECT_NEAR(fit.slope, 4, 1e-12);
  EXPECT_EQ(broken_order_rule(fit, fourth), "");
}

TEST(ObservedOrder, CountsAndStepsAreTheSameRefinement) {
  const std::vector<double> h{1.0 / 5, 1.0 / 10, 1.0 / 20, 1.0 / 40};
  const auto errors = errors_of_order(2, 1, h, 0.7);
  const OrderFit steps = fit_order("e", h, errors);
  const OrderFit counts = fit_order("e", {5, 10, 20, 40}, errors);
  EXPECT_NEAR(steps.slope, counts.slope, 1e-12);
  EXPECT_NEAR(steps.slope, 2, 0.1);
}

TEST(ObservedOrder, HigherTermsFadeWithRefinement) {
  const std::vector<double> h{0.4, 0.2, 0.1, 0.05, 0.025};
  const OrderFit fit = fit_order("e", h, errors_of_order(4, 1, h, 2));
  for (std::size_t i = 1; i < fit.pairwise_orders.size(); ++i) {
    EXPECT_LT(std::abs(fit.pairwise_orders[i] - 4), std::abs(fit.pairwise_orders[i - 1] - 4));
  }
}

TEST(ObservedOrder, StopsAtTheRoundoffFloor) {
  const OrderFit fit =
      fit_order("e", {1, 2, 4, 8, 16, 32}, {1e-2, 6.25e-4, 3.9e-5, 2.4e-6, 3e-13, 8e-13}, {.floor = 1e-12});
  EXPECT_EQ(fit.used, 4U);
  EXPECT_EQ(fit.pairwise_orders.size(), 3U);
  EXPECT_NEAR(fit.slope, 4, 0.05);
  EXPECT_EQ(broken_order_rule(fit, fourth), "");
}

TEST(ObservedOrder, TooFewLevelsAboveTheFloorFail) {
  const OrderFit fit = fit_order("e", {1, 2, 4}, {1e-2, 6e-4, 1e-13}, {.floor = 1e-12});
  EXPECT_TRUE(std::isnan(fit.slope));
  EXPECT_NE(broken_order_rule(fit, fourth), "");
}

TEST(OrderRule, EveryPartCanFail) {
  const std::vector<double> n{5, 10, 20, 40};
  const auto broken = [&](std::vector<double> errors) {
    return broken_order_rule(fit_order("e", n, std::move(errors)), fourth);
  };
  EXPECT_EQ(broken({4.096e-1, 2.56e-2, 1.6e-3, 1e-4}), "");
  EXPECT_NE(broken({1e-1, 2.5e-2, 6.25e-3, 1.6e-3}), "") << "second order";
  EXPECT_NE(broken({1e-1, 3.1e-3, 1e-4, 3e-6}), "") << "fifth order: too good";
  EXPECT_NE(broken({4.096e1, 2.56, 1.6e-1, 1e-2}), "") << "fourth order, but the finest error is too large";
  EXPECT_NE(broken({1, 1e-1, 1.5e-3, 3e-4}), "") << "a good pair must not hide a bad one";
  EXPECT_NE(broken({4.096e-1, 2.56e-2, 1.6e-3, std::numeric_limits<double>::quiet_NaN()}), "");
  EXPECT_NE(broken({4.096e-1, 2.56e-2, std::numeric_limits<double>::infinity(), 1e-4}), "");
}

TEST(OrderRule, AGoodMeanDoesNotExcuseABadPair) {
  // Pairs 6 and 2 have the mean slope 4.
  const OrderFit fit = fit_order("e", {1, 2, 4}, {1, std::pow(2.0, -6), std::pow(2.0, -8)});
  EXPECT_NEAR(fit.slope, 4, 1e-12);
  EXPECT_NE(broken_order_rule(fit, {.expected = 4, .tolerance = 0.3, .at_most = 5, .finest_error = 1}), "");
}

TEST(ObservedOrder, RefusesLevelsThatAreNoRefinement) {
  EXPECT_THROW(fit_order("e", {1, 2, 2}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(fit_order("e", {1, 3, 2}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(fit_order("e", {0, 1}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(fit_order("e", {1, 2}, {1}), std::invalid_argument);
}

TEST(SelfConvergence, FindsOrderLimitAndError) {
  const std::array<double, 3> h{1.0 / 40, 1.0 / 80, 1.0 / 120};
  for (const double p : {1.0, 2.0, 4.0, 6.0}) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) values[i] = 0.7 - 5 * std::pow(h[i], p);
    const auto found = self_convergence(h, values);
    ASSERT_TRUE(found.has_value()) << p;
    EXPECT_NEAR(found->order, p, 1e-3);
    EXPECT_NEAR(found->limit, 0.7, 1e-9);
    EXPECT_NEAR(found->finest_error, 5 * std::pow(h[2], p), 1e-3 * 5 * std::pow(h[2], p) + 1e-15);
  }
}

TEST(SelfConvergence, SaysNothingWhereThereIsNone) {
  EXPECT_FALSE(self_convergence({4, 2, 1}, {1, 2, 1}).has_value()) << "oscillates";
  EXPECT_FALSE(self_convergence({4, 2, 1}, {1, 2, 4}).has_value()) << "diverges";
  EXPECT_FALSE(self_convergence({4, 2, 1}, {1, 1, 1}).has_value()) << "has arrived";
}

}  // namespace
}  // namespace vlbeam
