#include "mechanics/time/integrate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "tests/core/support/function_ode.hpp"

namespace vlbeam::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using State = Eigen::VectorXd;

State scalar(double value) { return State::Constant(1, value); }

std::size_t steps_by(StepLimit limit, const StepsByLimit& counts) { return counts[static_cast<std::size_t>(limit)]; }

class Integrate : public ::testing::TestWithParam<IntegrationMethod> {
 protected:
  bool run(EventedOde& ode, double t_end, const std::vector<double>& sample_times = {}, double tolerance = 1e-10) {
    options_.type = GetParam();
    options_.tolerances = {tolerance, tolerance};
    return integrate(ode, y_, t_, t_end, sample_times, options_, counters_);
  }

  State y_ = Eigen::Vector2d(1, 0);
  double t_ = 0;
  IntegrationOptions options_;
  SolverCounters counters_;
};

INSTANTIATE_TEST_SUITE_P(AllSteppers, Integrate, ::testing::ValuesIn(integrators));

TEST_P(Integrate, FollowsAnOscillatorWithinItsTolerance) {
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    auto ode = oscillator();
    y_ = Eigen::Vector2d(1, 0);
    t_ = 0;
    ASSERT_TRUE(run(ode, 10, {}, tolerance));
    EXPECT_EQ(t_, 10);
    EXPECT_LE(std::hypot(y_[0] - std::cos(10), y_[1] + std::sin(10)), 30 * tolerance);
  }
  EXPECT_GT(counters_.steps, 0U);
  EXPECT_GT(counters_.smallest_step, 0);
}

TEST_P(Integrate, TellsWhatLimitedEachStep) {
  auto ode = oscillator();
  ode.guard = [&ode](const State& y, double) { return ode.events.empty() ? 0.5 - y[0] : -1; };
  options_.first_step = 1;  // the method rejects it
  ASSERT_TRUE(run(ode, 10));
  EXPECT_EQ(std::accumulate(counters_.limited_by.begin(), counters_.limited_by.end(), std::size_t{0}), counters_.steps);
  EXPECT_EQ(steps_by(StepLimit::events, counters_.limited_by), 1U);
  EXPECT_LE(steps_by(StepLimit::given, counters_.limited_by), 1U) << "the last step alone ends with the run";
  EXPECT_EQ(counters_.rejected_by, (StepsByLimit{0, counters_.rejected, 0, 0}));
}

TEST_P(Integrate, SamplesAreOnTheSolution) {
  auto ode = oscillator();
  run(ode, 3, {0, 0.1, 0.10001, 1.234, 3});
  ASSERT_EQ(ode.samples.size(), 5U);
  for (const auto& [t, y] : ode.samples) {
    EXPECT_NEAR(y[0], std::cos(t), 1e-9);
    EXPECT_NEAR(y[1], -std::sin(t), 1e-9);
  }
  EXPECT_EQ(ode.samples.front().y, Eigen::Vector2d(1, 0));
  EXPECT_EQ(ode.samples.back().y, y_);
}

TEST_P(Integrate, SamplesChangeNeitherStepsNorDigits) {
  auto bouncing = [] {
    auto ode = oscillator();
    ode.guard = [](const State& y, double) { return 0.3 - y[0]; };
    ode.on_event = [](int, State& y) { y[1] = -y[1]; };
    return ode;
  };
  auto quiet = bouncing(), watched = bouncing();
  run(quiet, 8);
  const State y = y_;
  const auto steps = counters_.steps;
  y_ = Eigen::Vector2d(1, 0);
  t_ = 0;
  counters_ = {};
  std::vector<double> times;
  for (int i = 0; i <= 800; ++i) times.push_back(i * 0.01);
  run(watched, 8, times);
  EXPECT_EQ(y_, y);
  EXPECT_EQ(counters_.steps, steps);
  ASSERT_EQ(watched.events.size(), quiet.events.size());
  for (std::size_t i = 0; i < quiet.events.size(); ++i) EXPECT_EQ(watched.events[i].t, quiet.events[i].t);
  EXPECT_EQ(watched.samples.size(), times.size());
}

