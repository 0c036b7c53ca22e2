// Ropes against closed forms, to the digits that these have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double at_sea_level = 9.81;

SlidingJointSpec ring(double x) {
  SlidingJointSpec joint;
  joint.position = x;
  joint.support = SupportType::pin;
  joint.slopes = JointSlopes::free;
  return joint;
}

Scene rope(std::vector<Point> points, double EA, double rhoA, int elements) {
  Scene scene;
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = std::move(points);
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0, .rhoA = rhoA};
  scene.beam.elements = elements;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.rtol = 1e-9;
  scene.integrator.atol = 1e-8;
  scene.integrator.step = 5e-3;
  return scene;
}

// (m1 + m2 + rhoA L) s'' = (m1 - m2 + 2 rhoA s) g: the rope's mass counts, on both sides and in motion.
TEST(RopeMarks, AtwoodWithTheMassOfItsRope) {
  const double rhoA = 0.05, m1 = 3, m2 = 2, half = 2;
  Scene scene = rope({{-0.1, -half, 0}, {0, 0, 0}, {0.1, -half, 0}}, 1e9, rhoA, 16);
  scene.beam.curve.points = {{0, -half, 0}, {0, 0, 0}, {1e-9, -half, 0}};
  scene.sliding_joints = {ring(half)};
  scene.point_masses = {{0, m2}, {16, m1}};
  scene.initial_shape = InitialShape::built;
  scene.duration = 0.5;
  scene.output.interval = 0.05;
  const RunResult run = test::completed(scene);
  const double mass = m1 + m2 + rhoA * 2 * half, b = 2 * rhoA * at_sea_level / mass,
               a = (m1 - m2) * at_sea_level / mass;
  const Sample& last = run.samples.back();
  const double way = half - *last.joint_position, exact = a / b * (std::cosh(std::sqrt(b) * last.t) - 1);
  EXPECT_NEAR(way, exact, 2e-6 * exact);
}

// The weight outside of a drum of nothing: m l^2 a' stays, whatever the length.
TEST(RopeMarks, ADeployedTetherKeepsItsAngularMomentum) {
  Scene scene;
  scene.gravity = {};
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 2e5, .EI = 0, .rhoA = 0.005};
  scene.beam.material.damping = 0.002;
  scene.beam.elements = 6;
  scene.start.type = SupportType::pin;
  scene.start.feed = TimeSpec{.table = {{0, 0, 0}, {4, 3, 0}}};
  scene.point_masses = {{6, 10}};
  scene.initial_velocity = InitialVelocitySpec{.rotation = 2.5};
  scene.duration = 5;
  scene.output.interval = 0.1;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 1e-3;
  const RunResult run = test::completed(scene);
  EXPECT_GE(run.events.size(), 5U);
  const double first = run.samples.front().angular_momentum[2];
  for (const Sample& sample : run.samples) EXPECT_NEAR(sample.angular_momentum[2], first, 1e-5 * first) << sample.t;
}

// A slow hoist of a pendulum: amplitudes grow as l^(-3/4), for the action m l^2 omega a^2 stays.
TEST(RopeMarks, APendulumThatIsHoistedSlowlySwingsWiderByThePowerThreeQuarters) {
  Scene scene;
  const double angle = 0.02, from = 2;
  scene.beam.curve.end = {from * std::sin(angle), -from * std::cos(angle), 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 0, .rhoA = 1e-4};
  scene.beam.material.damping = 0.01;
  scene.beam.elements = 4;
  scene.start.type = SupportType::pin;
  scene.start.feed = TimeSpec{.table = {{0, 0, 0}, {80, -1, 0}}};
  scene.point_masses = {{4, 2}};
  scene.duration = 86;
  scene.output.interval = 0.01;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 5e-3;
  scene.integrator.rho_inf = 1;
  const RunResult run = test::completed(scene);
  double after = 0;
  for (const Sample& sample : run.samples) {
    const double a = std::abs(std::atan2(sample.end[0], -sample.end[1]));
    if (sample.t > 81) after = std::max(after, a);
  }
  const double stretched = 2 * at_sea_level / 1e6;
  EXPECT_NEAR(after / angle, std::pow(from / (from - 1), 0.75), 1e-3 * std::pow(2, 0.75) + stretched);
}

// Around a guide a cable without mass slips where its tensions are in the ratio e^(mu phi).
TEST(RopeMarks, ACapstanHasItsRatio) {
  const double mu = 0.3;
  Scene scene;
  scene.gravity = {};
  scene.beam.curve.start = {-2, 0, 0};
  scene.beam.curve.end = {1, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e5, .EI = 0, .rhoA = 1e-8};
  scene.beam.compression = Compression::full;  // slack, a rope of next to no mass would be nowhere in particular
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = 12;
  scene.sliding_joints = {ring(2)};
  scene.sliding_joints[0].friction = AxialFriction{.coefficient = mu, .velocity = 1e-3};
  scene.loads = {{.node = 0, .x = {}, .magnitude = {.value = 10, .ramp = 0.1}, .direction = {-1, 0, 0}, .turn = {}}};
  scene.end.type = SupportType::pin;
  scene.end.motion = SupportMotionSpec{{-0.6, 0.8, 0}, {.rate = 1, .ramp = 0.5}, {}};
  scene.constraints = Constraints::multipliers;
  scene.integrator = IntegratorSpec{.type = IntegratorType::generalized_alpha, .step = 1e-3, .rho_inf = 0};
  scene.duration = 2;
  scene.output.interval = 0.1;
  const RunResult run = test::completed(scene);
  const Point& pull = run.samples.back().reactions[1].position;
  const double turn = std::atan2(1.6, -0.2), ratio = std::hypot(pull[0], pull[1]) / 10;
  EXPECT_NEAR(ratio, std::exp(mu * turn), 1e-8 * ratio);
}

}  // namespace
}  // namespace vlbeam
