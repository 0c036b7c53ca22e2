#include <gtest/gtest.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "scene/names.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// A sample of q, the end's position, and one of q', the momentum of everything.
struct State {
  Eigen::Vector2d q, v;
  double steps;
};

State final_state(Scene scene) {
  scene.output.interval = scene.duration;
  const RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  const Sample& last = result.samples.back();
  return {{last.end[0], last.end[1]}, {last.momentum[0], last.momentum[1]}, static_cast<double>(result.solver.steps)};
}

/// With the step, or the tolerance of a method that chooses it.
State final_state(Scene scene, IntegratorType type, double fineness) {
  if (has_fixed_step(type)) {
    scene.integrator.type = type;
    scene.integrator.step = fineness;
  } else {
    set_tolerance(scene, type, fineness);
  }
  return final_state(scene);
}

struct Order {
  double q, v;
};

/// Slope of the error over the number of steps, from the coarsest to the finest run. Each is the mean of five nearby
/// ones: where an event falls into its step is a matter of luck.
Order observed_order(const Scene& scene, IntegratorType type, double coarsest, double finest) {
  Scene located = scene;
  located.integrator.locate_events = true;
  const State exact = final_state(located, IntegratorType::fehlberg78, 1e-13);
  auto mean_error = [&](double fineness) {
    State error{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), 0};
    for (const double nearby : {1.0, 0.9, 0.8, 0.7, 0.6}) {
      const State state = final_state(scene, type, nearby * fineness);
      error.q[0] += (state.q - exact.q).norm() / 5;
      error.v[0] += (state.v - exact.v).norm() / 5;
      error.steps += state.steps / 5;
    }
    return error;
  };
  const State coarse = mean_error(coarsest), fine = mean_error(finest);
  const double steps = std::log(fine.steps / coarse.steps);
  return {std::log(coarse.q[0] / fine.q[0]) / steps, std::log(coarse.v[0] / fine.v[0]) / steps};
}

struct Method {
  IntegratorType type;
  double order, tolerance;
  double coarsest, finest;  ///< steps [s] or tolerances

  friend void PrintTo(const Method& method, std::ostream* out) { *out << to_string(method.type); }
};

class SmoothMotion : public ::testing::TestWithParam<Method> {};

TEST_P(SmoothMotion, ShowsTheOrderOfTheMethod) {
  const auto [type, order, tolerance, coarsest, finest] = GetParam();
  auto scene = flexible_pendulum(4);
  scene.beam.material.youngs_modulus = 1e6;
  scene.duration = 0.3;
  const Order observed = observed_order(scene, type, coarsest, finest);
  EXPECT_NEAR(observed.q, order, tolerance);
  EXPECT_NEAR(observed.v, order, tolerance);
}

INSTANTIATE_TEST_SUITE_P(Steppers, SmoothMotion,
                         ::testing::Values(Method{IntegratorType::dopri5, 5, 0.5, 1e-6, 1e-10},
                                           Method{IntegratorType::cash_karp, 5, 0.5, 1e-6, 1e-10},
                                           Method{IntegratorType::fehlberg78, 8, 0.8, 1e-5, 1e-8},
                                           Method{IntegratorType::rosenbrock4, 4, 0.5, 1e-6, 1e-9},
                                           Method{IntegratorType::adams_bashforth_moulton, 5, 0.3, 8e-4, 2e-4},
                                           Method{IntegratorType::generalized_alpha, 2, 0.1, 2e-3, 5e-4}));

/// A soft beam along which the mass slides past one length-control event. What a merge excites is then slow enough for
/// steps of a millisecond.
Scene sliding_past_an_event() {
  auto scene = falling_beam(ElementKind::ale_ancf, 4);
  scene.beam.material.youngs_modulus = 2e5;
  scene.gravity = {0, -1, 0};
  scene.sliding_mass->mass = 0.2;
  scene.sliding_mass->position = 0.3;
  scene.sliding_mass->velocity = 0.8;
  scene.duration = 0.3;
  return scene;
}

class AcrossEvents : public ::testing::TestWithParam<Method> {};

TEST_P(AcrossEvents, LocationKeepsTheOrder) {
  const auto [type, order, tolerance, coarsest, finest] = GetParam();
  ASSERT_EQ(simulate(sliding_past_an_event()).events.size(), 1U);
  const Order observed = observed_order(sliding_past_an_event(), type, coarsest, finest);
  EXPECT_NEAR(observed.q, order, tolerance);
  EXPECT_NEAR(observed.v, order, tolerance);
}

TEST_P(AcrossEvents, LateEventsDestroyIt) {
  const auto [type, order, tolerance, coarsest, finest] = GetParam();
  auto scene = sliding_past_an_event();
  scene.integrator.locate_events = false;
  const Order observed = observed_order(scene, type, coarsest, finest);
  EXPECT_LT(observed.q, 1.5);
  EXPECT_LT(observed.v, 1.5);
}

INSTANTIATE_TEST_SUITE_P(Steppers, AcrossEvents,
                         ::testing::Values(Method{IntegratorType::dopri5, 5, 0.7, 1e-5, 1e-10},
                                           Method{IntegratorType::adams_bashforth_moulton, 5, 0.5, 2e-3, 2e-4},
                                           Method{IntegratorType::generalized_alpha, 2, 0.3, 4e-3, 5e-4}));

}  // namespace
}  // namespace vlbeam::test
