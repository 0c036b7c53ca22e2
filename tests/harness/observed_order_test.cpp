#include "tools/observed_order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/error.hpp"

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
  EXPECT_EQ(fit.last, 4U);
  EXPECT_EQ(fit.pairwise_orders.size(), 3U);
  EXPECT_NEAR(fit.slope, 4, 0.05);
  EXPECT_EQ(broken_order_rule(fit, fourth), "");
}

TEST(ObservedOrder, TooFewLevelsAboveTheFloorFail) {
  const OrderFit fit = fit_order("e", {1, 2, 4}, {1e-2, 1e-13, 1e-14}, {.floor = 1e-12});
  EXPECT_TRUE(std::isnan(fit.slope));
  EXPECT_NE(fit.refusal, "");
  EXPECT_NE(broken_order_rule(fit, fourth), "");
  EXPECT_NE(fit_order("e", {1, 2}, {1e-2, 6.25e-4}).refusal, "") << "a pair is no order";
}

TEST(ObservedOrder, AllLevelsAreFittedUnlessARuleLeavesThemOut) {
  const std::vector<double> n{5, 10, 20, 40, 80};
  const std::vector<double> errors{1, 0.9, 0.9 / 16, 0.9 / 256, 0.9 / 4096};
  const OrderFit all = fit_order("e", n, errors);
  EXPECT_EQ(all.last - all.first, 5U);
  EXPECT_NE(all.refusal, "") << "the first pair is far from the others";
  EXPECT_EQ(all.excluded, "");
  const OrderFit fine =
      fit_order("e", n, errors, {.rule = {.coarsest = 10, .reason = "below, no mesh holds the wave"}});
  EXPECT_EQ(fine.first, 1U);
  EXPECT_NEAR(fine.slope, 4, 1e-12);
  EXPECT_EQ(fine.refusal, "");
  EXPECT_EQ(fine.excluded, "below, no mesh holds the wave");
  const OrderFit middle = fit_order("e", n, errors, {.rule = {.coarsest = 10, .finest = 40, .reason = "r"}});
  EXPECT_EQ(middle.last, 4U);
  const OrderFit steps =
      fit_order("e", {0.4, 0.2, 0.1, 0.05}, {1, 0.9, 0.9 / 16, 0.9 / 256}, {.rule = {.coarsest = 0.2, .reason = "r"}});
  EXPECT_EQ(steps.first, 1U);
}

TEST(ObservedOrder, RulesHaveAReason) {
  EXPECT_FALSE(level_rule_from_json(nullptr).coarsest.has_value());
  EXPECT_EQ(level_rule_from_json({{"coarsest", 10}, {"reason", "r"}}).coarsest, 10);
  EXPECT_EQ(level_rule_from_json({{"finest", 40}, {"reason", "r"}}).finest, 40);
  EXPECT_THROW(level_rule_from_json({{"coarsest", 10}}), InvalidInput);
  EXPECT_THROW(level_rule_from_json({{"coarse", 10}, {"reason", "r"}}), InvalidInput);
  EXPECT_THROW(level_rule_from_json({{"coarsest", "10"}, {"reason", "r"}}), InvalidInput);
  EXPECT_THROW(level_rule_from_json(3), InvalidInput);
}

TEST(ObservedOrder, RefusesWhatShowsNoOrder) {
  const auto refusal = [](std::vector<double> errors) {
    return fit_order("e", {1, 2, 4, 8}, std::move(errors)).refusal;
  };
  EXPECT_EQ(refusal({1, 0.25, 0.0625, 0.015625}), "");
  EXPECT_NE(refusal({1, 0.25, 0.3, 0.05}), "") << "rises";
  EXPECT_NE(refusal({1, 0.25, 0.25, 0.05}), "") << "stands still";
  EXPECT_NE(refusal({1, 1.1, 1.21, 1.331}), "") << "rises with a clean slope";
  EXPECT_NE(refusal({1, 0.25, 0.12, 0.03}), "") << "orders 2, 1, 2";
  EXPECT_NE(refusal({1, 0.25, std::nan(""), 0.03}), "");
}

