// Equilibria of beams on which several things slide, are guided or moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "mechanics/statics/equilibrium.hpp"
#include "scene/build.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

SlidingJointSpec at_ring(double position) {
  SlidingJointSpec joint = slider(position, 0);
  joint.support = SupportType::pin;
  joint.slopes = JointSlopes::equal_stretch;
  return joint;
}

/// reference/joints.py: a cable of 3 m, whose ends are drawn to where they are there.
Scene through_rings(int elements, StrainLaw law) {
  Scene scene = at_rest(elements, 100, 0);
  scene.statics.steps = 4;
  scene.gravity = {0, -1, 0};
  scene.beam.strain_law = law;
  scene.beam.curve.end = {3, 0, 0};
  scene.start = {.type = SupportType::pin, .motion = SupportMotionSpec{{0.6, 0.8, 0}, {.value = 0.25}}};
  scene.end = {.type = SupportType::pin, .motion = SupportMotionSpec{{-0.8, 0.6, 0}, {.value = 0.2}}};
  scene.sliding_joints = {at_ring(0.9), at_ring(2)};
  return scene;
}

TEST(RingsStatics, CableBetweenThreeCatenaries) {
  for (const auto& [law, x_1, x_2] : {std::tuple{StrainLaw::green, 0.79485991429503, 2.11688774540846},
                                      std::tuple{StrainLaw::engineering, 0.79477276034596, 2.11696942264872}}) {
    std::vector<double> errors;
    for (const int elements : {16, 32, 64}) {
      const RunResult result = completed(through_rings(elements, law));
      const Sample& last = result.samples.back();
      EXPECT_EQ(last.equilibrium->negative_pivots, 0);
      ASSERT_EQ(last.joints.size(), 2U);
      errors.push_back(std::hypot(*last.joints[0].position - x_1, *last.joints[1].position - x_2));
      for (const SlidingSample& joint : last.joints) EXPECT_NEAR((*joint.mass_position)[1], 0, 1e-12);
      const Configuration& shape = result.configurations.back();
      ASSERT_EQ(shape.kinks.size(), 2U);
      for (const auto& kink : shape.kinks) {
        const Point &before = shape.r_x[kink.node], &behind = kink.r_x;
        EXPECT_NEAR(std::hypot(before[0], before[1]), std::hypot(behind[0], behind[1]), 1e-12);
      }
    }
    EXPECT_LE(errors.back(), 2e-8);
    for (const std::size_t i : {0U, 1U}) EXPECT_GT(std::log2(errors[i] / errors[i + 1]), 4) << errors[i];
  }
}

/// Ends that are nearer to each other than the cable is long.
Scene hanging(const std::vector<SlidingJointSpec>& joints, int elements = 32) {
  Scene scene = at_rest(elements, 1e3, 0);
  scene.statics.steps = 4;
  scene.gravity = {0, -9.81, 0};
  scene.beam.curve.end = {2, 0, 0};
  scene.start.type = SupportType::pin;
  scene.end = {.type = SupportType::pin, .motion = SupportMotionSpec{{-1, 0, 0}, {.value = 0.3}}};
  scene.sliding_joints = joints;
  return scene;
}

TEST(TrolleysStatics, HeldOnAHangingCableAreMirrorImages) {
  Scene scene = hanging({slider(0.6, 0.5), slider(1.4, 0.5)});
  for (auto& joint : scene.sliding_joints) joint.slopes = JointSlopes::free;
  scene.statics.joints = StaticJoints::held;
  const Sample last = completed(scene).samples.back();
  const auto &left = last.joints[0], &right = last.joints[1];
  EXPECT_EQ(last.equilibrium->negative_pivots, 0);
  EXPECT_NEAR((*left.mass_position)[0] + (*right.mass_position)[0], 1.7, 1e-9);
  EXPECT_NEAR((*left.mass_position)[1], (*right.mass_position)[1], 1e-9);
  EXPECT_NEAR(left.on_beam->guiding, -right.on_beam->guiding, 1e-9);
  EXPECT_GT(std::abs(left.on_beam->guiding), 1) << "they would slide to the middle";
}

