// Steps that end at an event, because it was foreseen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/support/second_order_oscillator.hpp"

namespace vlbeam::test {
namespace {

struct Outcome {
  Eigen::VectorXd state = Eigen::Vector2d(1, 0);
  SolverCounters counters;
  SecondOrderOscillator ode;

  void run(double step, double t_end, bool adaptive = false, const std::vector<double>& sample_times = {}) {
    IntegrationOptions options;
    options.type = IntegrationMethod::generalized_alpha;
    options.generalized_alpha.adaptive = adaptive;
    options.generalized_alpha.step = step;
    options.generalized_alpha.newton_tolerance = 1e-13;
    if (adaptive) options.generalized_alpha.first_step = 1e-3;
    options.generalized_alpha.tolerances = {1e-5, 1e-5};
    double t = 0;
    EXPECT_TRUE(integrate(ode, state, t, t_end, sample_times, options, counters));
    EXPECT_EQ(t, t_end);
  }
  void wall(double at) {
    ode.guard = [at](const Eigen::VectorXd& y, double) { return at - y[0]; };
    ode.on_event = [at, this](int, Eigen::VectorXd& y) {
      largest_miss = std::max(largest_miss, std::abs(y[0] - at));
      y[1] = -y[1];
    };
  }

  double largest_miss = 0;
};

TEST(AimedSteps, EndAtTheEvent) {
  Outcome bouncing, free;
  bouncing.wall(0.3);
  bouncing.run(0.05, 10);
  free.run(0.05, 10);
  EXPECT_EQ(bouncing.ode.events.size(), 4U);
  EXPECT_LE(bouncing.largest_miss, 1e-12);
  EXPECT_NEAR(bouncing.state[0], std::cos(10 - 8 * std::acos(0.3)), 1e-2);
  // a step to the event, and two like it; neither the whole step nor those of another stepper
  EXPECT_LE(bouncing.ode.residuals, free.ode.residuals + 7 * 4);
  EXPECT_EQ(bouncing.counters.smallest_step, 0.05);
}

TEST(AimedSteps, AreAMillionthLongerWhereTheyAllButReachAnEvent) {
  for (const double share : {1e-7, 5e-5}) {  // of a step, that the event is behind its end
    Outcome run;
    const double at = 0.05 * (10 + share);
    run.ode.guard = [&](const Eigen::VectorXd&, double t) { return run.ode.events.empty() ? 20 * (t - at) : -1; };
    run.run(0.05, 1);
    ASSERT_EQ(run.ode.events.size(), 1U);
    EXPECT_NEAR(run.ode.events.front().t, at, 1e-12);
    EXPECT_EQ(run.counters.steps, share < 1e-6 ? 20U : 21U);  // no short one to an event that the tenth ends at
    EXPECT_LE(run.state.norm(), 2);
  }
  for (const double rest : {0.0, 2e-9, 5e-7}) {  // of a step, that is left behind the last whole one
    const double t_end = 0.05 * (10 + rest);
    Outcome end;  // but not beyond the end of the run
    end.ode.guard = [&](const Eigen::VectorXd&, double t) { return 20 * (t - t_end - 0.05 * 1e-7); };
    end.run(0.05, t_end);
    EXPECT_TRUE(end.ode.events.empty()) << rest;
  }
}

TEST(AimedSteps, EndAtTheFirstOfTwo) {
  for (const auto& times : {std::pair{0.512, 0.537}, {0.537, 0.512}, {0.512, 0.5121}}) {
    const double first = times.first, second = times.second;
    Outcome run;
    run.ode.guard = [&run, first](const Eigen::VectorXd&, double t) {
      return std::ranges::count(run.ode.events, 0, &FunctionOde::EventSeen::index) > 0 ? -1 : t - first;
    };
    run.ode.second_guard = [&run, second](const Eigen::VectorXd&, double t) {
      return std::ranges::count(run.ode.events, 1, &FunctionOde::EventSeen::index) > 0 ? -1 : t - second;
    };
    run.run(0.05, 1);
    ASSERT_EQ(run.ode.events.size(), 2U);
    EXPECT_EQ(run.ode.events[0].index, first < second ? 0 : 1);
    EXPECT_NEAR(run.ode.events[0].t, std::min(first, second), 1e-12);
    EXPECT_NEAR(run.ode.events[1].t, std::max(first, second), 1e-12);
  }
}

// Steps of half a second go elsewhere than accelerations tell, by up to 0.02: events are foreseen that do not come, and
// come unforeseen.
TEST(AimedSteps, MayBeWrong) {
  for (int i = 0; i <= 400; ++i) {
    const double level = -1.02 + 2.04 * i / 400;
    Outcome run;
    run.ode.guard = [level, &run](const Eigen::VectorXd& y, double) {
      return run.ode.events.empty() ? level - y[0] : -1;
    };
    double at = 1;
    run.ode.on_event = [&at](int, Eigen::VectorXd& y) { at = y[0]; };
    run.run(0.5, 3);  // falling all the way
    if (level < std::cos(3) - 0.05 || level > 1) continue;
    if (level > std::cos(3) + 0.05) {
      ASSERT_EQ(run.ode.events.size(), 1U) << level;
    }
    if (!run.ode.events.empty()) {
      EXPECT_NEAR(at, level, 1e-10);
    }
  }
}

TEST(AimedSteps, DoNotDependOnSamples) {
  for (const bool adaptive : {false, true}) {
    Outcome quiet, watched;
    quiet.wall(0.3);
    watched.wall(0.3);
    quiet.run(0.05, 10, adaptive);
    std::vector<double> times;
    for (int i = 0; i <= 3000; ++i) times.push_back(10 * i / 3000.0);
    watched.run(0.05, 10, adaptive, times);
    EXPECT_EQ(watched.state, quiet.state);
    EXPECT_EQ(watched.counters.steps, quiet.counters.steps);
    EXPECT_EQ(watched.ode.samples.size(), times.size());
  }
}

TEST(AimedSteps, DoNotDependOnTheEndOfTheRun) {
  for (int i = 1; i <= 100; ++i) {
    const double end = 0.04 * i;
    Outcome to_there, beyond;
    to_there.wall(0.3);
    beyond.wall(0.3);
    to_there.run(0.3, end, true, {end});
    beyond.run(0.3, 2 * end, true, {end});
    EXPECT_EQ(to_there.state, beyond.ode.samples.front().y) << end;
  }
}

}  // namespace
}  // namespace vlbeam::test