TEST_P(Integrate, EventsAreLocated) {
  auto ode = oscillator();
  ode.guard = [](const State& y, double) { return 0.3 - y[0]; };
  ode.on_event = [](int, State& y) { y[1] = -y[1]; };  // thrown back: the motion is periodic
  const double fall = std::acos(0.3);
  run(ode, 10, {}, 1e-13);
  ASSERT_EQ(ode.events.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(ode.events[i].index, 0);
    EXPECT_NEAR(ode.events[i].t, fall * (2 * static_cast<double>(i) + 1), 1e-10);
  }
  EXPECT_NEAR(y_[0], std::cos(10 - 8 * fall), 1e-10) << "and the run goes on from where the event was";
}

TEST_P(Integrate, TheFirstOfTwoEventsInAStepComesFirst) {
  FunctionOde ode(1, [](const State&, double) -> State { return scalar(1); });
  ode.guard = [](const State& y, double) { return y[0] - 0.7; };
  ode.second_guard = [](const State& y, double) { return y[0] - 0.4; };
  ode.on_event = [&ode](int index, State&) { (index == 0 ? ode.guard : ode.second_guard) = nullptr; };
  y_ = scalar(0);
  options_.first_step = 1;  // one step would do
  run(ode, 1);
  ASSERT_EQ(ode.events.size(), 2U);
  EXPECT_EQ(ode.events[0].index, 1);
  EXPECT_NEAR(ode.events[0].t, 0.4, 1e-10);
  EXPECT_EQ(ode.events[1].index, 0);
  EXPECT_NEAR(ode.events[1].t, 0.7, 1e-10);
}

/// Beyond the first event a step may have nowhere to go: an event that comes later costs nothing.
TEST_P(Integrate, LooksNoFartherThanTheFirstEvent) {
  std::vector<int> evaluations;
  for (const bool two : {false, true}) {
    int count = 0;
    FunctionOde ode(1, [&](const State& /*y*/, double) -> State {
      ++count;
      return scalar(1);
    });
    ode.guard = [](const State& y, double) { return y[0] - 0.4; };
    if (two) ode.second_guard = [](const State& y, double) { return y[0] - 0.7; };
    ode.on_event = [&](int, State& /*y*/) { ode.guard = ode.second_guard = nullptr; };
    y_ = scalar(0);
    t_ = 0;
    options_.first_step = 1;
    run(ode, 1);
    ASSERT_EQ(ode.events.size(), 1U);
    EXPECT_NEAR(ode.events[0].t, 0.4, 1e-10);
    evaluations.push_back(count);
  }
  EXPECT_EQ(evaluations[1], evaluations[0]);
}

TEST_P(Integrate, AnEventMayChangeTheEquationsAndTheSize) {
  FunctionOde ode(1, [](const State& y, double) -> State { return State::Ones(y.size()); });
  ode.guard = [](const State& y, double) { return y.size() == 1 ? y[0] - 0.5 : -1.0; };
  ode.on_event = [](int, State& y) {
    y.conservativeResize(2);
    y[1] = 10;
  };
  y_ = scalar(0);
  run(ode, 1, {0.25, 0.75});
  ASSERT_EQ(y_.size(), 2);
  EXPECT_NEAR(y_[0], 1, 1e-10);
  EXPECT_NEAR(y_[1], 10.5, 1e-10);
  EXPECT_EQ(ode.samples[0].y.size(), 1);
  EXPECT_EQ(ode.samples[1].y.size(), 2);
}

TEST_P(Integrate, StepsOutsideTheDomainAreRepeatedShorter) {
  // y' = -y is not defined where y < 0; a first step of 10 s leads there
  FunctionOde ode(1, [](const State& y, double) -> State { return scalar(y[0] < 0 ? nan : -y[0]); });
  y_ = scalar(1);
  options_.first_step = 10;
  ASSERT_TRUE(run(ode, 10));
  EXPECT_NEAR(y_[0], std::exp(-10), 1e-9);
  EXPECT_GT(counters_.rejected, 0U);
}

