// A scene in other units (by powers of two, so that nothing is rounded differently) is the same computation.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// How many new units go into the old ones: exponents of two.
struct Units {
  int length = 0, mass = 0, time = 0;

  double operator()(int lengths, int masses, int times) const {
    return std::ldexp(1.0, length * lengths + mass * masses + time * times);
  }
  double length_of() const { return (*this)(1, 0, 0); }
};

void scale(Point& point, double factor) {
  for (double& x : point) x *= factor;
}

void scale(TimeSpec& spec, double unit, const Units& units) {
  const double second = units(0, 0, 1);
  spec.value *= unit;
  spec.rate *= unit / second;
  spec.acceleration *= unit / (second * second);
  spec.amplitude *= unit;
  spec.frequency /= second;
  spec.ramp *= second;
  if (spec.until) *spec.until *= second;
}

Scene in_units(Scene scene, const Units& u) {
  const double metre = u.length_of(), second = u(0, 0, 1), newton = u(1, 1, -2);
  scale(scene.gravity, u(1, 0, -2));
  scene.gravity_ramp *= second;
  auto& curve = scene.beam.curve;
  scale(curve.start, metre);
  scale(curve.end, metre);
  scale(curve.center, metre);
  curve.radius *= metre;
  scene.beam.section.radius *= metre;
  scene.beam.material.density *= u(-3, 1, 0);
  scene.beam.material.youngs_modulus *= u(-1, 1, -2);
  scene.beam.material.damping *= second;
  scene.beam.material.curvature_regularization /= metre;
  for (auto* support : {&scene.start, &scene.end}) {
    if (!support->motion) continue;
    scale(support->motion->displacement, metre, u);
    if (support->motion->angle) scale(*support->motion->angle, 1, u);
  }
  scene.beam.material.mass_damping /= second;
  if (auto& drag = scene.drag) {
    for (double* c : {&drag->linear.normal, &drag->linear.tangential}) *c *= u(-1, 1, -1);
    for (double* c : {&drag->quadratic.normal, &drag->quadratic.tangential}) *c *= u(-2, 1, 0);
  }
  if (auto& mass = scene.sliding_mass) {
    mass->mass *= u(0, 1, 0);
    mass->position *= metre;
    mass->velocity *= metre / second;
    if (mass->friction) mass->friction->velocity *= metre / second;
  }
  if (scene.spin) {
    for (auto& drive : scene.spin->drives) scale(drive.angle, 1, u);
  }
  if (scene.flow) {
    for (auto& node : scene.flow->nodes) scale(node.x, metre, u);
  }
  for (auto& load : scene.loads) {
    scale(load.magnitude, newton, u);
    scale(load.turn, 1, u);
  }
  auto& integrator = scene.integrator;
  integrator.step *= second;
  if (auto& atol = integrator.atol_by_kind) {
    atol->length *= metre;
    atol->velocity *= metre / second;
    if (atol->spin) *atol->spin /= second;
  }
  scene.duration *= second;
  scene.output.interval *= second;
  for (double& t : scene.output.configurations) t *= second;
  return scene;
}

const std::array<Units, 6> others{{{10, 0, 0}, {-10, 0, 0}, {0, 10, 0}, {0, -10, 0}, {0, 0, 10}, {0, 0, -10}}};

/// The last shape, sample by sample, and the numbers of steps and iterations.
void expect_same_bits(const Scene& scene) {
  const RunResult expected = simulate(scene);
  ASSERT_EQ(expected.status, RunStatus::completed) << expected.failure;
  for (const Units& units : others) {
    SCOPED_TRACE(testing::Message() << "length 2^" << units.length << ", mass 2^" << units.mass << ", time 2^"
                                    << units.time);
    const RunResult result = simulate(in_units(scene, units));
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    EXPECT_EQ(result.solver.steps, expected.solver.steps);
    EXPECT_EQ(result.solver.newton.iterations, expected.solver.newton.iterations);
    EXPECT_EQ(result.solver.newton.tangents, expected.solver.newton.tangents);
    EXPECT_EQ(result.solver.rhs_evaluations, expected.solver.rhs_evaluations);
    EXPECT_EQ(result.events.size(), expected.events.size());
    ASSERT_EQ(result.samples.size(), expected.samples.size());
    const double metre = units.length_of(), joule = units(2, 1, -2);
    for (std::size_t i = 0; i < result.samples.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(result.samples[i].end[c] / metre, expected.samples[i].end[c]) << "sample " << i;
      }
      if (expected.samples[i].joint_position) {
        EXPECT_EQ(*result.samples[i].joint_position / metre, *expected.samples[i].joint_position) << "sample " << i;
      }
      EXPECT_EQ(result.samples[i].energy.kinetic / joule, expected.samples[i].energy.kinetic) << "sample " << i;
    }
  }
}

