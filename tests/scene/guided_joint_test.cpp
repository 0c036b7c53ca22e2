// Joints whose way along the beam is given.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

SlidingJointSpec guide_at(double position, const TimeSpec& x, double mass = 0.5) {
  SlidingJointSpec joint;
  joint.mass = mass;
  joint.position = position;
  joint.x = x;
  return joint;
}

/// From then on.
double mean_guiding(const RunResult& run, double from) {
  double sum = 0, count = 0;
  for (const Sample& sample : run.samples) {
    if (sample.t < from) continue;
    sum += sample.joint->guiding;
    ++count;
  }
  return sum / count;
}

const TimeSpec swings{.amplitude = 0.25, .frequency = 2, .phase_degrees = 90};

TEST(GuidedJoint, FollowsItsGuideAndItsLedgerClosesWithEveryElement) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    const Scene scene = test::rope({guide_at(0.7, swings), guide_at(1.3, {.rate = 1})}, element);
    const RunResult run = test::completed(scene);
    EXPECT_GE(run.events.size(), 5U) << "nothing is shown without events";
    EXPECT_LE(run.max_energy_drift / run.max_kinetic, 1e-9);
    for (const Sample& sample : run.samples) {
      EXPECT_NEAR(*sample.joints[0].position, 0.45 + 0.25 * std::cos(4 * M_PI * sample.t), 1e-12) << sample.t;
      EXPECT_NEAR(*sample.joints[1].position, 1.3 + sample.t, 1e-12) << sample.t;
    }
    EXPECT_GT(std::abs(run.samples.back().energy.supplied), 1e-3 * run.max_kinetic) << "the guides work";
  }
}

/// On a stiff straight bar a guided mass is a body on a rail: the guide bears m x'', but for the bar's stretch.
TEST(GuidedJoint, OnAStiffBarTheGuideBearsMassTimesAcceleration) {
  for (const IntegratorType type : {IntegratorType::fehlberg78, IntegratorType::generalized_alpha}) {
    Scene scene = test::rope({guide_at(0.7, {.acceleration = 3, .ramp = 0.1})});
    scene.gravity = {};
    scene.beam.elements = 4;
    scene.length_control.enabled = false;  // events would start axial waves
    scene.beam.material.youngs_modulus = 5e8;
    scene.integrator.type = type;
    scene.integrator.step = 1e-4;
    scene.duration = 0.4;
    scene.output.interval = 2e-3;
    const RunResult run = test::completed(scene);
    EXPECT_NEAR(mean_guiding(run, 0.2), 0.5 * 3, 0.005 * 0.5 * 3);
    EXPECT_NEAR((*run.samples.back().mass_position)[0], 0.7 + 1.5 * 0.16, 1e-5);
  }
}

/// A mark that travels without a mass changes nothing but the mesh: a ring, or an end, does not know of it.
TEST(GuidedJoint, WithoutAMassItIsButANodeThatTravels) {
  const auto middle = [](int elements, double position) {
    Scene scene = test::rope({guide_at(position, {.rate = 0.5}, 0)});
    scene.beam.elements = elements;
    scene.duration = 0.1;
    const RunResult run = test::completed(scene);
    EXPECT_NEAR(run.samples.back().joint->guiding, 0, 1e-3 * 9.81 * 1200 * M_PI * 0.015 * 0.015);
    return run.samples.back().energy.gravity;
  };
  const double one = middle(24, 0.5), other = middle(24, 1.1), fine = middle(32, 0.5);
  EXPECT_NEAR(one, other, 1e-5 * std::abs(one));
  EXPECT_NEAR(one, fine, 1e-5 * std::abs(one));
}

