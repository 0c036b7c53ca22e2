// Beam that comes in or leaves through an end: what a winch pays out or draws in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

/// A cable that hangs askew from a support that feeds it.
Scene paid_out(ElementKind element = ElementKind::ale_ancf) {
  Scene scene;
  scene.gravity = {0, -9.81, 0};
  scene.beam.element = element;
  scene.beam.elements = 5;
  scene.beam.curve.start = {0.5, 2, 0};
  scene.beam.curve.end = {1.1, 1.2, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 500, .EI = 0.01, .rhoA = 0.1};
  scene.beam.axial_strain = AxialStrain::full;
  scene.start.type = SupportType::pin;
  scene.start.feed = TimeSpec{.rate = 1, .ramp = 0.1};
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  scene.duration = 0.3;
  scene.output.interval = 0.02;
  return scene;
}

/// The same fed at its other end, from the same support.
Scene turned_round(Scene scene) {
  std::swap(scene.beam.curve.start, scene.beam.curve.end);
  std::swap(scene.start, scene.end);
  return scene;
}

SlidingJointSpec bead(double position) {
  SlidingJointSpec joint;
  joint.position = position;
  joint.mass = 0.05;
  return joint;
}

Scene implicit(Scene scene, double step, Constraints constraints = Constraints::eliminated) {
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = step;
  scene.constraints = constraints;
  return scene;
}

long count(const RunResult& run, EventType type) {
  return std::ranges::count_if(run.events, [type](const Event& event) { return event.type == type; });
}

TEST(Feed, BringsTheEnergyThatIsThen) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const int parts : {0, 1, 2, 3}) {
      Scene scene = paid_out(element);
      if (parts % 2 == 1) scene.start.type = SupportType::clamp;
      if (parts == 1) scene.beam.material.damping = 1e-4;
      if (parts == 2) scene.sliding_joints.push_back(bead(0.3));
      if (parts == 3) {
        scene.gravity_ramp = 0.2;
        scene.start.motion = {.direction = {1, 0.5, 0}, .displacement = {.rate = 1, .ramp = 0.2}};
        scene.drag.emplace().linear = {.normal = 0.1, .tangential = 0.05};
        scene.point_masses = {{.node = 3, .mass = 0.1}};
        scene.loads = {
            {.at = LoadPlace::beam, .x = {}, .magnitude = {.value = 0.5}, .direction = {1, 0, 0}, .turn = {}}};
      }
      const RunResult run = test::completed(scene);
      EXPECT_GE(count(run, EventType::segmentation), 1);
      EXPECT_GT(std::abs(run.samples.back().energy.supplied), 0.1);
      EXPECT_LT(run.max_energy_drift, 1e-9 * run.max_kinetic) << parts;
      if (parts == 2) continue;
      EXPECT_LT(test::completed(turned_round(scene)).max_energy_drift, 1e-9 * run.max_kinetic) << parts;
    }
  }
}

TEST(Feed, DrawsInWhatItPaidOut) {
  Scene scene = paid_out();
  scene.gravity = {0, -1, 0};
  scene.beam.material.mass_damping = 20;
  scene.start.feed = TimeSpec{.amplitude = 0.3, .frequency = 1, .phase_degrees = 90};
  scene.duration = 1;
  scene.output.configurations = {0.5, 1};
  const RunResult run = test::completed(scene);
  EXPECT_GT(count(run, EventType::segmentation), 0);
  EXPECT_GT(count(run, EventType::merging), 2);
  EXPECT_LT(run.max_energy_drift, 1e-9 * run.max_kinetic);
  ASSERT_EQ(run.configurations.size(), 2U);
  EXPECT_NEAR(run.configurations[0].x.front(), 0.6, 1e-12);
  EXPECT_NEAR(run.configurations[1].x.front(), 0, 1e-12);
  EXPECT_EQ(run.configurations[1].x.back(), 1);
}

// With two slopes at a ring the beam on its one side knows of the other by its way alone.
TEST(Feed, IsOneSideOfAGuidedRing) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    Scene one = paid_out(element);
    one.length_control.lower = 0.3;
    Scene two = one;
    two.start = {};
    two.beam.curve.start = {-0.1, 2.8, 0};
    two.beam.elements = 10;
    SlidingJointSpec& ring = two.sliding_joints.emplace_back();
    ring.support = SupportType::pin;
    ring.position = 1;
    ring.slopes = JointSlopes::free;
    ring.x = TimeSpec{.rate = -1, .ramp = 0.1};
    const RunResult fed = test::completed(one), guided = test::completed(two);
    EXPECT_GT(fed.events.size(), 0U);
    for (std::size_t i = 0; i < fed.samples.size(); ++i) {
      for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(fed.samples[i].end[c], guided.samples[i].end[c], 1e-9) << i;
    }
  }
}