/// One on each side of a ring that holds the cable fast: each slides, through length control, to where it is lowest.
TEST(TrolleysStatics, ReleasedTogetherRestWhereTheCableIsLowest) {
  SlidingJointSpec ring = at_ring(1);
  ring.x.emplace();
  ring.motion = SupportMotionSpec{{-1, 0, 0}, {.value = 0.15}};  // half of what the end moves
  std::vector<SlidingJointSpec> joints{slider(0.25, 0.5), ring, slider(1.75, 0.5)};
  for (auto& joint : joints) joint.slopes = JointSlopes::equal_stretch;
  const RunResult result = completed(hanging(joints));
  const Sample& last = result.samples.back();
  EXPECT_EQ(last.equilibrium->negative_pivots, 0);
  EXPECT_NEAR(*last.joints[0].position, 0.5, 1e-6);
  EXPECT_NEAR(*last.joints[2].position, 1.5, 1e-6);
  EXPECT_NEAR(*last.joints[0].position + *last.joints[2].position, 2, 1e-9);
  EXPECT_NEAR((*last.joints[1].mass_position)[0], 0.85, 1e-12);
  EXPECT_NEAR(last.joints[0].on_beam->guiding, 0, 1e-12);
  for (const auto& kink : result.configurations.back().kinks) {
    const Point &before = result.configurations.back().r_x[kink.node], &behind = kink.r_x;
    EXPECT_NEAR(before[1], -behind[1], 1e-6) << "level to both sides: the lowest point, and the ring in the middle";
  }
}

/// A rope that is drawn over rings through these points, with the arc length of its corners there, and no support.
Scene over_rings(const std::vector<Point>& points, const std::vector<double>& rings, double EA, double rhoA) {
  Scene scene = at_rest(20, EA, 0);
  scene.gravity = {0, -9.81, 0};
  scene.beam.section.rhoA = rhoA;
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = points;
  for (const double at : rings) {
    scene.sliding_joints.push_back(at_ring(at));
    scene.sliding_joints.back().slopes = JointSlopes::free;
  }
  return scene;
}

TEST(RopeOverRings, OfTwoEqualSidesIsFoundAndUnstable) {
  for (const double EA : {1e4, 1e8}) {
    const RunResult run = completed(over_rings({{0, -1, 0}, {0, 0, 0}, {0, -1, 0}}, {1}, EA, 1));
    const Sample& last = run.samples.back();
    EXPECT_NEAR(*last.joint_position, 1, 1e-9);
    EXPECT_NEAR(last.joint->force[1], -2 * 9.81, 1e-6) << "the weight of the rope";
    EXPECT_EQ(last.equilibrium->negative_pivots, 1) << "it slips off, once it moves";
  }
}

/// The longer side, and the heavier one, pulls the rope off: the error names the ring, and what would have to hold it.
TEST(RopeOverRings, SlidesWhereNothingHoldsIt) {
  Scene rope = over_rings({{0, -0.9, 0}, {0, 0, 0}, {0, -1.1, 0}}, {0.9}, 1e4, 1);
  Scene atwood = over_rings({{0, -1, 0}, {0, 0, 0}, {0, -1, 0}}, {1}, 1e5, 1e-4);
  atwood.point_masses = {{0, 2}, {20, 1}};
  for (const auto& [scene, lacks] : {std::pair{rope, 2 * 9.81}, std::pair{atwood, 9.81}}) {
    const RunResult run = simulate(scene);
    EXPECT_EQ(run.status, RunStatus::failed);
    EXPECT_NE(run.failure.find("the beam slides along the ring at joint 0 with "), std::string::npos) << run.failure;
    EXPECT_NE(run.failure.find(" N unbalanced: it comes to the end of the beam"), std::string::npos) << run.failure;
    BeamSystem<2> system(build_model<2>(scene), build_chain<2>(scene));
    SolverCounters counters;
    try {
      trace_equilibria<2>(
          system, {}, [](const Equilibrium&) { return true; }, counters);
      ADD_FAILURE() << "it is in equilibrium";
    } catch (const NotBalanced& slides) {
      EXPECT_EQ(slides.joint, 0);
      EXPECT_NEAR(std::abs(slides.force), lacks, 5e-3 * lacks);
    }
  }
  Scene two = over_rings({{-1, -1, 0}, {-1, 0, 0}, {1, 0, 0}, {1, -1, 0}}, {1, 3}, 1e5, 1);
  const RunResult run = simulate(two);
  EXPECT_EQ(run.status, RunStatus::failed);
  EXPECT_NE(run.failure.find("the beam slides along the ring at joint "), std::string::npos) << run.failure;
}

