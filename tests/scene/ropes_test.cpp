// Ropes as data sheets mean them, by default: law, tension, slack, corners, starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/automatic_integrator.hpp"
#include "scene/corners.hpp"
#include "scene/derived.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/shape.hpp"
#include "scene/slack.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double rope_gravity = 9.81;

/// A rope of unit length and weight w = rhoA g, drawn along a line.
Scene unit_rope(int elements, double EA_over_weight) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA_over_weight * rope_gravity, .EI = 0, .rhoA = 1};
  scene.beam.elements = elements;
  scene.statics.steps = 1;
  scene.duration = 1;
  scene.output.configurations = {1};
  return scene;
}

bool slack_is_warned_of(const RunResult& run) {
  return std::ranges::any_of(run.warnings, [](const Warning& w) { return w.kind == WarningKind::buckled_elements; });
}

/// The elastic catenary from (0, 0), by the horizontal and the vertical pull H and V at its end: x and y of the
/// material point s, and its tension (Irvine 1981, w = 9.81 N/m, length 1 m).
struct Catenary {
  double EA, H, V;  // V: at the end
  double vertical(double s) const { return V - rope_gravity * (1 - s); }
  double tension(double s) const { return std::hypot(H, vertical(s)); }
  std::array<double, 2> place(double s) const {
    const double a = vertical(0) / H, b = vertical(s) / H, c = H / rope_gravity;
    return {H * s / EA + c * (std::asinh(b) - std::asinh(a)),
            (vertical(0) * s + rope_gravity * s * s / 2) / EA + c * (std::sqrt(1 + b * b) - std::sqrt(1 + a * a))};
  }
};

TEST(Ropes, PullByTheirElongation) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.gravity = {};
  scene.beam.curve.end = {100, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 0, .rhoA = 1};
  scene.beam.elements = 10;
  scene.start.type = scene.end.type = SupportType::pin;
  scene.end.motion = SupportMotionSpec{{1, 0, 0}, {.value = 5}, {}};
  const RunResult run = test::completed(scene);
  EXPECT_NEAR(run.samples.back().strains.axial_force[1], 5e4, 1e-6);
  EXPECT_NEAR(run.samples.back().reactions[1].position[0], 5e4, 1e-6);
}

TEST(Ropes, AMomentRollsUpARodThatKeepsItsLength) {
  Scene scene = test::at_rest(16, 100, 1);
  scene.beam.strain_law = Scene().beam.strain_law;
  scene.start = {SupportType::clamp, ClampType::direction};
  scene.loads = {
      {.type = LoadType::moment, .node = 16, .x = {}, .magnitude = {.value = 2 * std::numbers::pi}, .turn = {}}};
  const RunResult run = test::completed(scene);
  EXPECT_NEAR(run.samples.back().beam_length, 1, 1e-5);
  EXPECT_NEAR(std::hypot(run.samples.back().end[0], run.samples.back().end[1]), 0, 2e-4);
}

// The tension of a hanging rope is the catenary's, all along it, however stiff it is and on few elements.
TEST(Ropes, HangAsTheCatenaryAtAllStiffnesses) {
  for (const double stiffness : {10.0, 1e3, 1e5, 1e6}) {
    for (const auto& [H, V] : {std::array{3.0, 5.0}, std::array{10.0, 12.0}}) {
      Scene scene = unit_rope(20, stiffness);
      const Catenary exact{stiffness * rope_gravity, H, V};
      const auto to = exact.place(1);
      scene.start.type = scene.end.type = SupportType::pin;
      scene.end.motion = SupportMotionSpec{{to[0] - 1, to[1], 0}, {.value = std::hypot(to[0] - 1, to[1])}, {}};
      const RunResult run = test::completed(scene);
      EXPECT_FALSE(slack_is_warned_of(run)) << stiffness;
      ASSERT_FALSE(run.configurations.empty());
      const double most = std::max(exact.tension(0), exact.tension(1));
      for (const ShapePoint& point : points_along(scene, run.configurations.back(), 4)) {
        const auto place = exact.place(point.x);
        EXPECT_NEAR(point.tension, exact.tension(point.x), 0.01 * most) << stiffness << " at " << point.x;
        EXPECT_NEAR(std::hypot(point.r[0] - place[0], point.r[1] - place[1]), 0, 1e-4)
            << stiffness << " at " << point.x;
      }
    }
  }
}

// At a free end nothing pulls, and the end hangs straight below.
TEST(Ropes, HangFreelyFromOneEnd) {
  for (const double stiffness : {10.0, 1e3, 1e6}) {
    for (const bool turned : {false, true}) {
      Scene scene = unit_rope(8, stiffness);
      scene.beam.curve.end = turned ? Point{0.6, -0.8, 0} : Point{0, -1, 0};
      scene.start.type = SupportType::pin;
      const RunResult run = test::completed(scene);
      EXPECT_FALSE(slack_is_warned_of(run)) << stiffness;
      const Sample& last = run.samples.back();
      EXPECT_NEAR(last.strains.axial_force[1], rope_gravity, 1e-4 * rope_gravity);
      EXPECT_NEAR(last.strains.axial_force[0], 0, 1e-2 * rope_gravity);
      EXPECT_NEAR(last.end[0], 0, 1e-6) << stiffness;
      EXPECT_NEAR(last.end[1], -(1 + 0.5 / stiffness), 1e-5) << stiffness;
    }
  }
}