TEST(Feed, IsTheSameFromEitherEnd) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    const Scene scene = paid_out(element);
    const RunResult at_start = test::completed(scene), at_end = test::completed(turned_round(scene));
    ASSERT_EQ(at_start.events.size(), at_end.events.size());
    const auto& start = at_start.samples.back();
    const auto& end = at_end.samples.back();
    EXPECT_NEAR(start.energy.supplied, end.energy.supplied, 1e-9);
    EXPECT_NEAR(start.momentum[0], end.momentum[0], 1e-9);
    EXPECT_NEAR(start.reactions[0].position[1], end.reactions[1].position[1], 1e-6);
  }
}

TEST(Feed, OfNothingChangesNothing) {
  Scene scene = paid_out(ElementKind::ale_rancf);
  scene.start.feed.reset();
  const RunResult held = test::completed(scene);
  scene.start.feed = TimeSpec{};
  const RunResult fed = test::completed(scene);
  for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(held.samples.back().end[c], fed.samples.back().end[c], 1e-10);
  EXPECT_EQ(fed.samples.back().energy.supplied, 0);
}

TEST(Feed, IsTheSameWithEveryIntegrator) {
  for (const bool slides : {false, true}) {
    Scene scene = paid_out();
    if (slides) scene.sliding_joints.push_back(bead(0.5));
    scene.start.feed->rate = -1;
    scene.gravity = {0, -3, 0};
    const RunResult exact = test::completed(scene);
    const auto off = [&](const Scene& other) {
      const auto end = test::completed(other).samples.back().end;
      return std::hypot(end[0] - exact.samples.back().end[0], end[1] - exact.samples.back().end[1]);
    };
    const double coarse = off(implicit(scene, 2e-4)), fine = off(implicit(scene, 1e-4));
    EXPECT_LT(fine, 1e-4);
    EXPECT_GT(coarse / fine, 3) << "order 2";
    EXPECT_NEAR(off(implicit(scene, 1e-4, Constraints::multipliers)), fine, 1e-7);
    if (slides) continue;
    scene.integrator.type = IntegratorType::rosenbrock4;
    scene.integrator.rtol = scene.integrator.atol = 1e-6;
    EXPECT_LT(off(scene), 1e-4);
  }
}

// A rigid rod that is let down at s(t) hangs by its weight less what it takes to let it fall faster.
TEST(Feed, LetsARodDownByItsWeight) {
  constexpr double rhoA = 0.1, g = 9.81, acceleration = 2, ramp = 0.2;
  Scene scene = paid_out();
  scene.beam.curve.start = {0, 0, 0};
  scene.beam.curve.end = {0, -1, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 1, .rhoA = rhoA};
  scene.initial_shape = InitialShape::equilibrium;
  scene.start.feed = TimeSpec{.acceleration = acceleration, .ramp = ramp};
  scene = implicit(scene, 1e-4);
  scene.duration = 1;
  const RunResult run = test::completed(scene);
  EXPECT_GT(count(run, EventType::segmentation), 3);
  for (const Sample& sample : run.samples) {
    if (sample.t < ramp + 0.05) continue;
    const double s = acceleration * sample.t * sample.t / 2, speed = acceleration * sample.t;
    EXPECT_NEAR(sample.end[1], -(1 + s), 1e-5) << sample.t;
    const double tension = rhoA * (1 + s) * (g - acceleration);  // the reaction gives what comes in its momentum
    EXPECT_NEAR(sample.reactions[0].position[1] / (tension - rhoA * speed * speed), 1, 1e-4) << sample.t;
    const double energy = rhoA * (1 + s) * (speed * speed / 2 - g * (1 + s) / 2) + rhoA * g / 2;
    EXPECT_NEAR(sample.energy.supplied, energy, 1e-4) << sample.t;
  }
}

// A rod that runs in at constant speed as a rigid body goes on as it started, in space too.
TEST(Feed, TakesABeamThatMoves) {
  Scene scene = paid_out(ElementKind::ale_rancf);
  scene.dimension = 3;
  scene.beam.curve.start = {0, 0, 0};
  scene.beam.curve.end = {0.48, 0.64, 0.6};
  scene.gravity = {};
  scene.start = {SupportType::clamp, ClampType::direction};
  scene.start.feed = TimeSpec{.rate = 2};
  scene.initial_velocity = InitialVelocitySpec{.translation = {0.96, 1.28, 1.2}};
  const RunResult run = test::completed(scene);
  EXPECT_GE(count(run, EventType::segmentation), 2);
  for (const Sample& sample : run.samples) {
    EXPECT_NEAR(sample.end[0], 0.48 * (1 + 2 * sample.t), 1e-9);
    EXPECT_NEAR(sample.end[2], 0.6 * (1 + 2 * sample.t), 1e-9);
    EXPECT_NEAR(sample.energy.total(), 0.1 * (1 + 2 * sample.t) * 4 / 2, 1e-9);
  }
  scene.initial_velocity->translation = {0.96, 1.28, 1.3};
  EXPECT_EQ(test::refused(scene), "/initial_velocity");
}