/// Over two smooth pegs 2 a apart each side hangs down to the directrix of the catenary between them:
/// L = 2 c exp(a/c), sides c cosh(a/c). Longer than 2 e a it has two equilibria, shorter none (above).
TEST(RopeOverRings, SidesEndOnTheDirectrixOfTheCatenaryBetween) {
  const double L = 6.4;
  Scene scene = over_rings({{-1, -2.2, 0}, {-1, 0, 0}, {1, 0, 0}, {1, -2.2, 0}}, {2.2, 4.2}, 1e6, 1);
  scene.beam.elements = 32;
  const RunResult run = completed(scene);
  double c = 1.9;  // of the flatter one
  for (int i = 0; i < 50; ++i) c -= (2 * c * std::exp(1 / c) - L) / (2 * std::exp(1 / c) * (1 - 1 / c));
  const Sample& last = run.samples.back();
  EXPECT_NEAR(*last.joints[0].position, c * std::cosh(1 / c), 5e-5) << "strains are 2e-5";
  EXPECT_NEAR(*last.joints[0].position + *last.joints[1].position, L, 1e-6);
  EXPECT_EQ(last.equilibrium->negative_pivots, 1) << "it slips off, once it moves";
}

/// Whittaker: 2 T sin(a) = W, T = P (reference/exact/pulleys.py), whatever the string's stiffness.
TEST(RopeOverRings, ThreeWeightsHangWhereTheStringIsStiff) {
  for (const double EA : {1e5, 1e7, 1e8, 1e9}) {
    Scene scene = over_rings({{-1, -1.5, 0}, {-1, 0, 0}, {1, 0, 0}, {1, -1.5, 0}}, {1.5, 3.5}, EA, 1e-9);
    scene.point_masses = {{0, 1}, {10, 1.2}, {20, 1}};
    const RunResult run = completed(scene);
    EXPECT_EQ(run.samples.back().equilibrium->negative_pivots, 0);
    EXPECT_NEAR(run.configurations.back().r[10][0], 0, 1e-8) << EA;
    EXPECT_NEAR(run.configurations.back().r[10][1], -0.75, 1e-8) << EA;
  }
}

/// Weights of different sizes, from a middle part that is straight: by the triangle of forces the angles a, b of both
/// sides to the level obey A cos a = B cos b, A sin a + B sin b = W.
TEST(RopeOverRings, ThreeUnequalWeightsFindTheirSide) {
  for (const auto& [A, W, B] :
       {std::tuple{0.0465, 0.0641, 0.0403}, std::tuple{3.0, 4.5, 2.0}, std::tuple{2.0, 2.5, 2.6}}) {
    Scene scene = over_rings({{-1, -3, 0}, {-1, 0, 0}, {1, 0, 0}, {1, -3, 0}}, {3, 5}, 2.6e6, 1e-10);
    scene.beam.elements = 24;
    scene.point_masses = {{0, A}, {12, W}, {24, B}};
    const RunResult run = completed(scene);
    // angles of the triangle with sides A, B, W, seen from the level; the rope is stretched by 2e-5 at most
    const double sin_a = (A * A + W * W - B * B) / (2 * A * W), sin_b = (B * B + W * W - A * A) / (2 * B * W);
    const double tan_a = sin_a / std::sqrt(1 - sin_a * sin_a), tan_b = sin_b / std::sqrt(1 - sin_b * sin_b);
    const double depth = 2 / (1 / tan_a + 1 / tan_b);
    EXPECT_EQ(run.samples.back().equilibrium->negative_pivots, 0);
    EXPECT_NEAR(run.configurations.back().r[12][0], -1 + depth / tan_a, 2e-4 * depth) << A;
    EXPECT_NEAR(run.configurations.back().r[12][1], -depth, 2e-4 * depth) << A;
    EXPECT_NEAR(*run.samples.back().joints[0].position, 4 - depth / sin_a, 2e-4 * depth) << A;
  }
}