TEST(Ropes, AreSlackByDefaultOverWhatScalesWithTheScene) {
  Scene scene = unit_rope(8, 1e3);
  EXPECT_EQ(compression(scene), Compression::none);
  EXPECT_NEAR(slack_over(scene), 3e-5, 1e-12);
  Scene larger = scene;  // lengths times 100, masses times 7, g as it is
  larger.beam.curve.end = {100, 0, 0};
  larger.beam.section.rhoA *= 7.0 / 100;
  larger.beam.section.EA *= 7;
  EXPECT_NEAR(slack_over(larger), slack_over(scene), 1e-15);
  scene.beam.section.EI = 1;
  EXPECT_EQ(compression(scene), Compression::full);
  scene.beam.section.EI = 0;
  scene.analysis = Analysis::dynamics;
  scene.integrator.type = IntegratorType::energy_momentum;
  EXPECT_EQ(compression(scene), Compression::full);
}

Scene over_a_corner() {
  Scene scene = unit_rope(15, 1e6);
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = {{-1, 0, 0}, {0, 0, 0}, {0, -2, 0}};
  scene.start.type = SupportType::pin;
  SlidingJointSpec ring;
  ring.support = SupportType::pin;
  ring.slopes = JointSlopes::free;
  scene.sliding_joints = {ring};
  scene.point_masses = {{15, 50}};
  return scene;
}

TEST(Corners, AJointStandsAtTheCornerThatItNames) {
  Scene scene = over_a_corner();
  scene.sliding_joints[0].at_corner = CornerSpec{1};
  place_at_corners(scene);
  EXPECT_EQ(scene.sliding_joints[0].position, 1);
  scene.sliding_joints[0].position = 1 + 0.009 * standard_length(scene);
  place_at_corners(scene);
  EXPECT_EQ(scene.sliding_joints[0].position, 1) << "it means the corner";
  scene.sliding_joints[0].position = 1 + 0.02 * standard_length(scene);
  place_at_corners(scene);
  EXPECT_NE(scene.sliding_joints[0].position, 1);
  scene.sliding_joints[0].at_corner = CornerSpec{2};
  EXPECT_THROW(place_at_corners(scene), InvalidInput);
}

TEST(Corners, ACornerThatIsRoundedOffBesideAJointIsSaid) {
  Scene scene = over_a_corner();
  scene.sliding_joints[0].position = 1.1;
  const RunResult run = simulate(scene);
  EXPECT_TRUE(
      std::ranges::any_of(run.warnings, [](const Warning& w) { return w.kind == WarningKind::rounded_corner; }));
}

// A motion that starts from an equilibrium starts from one of its rings, too: nothing rings along the rope.
TEST(Starts, TheEquilibriumIsOneOfTheRings) {
  Scene scene = over_a_corner();
  scene.sliding_joints[0].position = 1;
  scene.analysis = Analysis::dynamics;
  scene.initial_shape = InitialShape::equilibrium;
  scene.duration = 0.01;
  scene.output.interval = 0.01;
  scene.output.configurations.clear();
  const RunResult run = test::completed(scene);
  EXPECT_EQ(run.samples.front().equilibrium->holding_force, 0);
  EXPECT_NEAR(run.samples.back().end[1], run.samples.front().end[1], 1e-7);
}

// Without the ground the mass would stretch the rope by a hundredth.
TEST(Ground, BearsAMassAtTheEndOfARope) {
  Scene scene = unit_rope(8, 1e4);
  scene.beam.curve.start = {0, 1, 0};
  scene.beam.curve.end = {0, 0, 0};
  scene.start.type = SupportType::pin;
  scene.point_masses = {{8, 100}};
  scene.ground = GroundSpec{.height = 0, .stiffness = 1e6};
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  EXPECT_NEAR(run.samples.back().end[1], 0, 1e-4);
}

