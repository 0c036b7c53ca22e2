// Axes with corners: where joints stand they are kinks, where a mass hangs on a rope it has two slopes, and elsewhere a
// rope is rounded off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/build.hpp"
#include "scene/corners.hpp"
#include "scene/validate.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double g = 9.81;

/// A rope along a polyline, light and stiff.
Scene string_along(std::vector<Point> points, int elements, double EA = 1e8) {
  Scene scene;
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = std::move(points);
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0, .rhoA = 1e-4};
  scene.beam.elements = elements;
  return scene;
}

SlidingJointSpec ring_at(double x) {
  SlidingJointSpec ring;
  ring.position = x;
  ring.support = SupportType::pin;
  ring.slopes = JointSlopes::free;
  return ring;
}

Scene adaptive(Scene scene, double rtol = 1e-8) {
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.rtol = rtol;
  scene.integrator.atol = 1e-7;
  scene.integrator.step = 5e-3;
  return scene;
}

/// Of the node at material coordinate x in a shape.
Point place_at(const Configuration& shape, double x) {
  const auto nearest = std::ranges::min_element(shape.x, {}, [x](double at) { return std::abs(at - x); });
  return shape.r[static_cast<std::size_t>(nearest - shape.x.begin())];
}

// 2 T sin(alpha) = 1.2 g with T = g: the middle weight is 0.75 below the rings, 1 apart from it.
TEST(Corners, ThreeWeightsOnAStringOverTwoRingsFindTheirTriangle) {
  Scene scene = string_along({{-1, -1.5, 0}, {-1, 0, 0}, {1, 0, 0}, {1, -1.5, 0}}, 20, 1e6);
  scene.analysis = Analysis::statics;
  scene.sliding_joints = {ring_at(1.5), ring_at(3.5)};
  scene.point_masses = {{0, 1}, {10, 1.2}, {20, 1}};
  const RunResult run = test::completed(scene);
  const Sample& last = run.samples.back();
  ASSERT_EQ(last.joints.size(), 2U) << "the knot in the middle is none of them";
  const Point middle = place_at(run.configurations.back(), 2.5);
  EXPECT_NEAR(middle[0], 0, 1e-9);
  // its own weight, 5e-4 kg, lowers it by less than 1e-4 of that
  EXPECT_NEAR(middle[1], -0.75, 5e-4);
  EXPECT_NEAR(*last.joints[0].position, 1.25, 5e-4);
  EXPECT_NEAR(*last.joints[0].position + *last.joints[1].position, 5, 1e-9) << "it is symmetric";
}

// Two taut pieces of given length and a base make a triangle, whatever hangs at their common point.
TEST(Corners, AMassKinksARope) {
  const double a = 1.3, b = 0.9, base = 1.7, x = (base * base + a * a - b * b) / (2 * base),
               y = -std::sqrt(a * a - x * x);
  for (const int elements : {6, 24}) {
    for (const bool force : {false, true}) {
      Scene scene = string_along({{0, 0, 0}, {x, y, 0}, {base, 0, 0}}, elements);
      scene.analysis = Analysis::statics;
      scene.start.type = scene.end.type = SupportType::pin;
      scene.beam.section.rhoA = 1e-9;
      const std::vector<double> nodes = place_nodes(scene, {0, a, a + b}).x;
      const int node = static_cast<int>(std::ranges::find(nodes, a) - nodes.begin());
      if (force) {
        LoadSpec load;
        load.node = node;
        load.magnitude.value = 3;
        load.direction = {0.2, -1, 0};
        scene.loads = {load};
        scene.gravity = {};
      } else {
        scene.point_masses = {{node, 2}};
      }
      ASSERT_EQ(knots(scene).size(), 1U);
      const Point hangs = place_at(test::completed(scene).configurations.back(), a);
      EXPECT_NEAR(hangs[0], x, 4e-7) << elements;  // it stretches by 1.3e-7
      EXPECT_NEAR(hangs[1], y, 4e-7) << elements;
    }
  }
}

