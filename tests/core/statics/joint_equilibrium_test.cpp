// Equilibria of beams on which something slides: a sleeve, a ring, a mass.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <vector>

#include "core/error.hpp"
#include "mechanics/statics/static_equations.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/differences.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// The tangent is the derivative of what is free of the residual. Under dead forces it is symmetric, and the inertia
/// that block LU counts is that of the dense matrix on the directions in which the coordinates may move.
template <int D>
void expect_tangent(JointSlopes slopes, std::optional<Support<D>> in_space, bool held, bool loaded, unsigned seed,
                    const std::vector<ChainShape::Joint>& more = {}) {
  Random random(seed);
  const ChainShape shape{
      .elements = more.empty() ? 5 : 8, .joint = 2, .rational = true, .slopes = slopes, .more = more};
  BeamModel<D> model = model_of<D>(shape, random);
  model.start = Support<D>::direction_clamp(random.vector<D>());
  model.end = Support<D>::pin();
  model.joints.front().support = in_space;
  if (loaded) {
    model.loads = loads_on<D>(5 * shape.element_length, random);
    model.masses = masses_on<D>(5 * shape.element_length);
  }
  BeamSystem<D> system(model, random_chain<D>(shape, random));
  StaticEquations<D> equations(system);
  equations.hold_joints(held);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(equations.size());
  const Eigen::Index own = system.coordinates();
  u.head(own) = system.initial_state().head(own);
  equations.choose_conditions(u);
  u.tail(equations.conditions()).setConstant(0.3);
  ASSERT_TRUE(equations.linearize(u, 0.4, 0));
  const Eigen::MatrixXd free = equations.directions(u);
  // only directions that are free: what the solve itself returns
  Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(u.size(), [&] { return random.uniform(-1, 1); });
  const auto residual = [&](double s) -> Eigen::VectorXd {
    Eigen::VectorXd r;
    equations.residual(u + s * d, 0.4, r);
    return r;
  };
  for (const bool project : {true, false}) {
    Eigen::VectorXd r;
    if (project) {
      const Eigen::VectorXd whole = u;
      u += d;
      r = residual(0);
      u = whole;
      equations.solve(r);
      d = r / r.norm();
    } else {
      r = slope_of(residual);
      equations.solve(r);
      EXPECT_LE((r - d).norm(), 1e-6);
    }
  }
  if (loaded) return;
  const Eigen::MatrixXd reduced = free.transpose() * equations.dense(u, 0.4, 0) * free;
  EXPECT_LE((reduced - reduced.transpose()).norm(), 1e-12 * reduced.norm());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((reduced + reduced.transpose()) / 2, Eigen::EigenvaluesOnly)
          .eigenvalues();
  ASSERT_TRUE(equations.linearize(u, 0.4, 0));
  EXPECT_EQ(equations.negative_pivots(1e-13), (values.array() < 0).count());
  const auto mode = free * Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(reduced).eigenvectors().col(0);
  if (held) {
    EXPECT_NEAR(mode[equations.mark()], 0, 1e-12);
  }
}

