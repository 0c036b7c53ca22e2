// Joints that slide on beams in space whose sections have frames.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanics/motion/system/implicit_beam.hpp"
#include "scene/build.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/by_greens_law.hpp"
#include "tests/core/support/checkpoints.hpp"
#include "tests/core/support/differences.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// A heavy bead on a stiff helix whose axis is upright.
struct BeadOnHelix {
  double radius = 0.5, pitch = -1, EI = 1e6;
  int elements = 16;
  double position = 0.5, velocity = 0, duration = 1.2, step = 5e-4;
  bool mirrored = false;

  double length() const { return std::hypot(full_turn * radius, pitch); }
  double at(double t) const { return position + velocity * t + standard_gravity * -pitch / length() * t * t / 2; }
  Scene scene() const {
    Scene scene = test::by_greens_law();
    scene.dimension = 3;
    scene.gravity = {0, 0, -standard_gravity};
    scene.beam.curve = {.type = CurveType::arc,
                        .radius = radius,
                        .pitch = pitch,
                        .from_degrees = 0,
                        .to_degrees = mirrored ? -360.0 : 360.0};
    scene.beam.section = {
        .type = Section::Type::stiffness, .EA = 100 * EI, .EI = EI, .rhoA = 1, .GIp = 0.8 * EI, .rhoIp = 1e-3};
    scene.beam.elements = elements;
    scene.start = scene.end = {.type = SupportType::clamp, .clamp = ClampType::full};
    scene.sliding_mass.emplace();
    scene.sliding_mass->mass = 10;
    scene.sliding_mass->position = position;
    scene.sliding_mass->velocity = velocity;
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = step;
    scene.duration = duration;
    return scene;
  }
  static constexpr double standard_gravity = 9.81;
};

double last_position(const RunResult& result) {
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  return *result.samples.back().joint_position;
}

/// As a point of mass on a rigid wire would, but for what the wire gives way.
TEST(FramesAtJoints, ABeadRunsDownAHelix) {
  for (const double velocity : {0.0, 1.0}) {
    BeadOnHelix bead;
    bead.EI = 1e7;
    bead.velocity = velocity;
    bead.duration = velocity > 0 ? 0.8 : 1.2;
    const RunResult result = simulate(bead.scene());
    EXPECT_NEAR(last_position(result), bead.at(bead.duration), 1e-5 * bead.length());
    EXPECT_GE(result.events.size(), 8U);
  }
}

TEST(FramesAtJoints, AMirrorImageRunsAlike) {
  BeadOnHelix bead;
  bead.duration = 0.6;
  bead.elements = 8;
  const double one = last_position(simulate(bead.scene()));
  bead.mirrored = true;
  EXPECT_NEAR(last_position(simulate(bead.scene())), one, 1e-10);
}

/// A free beam that is curved in space and bends more easily one way, on which a mass slides.
Scene free_helix(int elements) {
  Scene scene = test::by_greens_law();
  scene.dimension = 3;
  scene.gravity = {};
  scene.beam.curve = {.type = CurveType::arc, .pitch = 0.8, .from_degrees = 0, .to_degrees = 120};
  scene.beam.section = {.type = Section::Type::stiffness,
                        .EA = 1e3,
                        .rhoA = 1,
                        .GIp = 3,
                        .rhoIp = 0.05,
                        .EI_y = 4,
                        .EI_z = 8,
                        .orientation = {0.1, 0.2, 1}};
  scene.beam.elements = elements;
  scene.start.type = scene.end.type = SupportType::free;
  scene.sliding_mass.emplace();
  scene.sliding_mass->mass = 0.5;
  scene.sliding_mass->position = 0.9;
  scene.sliding_mass->velocity = 0.8;
  scene.initial_velocity = {.translation = {0.3, -0.2, 0.5}, .rotation = 4, .axis = {1, 0.4, 0.7}};
  scene.integrator.type = IntegratorType::dopri5;
  scene.integrator.rtol = scene.integrator.atol = 1e-10;
  scene.duration = 0.5;
  return scene;
}

double off(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum);
}