// m1 = 2, m2 = 1: a third of gravity, whichever way the picture is turned.
TEST(Corners, AtwoodsMachineFallsByAThirdOfGravity) {
  for (const double degrees : {0.0, 37.0}) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    Scene scene = string_along({{s, -c, 0}, {0, 0, 0}, {1.5 * s, -1.5 * c, 0}}, 10, 1e6);
    scene.gravity = {g * s, -g * c, 0};
    scene.sliding_joints = {ring_at(1)};
    scene.point_masses = {{0, 2}, {10, 1}};
    scene.duration = 0.4;
    scene.output.interval = 0.1;
    for (const Sample& sample : test::completed(adaptive(scene)).samples) {
      // the rope's own mass, 2.5e-4 kg of 3, and its elongation, 1.3e-5
      EXPECT_NEAR(*sample.joint_position - 1, g / 6 * sample.t * sample.t, 1e-4) << sample.t;
    }
  }
}

// The wheel turns with the string: (m1 - m2) g/(m1 + m2 + I/r^2).
TEST(Corners, AWheelSlowsAtwoodsMachineDown) {
  const auto machine = [](double inertia, double radius) {
    Scene scene = string_along({{0, -1, 0}, {0, 0, 0}, {0, -1.5, 0}}, 10, 1e6);
    scene.sliding_joints = {ring_at(1)};
    scene.sliding_joints.front().pulley = PulleySpec{.radius = radius, .inertia = inertia};
    scene.point_masses = {{0, 2}, {10, 1}};
    scene.duration = 0.4;
    scene.output.interval = 0.1;
    return adaptive(scene);
  };
  const RunResult run = test::completed(machine(0.02, 0.1));
  EXPECT_GE(run.events.size(), 1U);
  for (const Sample& sample : run.samples) {
    EXPECT_NEAR(*sample.joint_position - 1, g / (2 * (3 + 2)) * sample.t * sample.t, 6e-5) << sample.t;
  }
  EXPECT_LE(run.max_energy_drift, 3e-5 * run.max_kinetic) << "with what the wheel has";
  EXPECT_NEAR(*test::completed(machine(0.08, 0.2)).samples.back().joint_position, *run.samples.back().joint_position,
              1e-12)
      << "its inertia over the radius squared counts";
}

// Several ways to the same motion: one joint solved by itself, the chain, residuals with tangents.
TEST(Corners, AWheelTurnsTheSameByEveryMethod) {
  Scene scene;
  scene.beam.elements = 6;
  scene.beam.section.radius = 0.02;
  scene.start.type = SupportType::clamp;
  SlidingJointSpec ring;
  ring.support = SupportType::pin;
  ring.position = 0.55;
  ring.pulley = PulleySpec{.radius = 0.1, .inertia = 0.5};
  scene.sliding_joints = {ring};
  scene.duration = 0.3;
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  const RunResult one = test::completed(scene);
  EXPECT_LE(one.max_energy_drift, 1e-8 * one.max_kinetic);
  const double x = *one.samples.back().joint_position;
  Scene without = scene;
  without.sliding_joints.front().pulley.reset();
  EXPECT_GT(std::abs(*test::completed(without).samples.back().joint_position - x), 1e-4) << "it matters";
  Scene implicit = scene;
  implicit.integrator.type = IntegratorType::generalized_alpha;
  implicit.integrator.step = 2e-4;
  EXPECT_NEAR(*test::completed(implicit).samples.back().joint_position, x, 2e-6);
  Scene linearized = scene;
  test::set_tolerance(linearized, IntegratorType::rosenbrock4, 1e-8);
  EXPECT_NEAR(*test::completed(linearized).samples.back().joint_position, x, 1e-6);
  Scene chain = scene;
  SlidingJointSpec light;
  light.position = 0.8;
  light.mass = 1e-9;
  light.x = TimeSpec{};
  chain.sliding_joints.push_back(light);
  EXPECT_NEAR(*test::completed(chain).samples.back().joints[0].position, x, 5e-6) << "on another mesh";
}