// A winch lowers 100 kg at 0.2 m/s; the ground's damper stops them within 0.1 ms, a fraction of a usual step. The
// ledger knows what the damper has taken: the kinetic energy and the stretch of the wire, not the power of either end
// of a step.
TEST(Ground, ALandingLosesWhatTheLoadHad) {
  Scene scene;
  scene.gravity = {0, -rope_gravity, 0};
  scene.initial_shape = InitialShape::equilibrium;
  scene.beam.curve.start = {0, 5, 0};
  scene.beam.curve.end = {0, 0.5, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 0, .rhoA = 0.5};
  scene.beam.material.damping = 0.01;
  scene.beam.elements = 10;
  scene.start.type = SupportType::pin;
  scene.start.feed = TimeSpec{.table = {{0, 0, 0}, {5, 1, 0}}};
  scene.point_masses = {{10, 100}};
  scene.ground = GroundSpec{.height = 0, .stiffness = 1e6, .damping = 1e4};
  scene.duration = 4;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = test::completed(scene);
  EXPECT_NEAR(run.samples.back().end[1], 0, 1e-4);
  const EnergyLedger ledger = energy_ledger(run);
  EXPECT_LE(ledger.largest_unexplained, 0.3) << "of 480 J that the winch has let down";
  EXPECT_GT(ledger.dissipated, 2 + 2.2) << "in motion and in the wire, while the winch goes on";
  EXPECT_LT(ledger.dissipated, 10);
}

// A rope that hangs through a ring between two pins, and is to slide in it: 5 N pull on both sides of the ring where
// 0.45 m are before it. A stiff one is slack behind a merge, and Newton's iteration has no stiffness there.
TEST(Starts, AStiffRopeFindsItsPlaceInARing) {
  for (const auto& [stiffness, elements] : {std::pair{1e3, 12}, {1e5, 12}, {1e7, 17}, {1e7, 32}}) {
    const double EA = stiffness * rope_gravity, before = 0.45, drawn = 0.4;
    const Catenary up{EA, 3, 4 + (1 - before) * rope_gravity};  // of a rope of 1 m whose first part this is
    const double down = 4.5, H = std::sqrt(25 - down * down);
    const Catenary behind{EA, H, rope_gravity - down};
    const auto first = up.place(before), second = behind.place(1 - before);
    const auto along = [](const std::array<double, 2>& a, double length) {
      const double size = std::hypot(a[0], a[1]);
      return Point{a[0] / size * length, a[1] / size * length, 0};
    };
    Scene scene = unit_rope(elements, stiffness);
    scene.beam.curve.type = CurveType::polyline;
    const Point start = along(first, -drawn), end = along(second, 1 - drawn);
    scene.beam.curve.points = {start, {}, end};
    const auto hold = [](SupportSpec& support, const Point& from, const Point& to) {
      const Point way{to[0] - from[0], to[1] - from[1], 0};
      support.type = SupportType::pin;
      support.motion = SupportMotionSpec{way, {.value = std::hypot(way[0], way[1])}, {}};
    };
    hold(scene.start, start, {-first[0], -first[1], 0});
    hold(scene.end, end, {second[0], second[1], 0});
    SlidingJointSpec& ring = scene.sliding_joints.emplace_back();
    ring.support = SupportType::pin;
    ring.position = drawn;
    ring.slopes = JointSlopes::free;
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.status, RunStatus::completed) << stiffness << ", " << elements << ": " << run.failure;
    EXPECT_NEAR(*run.samples.back().joint_position, before, 1e-4) << stiffness << ", " << elements;
  }
}

TEST(PointMasses, StandAtAPosition) {
  Scene scene = unit_rope(10, 1e6);
  scene.beam.curve.end = {0, -1, 0};
  scene.start.type = SupportType::pin;
  scene.point_masses = {{.mass = 2, .position = 0.37}};
  const RunResult run = test::completed(scene);
  EXPECT_NEAR(run.samples.back().reactions[0].position[1], 3 * rope_gravity, 1e-6);
  const auto points = points_along(scene, run.configurations.back(), 1);
  EXPECT_TRUE(std::ranges::any_of(points, [](const ShapePoint& p) { return std::abs(p.x - 0.37) < 1e-12; }));
}

// A taut rope merges with unit weights by default, whichever way its merged element is found: fitted weights follow its
// waves, 0.002 and less, and one such merge let a converge run of a zipline gain 1.3e5 J.
TEST(Ropes, MergeWithUnitWeightsUnlessTheSceneSaysHow) {
  Scene scene = unit_rope(12, 1e5);
  scene.analysis = Analysis::dynamics;
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = {{0, 0, 0}, {2, -2.5, 0}, {20, -3, 0}};
  scene.beam.section.rhoA = 0.5;
  scene.start.type = scene.end.type = SupportType::pin;
  SlidingJointSpec rider;
  rider.position = std::hypot(2, 2.5);
  rider.mass = 80;
  rider.slopes = JointSlopes::free;
  scene.sliding_joints = {rider};
  scene.duration = 1;
  scene.output.configurations = {};
  const auto merges_of_unit_weights = [](const Scene& s) {
    const RunResult run = test::completed(s);
    EXPECT_FALSE(run.events.empty());
    return std::ranges::all_of(run.events, [](const Event& e) { return e.weights == std::array<double, 3>{1, 1, 1}; });
  };
  EXPECT_EQ(merge_policy(scene), MergePolicy::relaxed);
  EXPECT_TRUE(merges_of_unit_weights(scene));
  scene.length_control.merge = MergePolicy::relaxed;
  EXPECT_FALSE(merges_of_unit_weights(scene));
}

}  // namespace
}  // namespace vlbeam