TEST(FramesAtJoints, AFreeBeamKeepsMomentaAndEnergy) {
  Scene scene = free_helix(6);
  scene.duration = 0.2;  // before the first event
  const RunResult smooth = simulate(scene);
  ASSERT_EQ(smooth.status, RunStatus::completed) << smooth.failure;
  EXPECT_EQ(smooth.events.size(), 0U);
  EXPECT_LE(off(smooth.samples.back().momentum, smooth.samples.front().momentum), 1e-11);
  EXPECT_LE(off(smooth.samples.back().angular_momentum, smooth.samples.front().angular_momentum), 1e-11);
  EXPECT_LE(smooth.max_energy_drift, 1e-11 * smooth.max_kinetic);
  EXPECT_GT(smooth.samples.back().energy.torsion, 1e-4);
  scene.duration = 0.5;
  scene.length_control.velocities = VelocityTransfer::conservative;
  const RunResult events = simulate(scene);
  ASSERT_EQ(events.status, RunStatus::completed) << events.failure;
  EXPECT_GE(events.events.size(), 1U);
  EXPECT_LE(off(events.samples.back().momentum, events.samples.front().momentum), 1e-11);
  EXPECT_LE(off(events.samples.back().angular_momentum, events.samples.front().angular_momentum), 1e-8);
  EXPECT_NEAR(events.samples.back().energy.total(), events.samples.front().energy.total(), 1e-8);
}

/// What damping takes is what the energy lacks, in smooth motion and through events.
TEST(FramesAtJoints, DampingIsBooked) {
  Scene scene = free_helix(6);
  scene.beam.material.damping = 0.01;
  scene.sliding_mass->velocity = 2;
  scene.duration = 0.25;
  scene.integrator.rtol = scene.integrator.atol = 1e-9;
  scene.length_control.velocities = VelocityTransfer::conservative;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_GE(result.events.size(), 1U);
  const Sample &last = result.samples.back(), &first = result.samples.front();
  EXPECT_GT(last.energy.dissipated, 1e-3 * result.max_kinetic);
  EXPECT_LE(energy_ledger(result).largest_drift, 1e-8 * result.max_kinetic);
  EXPECT_LE(off(last.momentum, first.momentum), 1e-10);
}

/// What the first cut and merge change of the energy, over meshes: of order 4, as in the plane.
TEST(FramesAtJoints, CutsAndMergesConvergeFast) {
  std::vector<double> jumps;
  for (const int elements : {6, 12, 24}) {
    Scene scene = free_helix(elements);
    scene.sliding_mass->velocity = 2;
    scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 1e-3};
    scene.duration = 0.25;
    const RunResult result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    ASSERT_GE(result.events.size(), 1U);
    jumps.push_back(std::abs(result.events.front().discrete_jump));
  }
  EXPECT_GE(std::log2(jumps[0] / jumps[2]) / 2, 3.5) << jumps[0] << " " << jumps[1] << " " << jumps[2];
  EXPECT_LE(jumps[2], 1e-5);
}

/// A joint that is led along a helix that nothing loads, through cuts and merges.
TEST(FramesAtJoints, NothingPushesAJointInTheRestShape) {
  for (const bool round : {false, true}) {
    Scene scene = free_helix(8);
    if (round) {
      scene.beam.section.EI = 5;
      scene.beam.section.EI_y.reset();
      scene.beam.section.EI_z.reset();
      scene.beam.section.orientation = {};
    }
    scene.analysis = Analysis::statics;
    scene.integrator = {};
    scene.initial_velocity.reset();
    scene.sliding_mass.reset();
    scene.start.type = SupportType::clamp;
    auto& joint = scene.sliding_joints.emplace_back();
    joint.position = 0.4;
    joint.mass = 0.3;
    joint.x = TimeSpec{.value = 1.4, .ramp = 1};
    scene.statics.steps = 12;
    const RunResult result = simulate(scene);
    EXPECT_NEAR(last_position(result), 1.8, 1e-12);
    for (const Sample& sample : result.samples) EXPECT_LE(std::abs(sample.energy.total()), 1e-22);
  }
}

