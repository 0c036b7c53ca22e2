// Beams in space whose sections have frames: equilibria, stability and motions.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "mechanics/frames/frame_room.hpp"
#include "mechanics/statics/static_equations.hpp"
#include "scene/build.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/by_greens_law.hpp"
#include "tests/core/support/checkpoints.hpp"

namespace vlbeam::test {
namespace {

using std::numbers::pi;

Section section(double EA, double EI, double GIp) {
  return {.type = Section::Type::stiffness, .EA = EA, .EI = EI, .rhoA = 0.1, .GIp = GIp, .rhoIp = 1e-4};
}

/// A clamped arc under a force across its plane at its end.
Scene loaded_arc(int elements, double radius, double degrees, const Section& of, double force) {
  Scene scene = test::by_greens_law();
  scene.dimension = 3;
  scene.gravity = {};
  scene.analysis = Analysis::statics;
  scene.beam.curve = {.type = CurveType::arc, .radius = radius, .from_degrees = 0, .to_degrees = degrees};
  scene.beam.section = of;
  scene.beam.elements = elements;
  scene.start.type = SupportType::clamp;
  scene.loads = {{.node = elements, .x = {}, .magnitude = {.value = force}, .direction = {0, 0, 1}, .turn = {}}};
  scene.statics.steps = 5;
  return scene;
}

Point tip(const Scene& scene) {
  const RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_EQ(result.samples.back().equilibrium->negative_pivots, 0);
  return result.samples.back().end;
}

TEST(FramesInSpace, AQuarterArcBendsAndTwistsAcrossItsPlane) {
  const double EI = 10, force = 1e-4;
  for (const double GIp : {EI / 1.3, 1e6 * EI}) {
    const double exact = force * (pi / 4 / EI + (3 * pi / 4 - 2) / GIp);
    double coarser = 0;
    for (const auto& [elements, mark] : {std::pair{2, 5e-3}, {4, 2.5e-4}, {8, 2e-5}, {16, 2e-6}}) {
      const double error = std::abs(tip(loaded_arc(elements, 1, 90, section(1e8, EI, GIp), force))[2] / exact - 1);
      EXPECT_LE(error, mark) << elements << " " << GIp;
      if (coarser > 0 && elements <= 8) {
        EXPECT_NEAR(std::log2(coarser / error), 4, 0.3);
      }
      coarser = error;
    }
  }
}

/// A hook, 1000 times slenderer and more: it is where it was, and stable.
TEST(FramesInSpace, ASlenderHookIsStable) {
  std::vector<Point> tips;
  for (const double radius : {1e-3, 1e-5, 5e-6}) {
    const double EI = 2e11 * pi * radius * radius * radius * radius / 4;
    Scene scene = loaded_arc(16, 1, 0, section(2e11 * pi * radius * radius, EI, EI / 1.3), 2 * EI);
    scene.beam.curve = {.type = CurveType::nurbs};
    scene.beam.curve.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    scene.beam.curve.control_points = {{0, 0, 0}, {0.5, 0, 0}, {0.7, 0.4, 0.1}, {0.3, 0.5, 0.4}};
    scene.loads.front().direction = {0.3, -1, 0.5};
    tips.push_back(tip(scene));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(tips.back()[c], tips.front()[c], 1e-6) << radius;
  }
}

/// Bathe & Bolourchi (1979): published results are of elements that shear, and within 1 % of this.
TEST(FramesInSpace, ABendOf45DegreesGoesFar) {
  const Point exact{100 - 15.558, 46.892, 53.608};
  for (const auto& [elements, mark] : {std::pair{8, 1e-2}, {16, 1e-3}}) {
    const Point at = tip(loaded_arc(elements, 100, 45, section(1e7, 1e7 / 12, 7.03e5), 600));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(at[c], exact[c], mark);
  }
}

/// A straight shaft of unit length and bending stiffness between pins or clamps, one of which may come nearer, under
/// torques at its ends.
class Twisted {
 public:
  Twisted(int elements, SupportType ends) : elements_(elements) {
    scene_.dimension = 3;
    scene_.gravity = {};
    scene_.analysis = Analysis::statics;
    scene_.beam.section = section(1e7, 1, GIp_);
    scene_.beam.elements = elements;
    scene_.beam.space_law = SpaceLaw::frames;
    scene_.start.type = scene_.end.type = ends;
    for (const int node : {0, elements}) {
      scene_.loads.push_back({.type = LoadType::torque, .node = node, .x = {}, .magnitude = {.value = 1}, .turn = {}});
    }
    scene_.loads.front().magnitude.value = -1;
  }