TEST(ObservedOrder, UncertaintyComesFromScatterAndFromWhatErrorsAreKnownTo) {
  const std::vector<double> n{1, 2, 4, 8};
  const auto scattered = fit_order("e", n, {1, 0.25 * 1.1, 0.0625 / 1.1, 0.015625});
  EXPECT_GT(scattered.slope_uncertainty, 0.02);
  EXPECT_LT(scattered.slope_uncertainty, 0.2);
  EXPECT_NEAR(fit_order("e", n, {1, 0.25, 0.0625, 0.015625}).slope_uncertainty, 0, 1e-12);
  const OrderFit known = fit_order("e", n, {1, 0.25, 0.0625, 0.015625}, {.floor = 1e-3});
  EXPECT_NEAR(known.pair_uncertainties.back(), 1e-3 * (1 / 0.0625 + 1 / 0.015625) / std::log(2), 1e-12);
  EXPECT_NEAR(known.slope_uncertainty, 1e-3 * (1 + 1 / 0.015625) / std::log(8), 1e-12);
}

TEST(ObservedOrder, AReportHoldsAllOfIt) {
  const OrderFit fit =
      fit_order("e", {1, 2, 4, 8}, {2, 1, 0.24, 0.06}, {.floor = 1e-3, .rule = {.coarsest = 2, .reason = "r"}});
  const OrderFit read = fit_from_json(fit_to_json(fit));
  EXPECT_EQ(fit_to_json(read), fit_to_json(fit));
  EXPECT_EQ(read.first, 1U);
  EXPECT_EQ(read.excluded, "r");
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
  // Pairs 4.3, 3.6, 4.1: near enough to be one order, and the mean is fine.
  const OrderFit fit =
      fit_order("e", {1, 2, 4, 8}, {1, std::pow(2.0, -4.05), std::pow(2.0, -7.7), std::pow(2.0, -11.8)});
  EXPECT_EQ(fit.refusal, "");
  EXPECT_NEAR(fit.slope, 3.9, 0.1);
  EXPECT_NE(broken_order_rule(fit, {.expected = 4, .tolerance = 0.3, .at_most = 5, .finest_error = 1}), "");
  EXPECT_EQ(broken_order_rule(fit, {.expected = 4, .tolerance = 0.5, .at_most = 5, .finest_error = 1}), "");
}

