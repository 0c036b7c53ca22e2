// Beams that are curved from the start: strains measured from the initial shape, or from a straight beam.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/build.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// Example 3 of Ding & Ouyang (2022): a mass slides along a semicircle suspended at both ends.
Scene semicircle(int elements) {
  Scene scene;
  scene.beam.curve = {.type = CurveType::arc, .radius = 2, .from_degrees = 180, .to_degrees = 360};
  scene.beam.section.radius = 0.02;
  scene.beam.material.youngs_modulus = 2e8;
  scene.beam.elements = elements;
  scene.start.type = scene.end.type = SupportType::pin;
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->position = beam_length(scene) / 16;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  scene.duration = 0.4;
  scene.output.interval = 0.05;
  return scene;
}

Scene without_gravity(Scene scene) {
  scene.gravity = {0, 0, 0};
  return scene;
}

template <int D>
double largest_acceleration(const Scene& scene) {
  BeamSystem<D> system(build_model<D>(scene), build_chain<D>(scene));
  const Eigen::VectorXd y = system.initial_state();
  Eigen::VectorXd dydt(y.size());
  system.rhs(y, dydt, 0);
  return dydt.cwiseAbs().maxCoeff();
}

TEST(CurvedBeam, AsBuiltItIsFreeOfStressWhereItStarts) {
  // accelerations: forces below 1e-10 EA on nodes of some kg
  const double EA = 2e8 * 3.14159 * 0.02 * 0.02;
  for (const auto element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
    for (const auto weights : {WeightTransport::frozen, WeightTransport::transported}) {
      auto scene = without_gravity(semicircle(5));
      scene.beam.element = element;
      scene.weights = weights;
      EXPECT_LE(largest_acceleration<2>(scene), 1e-10 * EA);
      scene.dimension = 3;
      scene.beam.material.curvature_regularization = 0.1;
      EXPECT_LE(largest_acceleration<3>(scene), 1e-10 * EA);
    }
  }
  auto scene = without_gravity(semicircle(5));
  scene.beam.rest_shape = RestShape::paper;
  EXPECT_GT(largest_acceleration<2>(scene), 1e-3 * EA);
}

TEST(CurvedBeam, TheEnergyLedgerCloses) {
  for (const auto rest : {RestShape::as_built, RestShape::paper}) {
    for (const auto weights : {WeightTransport::frozen, WeightTransport::transported}) {
      auto scene = semicircle(8);
      scene.beam.rest_shape = rest;
      scene.weights = weights;
      scene.duration = 0.7;
      const auto result = simulate(scene);
      ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
      EXPECT_GE(result.events.size(), 1U);
      EXPECT_LE(result.max_energy_drift, 1e-9 * result.max_kinetic);
    }
  }
}

TEST(CurvedBeam, ImplicitAndExplicitIntegratorsAgree) {
  auto scene = semicircle(6);
  scene.length_control.enabled = false;
  scene.gravity_ramp = 0.2;
  scene.duration = 0.3;
  const auto fine = simulate(scene);
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.rho_inf = 0.9;
  double coarser = 0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    scene.integrator.step = step;
    const auto result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    const double error = std::abs(*result.samples.back().joint_position - *fine.samples.back().joint_position);
    if (coarser > 0) {
      EXPECT_NEAR(std::log2(coarser / error), 2, 0.25);
    }
    coarser = error;
  }
  EXPECT_LE(coarser, 5e-6);
}

TEST(CurvedBeam, AMassWithoutInertiaToSpeakOfLeavesTheArcWhereItIs) {
  // a joint that slides along an unloaded arc: with transported weights the arc stays one, with frozen ones it does not
  auto scene = without_gravity(semicircle(6));
  scene.sliding_mass->mass = 1e-9;
  scene.sliding_mass->velocity = 1;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
  scene.duration = 0.05;
  scene.output.configurations = {0.05};
  auto radius_error = [&](WeightTransport weights) {
    scene.weights = weights;
    const auto result = simulate(scene);
    EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
    const auto& shape = result.configurations.front();
    double largest = 0;
    for (const auto& r : shape.r) largest = std::max(largest, std::abs(std::hypot(r[0], r[1]) - 2));
    return largest;
  };
  EXPECT_LE(radius_error(WeightTransport::transported), 1e-8);
  EXPECT_GT(radius_error(WeightTransport::frozen), 1e-7);
}

TEST(CurvedBeam, InSpaceItIsThePlanarOne) {
  auto scene = semicircle(4);  // not so long that its curvature changes sign, which a magnitude cannot
  scene.duration = 0.02;
  const auto planar = simulate(scene);
  scene.dimension = 3;
  scene.gravity = {0, -9.81, 0};
  scene.beam.material.curvature_regularization = 1e-6;
  const auto spatial = simulate(scene);
  ASSERT_EQ(spatial.status, RunStatus::completed) << spatial.failure;
  EXPECT_NEAR(*spatial.samples.back().joint_position, *planar.samples.back().joint_position, 1e-8);
  EXPECT_NEAR(spatial.samples.back().energy.bending, planar.samples.back().energy.bending, 1e-6);
}

}  // namespace
}  // namespace vlbeam::test
