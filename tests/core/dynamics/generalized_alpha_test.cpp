#include "mechanics/time/generalized_alpha.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/simulate.hpp"
#include "tests/core/support/by_greens_law.hpp"

namespace vlbeam::test {
namespace {

/// Position of the beam's end and the momentum of everything: a sample of q and of q'.
Eigen::Vector4d final_state(Scene scene, double step, double rho_inf = 0.9) {
  if (step > 0) {
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = step;
    scene.integrator.rho_inf = rho_inf;
  } else {
    scene.integrator.type = IntegratorType::fehlberg78;
    scene.integrator.rtol = scene.integrator.atol = 1e-12;
  }
  scene.output.interval = scene.duration;
  const RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  const Sample& last = result.samples.back();
  return {last.end[0], last.end[1], last.momentum[0], last.momentum[1]};
}

Scene pendulum() {
  Scene scene = test::by_greens_law();
  scene.start.type = SupportType::pin;
  scene.gravity_ramp = 0.25;
  scene.beam.elements = 4;
  scene.beam.element = ElementKind::ancf;
  scene.duration = 0.3;
  return scene;
}

/// Errors of position and of momentum at three steps, each half the last; orders of the two halvings.
void expect_second_order(const Scene& scene, double step, double tolerance, double rho_inf) {
  const Eigen::Vector4d exact = final_state(scene, 0);
  std::array<double, 3> position{}, velocity{};
  for (std::size_t i = 0; i < 3; ++i, step /= 2) {
    const Eigen::Vector4d error = final_state(scene, step, rho_inf) - exact;
    position[i] = error.head<2>().norm();
    velocity[i] = error.tail<2>().norm();
  }
  for (const auto& errors : {position, velocity}) {
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 2 * tolerance);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, tolerance);
  }
}

TEST(GeneralizedAlpha, IsOfSecondOrderForAFlexiblePendulum) {
  for (const double rho_inf : {0.5, 0.9, 1.0}) expect_second_order(pendulum(), 1e-3, 0.1, rho_inf);
}

TEST(GeneralizedAlpha, FullNewtonConvergesQuadratically) {
  Scene scene = pendulum();
  scene.gravity_ramp = 0;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 0.02;
  scene.integrator.newton = NewtonKind::full;
  scene.integrator.newton_tolerance = 1e-15;
  const auto history = simulate(scene).solver.newton.longest;
  ASSERT_GE(history.size(), 4u);
  int quadratic = 0;  // where rounding does not yet show
  for (std::size_t i = 1; i < history.size() && history[i] > 1e-13; ++i) {
    if (history[i - 1] < 0.1) {
      EXPECT_LE(history[i], 30 * history[i - 1] * history[i - 1]);
      ++quadratic;
    }
  }
  EXPECT_GE(quadratic, 2);
}

TEST(GeneralizedAlpha, FullAndModifiedNewtonGiveTheSameMotion) {
  Scene scene = pendulum();
  const Eigen::Vector4d modified = final_state(scene, 1e-3);
  scene.integrator.newton = NewtonKind::full;
  EXPECT_LE((final_state(scene, 1e-3) - modified).norm(), 1e-7);
}

TEST(GeneralizedAlpha, AnAdaptiveStepFollowsTheTolerance) {
  Scene scene = pendulum();
  scene.duration = 1;
  const Eigen::Vector4d exact = final_state(scene, 0);
  std::array<double, 3> errors{};
  scene.integrator.adaptive = true;
  for (std::size_t i = 0; i < 3; ++i) {
    scene.integrator.rtol = scene.integrator.atol = std::pow(10, -4 - static_cast<double>(i));
    errors[i] = (final_state(scene, 0.05) - exact).head<2>().norm();
  }
  EXPECT_LT(errors[1], errors[0] / 2);
  EXPECT_LT(errors[2], errors[1] / 2);
  EXPECT_LT(errors[2], 3e-4);
}

TEST(GeneralizedAlpha, RejectsAStepThatNewtonCannotSolveAndGoesOn) {
  Scene scene = pendulum();
  scene.gravity_ramp = 0;
  scene.gravity = {0, -3000, 0};
  scene.duration = 0.02;
  scene.output.interval = 0.02;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 0.02;
  const RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed);
  EXPECT_GT(result.solver.rejected, 0u);
}

/// A steel cantilever that vibrates in its first mode under a weight `share` of its own that is there at once.
Scene vibrating(double share) {
  Scene scene = test::by_greens_law();
  scene.start.type = SupportType::clamp;
  scene.beam.elements = 8;
  scene.beam.material.youngs_modulus = 2.1e11;
  scene.gravity = {0, -9.81 * share, 0};
  scene.gravity_ramp = 0.02;
  scene.duration = 0.3;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.step = 0.01;
  scene.integrator.rtol = 1e-14;
  scene.integrator.atol_by_kind = AbsoluteTolerances{.length = 1e-7, .velocity = 1e-5, .angle = {}, .spin = {}};
  return scene;
}

// A vibration that the steps resolve is limited as before; what the method damps by itself is not.
TEST(GeneralizedAlpha, FilteredErrorsLeaveResolvedVibrationsAlone) {
  Scene resolved = vibrating(1);
  const RunResult all = simulate(resolved);
  resolved.integrator.error_estimate = ErrorEstimate::filtered;
  const RunResult filtered = simulate(resolved);
  EXPECT_GT(static_cast<double>(filtered.solver.steps), 0.85 * static_cast<double>(all.solver.steps));
  EXPECT_LE(filtered.solver.steps, all.solver.steps);

  Scene ringing = vibrating(1);  // a thin wire that is pulled all at once: waves along the axis
  ringing.beam.section.radius = 1e-3;
  ringing.beam.elements = 32;
  LoadSpec pull;
  pull.node = 32;
  pull.direction = {1, 0, 0};
  pull.magnitude.value = 0.3;
  ringing.loads = {pull};
  const RunResult resolving = simulate(ringing);
  ringing.integrator.error_estimate = ErrorEstimate::filtered;
  const RunResult damping = simulate(ringing);
  EXPECT_LT(2 * damping.solver.steps, resolving.solver.steps);
  EXPECT_NEAR(damping.samples.back().end[1], resolving.samples.back().end[1], 2e-5);  // it sags 0.2 m
}

// A tenth of the motion, a tenth of the tolerance: as many steps.
TEST(GeneralizedAlpha, TolerancesFollowTheMotion) {
  const auto steps = [](double share, bool of_motion) {
    Scene scene = vibrating(share);
    scene.integrator.atol_by_kind->length = 1e-5;
    if (of_motion) scene.integrator.atol_by_kind->motion = 0.1;
    return static_cast<double>(simulate(scene).solver.steps);
  };
  EXPECT_NEAR(steps(0.1, true) / steps(1, true), 1, 0.1);
  EXPECT_LT(steps(0.1, false) / steps(1, false), 0.7);
}

}  // namespace
}  // namespace vlbeam::test
