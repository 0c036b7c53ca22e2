// Functions of time that a scene describes.
#include "scene/time_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"

namespace vlbeam {
namespace {

/// Rates and accelerations are the derivatives of the values.
void expect_derivatives(const TimeSpec& spec, const std::vector<double>& times) {
  const TimeFunction f = time_function(spec);
  const double h = 1e-5;
  for (const double t : times) {
    EXPECT_NEAR(f(t).rate, (f(t + h).value - f(t - h).value) / (2 * h), 1e-7) << t;
    EXPECT_NEAR(f(t).acceleration, (f(t + h).rate - f(t - h).rate) / (2 * h), 1e-6) << t;
  }
}

TEST(TimeFunction, OfARampedRateNeverRunsFasterAndComesHalfTheRampLate) {
  const TimeSpec spec{.value = 0.5, .rate = 20, .rate_ramp = 0.4};
  const TimeFunction f = time_function(spec);
  EXPECT_EQ(f(0).value, 0.5);
  EXPECT_EQ(f(0).rate, 0);
  double fastest = 0;
  for (int i = 0; i <= 100; ++i) fastest = std::max(fastest, f(0.01 * i).rate);
  EXPECT_EQ(fastest, 20);
  EXPECT_NEAR(f(0.4).value, 0.5 + 20 * 0.2, 1e-14);
  EXPECT_NEAR(f(3).value, 0.5 + 20 * (3 - 0.2), 1e-13);
  expect_derivatives(spec, {0.05, 0.2, 0.39, 0.41, 2});
  const TimeSpec whole{.rate = 20, .ramp = 0.4};
  double much_faster = 0;
  for (int i = 0; i <= 100; ++i) much_faster = std::max(much_faster, time_function(whole)(0.004 * i).rate);
  EXPECT_GT(much_faster, 37) << "which is what the other ramp does";
}

TEST(TimeFunction, OfATablePassesItsEntriesWithoutOvershoot) {
  TimeSpec spec;
  spec.table = {{1, 2, 0}, {1.5, 2.5, 0}, {3, 6, 0}, {4, 6, 0}, {5, 5, 0}};
  const TimeFunction f = time_function(spec);
  for (const Point& entry : spec.table) EXPECT_NEAR(f(entry[0]).value, entry[1], 1e-14);
  EXPECT_EQ(f(0).value, 2);
  EXPECT_EQ(f(9).value, 5);
  for (const double t : {0.0, 1.0, 3.0, 4.0, 5.0, 9.0}) EXPECT_EQ(f(t).rate, 0) << "at rest at ends and turns, " << t;
  double before = f(1).value;
  for (int i = 1; i <= 300; ++i) {
    const double now = f(1 + 0.01 * i).value;
    EXPECT_GE(now, before - 1e-14) << "it rises up to t = 4";
    EXPECT_LE(now, 6 + 1e-14);
    before = now;
  }
  expect_derivatives(spec, {1.2, 1.7, 2.9, 3.5, 4.4});
}

TEST(TimeFunction, ASmoothTableIsASplineThatRestsWhereItSaysTheSameTwice) {
  TimeSpec spec;
  spec.table = {{1, 2, 0}, {1.5, 2.5, 0}, {3, 6, 0}, {4, 6, 0}, {5, 5, 0}, {5.5, 4.2, 0}, {7, 4, 0}};
  spec.smooth = true;
  const TimeFunction f = time_function(spec);
  for (const Point& entry : spec.table) EXPECT_NEAR(f(entry[0]).value, entry[1], 1e-14);
  for (const double t : {0.0, 1.0, 3.0, 4.0, 7.0, 9.0}) EXPECT_EQ(f(t).rate, 0) << "at rest, " << t;
  for (const double t : {3.2, 3.9}) EXPECT_EQ(f(t).value, 6) << "and stays there, " << t;
  for (const double t : {1.5, 5.0, 5.5}) {
    EXPECT_NEAR(f(t - 1e-9).acceleration, f(t + 1e-9).acceleration, 1e-6) << "the acceleration does not jump, " << t;
  }
  expect_derivatives(spec, {1.2, 1.7, 2.9, 4.4, 6});
  spec.table.clear();
  EXPECT_THROW(check_time_function("/x", spec), InvalidInput);

  TimeSpec wave;  // ten points of a cosine: a spline with its rates at the ends errs by the fourth power
  for (int i = 0; i <= 10; ++i) wave.table.push_back({0.1 * i, -std::cos(std::numbers::pi * 0.1 * i), 0});
  wave.smooth = true;
  const TimeFunction of_ten = time_function(wave);
  for (int i = 0; i <= 100; ++i) {
    EXPECT_NEAR(of_ten(0.01 * i).value, -std::cos(std::numbers::pi * 0.01 * i),
                5 * std::pow(0.1 * std::numbers::pi, 4) / 384);
  }
}

TEST(TimeFunction, ItsPartsExcludeEachOther) {
  const auto refused = [](const TimeSpec& spec) -> std::string {
    try {
      check_time_function("/x", spec);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return "nothing";
  };
  EXPECT_EQ(refused({.rate = 1, .ramp = 1}), "nothing");
  EXPECT_EQ(refused({.rate = 1, .ramp = 1, .rate_ramp = 1}), "/x/rate_ramp");
  TimeSpec table;
  table.table = {{0, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(refused(table), "nothing");
  table.rate = 1;
  EXPECT_EQ(refused(table), "/x/table");
  table.rate = 0;
  table.table.push_back({1, 2, 0});
  EXPECT_EQ(refused(table), "/x/table/2/0");
  table.table.resize(1);
  EXPECT_EQ(refused(table), "/x/table");
}

}  // namespace
}  // namespace vlbeam