TEST(Corners, AWheelGoesWithARingThatDoesNotRub) {
  Scene scene = string_along({{0, -1, 0}, {0, 0, 0}, {0, -1.5, 0}}, 10, 1e6);
  scene.sliding_joints = {ring_at(1)};
  scene.sliding_joints.front().pulley = PulleySpec{.radius = 0.1, .inertia = 1};
  Scene broken = scene;
  broken.sliding_joints.front().friction.emplace();
  EXPECT_EQ(test::refused(broken), "/sliding_joints/0/friction");
  broken = scene;
  broken.sliding_joints.front().slopes = JointSlopes::equal_stretch;
  EXPECT_EQ(test::refused(broken), "/sliding_joints/0/slopes");
  broken = scene;
  broken.sliding_joints.front().support = SupportType::free;
  broken.sliding_joints.front().mass = 1;
  EXPECT_EQ(test::refused(broken), "/sliding_joints/0/support");
  broken = scene;
  broken.sliding_joints.front().pulley->radius = 0;
  EXPECT_EQ(test::refused(broken), "/sliding_joints/0/pulley/radius");
}

// s'' = g (l2 - l1 + 2 s)/L
TEST(Corners, ARopeSlipsOffAPegAsAHyperbolicCosine) {
  Scene scene = string_along({{0, -0.9, 0}, {0, 0, 0}, {0, -1.1, 0}}, 20, 1e5);
  scene.beam.section.rhoA = 1;
  scene.sliding_joints = {ring_at(0.9)};
  scene.duration = 0.5;
  scene.output.interval = 0.1;
  for (const Sample& sample : test::completed(adaptive(scene)).samples) {
    const double s = 0.1 * (std::cosh(std::sqrt(g) * sample.t) - 1);
    EXPECT_NEAR(0.9 - *sample.joint_position, s, 1e-3) << sample.t;
  }
}