TEST(GuidedJoint, ImplicitMethodsComeNearTheExplicitRunWithTheirOrder) {
  // all smooth: what starts at once throws the axial waves that no step here follows
  Scene scene = test::rope({guide_at(0.5, {.rate = 0.5, .ramp = 0.05})});
  scene.gravity_ramp = 0.05;
  SlidingJointSpec free;
  free.mass = 0.2;
  free.position = 1.4;
  scene.sliding_joints.push_back(free);
  scene.duration = 0.08;
  const Sample exact = test::completed(scene).samples.back();
  for (const Constraints constraints : {Constraints::eliminated, Constraints::multipliers}) {
    Scene implicit = scene;
    implicit.constraints = constraints;
    implicit.integrator = {};
    implicit.integrator.type = IntegratorType::generalized_alpha;
    struct Errors {
      double place, work;
    };
    const auto errors = [&](double step) {
      implicit.integrator.step = step;
      const Sample last = test::completed(implicit).samples.back();
      EXPECT_NEAR(*last.joints[0].position, *exact.joints[0].position, 1e-12);
      return Errors{std::abs(*last.joints[1].position - *exact.joints[1].position) +
                        std::abs((*last.joints[0].mass_position)[1] - (*exact.joints[0].mass_position)[1]),
                    std::abs(last.energy.supplied - exact.energy.supplied)};
    };
    const Errors coarse = errors(4e-4), fine = errors(2.5e-5);
    EXPECT_LE(fine.place, 1e-7);
    EXPECT_GT(std::log2(coarse.place / fine.place) / 4, 1.9);
    EXPECT_GT(std::log2(coarse.work / fine.work) / 4, 1.9);
  }
  Scene other = scene;
  test::set_tolerance(other, IntegratorType::rosenbrock4, 1e-9);
  EXPECT_NEAR(*test::completed(other).samples.back().joints[1].position, *exact.joints[1].position, 1e-6);
}

TEST(GuidedJoint, FrictionIsBorneByTheGuide) {
  SlidingJointSpec rubbing = guide_at(0.6, {.rate = 1});
  rubbing.friction = AxialFriction{0.3, 0.01};
  const RunResult run = test::completed(test::rope({rubbing}));
  EXPECT_GT(run.samples.back().energy.dissipated, 0.05 * std::abs(run.samples.back().energy.supplied));
  EXPECT_LE(run.max_energy_drift / run.max_kinetic, 1e-9);
}

/// Rollers that lift a hanging rope: a ring that is guided bears its weight and what accelerates it.
TEST(GuidedJoint, ARingThatIsGuidedLiftsARopeThroughItself) {
  SlidingJointSpec roller = guide_at(1, {.acceleration = 2, .ramp = 0.2}, 0);
  roller.support = SupportType::pin;
  for (const IntegratorType type : {IntegratorType::fehlberg78, IntegratorType::generalized_alpha}) {
    Scene scene = test::rope({roller});
    scene.beam.curve.end = {0, -2, 0};
    scene.start.type = scene.end.type = SupportType::free;
    scene.gravity_ramp = 0.2;
    scene.integrator.type = type;
    scene.integrator.step = 1e-4;
    scene.duration = 0.24;  // until the first event, which starts axial waves
    scene.output.interval = 2e-3;
    const RunResult run = test::completed(scene);
    const Sample& last = run.samples.back();
    const double largest = std::abs(last.energy.gravity) + last.energy.kinetic;
    EXPECT_LE(run.max_energy_drift / largest, type == IntegratorType::fehlberg78 ? 1e-9 : 1e-4);
    EXPECT_NEAR((*last.mass_position)[1], -1, 1e-12);
    const double mass = 1200 * M_PI * 0.015 * 0.015 * 2;
    EXPECT_NEAR(mean_guiding(run, 0.2), mass * (9.81 + 2), 0.01 * mass * 9.81);
  }
}

TEST(GuidedJoint, RefusesWhatItDoesNotKnow) {
  const Scene good = test::rope({guide_at(0.5, {.rate = 1})});
  Scene scene = good;
  scene.sliding_joints[0].velocity = 1;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/velocity");
  scene = good;
  scene.sliding_joints[0].support = SupportType::pin;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/x");
  scene = good;
  scene.sliding_joints[0].at_support = AtSupport::rest;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/at_support");
  scene = good;
  scene.length_control.end_merge = 0.3;
  EXPECT_EQ(test::refused(scene), "/length_control/end_merge");
  scene = good;
  scene.length_control.velocities = VelocityTransfer::conservative;
  EXPECT_EQ(test::refused(scene), "/length_control/velocities");
  scene = good;
  scene.integrator.type = IntegratorType::energy_momentum;
  EXPECT_EQ(test::refused(scene), "/integrator/type");
  scene = good;
  scene.sliding_joints[0].x = TimeSpec{.rate = 6};  // into the pin at 2 m
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/x");
  scene.sliding_joints[0].x = TimeSpec{.rate = -2};
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/x");
}

}  // namespace
}  // namespace vlbeam