template <int D>
void expect_tangents() {
  unsigned seed = 1;
  for (const auto slopes :
       {JointSlopes::continuous, JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
    for (const bool held : {true, false}) {
      for (const bool loaded : {true, false}) {
        SCOPED_TRACE(std::to_string(D) + "D, slopes " + std::to_string(static_cast<int>(slopes)) +
                     (held ? ", held" : "") + (loaded ? ", loaded" : ""));
        expect_tangent<D>(slopes, std::nullopt, held, loaded, seed++);
        expect_tangent<D>(slopes, Support<D>::pin(), held, loaded, seed++);
        // next to it, and apart
        expect_tangent<D>(slopes, Support<D>::pin(), held, loaded, seed++,
                          {{3, JointSlopes::equal_stretch}, {6, slopes}});
        if (slopes == JointSlopes::equal_stretch || slopes == JointSlopes::free) continue;
        expect_tangent<D>(slopes, Support<D>::direction_clamp(Vec<double, D>::Ones()), held, loaded, seed++);
      }
    }
  }
}

TEST(StaticEquations, TangentAndItsInertia) {
  expect_tangents<2>();
  expect_tangents<3>();
}

Scene statics(double EA, double EI, int elements) {
  Scene scene = at_rest(elements, EA, EI);
  scene.statics.steps = 4;
  return scene;
}

SlidingJointSpec joint_at(double x, SupportType support, double mass = 0) {
  SlidingJointSpec joint;
  joint.mass = mass;
  joint.position = x;
  joint.support = support;
  return joint;
}

/// A rod of the given length through a sleeve inclined upwards, with `outside` of it beyond the sleeve at first, and a
/// dead load of 1 N downwards at its end. EA = 1000 N, EI = 1 N m^2.
Scene in_sleeve(double degrees, double length, double outside, int elements) {
  Scene scene = statics(1000, 1, elements);
  const double beta = degrees * std::numbers::pi / 180;
  scene.beam.curve.end = {length * std::cos(beta), length * std::sin(beta), 0};
  scene.sliding_joints = {joint_at(length - outside, SupportType::clamp)};
  scene.loads = {{.node = elements, .x = {}, .magnitude = {.value = 1}, .direction = {0, -1, 0}, .turn = {}}};
  return scene;
}

/// Length outside, by reference/joints.py.
constexpr double outside_at_30 = 1.027747480123, outside_at_60 = 1.474092837143;

TEST(SleeveStatics, RodBalancesWhereShootingHasItAndNotStably) {
  for (const auto& [degrees, outside] : {std::pair{30.0, outside_at_30}, std::pair{60.0, outside_at_60}}) {
    const double length = 2 * outside;
    std::vector<double> errors;
    for (const int n : {8, 16, 32}) {
      const RunResult result = completed(in_sleeve(degrees, length, 0.97 * outside, n));
      const Sample& last = result.samples.back();
      EXPECT_EQ(last.equilibrium->negative_pivots, 1) << "the rod is drawn in or thrown out";
      EXPECT_EQ(last.equilibrium->holding_force, 0);
      EXPECT_EQ(result.samples[4].equilibrium->negative_pivots, 0) << "while the sleeve grips it";
      errors.push_back(std::abs(length - *last.joint_position - outside));
      EXPECT_NEAR(last.joint->force[1], -1, 1e-9) << "the sleeve bears the load";
    }
    EXPECT_LT(errors.back(), 3e-6);
    EXPECT_GT(std::log2(errors[0] / errors[1]), 4);
    EXPECT_GT(std::log2(errors[1] / errors[2]), 4);
  }
}

/// Over several elements, either way: length control makes the mesh that the place needs.
TEST(SleeveStatics, ReachesTheSamePlaceFromWhereverItStarts) {
  for (const double start : {0.3, 0.6, 0.9, 1.2, 1.5, 1.8}) {
    const RunResult result = completed(in_sleeve(30, 2.2, start, 24));
    EXPECT_NEAR(2.2 - *result.samples.back().joint_position, outside_at_30, 3e-6) << start;
  }
}

/// Of the tension and the moment that the load makes at the sleeve: W - r_x.F - theta' M of the strain law, which
/// without stretch is P sin(beta) - M^2/2 EI.
TEST(SleeveStatics, HoldingForceIsTheConfigurationalOne) {
  std::vector<double> errors;
  for (const int n : {16, 32}) {
    Scene scene = in_sleeve(30, 2, 0.6, n);
    scene.statics.joints = StaticJoints::held;
    const RunResult result = completed(scene);
    const Sample& last = result.samples.back();
    EXPECT_EQ(*last.joint_position, 1.4);
    EXPECT_EQ(last.equilibrium->negative_pivots, 0);
    const double moment = last.end[0] - (*last.mass_position)[0], along = -0.5;
    double stretch = 1;
    for (int i = 0; i < 30; ++i) {
      const double off = 500 * stretch * (stretch * stretch - 1) - moment * moment * stretch - along;
      stretch -= off / (500 * (3 * stretch * stretch - 1) - moment * moment);
    }
    const double curvature = stretch * moment, strain = (stretch * stretch - 1) / 2;
    const double expected =
        500 * strain * strain + curvature * curvature / 2 - stretch * along - stretch * curvature * moment;
    errors.push_back(std::abs(-last.equilibrium->holding_force - expected));
  }
  EXPECT_LT(errors[1], 1e-5);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3);
}

/// A pull along the sleeve draws the rod out: what was found before stays.
TEST(SleeveStatics, WithoutAnEquilibriumTheLastHeldOneIsKept) {
  Scene scene = in_sleeve(0, 2, 1, 8);
  scene.loads.front().direction = {1, 0, 0};
  const RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("end of the beam"), std::string::npos) << result.failure;
  EXPECT_EQ(result.failure_time, 1);
  const Sample& last = result.samples.back();
  EXPECT_EQ(last.equilibrium->load_factor, 1);
  EXPECT_NEAR(std::abs(last.equilibrium->holding_force), 1, 2e-3);
  EXPECT_LT(*last.joint_position, 0.3) << "the rod went the way it was pulled";
}