TEST(ObservedOrder, RefusesLevelsThatAreNoRefinement) {
  EXPECT_THROW(fit_order("e", {1, 2, 2}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(fit_order("e", {1, 3, 2}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(fit_order("e", {0, 1}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(fit_order("e", {1, 2}, {1}), std::invalid_argument);
}

std::vector<double> values_of_order(double p, double limit, double constant, const std::vector<double>& n) {
  std::vector<double> values;
  for (const double count : n) values.push_back(limit + constant * std::pow(count, -p));
  return values;
}

TEST(GridConvergence, FindsOrderLimitAndAnUncertaintyThatHoldsIt) {
  const std::vector<double> n{40, 80, 120};
  for (const double p : {1.0, 2.0, 4.0, 6.0}) {
    const auto found = grid_convergence("x", n, values_of_order(p, 0.7, -5, n), {.expected_order = p});
    ASSERT_TRUE(found.order.has_value()) << p;
    EXPECT_NEAR(*found.order, p, 1e-3);
    EXPECT_NEAR(*found.limit, 0.7, 1e-9);
    EXPECT_EQ(found.safety_factor, 1.25);
    EXPECT_NEAR(found.uncertainty, 1.25 * 5 * std::pow(120, -p), 1e-2 * 5 * std::pow(120, -p) + 1e-15);
    EXPECT_EQ(found.refusal, "");
  }
}

TEST(GridConvergence, WithoutAnExpectedOrderOrFarFromItTheSafetyFactorIsThree) {
  const std::vector<double> n{10, 20, 40};
  const double error = std::pow(40, -2);
  EXPECT_EQ(grid_convergence("x", n, values_of_order(2, 1, 1, n)).safety_factor, 3);
  EXPECT_NEAR(grid_convergence("x", n, values_of_order(2, 1, 1, n)).uncertainty, 3 * error, 1e-9);
  // Too high an order: Richardson's error is too small, so the expected order is taken.
  const auto high = grid_convergence("x", n, values_of_order(2.9, 1, 1, n), {.expected_order = 2});
  EXPECT_EQ(high.safety_factor, 3);
  EXPECT_NEAR(high.uncertainty, 3 * (std::pow(20, -2.9) - std::pow(40, -2.9)) / 3, 1e-12);
  EXPECT_GT(high.uncertainty, 3 * std::abs(high.values.back() - *high.limit));
  // Too low: the observed one, which gives more.
  const auto low = grid_convergence("x", n, values_of_order(1.5, 1, 1, n), {.expected_order = 2});
  EXPECT_EQ(low.safety_factor, 3);
  EXPECT_NEAR(low.uncertainty, 3 * std::pow(40, -1.5), 1e-9);
}

TEST(GridConvergence, AFourthLevelMustShowTheOrderToo) {
  const std::vector<double> n{5, 10, 20, 40};
  auto values = values_of_order(2, 1, 1, n);
  EXPECT_EQ(grid_convergence("x", n, values, {.expected_order = 2}).safety_factor, 1.25);
  values[0] += 0.01;
  EXPECT_EQ(grid_convergence("x", n, values, {.expected_order = 2}).safety_factor, 3);
}

TEST(GridConvergence, AnOrderFarBetterThanExpectedMustBeSeenTwice) {
  const auto found = [](std::vector<double> levels, std::vector<double> values) {
    return grid_convergence("x", std::move(levels), std::move(values), {.expected_order = 4});
  };
  const auto once = found({2, 4, 8}, values_of_order(6.5, 1, 1, {2, 4, 8}));
  EXPECT_NE(once.refusal.find("three values alone"), std::string::npos);
  EXPECT_NEAR(once.uncertainty, 3 * (std::pow(2, -6.5) - std::pow(8, -6.5)), 1e-12);
  auto values = values_of_order(6.5, 1, 1, {2, 4, 8, 16});
  EXPECT_NEAR(found({2, 4, 8, 16}, values).order.value_or(0), 6.5, 1e-3);
  values[0] = 1.004;
  EXPECT_FALSE(found({2, 4, 8, 16}, values).order.has_value()) << "by chance";
}

TEST(GridConvergence, RefusesOutsideTheAsymptoticRangeAndSaysTheUncertaintyAllTheSame) {
  const auto refused = [](std::vector<double> values, const GridConvergenceOptions& options, double uncertainty) {
    const auto found = grid_convergence("x", {1, 2, 4}, std::move(values), options);
    EXPECT_FALSE(found.limit.has_value());
    EXPECT_FALSE(found.order.has_value());
    EXPECT_NEAR(found.uncertainty, uncertainty, 1e-12);
    return found.refusal;
  };
  EXPECT_NE(refused({1, 2, 1}, {}, 3).find("oscillate"), std::string::npos);
  EXPECT_NE(refused({1, 2, 4}, {}, 9).find("do not shrink"), std::string::npos);
  EXPECT_NE(refused({1, 2, 2.9}, {.expected_order = 4}, 5.7).find("far from the expected"), std::string::npos);
  EXPECT_NE(refused({1, 2, 2 + 1.0 / 512}, {.expected_order = 4}, 3 + 3.0 / 512).find("far from"), std::string::npos);
  EXPECT_NE(refused({1, 1 + 1e-14, 1}, {.floor = 1e-13}, 1e-13).find("floor"), std::string::npos) << "rounding";
  EXPECT_NE(refused({1, 1, 1}, {}, 0).find("floor"), std::string::npos);
}

TEST(GridConvergence, TwoLevelsHaveADifferenceOnly) {
  const auto found = grid_convergence("x", {10, 20}, {1, 1.01});
  EXPECT_FALSE(found.limit.has_value());
  EXPECT_NEAR(found.uncertainty, 0.03, 1e-12);
  EXPECT_TRUE(std::isnan(grid_convergence("x", {10}, {1}).uncertainty));
  EXPECT_TRUE(std::isnan(grid_convergence("x", {10, 20, 40}, {1, std::nan(""), 1}).uncertainty));
}

}  // namespace
}  // namespace vlbeam
