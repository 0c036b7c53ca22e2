// Rings and sleeves that are moved through space.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double place = 0.55;
const TimeSpec sways{.value = 0.03, .amplitude = 0.03, .frequency = 5, .phase_degrees = -90};

/// A soft cantilever whose ring or sleeve swings across it.
Scene swung(SupportType support, ElementKind element = ElementKind::ale_ancf) {
  Scene scene;
  scene.beam.element = element;
  scene.beam.elements = 8;
  scene.beam.section.radius = 0.02;
  scene.start.type = SupportType::clamp;
  SlidingJointSpec joint;
  joint.support = support;
  joint.position = place;
  joint.motion = {.direction = {0.6, 0.8, 0}, .displacement = sways};
  scene.sliding_joints = {joint};
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-12);
  scene.duration = 0.3;
  scene.output.interval = 0.01;
  return scene;
}

Point moved_to(double t) {
  const double s = 0.03 * (1 - std::cos(10 * M_PI * t));
  return {place + 0.6 * s, 0.8 * s, 0};
}

TEST(MovedJoint, IsWhereItIsMovedAndTheLedgerCloses) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      const RunResult run = test::completed(swung(support, element));
      EXPECT_GE(run.events.size(), 1U) << "nothing is shown without events";
      EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
      double work = 0;
      for (const Sample& sample : run.samples) {
        const Point there = moved_to(sample.t);
        EXPECT_NEAR((*sample.mass_position)[0], there[0], 1e-13) << sample.t;
        EXPECT_NEAR((*sample.mass_position)[1], there[1], 1e-13) << sample.t;
        work = std::max(work, std::abs(sample.energy.supplied));
      }
      EXPECT_GT(work, 0.1 * run.max_kinetic) << "what moves it works";
    }
  }
}

// In a frame that accelerates with them, supports, rings and sleeves stand still under another gravity.
TEST(MovedJoint, TogetherWithItsSupportIsAtRestInAnotherFrame) {
  const Point a{9, 20, 0};
  const TimeSpec falls{.acceleration = std::hypot(a[0], a[1])};
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    for (const auto& [type, constraints] : {std::pair{IntegratorType::fehlberg78, Constraints::eliminated},
                                            std::pair{IntegratorType::generalized_alpha, Constraints::eliminated},
                                            std::pair{IntegratorType::generalized_alpha, Constraints::multipliers}}) {
      Scene moving = swung(support);
      moving.gravity = {};
      moving.integrator.type = type;
      moving.integrator.step = 1e-3;
      moving.integrator.newton_tolerance = 1e-12;
      moving.constraints = constraints;
      Scene standing = moving;
      moving.start.motion = moving.sliding_joints.front().motion = {.direction = a, .displacement = falls};
      standing.sliding_joints.front().motion.reset();
      standing.gravity = {-a[0], -a[1], 0};
      const RunResult there = test::completed(moving), here = test::completed(standing);
      ASSERT_EQ(there.samples.size(), here.samples.size());
      EXPECT_EQ(there.events.size(), here.events.size());
      EXPECT_GE(here.events.size(), support == SupportType::pin ? 1U : 0U);
      for (std::size_t i = 0; i < here.samples.size(); ++i) {
        const Sample &of_there = there.samples[i], &of_here = here.samples[i];
        const double t = of_here.t;
        EXPECT_NEAR(*of_there.joint_position, *of_here.joint_position, 1e-9) << t;
        for (std::size_t c = 0; c < 2; ++c) {
          EXPECT_NEAR(of_there.end[c] - a[c] * t * t / 2, of_here.end[c], 1e-9) << t;
          EXPECT_NEAR(of_there.joint->force[c], of_here.joint->force[c], 1e-5) << t;
        }
      }
    }
  }
}