/// How deep the weight of 3 kg on a bight and the one of 1 kg at the rope's end hang, by Lagrange's equation of an
/// inextensible string between (0, 0) and a ring at (0.4, 0): the end rises by 2 sqrt(0.04 + y^2).
std::array<double, 2> on_a_bight(double until) {
  double y = 1, v = 0;
  const auto half = [](double depth) { return std::sqrt(0.04 + depth * depth); };
  const auto acceleration = [&](double at, double speed) {
    const double u = 2 * at / half(at), u_y = 2 * 0.04 / std::pow(half(at), 3);  // end' = -u y'
    return (3 * g - u * g - u * u_y * speed * speed) / (3 + u * u);
  };
  const int steps = 4000;
  const double h = until / steps;
  for (int i = 0; i < steps; ++i) {
    const double k1 = acceleration(y, v), k2 = acceleration(y + h / 2 * v, v + h / 2 * k1),
                 k3 = acceleration(y + h / 2 * v + h * h / 4 * k1, v + h / 2 * k2),
                 k4 = acceleration(y + h * v + h * h / 2 * k2, v + h * k3);
    y += h * v + h * h / 6 * (k1 + k2 + k3);
    v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {y, 1 + 2 * half(1) - 2 * half(y)};
}

TEST(Corners, AMovablePulleyFallsAsLagrangeSays) {
  Scene scene = string_along({{0, 0, 0}, {0.2, -1, 0}, {0.4, 0, 0}, {0.4, -1, 0}}, 15, 1e6);
  scene.start.type = SupportType::pin;
  SlidingJointSpec weight = ring_at(std::hypot(0.2, 1));
  weight.support = SupportType::free;
  weight.mass = 3;
  scene.sliding_joints = {weight, ring_at(2 * std::hypot(0.2, 1))};
  scene.point_masses = {{15, 1}};
  scene.duration = 0.4;
  scene.output.interval = 0.1;
  for (const Sample& sample : test::completed(adaptive(scene)).samples) {
    const auto [bight, end] = on_a_bight(sample.t);
    EXPECT_NEAR((*sample.mass_position)[1], -bight, 1e-4) << sample.t;
    EXPECT_NEAR(sample.end[1], -end, 2e-4) << sample.t;
  }
}

// Without gravity nothing stresses it, so nothing moves: straight pieces, and arcs that meet at a corner.
TEST(Corners, ABeamWithCornersRestsUnstressed) {
  SlidingJointSpec hinge = ring_at(1);
  hinge.slopes = JointSlopes::equal_stretch;
  Scene scene = string_along({{0, 0, 0}, {1, 0, 0}, {1, 0.8, 0}}, 9, 1e4);
  scene.beam.section.EI = 2;
  scene.gravity = {};
  scene.sliding_joints = {hinge};
  Scene curved = scene;
  curved.beam.curve = {.type = CurveType::nurbs,
                       .degree = 2,
                       .knots = {0, 0, 0, 1, 1, 2, 2, 2},
                       .weights = {},
                       .control_points = {{0, 0, 0}, {0.5, 0.4, 0}, {1, 0, 0}, {1.5, 0.5, 0}, {2, 0, 0}}};
  const double corner = drawn_axis<2>(curved.beam.curve).kinks().front();
  EXPECT_NEAR(drawn_axis<2>(curved.beam.curve).turn_at(corner), std::atan(0.8) + M_PI / 4, 1e-12);
  curved.sliding_joints.front().position = corner;
  curved.sliding_joints.front().slopes = JointSlopes::free;
  EXPECT_FALSE(has_rest_shape(scene)) << "its pieces are straight";
  EXPECT_TRUE(has_rest_shape(curved));
  for (Scene& still : std::array{scene, curved}) {
    test::set_tolerance(still, IntegratorType::dopri5, 1e-9);
    still.duration = 0.02;
    EXPECT_LE(test::completed(still).max_kinetic, 1e-16);
  }
}

TEST(Corners, ARopesOtherCornersBecomeRound) {
  Scene scene = string_along({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 0, 0}}, 16, 1e3);
  scene.sliding_joints = {ring_at(3)};  // the last corner is its
  scene.gravity = {};
  const Axis<2> axis = build_axis<2>(scene);
  ASSERT_EQ(axis.kinks().size(), 1U);
  // each rounding takes a quarter of a circle of radius 0.25, half an element to either side being a fourth of a piece
  EXPECT_NEAR(axis.length(), 4 - 2 * 0.25 * (2 - M_PI / 2), 1e-9);
  const InitialNodes nodes = place_nodes(scene, axis.breaks());
  EXPECT_EQ(nodes.x[static_cast<std::size_t>(nodes.joints.front())], axis.kinks().front());
  for (const double x : nodes.x) {
    const double before = std::max(0.0, x - 1e-7), behind = std::min(axis.length(), x + 1e-7);
    if (x != axis.kinks().front()) {
      EXPECT_LE((axis.tangent(before) - axis.tangent(behind)).norm(), 1e-6) << x;
    }
  }
  test::set_tolerance(scene, IntegratorType::dopri5, 1e-9);
  scene.duration = 0.02;
  EXPECT_LE(test::completed(scene).max_kinetic, 1e-14) << "it is not stressed";
}

TEST(Corners, JointsInAnotherOrderAreNamed) {
  Scene scene = string_along({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}}, 12);
  scene.sliding_joints = {ring_at(2), ring_at(1)};
  try {
    validate(scene);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/sliding_joints/1/position");
    EXPECT_NE(error.allowed.find("in order"), std::string::npos) << error.what();
  }
}