Scene with_events() {
  Scene scene = falling_beam(ElementKind::ale_rancf, 10);
  scene.duration = 0.3;
  scene.output.interval = 0.1;
  return scene;
}

Scene with_step(Scene scene, IntegratorType type, double step) {
  scene.integrator.type = type;
  scene.integrator.step = step;
  return scene;
}

Scene shaft() {
  Scene scene = shaft_under_turning_load(4);
  scene.duration = 0.01;
  scene.output.interval = 0.005;
  return scene;
}

TEST(Units, ChangeNoBitOfGeneralizedAlpha) {
  expect_same_bits(with_step(with_events(), IntegratorType::generalized_alpha, 1e-3));
  Scene full = with_step(with_events(), IntegratorType::generalized_alpha, 1e-3);
  full.integrator.newton = NewtonKind::full;
  expect_same_bits(full);
}

TEST(Units, ChangeNoBitWithMultipliers) {
  Scene scene = with_step(with_events(), IntegratorType::generalized_alpha, 1e-3);
  scene.constraints = Constraints::multipliers;
  expect_same_bits(scene);
}

TEST(Units, ChangeNoBitInSpace) {
  Scene scene = with_step(with_events(), IntegratorType::generalized_alpha, 1e-3);
  scene.dimension = 3;
  scene.gravity = {0, -9, 3};
  expect_same_bits(scene);
  scene.constraints = Constraints::multipliers;
  expect_same_bits(scene);
}

TEST(Units, ChangeNoBitOfAShaft) { expect_same_bits(with_step(shaft(), IntegratorType::generalized_alpha, 1e-4)); }

TEST(Units, ChangeNoBitOfEnergyMomentum) {
  Scene scene = with_step(with_events(), IntegratorType::energy_momentum, 1e-3);
  scene.length_control.velocities = VelocityTransfer::conservative;
  expect_same_bits(scene);
}

TEST(Units, ChangeNoBitOfAdamsBashforthMoulton) {
  expect_same_bits(with_step(with_events(), IntegratorType::adams_bashforth_moulton, 2e-5));
}

Scene with_tolerance(Scene scene, IntegratorType type, double tolerance) {
  scene.integrator.type = type;
  scene.integrator.rtol = tolerance;
  scene.integrator.atol_by_kind = {tolerance, 3 * tolerance, {}, {}};
  return scene;
}

TEST(Units, ChangeNoBitOfExplicitMethodsThatChooseTheirSteps) {
  for (const auto type : {IntegratorType::dopri5, IntegratorType::cash_karp, IntegratorType::fehlberg78,
                          IntegratorType::bulirsch_stoer}) {
    SCOPED_TRACE(static_cast<int>(type));
    Scene scene = with_tolerance(with_events(), type, 1e-6);
    scene.duration = 0.25;
    expect_same_bits(scene);
  }
  Scene loaded = with_tolerance(shaft(), IntegratorType::dopri5, 1e-5);
  loaded.integrator.atol_by_kind->angle = 1e-6;
  loaded.integrator.atol_by_kind->spin = 1e-4;
  loaded.duration = 0.002;
  loaded.output.interval = 0.001;
  expect_same_bits(loaded);
}

TEST(Units, ChangeNoBitOfAdaptiveGeneralizedAlpha) {
  Scene scene = with_tolerance(with_events(), IntegratorType::generalized_alpha, 1e-6);
  scene.integrator.adaptive = true;
  expect_same_bits(scene);
  scene.constraints = Constraints::multipliers;
  expect_same_bits(scene);
}

/// With all that its Jacobian takes from differences: what damping, friction and moving supports do, and when.
TEST(Units, ChangeNoBitOfRosenbrock4) {
  Scene scene = with_tolerance(falling_beam(ElementKind::ale_rancf, 4), IntegratorType::rosenbrock4, 1e-5);
  scene.duration = 0.2;
  scene.output.interval = 0.1;
  scene.gravity_ramp = 0.05;
  expect_same_bits(scene);
  scene.beam.material.damping = 1e-3;
  scene.sliding_mass->friction = AxialFriction{0.1, 0.05};
  scene.start.motion =
      SupportMotionSpec{{1, 2, 0}, {.value = 0.01, .amplitude = -0.01, .frequency = 3, .phase_degrees = 90}};
  expect_same_bits(scene);
}

TEST(Units, ChangeNoBitOfLengthControl) {
  Scene scene = with_step(with_events(), IntegratorType::generalized_alpha, 1e-3);
  scene.weights = WeightTransport::transported;
  scene.length_control.merge = MergePolicy::least_change;
  scene.length_control.velocities = VelocityTransfer::conservative;
  expect_same_bits(scene);
  scene.sliding_mass->friction = AxialFriction{.coefficient = 0.1};
  expect_same_bits(scene);
}

}  // namespace
}  // namespace vlbeam::test