/// A ring on a cantilever that is curved in space, under its weight: held, then let go to where nothing pushes it.
TEST(FramesAtJoints, ARingFindsItsEquilibrium) {
  Scene scene = free_helix(8);
  scene.analysis = Analysis::statics;
  scene.integrator = {};
  scene.initial_velocity.reset();
  scene.sliding_mass.reset();
  scene.gravity = {0, 0, -1};
  scene.start.type = SupportType::clamp;
  auto& ring = scene.sliding_joints.emplace_back();
  ring.position = 0.9;
  ring.support = SupportType::pin;
  scene.statics.steps = 4;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const double found = *result.samples.back().joint_position, least = result.samples.back().energy.total();
  EXPECT_GT(std::abs(found - 0.9), 1e-5);
  // with the beam's mark in the ring led to either side of it the energy is higher
  for (const double off : {-0.02, 0.02}) {
    scene.sliding_joints.front().x = TimeSpec{.value = found - 0.9 + off, .ramp = 1};
    const RunResult led = simulate(scene);
    ASSERT_EQ(led.status, RunStatus::completed) << led.failure;
    EXPECT_GT(led.samples.back().energy.total(), least + 1e-9);
  }
}

/// A chain with joints in motion, three of which follow each other at once.
struct ChainInSpace {
  std::unique_ptr<BeamSystem<3>> system;
  Eigen::VectorXd q, v, a;

  explicit ChainInSpace(unsigned seed, bool torques = false, bool friction = false) {
    Random random(seed);
    Scene scene = free_helix(8);
    scene.sliding_mass.reset();
    for (const double x : {0.5, 1.1, 1.4}) {
      auto& joint = scene.sliding_joints.emplace_back();
      joint.mass = 0.3;
      joint.position = x;
      joint.velocity = 0.5;
    }
    scene.sliding_joints[1].support = SupportType::pin;
    scene.sliding_joints[1].velocity = 0;
    if (friction) scene.sliding_joints[0].friction = AxialFriction{0.3, 0.4};
    scene.initial_velocity.reset();
    scene.start.type = SupportType::clamp;
    scene.beam.material.damping = 0.02;
    if (torques) {
      scene.loads = {{.type = LoadType::torque,
                      .at = LoadPlace::point,
                      .x = TimeSpec{.value = 0.8},
                      .magnitude = {.value = 2},
                      .turn = {}}};
    }
    system = std::make_unique<BeamSystem<3>>(build_model<3>(scene), build_chain<3>(scene));
    system->second_order()->expand(system->initial_state(), q, v);
    const Eigen::Index n = q.size();
    const auto some = [&](double size) {
      Eigen::VectorXd values = Eigen::VectorXd::NullaryExpr(n, [&] { return random.uniform(-size, size); });
      system->supports().project(values.data());
      return values;
    };
    q += some(0.02);
    v += some(2);
    a = some(3);
  }
};

TEST(FramesAtJoints, ResidualVanishesAtTheExplicitAcceleration) {
  for (const bool friction : {false, true}) {
    ChainInSpace chain(3, true, friction);
    auto& implicit = *chain.system->second_order();
    Eigen::VectorXd a, r(chain.q.size());
    implicit.acceleration(chain.q, chain.v, 0, a);
    implicit.residual(chain.q, chain.v, a, 0, r);
    const Eigen::VectorXd right = r;
    implicit.residual(chain.q, chain.v, Eigen::VectorXd::Zero(a.size()), 0, r);
    EXPECT_LE(right.norm(), 1e-11 * r.norm());
  }
}

TEST(FramesAtJoints, TangentIsTheDerivativeOfTheResidual) {
  for (const TangentWeights& by :
       {TangentWeights{1, 0, 0}, TangentWeights{0, 1, 0}, TangentWeights{0, 0, 1}, TangentWeights{1, 30, 900}}) {
    ChainInSpace chain(4, true);
    auto& implicit = *chain.system->second_order();
    Random random(9);
    Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(chain.q.size(), [&] { return random.uniform(-1, 1); });
    chain.system->supports().project(d.data());
    const Eigen::VectorXd difference = slope_of([&](double s) {
      Eigen::VectorXd r(chain.q.size());
      implicit.residual(chain.q + s * by.q * d, chain.v + s * by.v * d, chain.a + s * by.a * d, 0, r);
      return r;
    });
    Eigen::MatrixXd dense;
    implicit.tangent(chain.q, chain.v, chain.a, 0, by, dense);
    Eigen::VectorXd product = dense * d;
    chain.system->supports().project(product.data());
    EXPECT_LE((product - difference).norm(), 1e-8 * difference.norm()) << by.q << by.v << by.a;
    if (by.q * by.a == 0) continue;
    ASSERT_TRUE(implicit.linearize(chain.q, chain.v, chain.a, 0, by));
    Eigen::VectorXd solution = difference;
    implicit.solve(solution);
    EXPECT_LE((solution - d).norm(), 1e-6 * d.norm());
  }
}