/// A ring that is moved down by what its supports could have been moved up.
TEST(MovedJointStatics, IsTheSameSeenFromTheRing) {
  const SupportMotionSpec down{{0, -1, 0}, {.value = 0.2}}, up{{0, 1, 0}, {.value = 0.2}};
  Scene scene = at_rest(24, 100, 0.01);
  scene.beam.curve.end = {2, 0, 0};
  scene.gravity = {0, -1, 0};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.sliding_joints = {at_ring(0.8)};
  Scene other = scene;
  scene.sliding_joints.front().motion = down;
  other.start.motion = other.end.motion = up;
  const Sample one = completed(scene).samples.back(), two = completed(other).samples.back();
  EXPECT_NEAR((*one.mass_position)[1], -0.2, 1e-12);
  EXPECT_NEAR(*one.joint_position, *two.joint_position, 1e-9);
  EXPECT_NEAR(one.joint->force[1], two.joint->force[1], 1e-8);
  EXPECT_GT(std::abs(*one.joint_position - 0.8), 1e-3) << "it has been released";
}

/// The guide leads the beam through the ring, over its nodes, to where it could have been put at first.
TEST(GuidedJointStatics, EndsWhereItIsLed) {
  Scene led = through_rings(60, StrainLaw::green);
  led.sliding_joints = {at_ring(0.9), at_ring(2)};
  led.sliding_joints[0].x = TimeSpec{.value = -0.1};
  led.sliding_joints[1].x = TimeSpec{.value = 0.12};
  led.statics.steps = 8;
  Scene put = led;
  for (auto& joint : put.sliding_joints) {
    joint.position += joint.x->value;
    joint.x.reset();
  }
  // the same rings in space
  put.sliding_joints[0].motion = SupportMotionSpec{{1, 0, 0}, {.value = 0.1}};
  put.sliding_joints[1].motion = SupportMotionSpec{{-1, 0, 0}, {.value = 0.12}};
  put.statics.joints = StaticJoints::held;
  const Sample one = completed(led).samples.back(), two = completed(put).samples.back();
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_NEAR(*one.joints[i].position, *two.joints[i].position, 1e-12);
    EXPECT_NEAR((*one.joints[i].mass_position)[0], (*two.joints[i].mass_position)[0], 1e-12);
    for (const std::size_t c : {0U, 1U})
      EXPECT_NEAR(one.joints[i].on_beam->force[c], two.joints[i].on_beam->force[c], 1e-5);
  }
}

/// A motion starts there at rest, and stays.
TEST(SeveralFromTheirEquilibrium, StayAtRest) {
  for (const StaticJoints joints : {StaticJoints::held, StaticJoints::released}) {
    const bool released = joints == StaticJoints::released;
    Scene scene = test::by_greens_law();
    scene.beam.curve = {
        .type = CurveType::arc, .center = {0, 0, 0}, .radius = 1, .from_degrees = 200, .to_degrees = 340};
    scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e4, .EI = 0, .rhoA = 1};
    scene.beam.element = ElementKind::ale_ancf;
    scene.beam.elements = 30;
    scene.start.type = scene.end.type = SupportType::pin;
    scene.sliding_joints = {at_ring(0.8), at_ring(1.7)};
    if (!released) {
      for (auto& joint : scene.sliding_joints) joint.x.emplace();
    }
    scene.initial_shape = InitialShape::equilibrium;
    scene.statics.joints = joints;
    set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
    scene.duration = 0.02;
    scene.output.interval = 0.01;
    const RunResult run = completed(scene);
    EXPECT_EQ(run.samples.front().equilibrium->negative_pivots, 0);
    EXPECT_LE(run.max_kinetic, 1e-13);
    const double moved = std::abs(*run.samples.front().joints[0].position - 0.8);
    if (released) {
      EXPECT_GT(moved, 1e-3);
    } else {
      EXPECT_EQ(moved, 0);
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