TEST(MovedJoint, IsTheSameWithEveryIntegrator) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    Scene scene = swung(support);
    scene.duration = 0.1;
    scene.length_control.enabled = false;  // the order of steps alone
    const RunResult exact = test::completed(scene);
    const auto error = [&](const RunResult& run) {
      double largest = 0;
      for (std::size_t i = 0; i < exact.samples.size(); ++i) {
        largest = std::max(largest, std::abs(*run.samples[i].joint_position - *exact.samples[i].joint_position));
      }
      return largest;
    };
    for (const Constraints constraints : {Constraints::eliminated, Constraints::multipliers}) {
      std::vector<double> errors, drifts;
      for (const double step : {5e-5, 2.5e-5}) {
        Scene implicit = scene;
        implicit.integrator.type = IntegratorType::generalized_alpha;
        implicit.integrator.step = step;
        implicit.integrator.newton_tolerance = 1e-12;
        implicit.constraints = constraints;
        const RunResult run = test::completed(implicit);
        errors.push_back(error(run));
        drifts.push_back(run.max_energy_drift);
      }
      EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2) << errors[0] << ' ' << errors[1];
      EXPECT_GT(drifts[0] / drifts[1], 3) << drifts[0] << ' ' << drifts[1];
    }
    Scene stiff = scene;
    test::set_tolerance(stiff, IntegratorType::rosenbrock4, 1e-8);
    EXPECT_LT(error(test::completed(stiff)), 1e-6);
  }
}

// A stiff rod that is pinned at its start turns about it, and the ring is where it is on the rod.
TEST(MovedJoint, TurnsARigidRod) {
  Scene scene;
  scene.gravity = {};
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 1e4, .rhoA = 1};
  scene.beam.elements = 10;
  scene.start.type = SupportType::pin;
  SlidingJointSpec ring;
  ring.support = SupportType::pin;
  ring.position = 0.5;
  ring.motion = {.direction = {0, 1, 0}, .displacement = {.value = 1.2, .ramp = 0.5}};
  scene.sliding_joints = {ring};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.duration = 0.5;
  const RunResult run = test::completed(scene);
  EXPECT_GE(run.events.size(), 3U);
  EXPECT_NEAR(*run.samples.back().joint_position, 1.3, 1e-6);
  EXPECT_NEAR(run.samples.back().end[0], 2 * 0.5 / 1.3, 1e-3);
  EXPECT_NEAR(run.samples.back().end[1], 2 * 1.2 / 1.3, 1e-3);
}

// Among others, and where a kink is allowed.
TEST(MovedJoint, GoesWithOtherJointsAndKinks) {
  SlidingJointSpec ring, mass;
  ring.support = SupportType::pin;
  ring.position = 0.7;
  ring.slopes = JointSlopes::equal_stretch;
  ring.motion = {.direction = {0, 1, 0}, .displacement = sways};
  mass.mass = 0.5;
  mass.position = 1.3;
  const RunResult run = test::completed(test::rope({ring, mass}));
  EXPECT_GE(run.events.size(), 1U);
  EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
  for (const Sample& sample : run.samples) {
    EXPECT_NEAR((*sample.joints[0].mass_position)[1], 0.03 * (1 - std::cos(10 * M_PI * sample.t)), 1e-13);
  }
}

TEST(MovedJoint, IsRefusedWhereItCannotBe) {
  const std::string motion = "/sliding_joints/0/motion";
  Scene scene = swung(SupportType::pin);
  scene.sliding_joints.front().motion->direction = {};
  EXPECT_EQ(test::refused(scene), motion + "/direction");
  scene = swung(SupportType::pin);
  scene.sliding_joints.front().motion->direction = {0, 0, 1};
  EXPECT_EQ(test::refused(scene), motion + "/direction/2");
  scene = swung(SupportType::pin);
  scene.sliding_joints.front().motion->displacement = {.rate = 1};
  EXPECT_EQ(test::refused(scene), motion) << "it starts from rest";
  scene = swung(SupportType::pin);
  scene.sliding_joints.front().support = SupportType::free;
  scene.sliding_joints.front().mass = 1;
  EXPECT_EQ(test::refused(scene), motion);
}

}  // namespace
}  // namespace vlbeam