  /// Whether all eigenvalues of the straight shaft's tangent, which torques make unsymmetric, are positive.
  bool is_stable(double torque) const {
    BeamModel<3> model = build_model<3>(scene_);
    for (Torques::Point& load : bring<FrameRoom>(model).torques.points) {
      load.torque = [unit = load.torque(1), torque](double) { return unit * torque; };
    }
    model.end.free_position[0] = 1;
    model.start.free_angle = model.end.free_angle = true;
    Support<3> middle;  // turning as a whole is no instability
    middle.free_angle = false;
    model.held_nodes.push_back({elements_ / 2, middle});
    BeamSystem<3> system(model, build_chain<3>(scene_));
    StaticEquations<3> equations(system);
    Eigen::VectorXd u = system.initial_state().head(system.coordinates());
    for (int k = 0; k <= elements_; ++k) u[system.angles() + k] = torque / GIp_ * (k - elements_ / 2) / elements_;
    // sections that are stretched twist less, by this law: the shaft gets longer by M^2/(GIp EA)
    for (int i = 0; i < 3; ++i) {
      Eigen::VectorXd r;
      equations.residual(u, 1, r);
      if (!equations.linearize(u, 1, 0)) return false;
      equations.solve(r);
      u -= r;
    }
    // buckling in two directions at once: a determinant would keep its sign
    const Eigen::MatrixXd directions = equations.directions(u);
    const Eigen::MatrixXd tangent = directions.transpose() * equations.dense(u, 1, 0) * directions;
    return Eigen::EigenSolver<Eigen::MatrixXd>(tangent, false).eigenvalues().real().minCoeff() > 0;
  }

  double critical_torque(double low, double high) const {
    EXPECT_TRUE(is_stable(low));
    EXPECT_FALSE(is_stable(high));
    for (int i = 0; i < 20; ++i) {
      const double middle = (low + high) / 2;
      (is_stable(middle) ? low : high) = middle;
    }
    return low;
  }

 private:
  static constexpr double GIp_ = 0.8;
  int elements_;
  Scene scene_;
};

TEST(FramesInSpace, AShaftBucklesByTorque) {
  // Greenhill (1883): tan(M L/(2 EI)) = M L/(2 EI) where ends are clamped, M L/EI = 2 pi where they are hinged
  EXPECT_NEAR(Twisted(12, SupportType::clamp).critical_torque(8.5, 9.5) / 8.98682, 1, 2e-3);
  EXPECT_NEAR(Twisted(12, SupportType::pin).critical_torque(6, 6.6) / (2 * pi), 1, 2e-3);
}

/// A free arc with two bending stiffnesses.
Scene free_arc() {
  Scene scene = test::by_greens_law();
  scene.dimension = 3;
  scene.gravity = {};
  scene.beam.curve = {.type = CurveType::arc, .from_degrees = 0, .to_degrees = 120};
  scene.beam.section = {.type = Section::Type::stiffness,
                        .EA = 1e3,
                        .rhoA = 1,
                        .GIp = 3,
                        .rhoIp = 0.05,
                        .EI_y = 4,
                        .EI_z = 8,
                        .orientation = {0.1, 0.2, 1}};
  scene.beam.elements = 4;
  scene.start.type = SupportType::free;
  scene.integrator.type = IntegratorType::dopri5;
  scene.integrator.rtol = scene.integrator.atol = 1e-10;
  return scene;
}

TEST(FramesInSpace, AFreeBeamThatTumblesKeepsMomentaAndEnergy) {
  Scene scene = free_arc();
  scene.initial_velocity = {.translation = {0.3, -0.2, 0.5}, .rotation = 4, .axis = {1, 0.4, 0.7}};
  scene.duration = 1.5;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const Sample &first = result.samples.front(), &last = result.samples.back();
  const auto size = [](const auto& vector) { return Eigen::Map<const Eigen::Vector3d>(vector.data()); };
  EXPECT_LE((size(last.momentum) - size(first.momentum)).norm(), 1e-9 * size(first.momentum).norm());
  EXPECT_LE((size(last.angular_momentum) - size(first.angular_momentum)).norm(),
            1e-9 * size(first.angular_momentum).norm());
  EXPECT_LE(result.max_energy_drift, 1e-9 * first.energy.total());
  EXPECT_GT(last.energy.torsion, 1e-5 * first.energy.total());
}

/// Turned by a force and a torque that grow smoothly.
Scene driven_arc() {
  Scene scene = free_arc();
  scene.duration = 0.8;
  scene.output.interval = 0.1;
  scene.loads = {{.node = 4, .x = {}, .magnitude = {.value = 12, .ramp = 0.6}, .direction = {1, 0.5, 1}, .turn = {}},
                 {.type = LoadType::torque, .node = 0, .x = {}, .magnitude = {.value = 2, .ramp = 0.6}, .turn = {}}};
  return scene;
}

TEST(FramesInSpace, GeneralizedAlphaIsOfSecondOrder) {
  Scene scene = driven_arc();
  const RunResult fine = simulate(scene);
  ASSERT_EQ(fine.status, RunStatus::completed) << fine.failure;
  EXPECT_LE(fine.max_energy_drift, 1e-9 * fine.max_kinetic);  // the torque's work included
  scene.integrator.type = IntegratorType::generalized_alpha;
  double coarser = 0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    scene.integrator.step = step;
    const RunResult result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    double error = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      error = std::max(error, std::abs(result.samples.back().end[c] - fine.samples.back().end[c]));
    }
    if (coarser > 0) {
      EXPECT_NEAR(std::log2(coarser / error), 2, 0.2);
    }
    coarser = error;
  }
  EXPECT_LE(coarser, 1e-4);
}

