#include <gtest/gtest.h>
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "scene/simulate.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

TEST(Multipliers, GiveTheTrajectoryOfEliminatedConstraints) {
  for (const auto clamp : {ClampType::direction, ClampType::full}) {
    auto scene = falling_beam(ElementKind::ale_rancf, 6);
    scene.start.clamp = clamp;
    scene.duration = 0.4;  // across length-control events
    scene.output.interval = 0.1;
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 1e-3;
    scene.integrator.newton_tolerance = 1e-12;
    const auto eliminated = simulate(scene);
    scene.constraints = Constraints::multipliers;
    const auto multipliers = simulate(scene);
    ASSERT_EQ(eliminated.events.size(), multipliers.events.size());
    ASSERT_GE(eliminated.events.size(), 1U);
    for (std::size_t i = 0; i < eliminated.samples.size(); ++i) {
      const auto &a = eliminated.samples[i], &b = multipliers.samples[i];
      EXPECT_NEAR(*a.joint_position, *b.joint_position, 1e-8);
      for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_NEAR(a.end[c], b.end[c], 1e-8);
        EXPECT_NEAR(a.momentum[c], b.momentum[c], 1e-6);
      }
    }
    const auto& residual = multipliers.solver.newton.constraints;
    EXPECT_LE(residual.position, 1e-12);
    EXPECT_LE(residual.velocity, 1e-8);
    EXPECT_GT(residual.velocity, 0) << "there are constraints";
  }
}

class KinkedMultipliers : public ::testing::TestWithParam<std::tuple<JointSlopes, Constraints>> {};

TEST_P(KinkedMultipliers, TendToTheExplicitSolutionWithOrderTwo) {
  for (const double friction : {0.0, 0.2}) {
    for (const bool spatial : {false, true}) {
      SCOPED_TRACE(std::string(spatial ? "in space" : "in the plane") + (friction > 0 ? ", with friction" : ""));
      auto scene = falling_beam(ElementKind::ale_ancf, 4);
      scene.start.type = scene.end.type = SupportType::pin;
      scene.sliding_mass->mass = 5;
      scene.sliding_mass->slopes = std::get<JointSlopes>(GetParam());
      if (friction > 0) scene.sliding_mass->friction = AxialFriction{friction, 0.1};
      if (spatial) {
        scene.dimension = 3;
        scene.beam.curve.end = {0.36, 0.48, 0.8};
      }
      scene.gravity_ramp = 0.1;
      scene.duration = scene.output.interval = 0.2;
      set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
      const auto exact = simulate(scene);
      EXPECT_GT(std::abs(*exact.samples.back().joint_position - 0.1), 1e-2) << "the mass must move";
      scene.integrator.type = IntegratorType::generalized_alpha;
      scene.integrator.newton_tolerance = 1e-12;
      scene.constraints = std::get<Constraints>(GetParam());
      std::array<double, 2> errors{};
      scene.integrator.step = 2.5e-4;
      for (double& error : errors) {
        const auto result = simulate(scene);
        ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
        for (std::size_t c = 0; c < 3; ++c) {
          const double off = (*result.samples.back().mass_position)[c] - (*exact.samples.back().mass_position)[c];
          error = std::max(error, std::abs(off));
        }
        EXPECT_LE(result.solver.newton.constraints.position, 1e-11);
        scene.integrator.step /= 2;
      }
      EXPECT_LE(errors[1], 1e-6);
      const double order = std::log2(errors[0] / errors[1]);
      if (friction > 0) {
        EXPECT_GE(order, 1.7) << "the contact force passes through zero: a kink in time";
      } else {
        EXPECT_NEAR(order, 2, 0.1);
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Modes, KinkedMultipliers,
                         ::testing::Combine(::testing::Values(JointSlopes::continuous, JointSlopes::tangent,
                                                              JointSlopes::equal_stretch, JointSlopes::free),
                                            ::testing::Values(Constraints::eliminated, Constraints::multipliers)));

TEST(Multipliers, AreOfSecondOrder) {
  // gravity grows smoothly and no event is due
  auto scene = falling_beam(ElementKind::ale_ancf, 4);
  scene.gravity_ramp = 0.2;
  scene.duration = 0.2;
  scene.output.interval = 0.2;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.newton_tolerance = 1e-12;
  scene.constraints = Constraints::multipliers;
  std::array<Eigen::VectorXd, 4> multipliers;
  scene.integrator.step = 1e-3;
  for (auto& result : multipliers) {
    const auto run = simulate(scene);
    ASSERT_TRUE(run.events.empty());
    const std::vector<double>& found = run.solver.newton.multipliers;
    result = Eigen::Map<const Eigen::VectorXd>(found.data(), std::ssize(found));
    scene.integrator.step /= 2;
  }
  ASSERT_EQ(multipliers[0].size(), 3);  // of a direction clamp
  const double first = (multipliers[0] - multipliers[1]).norm(), second = (multipliers[1] - multipliers[2]).norm(),
               third = (multipliers[2] - multipliers[3]).norm();
  EXPECT_NEAR(std::log2(first / second), 2, 0.2);
  EXPECT_NEAR(std::log2(second / third), 2, 0.1);
}

TEST(Multipliers, WorkInSpaceAndWithoutAJoint) {
  auto scene = falling_beam(ElementKind::ancf, 4);
  scene.sliding_mass.reset();
  scene.dimension = 3;
  scene.start.type = SupportType::pin;
  scene.duration = 0.2;
  scene.output.interval = 0.1;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.newton_tolerance = 1e-12;
  const auto eliminated = simulate(scene);
  scene.constraints = Constraints::multipliers;
  const auto multipliers = simulate(scene);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(eliminated.samples.back().end[c], multipliers.samples.back().end[c], 1e-9);
  }
}

TEST(Multipliers, HoldTheWeightOfABeamAtRest) {
  // damped until it hangs still: the clamp then carries the weight of everything
  auto scene = falling_beam(ElementKind::ale_ancf, 6);
  scene.beam.material.damping = 0.05;
  scene.beam.material.youngs_modulus = 2e9;
  scene.sliding_mass.reset();
  scene.gravity_ramp = 1;
  scene.duration = 8;
  scene.output.interval = 8;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 0.01;
  scene.integrator.rho_inf = 0.5;
  scene.constraints = Constraints::multipliers;
  const auto result = simulate(scene);
  const double weight = 7200 * 3.141592653589793 * 1e-4 * 9.81;
  EXPECT_NEAR(result.samples.back().reactions[0].position[1], weight, 1e-6 * weight);
  EXPECT_NEAR(result.samples.back().reactions[0].position[0], 0, 1e-6 * weight);
}

}  // namespace
}  // namespace vlbeam::test