TEST(Feed, EndsWhereNoElementIsLeft) {
  Scene scene = paid_out();
  scene.start.feed = TimeSpec{.rate = -2, .ramp = 0.05};
  scene.duration = 0.495;
  const RunResult alone = simulate(scene);
  EXPECT_EQ(alone.status, RunStatus::failed);
  EXPECT_NE(alone.failure.find("the feed at the beam's start has drawn in what there was"), std::string::npos)
      << alone.failure;
  scene.gravity = {};
  scene.start.feed->rate = -0.1;
  scene.sliding_joints = {bead(0.5)};
  scene.sliding_joints.front().velocity = -2;
  const RunResult met = simulate(scene);
  EXPECT_EQ(met.status, RunStatus::failed);
  EXPECT_NE(met.failure.find("the feed at the beam's start and the sliding joint 0 met"), std::string::npos)
      << met.failure;
}

TEST(Feed, LetsAGuidedJointGoWhereBeamHasComeIn) {
  Scene scene = paid_out();
  scene.sliding_joints = {bead(0.15)};
  scene.sliding_joints.front().x = TimeSpec{.rate = -0.8, .ramp = 0.1};
  const RunResult run = test::completed(scene);
  EXPECT_LT(*run.samples.back().joint_position, 0);
  EXPECT_LT(run.max_energy_drift, 1e-9 * run.max_kinetic);
  scene.start.feed->rate = 0.1;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/x");
}

TEST(Feed, IsRefusedWhereItCannotBe) {
  const auto refused = [](const std::function<void(Scene&)>& change) {
    Scene scene = paid_out();
    change(scene);
    return test::refused(scene);
  };
  EXPECT_EQ(refused([](Scene& s) { s.start.type = SupportType::free; }), "/supports/at=start/type");
  EXPECT_EQ(refused([](Scene& s) { s.start.type = SupportType::slide; }), "/supports/at=start/type");
  EXPECT_EQ(refused([](Scene& s) { s.start.feed->ramp = 0; }), "/supports/at=start/feed");
  EXPECT_EQ(refused([](Scene& s) { s.start.feed->rate = -4; }), "/supports/at=start/feed");
  EXPECT_EQ(refused([](Scene& s) { s.start.feed = TimeSpec{.value = 0.3}; }), "/supports/at=start/feed/value");
  EXPECT_EQ(refused([](Scene& s) { s.start.feed->rate = 1e9; }), "/supports/at=start/feed");
  EXPECT_EQ(refused([](Scene& s) { s.beam.element = ElementKind::ancf; }), "/beam/element");
  EXPECT_EQ(refused([](Scene& s) { s.formulation = Formulation::virtual_work; }), "/formulation");
  EXPECT_EQ(refused([](Scene& s) { s.length_control.lower = 0; }), "/length_control/lower");
  EXPECT_EQ(refused([](Scene& s) { s.length_control.end_merge = 0.5; }), "/length_control/end_merge");
  EXPECT_EQ(refused([](Scene& s) { s.length_control.velocities = VelocityTransfer::conservative; }),
            "/length_control/velocities");
  EXPECT_EQ(refused([](Scene& s) { s.integrator.type = IntegratorType::energy_momentum; }), "/integrator/type");
  EXPECT_EQ(refused([](Scene& s) { s.analysis = Analysis::statics; }), "/supports/at=start/feed");
  EXPECT_EQ(refused([](Scene& s) { s.point_masses = {{.node = 20, .mass = 0.1}}; }), "/point_masses/0/node");
  EXPECT_EQ(refused([](Scene& s) {
              s.start.feed->rate = -1;
              s.point_masses = {{.node = 1, .mass = 0.1}};
            }),
            "/point_masses/0/node");
  EXPECT_EQ(refused([](Scene& s) {
              s.start.feed->rate = -1;
              s.loads = {{.node = 1, .x = {}, .magnitude = {.value = 1}, .direction = {1, 0, 0}, .turn = {}}};
            }),
            "/loads");
}

}  // namespace
}  // namespace vlbeam