TEST_P(Integrate, AWallOfTheDomainIsAStepUnderflow) {
  FunctionOde ode(1, [](const State& y, double) -> State { return scalar(y[0] < 0.5 ? 1 : nan); });
  y_ = scalar(0);
  options_.first_step = 0.1;
  try {
    run(ode, 1);
    FAIL() << "the wall was passed";
  } catch (const ComputationFailed& failure) {
    EXPECT_NEAR(failure.t, 0.5, 1e-6);
    EXPECT_NEAR(t_, failure.t, 1e-15) << "the last good state is handed back";
    EXPECT_NEAR(y_[0], t_, 1e-6);
    EXPECT_NE(std::string(failure.what()).find("underflow"), std::string::npos);
  }
}

TEST_P(Integrate, ASolutionThatBlowsUpIsAStepUnderflow) {
  FunctionOde ode(1, [](const State& y, double) -> State { return scalar(y[0] * y[0]); });  // y = 1/(1 - t)
  y_ = scalar(1);
  options_.first_step = 0.01;
  try {
    run(ode, 2);
    FAIL() << "y = " << y_[0];
  } catch (const ComputationFailed& failure) {
    EXPECT_NEAR(failure.t, 1, 1e-3);
  }
}

TEST_P(Integrate, ACascadeOfEventsIsAFailure) {
  auto ode = oscillator();
  ode.guard = [](const State&, double t) { return t - 0.25; };  // the event does not take its cause away
  try {
    run(ode, 1);
    FAIL();
  } catch (const ComputationFailed& failure) {
    EXPECT_NEAR(failure.t, 0.25, 1e-10);
    EXPECT_NE(std::string(failure.what()).find("cascade"), std::string::npos);
  }
  EXPECT_GT(ode.events.size(), 1U);
}

TEST_P(Integrate, AFewEventsAtOneInstantAreNoCascade) {
  auto ode = oscillator();
  int left = 3;
  ode.guard = [&](const State&, double t) { return left > 0 ? t - 0.25 : -1.0; };
  ode.on_event = [&](int, State&) { --left; };
  EXPECT_TRUE(run(ode, 1));
  ASSERT_EQ(ode.events.size(), 3U);
  for (const auto& event : ode.events) EXPECT_NEAR(event.t, 0.25, 1e-10);
}

TEST_P(Integrate, AnEventAtTheVeryStartIsHandled) {
  auto ode = oscillator();
  ode.guard = [](const State& y, double) { return y[0] - 0.9; };
  ode.on_event = [](int, State& y) { y << 0.5, 0; };
  EXPECT_TRUE(run(ode, 1));
  ASSERT_EQ(ode.events.size(), 1U);
  EXPECT_EQ(ode.events[0].t, 0);
  EXPECT_NEAR(y_[0], 0.5 * std::cos(1), 1e-8);
}

TEST_P(Integrate, MayBeInterrupted) {
  auto ode = oscillator();
  ode.interrupt_at = 0.5;
  EXPECT_FALSE(run(ode, 100));
  EXPECT_GE(t_, 0.5);
  EXPECT_LT(t_, 10);
}

TEST(SideSteps, ThatCannotBeTakenHalveTheMainStep) {
  // y' = 1, undefined early on but for the stages of steps of 0.5 and 1 s: the event at 0.6 s cannot be reached from 0
  FunctionOde ode(1, [](const State&, double t) -> State {
    return scalar((t > 0 && t < 0.09) || (t > 0.155 && t < 0.19) ? nan : 1);
  });
  ode.guard = [&ode](const State& y, double) { return ode.events.empty() ? y[0] - 0.6 : -1; };
  IntegrationOptions options;
  options.first_step = 1;
  SolverCounters counters;
  State y = scalar(0);
  double t = 0;
  EXPECT_TRUE(integrate(ode, y, t, 1, {0.55, 0.95}, options, counters));
  EXPECT_NEAR(y[0], 1, 1e-12);
  EXPECT_EQ(counters.rejected, 1U);
  EXPECT_EQ(counters.rejected_by, (StepsByLimit{0, 0, 0, 1}));
  EXPECT_EQ(steps_by(StepLimit::events, counters.limited_by), 2U) << "the half, and what ends at the event";
  ASSERT_EQ(ode.events.size(), 1U);
  EXPECT_NEAR(ode.events[0].t, 0.6, 1e-12);
  ASSERT_EQ(ode.samples.size(), 2U);
  for (const auto& sample : ode.samples) EXPECT_NEAR(sample.y[0], sample.t, 1e-12);
}

