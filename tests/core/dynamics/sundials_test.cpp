#include "mechanics/sundials/sundials_stepper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// A falling beam with two length-control events, damped or not.
Scene scene_for(IntegratorType type, double tolerance, double damping = 0) {
  Scene scene = falling_beam(ElementKind::ale_ancf, 6);
  scene.duration = 0.45;
  scene.output.interval = 0.1;
  scene.length_control.velocities = VelocityTransfer::conservative;
  scene.beam.material.damping = damping;
  scene.constraints = type == IntegratorType::ida ? Constraints::multipliers : Constraints::eliminated;
  set_tolerance(scene, type, tolerance);
  return scene;
}

double sample_difference(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.samples.size(), b.samples.size());
  EXPECT_EQ(a.events.size(), b.events.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i) {
    const Sample &p = a.samples[i], &q = b.samples[i];
    largest = std::max({largest, std::abs(*p.joint_position - *q.joint_position), std::abs(p.end[0] - q.end[0]),
                        std::abs(p.end[1] - q.end[1]), std::abs(p.energy.dissipated - q.energy.dissipated)});
  }
  return largest;
}

RunResult finished(const Scene& scene) {
  RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  return result;
}

class Sundials : public ::testing::TestWithParam<IntegratorType> {
 protected:
  void SetUp() override {
    if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  }
};
INSTANTIATE_TEST_SUITE_P(All, Sundials,
                         ::testing::Values(IntegratorType::ida, IntegratorType::cvode, IntegratorType::arkode));

TEST_P(Sundials, TakesAbsoluteTolerancesByKind) {
  const RunResult exact = finished(scene_for(IntegratorType::fehlberg78, 1e-12, 1e-4));
  for (const double tolerance : {1e-6, 1e-8}) {
    Scene scene = scene_for(GetParam(), tolerance, 1e-4);
    scene.integrator.atol_by_kind = {tolerance, 3 * tolerance, {}, {}};
    EXPECT_LE(sample_difference(finished(scene), exact), 2000 * tolerance);
  }
}

TEST_P(Sundials, IsInterruptedAndKeepsNoCheckpoint) {
  const Scene scene = scene_for(GetParam(), 1e-6);
  EXPECT_EQ(simulate(scene, [](double t) { return t < 0.1; }).status, RunStatus::interrupted);
  Checkpoints checkpoints;
  checkpoints.keep = [](const Checkpoint&) { ADD_FAILURE(); };
  EXPECT_THROW(simulate(scene, {}, &checkpoints), InvalidInput);
}

TEST_P(Sundials, AgreesWithFehlbergToItsTolerance) {
  const RunResult exact = finished(scene_for(IntegratorType::fehlberg78, 1e-12));
  ASSERT_GE(exact.events.size(), 2u);
  double last = 1;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    const double error = sample_difference(finished(scene_for(GetParam(), tolerance)), exact);
    EXPECT_LE(error, 2000 * tolerance);
    EXPECT_LT(error, last / 3);
    last = error;
  }
}

TEST_P(Sundials, CountsWhatDampingDissipates) {
  const RunResult exact = finished(scene_for(IntegratorType::fehlberg78, 1e-11, 1e-3));
  EXPECT_GT(exact.samples.back().energy.dissipated, 1e-3);
  EXPECT_LE(sample_difference(finished(scene_for(GetParam(), 1e-8, 1e-3)), exact), 1e-4);
}

TEST_P(Sundials, FollowsTheFallingBeamOfTenElements) {
  Scene scene = scene_for(IntegratorType::fehlberg78, 1e-12);
  scene.beam.elements = 10;
  scene.duration = 0.4;
  const RunResult exact = finished(scene);
  ASSERT_GE(exact.events.size(), 3U);
  scene.constraints = GetParam() == IntegratorType::ida ? Constraints::multipliers : Constraints::eliminated;
  set_tolerance(scene, GetParam(), 1e-8);
  EXPECT_LE(sample_difference(finished(scene), exact), 1e-8);
}

/// A stretch without events, on which forces grow smoothly.
Scene smooth_scene(IntegratorType type, double tolerance) {
  Scene scene = scene_for(type, tolerance);
  scene.gravity_ramp = 0.2;
  scene.duration = 0.2;
  return scene;
}

TEST_P(Sundials, AgreesOnASmoothStretch) {
  const RunResult exact = finished(smooth_scene(IntegratorType::fehlberg78, 1e-12));
  EXPECT_TRUE(exact.events.empty());
  EXPECT_LE(sample_difference(finished(smooth_scene(GetParam(), 1e-10)), exact), 2e-9);
}

TEST(Ida, KeepsConstraints) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  const auto residual = finished(scene_for(IntegratorType::ida, 1e-9)).solver.newton.constraints;
  EXPECT_LE(residual.position, 1e-9);
  EXPECT_LE(residual.velocity, 1e-8);
  EXPECT_GT(residual.velocity, 0) << "there are constraints";
}

TEST(Ida, FindsTheReactionsOfGeneralizedAlpha) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  const auto multipliers_of = [](const Scene& scene) -> Eigen::VectorXd {
    const std::vector<double> found = finished(scene).solver.newton.multipliers;
    return Eigen::Map<const Eigen::VectorXd>(found.data(), std::ssize(found));
  };
  const Eigen::VectorXd multipliers = multipliers_of(smooth_scene(IntegratorType::ida, 1e-10));
  Scene scene = smooth_scene(IntegratorType::ida, 1e-10);
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 2e-5;
  scene.integrator.newton_tolerance = 1e-12;
  const Eigen::VectorXd other = multipliers_of(scene);
  ASSERT_EQ(multipliers.size(), other.size());
  EXPECT_LE((multipliers - other).norm(), 1e-6 * other.norm());
}

/// Their conditions are quadratic, so that the Jacobian has second derivatives of them.
TEST(Ida, TakesTwoSlopesAtTheMass) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  for (const auto slopes : {JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
    Scene scene = smooth_scene(IntegratorType::fehlberg78, 1e-11);
    scene.end.type = SupportType::pin;
    scene.sliding_mass->slopes = slopes;
    const RunResult exact = finished(scene);
    scene.constraints = Constraints::multipliers;
    set_tolerance(scene, IntegratorType::ida, 1e-9);
    const RunResult by_ida = finished(scene);
    EXPECT_LE(sample_difference(by_ida, exact), 1e-10);
    EXPECT_LE(by_ida.solver.newton.constraints.position, 1e-9);
  }
}

/// By difference quotients the Jacobian took four times as many evaluations.
TEST(Ida, HasAnExactJacobian) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  const RunResult result = finished(scene_for(IntegratorType::ida, 1e-7));
  EXPECT_LE(result.solver.rhs_evaluations, 4 * result.solver.steps);
}

TEST(WithoutSundials, ItsIntegratorsAreRefused) {
  if (have_sundials()) GTEST_SKIP() << "built with SUNDIALS";
  for (const auto type : {IntegratorType::ida, IntegratorType::cvode, IntegratorType::arkode}) {
    try {
      simulate(scene_for(type, 1e-6));
      FAIL();
    } catch (const InvalidInput& refused) {
      EXPECT_EQ(refused.field, "/integrator/type");
      EXPECT_NE(refused.allowed.find("VLBEAM_SUNDIALS"), std::string::npos);
    }
  }
}

TEST(Ida, NeedsMultipliers) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  Scene scene = scene_for(IntegratorType::ida, 1e-6);
  scene.constraints = Constraints::eliminated;
  EXPECT_THROW(simulate(scene), InvalidInput);
}

}  // namespace
}  // namespace vlbeam::test