TEST(Corners, AreRefusedWithTheirPlaceWhereTheyCannotBe) {
  Scene bends = string_along({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 8);
  bends.beam.section.EI = 1;
  EXPECT_EQ(test::refused(bends), "/beam/curve/points/1");
  bends.sliding_joints = {ring_at(1)};
  bends.sliding_joints.front().slopes = JointSlopes::continuous;
  EXPECT_EQ(test::refused(bends), "/sliding_joints/0/slopes");
  bends.sliding_joints = {ring_at(1 + 1e-6)};
  EXPECT_EQ(test::refused(bends), "/beam/curve/points/1") << "the joint is not at the corner";
  Scene back = string_along({{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}}, 8);
  back.sliding_joints = {ring_at(1.5)};
  EXPECT_EQ(test::refused(back), "/beam/curve/points/1") << "too sharp to become round";
  Scene twice = string_along({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, 8);
  EXPECT_EQ(test::refused(twice), "/beam/curve/points/2");
  EXPECT_EQ(test::refused(string_along({{0, 0, 0}}, 8)), "/beam/curve/points");
  EXPECT_EQ(test::refused(string_along({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}}, 2)), "/beam/elements");
  Scene exact = string_along({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 8);
  exact.sliding_joints = {ring_at(1)};
  exact.beam.axis = AxisForm::exact;
  EXPECT_EQ(test::refused(exact), "/beam/axis");
  Scene sets_off = exact;
  sets_off.beam.axis = {};
  sets_off.sliding_joints.front().support = SupportType::free;
  sets_off.sliding_joints.front().mass = 1;
  sets_off.sliding_joints.front().velocity = 1;
  EXPECT_EQ(test::refused(sets_off), "/sliding_joints/0/velocity");
}

// The ring would have to let the knot through.
TEST(Corners, AJointStopsAtAKnot) {
  Scene scene = string_along({{0, -1, 0}, {0, 0, 0}, {0, -1.5, 0}}, 10, 1e5);
  scene.sliding_joints = {ring_at(1)};
  scene.point_masses = {{0, 0.2}, {3, 0.5}, {10, 1}};
  scene.duration = 2;
  const RunResult run = simulate(adaptive(scene, 1e-6));
  EXPECT_EQ(run.status, RunStatus::failed);
  EXPECT_NE(run.failure.find("met"), std::string::npos) << run.failure;
}

TEST(Corners, AMassThatAKinkWouldPassIsRefused) {
  Scene scene = string_along({{0, -1, 0}, {0, 0, 0}, {0, -1.5, 0}}, 10, 1e5);
  scene.sliding_joints = {ring_at(1)};
  scene.point_masses = {{4, 0.5}};
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/slopes") << "it stands where the ring does";
}

TEST(Corners, TheAxisIsThatOfTheCurveAskedForWhicheverWasDrawnBefore) {
  CurveSpec bent{.type = CurveType::polyline};
  bent.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  CurveSpec longer = bent;
  longer.points[2] = {1, 2, 0};
  CurveSpec curved{.type = CurveType::nurbs, .knots = {0, 0, 0, 0, 1, 1, 1, 1}};
  curved.control_points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}};
  CurveSpec weighted = curved;
  weighted.weights = {1, 2, 2, 1};
  const double first = drawn_axis<3>(curved).length();
  for (int round = 0; round < 2; ++round) {
    EXPECT_DOUBLE_EQ(drawn_axis<3>(bent).length(), 2);
    EXPECT_DOUBLE_EQ(drawn_axis<3>(longer).length(), 3);
    EXPECT_DOUBLE_EQ(drawn_axis<3>(longer).kinks().front(), 1);
    EXPECT_EQ(drawn_axis<3>(curved).length(), first);
    EXPECT_EQ(drawn_axis<2>(curved).length(), first);
    EXPECT_GT(std::abs(drawn_axis<3>(weighted).length() - first), 1e-3);
  }
}

}  // namespace
}  // namespace vlbeam