/// reference/joints.py
Scene through_ring(int elements, StrainLaw law, double x) {
  Scene scene = statics(100, 0, elements);
  scene.gravity = {0, -1, 0};
  scene.beam.strain_law = law;
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.curve.start = {0, 0, 0};
  scene.start = {.type = SupportType::pin, .motion = SupportMotionSpec{{0.6, 0.8, 0}, {.value = 0.25}}};
  scene.end = {.type = SupportType::pin, .motion = SupportMotionSpec{{-0.8, 0.6, 0}, {.value = 0.2}}};
  scene.sliding_joints = {joint_at(x, SupportType::pin)};
  scene.sliding_joints.front().slopes = JointSlopes::equal_stretch;
  return scene;
}

TEST(RingStatics, CableBetweenTwoCatenaries) {
  for (const auto& [law, x, tension] : {std::tuple{StrainLaw::green, 0.69603843362944, 0.72413974955075},
                                        std::tuple{StrainLaw::engineering, 0.69597519925966, 0.72410821731492}}) {
    const RunResult result = completed(through_ring(64, law, 0.8));
    const Sample& last = result.samples.back();
    EXPECT_EQ(last.equilibrium->negative_pivots, 0);
    EXPECT_NEAR(*last.joint_position, x, 2e-8);
    EXPECT_NEAR((*last.mass_position)[0], 0.8, 1e-12);
    // the force at the ring is that of two equal tensions, and of the stretches at its slopes
    const Configuration& shape = result.configurations.back();
    ASSERT_FALSE(shape.kinks.empty());
    const Point &before = shape.r_x[shape.kinks.front().node], &behind = shape.kinks.front().r_x;
    const double stretch = std::hypot(before[0], before[1]);
    EXPECT_NEAR(stretch, std::hypot(behind[0], behind[1]), 1e-12);
    EXPECT_NEAR(100 * (stretch - 1), tension, 2e-2);
  }
}