/// Turned as a whole, with all that acts on it.
TEST(FramesAtJoints, ATurnedSceneRunsAlike) {
  const auto run = [](const Eigen::Matrix3d& turn) {
    Scene scene = free_helix(6);
    scene.beam.section.EI = 5;
    scene.beam.section.EI_y.reset();
    scene.beam.section.EI_z.reset();
    const auto turned = [&](const Vec<double, 3>& v) -> Point {
      const Vec<double, 3> w = turn * v;
      return {w[0], w[1], w[2]};
    };
    scene.beam.section.orientation = turned({0.1, 0.2, 1});
    scene.beam.curve = {.type = CurveType::nurbs};
    scene.beam.curve.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    scene.beam.curve.control_points = {turned({0, 0, 0}), turned({0.8, 0, 0.2}), turned({1.2, 0.8, 0.3}),
                                       turned({0.9, 1.2, 1})};
    scene.gravity = turned({0.5, -3, 4});
    scene.sliding_mass->velocity = 2;
    scene.duration = 0.25;
    scene.integrator.rtol = scene.integrator.atol = 1e-9;
    scene.initial_velocity = {.translation = turned({0.3, -0.2, 0.5}), .rotation = 4, .axis = turned({1, 0.4, 0.7})};
    return simulate(scene);
  };
  const RunResult one = run(Eigen::Matrix3d::Identity());
  const RunResult other = run(Eigen::AngleAxisd(2.1, Vec<double, 3>(1, -2, 0.5).normalized()).toRotationMatrix());
  EXPECT_GE(one.events.size(), 1U);
  EXPECT_NEAR(last_position(one), last_position(other), 1e-8);
}

TEST(FramesAtJoints, AnExplicitMethodAndAnImplicitOneAgree) {
  Scene scene = free_helix(6);
  scene.duration = 0.1;
  const double exact = last_position(simulate(scene));
  scene.integrator.type = IntegratorType::generalized_alpha;
  double coarser = 0;
  for (const double step : {2.5e-4, 1.25e-4}) {
    scene.integrator.step = step;
    const double error = std::abs(last_position(simulate(scene)) - exact);
    if (coarser > 0) {
      EXPECT_NEAR(std::log2(coarser / error), 2, 0.2);
    }
    coarser = error;
  }
  EXPECT_LE(coarser, 5e-7);
}

/// Its Jacobian is that of the implicit equations.
TEST(FramesAtJoints, RosenbrockAgreesWithAnExplicitMethod) {
  Scene scene = free_helix(6);
  scene.beam.material.damping = 1e-3;
  scene.sliding_mass->velocity = 2;
  scene.loads = {{.type = LoadType::torque, .node = 0, .x = {}, .magnitude = {.value = 2, .ramp = 0.1}, .turn = {}}};
  scene.duration = 0.25;
  scene.integrator.rtol = scene.integrator.atol = 1e-8;
  const RunResult exact = simulate(scene);
  scene.integrator.type = IntegratorType::rosenbrock4;
  const RunResult found = simulate(scene);
  EXPECT_GE(found.events.size(), 1U);
  EXPECT_NEAR(last_position(found), last_position(exact), 1e-6);
  EXPECT_LE(off(found.samples.back().end, exact.samples.back().end), 1e-6);
  EXPECT_NEAR(found.samples.back().energy.torsion, exact.samples.back().energy.torsion, 1e-6);
}

TEST(FramesAtJoints, GoOnFromACheckpointAsIfNothingHadBeen) {
  for (const IntegratorType type : {IntegratorType::dopri5, IntegratorType::generalized_alpha}) {
    Scene scene = free_helix(6);
    scene.sliding_mass->velocity = 1.5;
    scene.integrator.type = type;
    scene.integrator.rtol = scene.integrator.atol = 1e-6;
    expect_to_go_on(scene, 0.15);
  }
}

}  // namespace
}  // namespace vlbeam::test
