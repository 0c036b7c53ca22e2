#include "mechanics/conserving/energy_momentum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

RunResult run(Scene scene, double step) {
  if (step > 0) {
    scene.integrator.type = IntegratorType::energy_momentum;
    scene.integrator.step = step;
  } else {
    set_tolerance(scene, IntegratorType::fehlberg78, 1e-12);
  }
  RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  return result;
}

/// Position of the beam's end and the momentum of everything: a sample of q and of q'.
Eigen::Vector4d state_after(Scene scene, double step) {
  scene.output.interval = scene.duration;
  const RunResult result = run(scene, step);
  const Sample& last = result.samples.back();
  return {last.end[0], last.end[1], last.momentum[0], last.momentum[1]};
}

/// Errors of position and of momentum at three steps, each half the last; orders of the two halvings.
void expect_second_order(const Scene& scene, double step) {
  const Eigen::Vector4d exact = state_after(scene, 0);
  std::array<double, 3> position{}, velocity{};
  for (std::size_t i = 0; i < 3; ++i, step /= 2) {
    const Eigen::Vector4d error = state_after(scene, step) - exact;
    position[i] = error.head<2>().norm();
    velocity[i] = error.tail<2>().norm();
  }
  for (const auto& errors : {position, velocity}) {
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.1);
  }
}

/// Largest |E - E_0 - jumps at events| over the largest kinetic energy.
double drift(const RunResult& result) { return result.max_energy_drift / result.max_kinetic; }

Scene let_go(Scene scene) {
  scene.gravity_ramp = 0;
  return scene;
}

TEST(EnergyMomentum, IsOfSecondOrderForAFlexiblePendulum) {
  Scene scene = flexible_pendulum(4);
  scene.duration = 0.3;
  expect_second_order(scene, 1e-3);
}

TEST(EnergyMomentum, IsOfSecondOrderForASlidingMassBeforeItsFirstEvent) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    Scene scene = falling_beam(element, 4);
    scene.gravity_ramp = 0.2;
    scene.duration = 0.3;
    expect_second_order(scene, 1e-3);
  }
}

TEST(EnergyMomentum, KeepsTheEnergyOfASwingingBeam) {
  Scene scene = let_go(flexible_pendulum(2));
  scene.duration = 10;
  scene.output.interval = 0.1;
  EXPECT_LE(drift(run(scene, 1e-3)), 1e-11);
}

TEST(EnergyMomentum, KeepsTheEnergyOfASlidingMassBetweenEvents) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    Scene scene = falling_beam(element, 8);
    const RunResult result = run(scene, 1e-4);
    EXPECT_GE(result.events.size(), 3U);
    EXPECT_LE(drift(result), 1e-10);
  }
}

TEST(EnergyMomentum, KeepsTheEnergyInStepsFarTooLongForAnExplicitMethod) {
  Scene scene = let_go(flexible_pendulum(8));
  scene.beam.material.youngs_modulus = 2e9;  // an axial wave crosses an element in 0.24 ms
  scene.duration = 1;
  const RunResult result = run(scene, 5e-3);
  EXPECT_EQ(result.solver.rejected, 0U);
  EXPECT_LE(drift(result), 1e-10);
}

/// Samples between the steps factor matrices of their own.
TEST(ImplicitMethods, GoTheSameWayWithSamplesBetweenTheirSteps) {
  for (const IntegratorType type : {IntegratorType::energy_momentum, IntegratorType::generalized_alpha}) {
    Scene scene = let_go(flexible_pendulum(3));
    scene.integrator.type = type;
    scene.output.interval = scene.duration;
    const Point expected = simulate(scene).samples.back().end;
    scene.output.interval = scene.duration / 1371;
    const Point seen = simulate(scene).samples.back().end;
    EXPECT_NEAR(seen[0], expected[0], 1e-8);
    EXPECT_NEAR(seen[1], expected[1], 1e-8);
  }
}

TEST(EnergyMomentum, KeepsEnergyAndDissipationTogether) {
  Scene scene = falling_beam(ElementKind::ale_rancf, 4);
  scene.beam.material.damping = 1e-3;
  scene.duration = 0.3;
  const RunResult result = run(scene, 1e-3);
  EXPECT_GT(result.samples.back().energy.dissipated, 1e-3 * result.max_kinetic);
  EXPECT_LE(drift(result), 1e-10);
}

}  // namespace
}  // namespace vlbeam::test