/// A taut cable, bent at a ring. Each leg swings across by itself, n c_t/2 l of its material length l, and a wave along
/// the cable runs through the ring, n c_a/2 L, or, held there, n c_a/2 l: c_t^2 = EA (s^2 - 1)/2 rhoA,
/// c_a^2 = EA (3 s^2 - 1)/2 rhoA at the stretch s.
TEST(RingStatics, FrequenciesOfABentCable) {
  const double EA = 100, legs[2] = {0.9, std::hypot(1.5, 0.4)};
  for (const StaticJoints joints : {StaticJoints::released, StaticJoints::held}) {
    Scene scene = statics(EA, 0, 64);
    scene.beam.curve.end = {2, 0, 0};
    scene.start = {.type = SupportType::pin, .motion = SupportMotionSpec{{-1, 0, 0}, {.value = 0.1}}};
    scene.end = {.type = SupportType::pin, .motion = SupportMotionSpec{{0.3, 0.4, 0}, {.value = 0.5}}};
    scene.sliding_joints = {joint_at(0.8, SupportType::pin)};
    scene.sliding_joints.front().slopes = JointSlopes::equal_stretch;
    scene.statics.joints = joints;
    scene.statics.frequencies = 6;
    const bool released = joints == StaticJoints::released;
    const RunResult result = completed(scene);
    const double even = (legs[0] + legs[1]) / 2,
                 lengths[2] = {released ? legs[0] / even : 0.8, released ? legs[1] / even : 1.2};
    EXPECT_NEAR(*result.samples.back().joint_position, lengths[0], 1e-10);
    std::vector<double> expected;
    for (int n = 1; n <= 6; ++n) {
      for (int leg = 0; leg < 2; ++leg) {
        const double s = legs[leg] / lengths[leg], half = n / (2 * lengths[leg]);
        expected.push_back(half * std::sqrt(EA * (s * s - 1) / 2));
        const double along = std::sqrt(EA * (3 * s * s - 1) / 2);
        if (!released) expected.push_back(half * along);
        if (released && leg == 0) expected.push_back(n / 4.0 * along);
      }
    }
    std::ranges::sort(expected);
    ASSERT_EQ(result.frequencies.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(result.frequencies[i] / expected[i], 1, 1e-6) << released << i;
  }
}

/// A straight rod, pinned at one end: it bends on either side of the sleeve by itself, and its wave runs through, or
/// not.
TEST(SleeveStatics, FrequenciesOfAStraightRod) {
  const double EA = 1000, length = 2, inside = 0.8, outside = 1.2;
  const auto bending = [](double b, double l) { return b * b / (l * l * 2 * std::numbers::pi); };
  std::vector<double> expected{bending(1.8751040687119611, outside), bending(4.694091132974174, outside),
                               bending(3.9266023120479188, inside)};
  for (const StaticJoints joints : {StaticJoints::released, StaticJoints::held}) {
    Scene scene = statics(EA, 1, 40);
    scene.beam.curve.end = {length, 0, 0};
    scene.start.type = SupportType::pin;
    scene.sliding_joints = {joint_at(inside, SupportType::clamp)};
    scene.statics.joints = joints;
    scene.statics.frequencies = 4;
    const RunResult result = completed(scene);
    ASSERT_EQ(result.frequencies.size(), 4U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(result.frequencies[i] / expected[i], 1, 1e-5);
    const double axial = std::sqrt(EA) / (4 * (joints == StaticJoints::released ? length : outside));
    EXPECT_NEAR(result.frequencies[3] / axial, 1, 1e-5);
  }
}

/// A mass M held in the middle of a taut cable of material length 2 l: M w^2 = 2 K (w/c) cot(w l/c), c^2 = K/rhoA, with
/// K = EA (s^2 - 1)/2 across the cable and EA (3 s^2 - 1)/2 along it, at the stretch s.
TEST(MassStatics, FrequenciesOfABeadOnATautCable) {
  constexpr double EA = 100, mass = 5, stretch = 1.1;
  Scene scene = statics(EA, 0, 40);
  scene.beam.curve.end = {2, 0, 0};
  scene.start = {.type = SupportType::pin, .motion = SupportMotionSpec{{-1, 0, 0}, {.value = 0.1}}};
  scene.end = {.type = SupportType::pin, .motion = SupportMotionSpec{{1, 0, 0}, {.value = 0.1}}};
  scene.sliding_joints = {joint_at(1, SupportType::free, mass)};
  scene.sliding_joints.front().slopes = JointSlopes::equal_stretch;
  scene.statics.joints = StaticJoints::held;
  scene.statics.frequencies = 2;
  const RunResult result = completed(scene);
  ASSERT_EQ(result.frequencies.size(), 2U);
  for (const std::size_t i : {0, 1}) {
    const double K = EA * ((i == 0 ? 1 : 3) * stretch * stretch - 1) / 2, c = std::sqrt(K);
    double low = 1e-6, high = std::numbers::pi / 2 * c;  // of w; the difference of the two sides changes its sign once
    for (int k = 0; k < 100; ++k) {
      const double w = (low + high) / 2;
      (mass * w < 2 * K / c / std::tan(w / c) ? low : high) = w;
    }
    EXPECT_NEAR(result.frequencies[i] / (low / (2 * std::numbers::pi)), 1, 1e-6) << i;
  }
}

/// A trolley rolls to where a taut cable is lowest, and the cable bears it there.
TEST(MassStatics, TrolleyRestsInTheMiddle) {
  Scene scene = statics(1000, 0, 20);
  scene.gravity = {0, -1, 0};
  scene.beam.curve.end = {2, 0, 0};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.sliding_joints = {joint_at(0.75, SupportType::free, 5)};
  scene.sliding_joints.front().slopes = JointSlopes::equal_stretch;
  const RunResult result = completed(scene);
  const Sample& last = result.samples.back();
  EXPECT_EQ(last.equilibrium->negative_pivots, 0);
  EXPECT_NEAR(*last.joint_position, 1, 1e-6);
  EXPECT_NEAR((*last.mass_position)[0], 1, 1e-6);
  EXPECT_NEAR(last.joint->force[1], 5, 1e-9);
  EXPECT_NEAR(last.reactions[0].position[1] + last.reactions[1].position[1], 7, 1e-9);
}

/// Alone, a cut or a merge would change the number of nodes on the path of equilibria.
TEST(SleeveStatics, TakesCutsAndMergesInPairsOnly) {
  Scene scene = in_sleeve(30, 1.2, 1, 12);
  scene.length_control.lower = 0.3;
  EXPECT_EQ(refused(scene), "/length_control/lower");
}

}  // namespace
}  // namespace vlbeam::test