/// The moment in a rod that an oblique one turns at its end is that one all along. So the rod becomes a helix about its
/// axis, however stiff it is in torsion: EI t' = M x t. One that follows stands otherwise about the first tangent.
TEST(FramesInSpace, AMomentRollsARodUpToAHelix) {
  const Eigen::Vector3d axis(0.8, 0, 0.6), start(1, 0, 0);
  const Eigen::Vector3d u = (start - 0.8 * axis) / 0.6, v = axis.cross(u);
  const double turning = 4 * pi;  // M/EI, over the length of 1
  const Eigen::Vector3d exact = 0.8 * axis + 0.6 / turning * (std::sin(turning) * u + (1 - std::cos(turning)) * v);
  Scene scene = test::by_greens_law();
  scene.dimension = 3;
  scene.analysis = Analysis::statics;
  scene.gravity = {};
  scene.beam.curve = {.type = CurveType::line, .start = {0, 0, 0}, .end = {1, 0, 0}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e5, .EI = 2, .rhoA = 1, .GIp = 0.7};
  scene.beam.space_law = SpaceLaw::frames;
  scene.beam.strain_law = StrainLaw::engineering;
  scene.start.type = SupportType::clamp;
  scene.statics.steps = 40;
  const auto end = [&](int elements, bool follows) {
    scene.beam.elements = elements;
    scene.loads = {{.type = LoadType::moment,
                    .node = elements,
                    .x = {},
                    .magnitude = {.value = 2 * turning},
                    .direction = {0.8, 0, 0.6},
                    .follows = follows,
                    .turn = {}}};
    const RunResult run = simulate(scene);
    EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
    const Point& at = run.samples.back().end;
    return Eigen::Vector3d(at[0], at[1], at[2]);
  };
  const double coarse = (end(16, false) - exact).norm(), fine = (end(32, false) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.4);
  EXPECT_LE(fine, 1e-4);
  const Eigen::Vector3d followed = end(32, true);
  EXPECT_NEAR(followed[0], exact[0], 1e-4);
  EXPECT_NEAR(followed.norm(), exact.norm(), 1e-4);
  EXPECT_GT((followed - exact).norm(), 1e-2);
}

TEST(FramesInSpace, AMomentFeedsAngularMomentumAndEnergy) {
  for (const bool follows : {false, true}) {
    Scene scene = free_arc();
    scene.duration = 0.8;
    scene.loads = {{.type = LoadType::moment,
                    .node = 2,
                    .x = {},
                    .magnitude = {.value = 3, .ramp = 0.6},
                    .direction = {0.5, -1, 0.7},
                    .follows = follows,
                    .turn = {}}};
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    EXPECT_GT(run.max_kinetic, 0.1);
    EXPECT_LE(run.max_energy_drift, 1e-8 * run.max_kinetic);
    if (follows) continue;
    const Eigen::Vector3d axis = Eigen::Vector3d(0.5, -1, 0.7).normalized();
    const double impulse = 3 * (0.8 - 0.6 / 2);  // a smooth ramp is symmetric
    const Point& gained = run.samples.back().angular_momentum;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(gained[static_cast<std::size_t>(c)], impulse * axis[c], 1e-8);
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 1e-3;
    const RunResult implicit = simulate(scene);
    ASSERT_EQ(implicit.status, RunStatus::completed) << implicit.failure;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(implicit.samples.back().end[c], run.samples.back().end[c], 1e-4);
  }
}

TEST(FramesInSpace, GoOnFromACheckpointAsIfNothingHadBeen) {
  for (const IntegratorType type : {IntegratorType::dopri5, IntegratorType::generalized_alpha}) {
    Scene scene = free_arc();
    scene.initial_velocity = {.rotation = 6, .axis = {1, 0.4, 0.7}};
    scene.duration = 0.6;
    scene.integrator.type = type;
    scene.integrator.rtol = scene.integrator.atol = 1e-6;
    expect_to_go_on(scene, 0.2);
  }
}

}  // namespace
}  // namespace vlbeam::test