TEST(SideSteps, ThatCannotBeTakenAtAllAreAStepUnderflow) {
  FunctionOde ode(1, [](const State&, double t) -> State { return scalar(t > 0 && t < 0.19 ? nan : 1); });
  ode.guard = [](const State& y, double) { return y[0] - 0.6; };
  IntegrationOptions options;
  options.first_step = 1;
  SolverCounters counters;
  State y = scalar(0);
  double t = 0;
  EXPECT_THROW(integrate(ode, y, t, 1, {}, options, counters), ComputationFailed);
  EXPECT_EQ(t, 0) << "the last good state is handed back";
  EXPECT_EQ(y[0], 0);
}

/// The Adams-Bashforth-Moulton method and an oscillator that a wall throws back four times until t = 10.
class Multistep : public ::testing::Test {
 protected:
  struct Outcome {
    State y;
    SolverCounters counters;
    FunctionOde ode;
  };

  Outcome run(double step, const std::vector<double>& sample_times = {}) {
    Outcome outcome{Eigen::Vector2d(1, 0), {}, oscillator()};
    outcome.ode.guard = [](const State& y, double) { return 0.3 - y[0]; };
    outcome.ode.on_event = [](int, State& y) { y[1] = -y[1]; };
    options_.type = IntegrationMethod::adams_bashforth_moulton;
    options_.step = step;
    double t = 0;
    EXPECT_TRUE(integrate(outcome.ode, outcome.y, t, 10, sample_times, options_, outcome.counters));
    return outcome;
  }
  double error(double step) { return std::abs(run(step).y[0] - std::cos(10 - 8 * std::acos(0.3))); }

  IntegrationOptions options_;
};

TEST_F(Multistep, KeepsItsOrderAcrossLocatedEvents) {
  EXPECT_EQ(run(0.01).ode.events.size(), 4U);
  const double coarse = error(0.04), fine = error(0.01);
  EXPECT_NEAR(std::log2(coarse / fine) / 2, 5, 0.4) << coarse << " " << fine;
}

TEST_F(Multistep, LosesItsOrderWhereEventsComeLate) {
  options_.locate_events = false;
  const auto seen = run(0.04).ode.events;
  ASSERT_EQ(seen.size(), 4U);
  EXPECT_NEAR(std::remainder(seen.front().t, 0.04), 0, 1e-12) << "at the end of a step";
  EXPECT_GT(seen.front().t, std::acos(0.3));
  EXPECT_LE(std::log2(error(0.04) / error(0.0025)) / 4, 1.5);
}

TEST_F(Multistep, SamplesChangeNeitherStepsNorDigits) {
  const auto quiet = run(0.01);
  std::vector<double> times;
  for (int i = 0; i <= 3000; ++i) times.push_back(10 * i / 3000.0);
  const auto watched = run(0.01, times);
  EXPECT_EQ(watched.y, quiet.y);
  EXPECT_EQ(watched.counters.steps, quiet.counters.steps);
  ASSERT_EQ(watched.ode.samples.size(), times.size());
  const double fall = std::acos(0.3);
  for (const auto& [t, y] : watched.ode.samples) {
    EXPECT_NEAR(y[0], std::cos(std::remainder(t, 2 * fall)), 1e-9) << t;
  }
}

TEST_F(Multistep, AStepOutsideTheDomainIsRepeatedShorter) {
  // y' = -y is not defined where y < 0: a step of 10 s leads there
  FunctionOde ode(1, [](const State& y, double) -> State { return scalar(y[0] < 0 ? nan : -y[0]); });
  options_.type = IntegrationMethod::adams_bashforth_moulton;
  options_.step = 10;
  State y = scalar(1);
  double t = 0;
  SolverCounters counters;
  EXPECT_TRUE(integrate(ode, y, t, 10, {}, options_, counters));
  EXPECT_GT(counters.rejected, 0U);
  EXPECT_EQ(counters.rejected_by, (StepsByLimit{0, counters.rejected, 0, 0}));
  EXPECT_NEAR(y[0], std::exp(-10), 1e-4);
}

}  // namespace
}  // namespace vlbeam::test
