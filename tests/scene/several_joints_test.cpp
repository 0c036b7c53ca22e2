// Several joints on one beam: masses, rings and sleeves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

using test::slider;

double largest_ledger(const RunResult& run) { return run.max_energy_drift / run.max_kinetic; }

TEST(SeveralJoints, TwoEqualMassesOnASymmetricBeamStayMirrorImages) {
  Scene scene = test::rope({slider(0.4, 0.5, 1.5), slider(1.6, 0.5, -1.5)});
  const RunResult run = test::completed(scene);
  EXPECT_GE(run.events.size(), 6U) << "nothing is shown without events";
  EXPECT_EQ(run.events.size() % 2, 0U);
  for (const Sample& sample : run.samples) {
    ASSERT_EQ(sample.joints.size(), 2U);
    const auto &left = sample.joints[0], &right = sample.joints[1];
    EXPECT_NEAR(*left.position + *right.position, 2, 1e-9) << "at " << sample.t;
    EXPECT_NEAR((*left.mass_position)[0] + (*right.mass_position)[0], 2, 1e-9);
    EXPECT_NEAR((*left.mass_position)[1], (*right.mass_position)[1], 1e-9);
  }
  EXPECT_GT(*run.samples.back().joints[0].position, 0.7) << "they slide";
}

TEST(SeveralJoints, TheEffectOfALightOneIsProportionalToItsMass) {
  const auto place = [](double light) {
    Scene scene = test::rope({slider(0.5, 0.5, 1)});
    if (light > 0) scene.sliding_joints.push_back(slider(1.45, light));
    scene.length_control.lower = 0.4985;  // the same events of the first one
    scene.length_control.end_merge = 0;   // of one mass too
    scene.duration = 0.12;
    return test::completed(scene).samples.back();
  };
  // three light ones, so that what a mesh with another node changes falls out
  const auto x = [&](double light) { return *place(light).joint_position; };
  const double with_4 = x(4e-3), with_2 = x(2e-3), with_1 = x(1e-3);
  const double first = with_4 - with_2, second = with_2 - with_1;
  EXPECT_GT(std::abs(first), 1e-7) << "it has an effect";
  EXPECT_NEAR(first / second, 2, 0.05);
}

TEST(SeveralJoints, KeepTheLedgerBetweenEventsWithEveryElement) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    SlidingJointSpec ring;
    ring.support = SupportType::pin;
    ring.position = 1.0;
    Scene scene = test::rope({slider(0.4, 0.5, 1), ring, slider(1.5, 0.2, -0.5)}, element);
    scene.end.type = SupportType::free;
    const RunResult run = test::completed(scene);
    EXPECT_GE(run.events.size(), 2U);
    EXPECT_LE(largest_ledger(run), 1e-9) << static_cast<int>(element);
    for (const Sample& sample : run.samples) {
      EXPECT_NEAR((*sample.joints[1].mass_position)[0], 1, 1e-12);
      EXPECT_NEAR((*sample.joints[1].mass_position)[1], 0, 1e-12);
    }
  }
}

/// A ring at rest bears on velocities as a support does.
TEST(SeveralJoints, KeepTheEnergyAtEventsWithConservativeVelocities) {
  SlidingJointSpec ring;
  ring.support = SupportType::pin;
  ring.position = 1.0;
  Scene scene = test::rope({slider(0.4, 0.5, 1), ring, slider(1.5, 0.2, -0.5)});
  const RunResult projected = test::completed(scene);
  scene.length_control.velocities = VelocityTransfer::conservative;
  const RunResult run = test::completed(scene);
  const auto jumps = [](const RunResult& of) {
    double sum = 0;
    for (const Event& event : of.events) sum += std::abs(event.discrete_jump);
    return sum;
  };
  EXPECT_GE(run.events.size(), 2U);
  EXPECT_TRUE(std::ranges::all_of(run.events, &Event::restored));
  EXPECT_LE(jumps(run), 1e-10 * run.max_kinetic);
  EXPECT_GT(jumps(projected), 1e-7 * run.max_kinetic) << "there is something to restore";
  for (const Sample& sample : run.samples) EXPECT_NEAR((*sample.joints[1].mass_position)[1], 0, 1e-12);
}

TEST(SeveralJoints, FrictionIsInTheLedger) {
  auto rubbing = slider(0.6, 0.5, 1);
  rubbing.friction = AxialFriction{0.2, 0.05};
  auto other = slider(1.3, 0.3, -0.5);
  other.friction = AxialFriction{0.4, 0.05};
  Scene scene = test::rope({rubbing, other});
  scene.duration = 0.15;
  const RunResult run = test::completed(scene);
  EXPECT_GT(run.samples.back().energy.dissipated, 0.01 * run.max_kinetic);
  EXPECT_LE(largest_ledger(run), 1e-9);
}

TEST(SeveralJoints, GeneralizedAlphaComesNearTheExplicitRunWithItsOrder) {
  for (const Constraints constraints : {Constraints::eliminated, Constraints::multipliers}) {
    Scene scene = test::rope({slider(0.55, 0.5, 1), slider(0.9, 0.3, 0.5), slider(1.5, 0.2, -0.5)});
    scene.duration = 0.08;
    const Point exact = *test::completed(scene).samples.back().joints[1].mass_position;
    scene.integrator = {};
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.constraints = constraints;
    const auto error = [&](double step) {
      scene.integrator.step = step;
      const Point at = *test::completed(scene).samples.back().joints[1].mass_position;
      return std::hypot(at[0] - exact[0], at[1] - exact[1]);
    };
    // over five halvings: the error of a single one goes up and down with the vibration, of one joint, too
    const double coarse = error(4e-4), fine = error(1.25e-5);
    EXPECT_LE(fine, 1e-8);
    EXPECT_GT(std::log2(coarse / fine) / 5, 1.5);
  }
}

/// Explicit methods early, for their steps get as short as the last element.
TEST(SeveralJoints, MayLeaveAFreeEndOneAfterTheOther) {
  for (const IntegratorType type : {IntegratorType::fehlberg78, IntegratorType::generalized_alpha}) {
    Scene scene = test::rope({slider(1.2, 0.3, 3), slider(1.7, 0.3, 3)});
    scene.integrator.type = type;
    if (type == IntegratorType::fehlberg78) {
      for (SlidingJointSpec& joint : scene.sliding_joints) joint.separation_distance = 0.06;
    }
    scene.gravity = {0, 0, 0};
    scene.start = {SupportType::clamp, ClampType::full};
    scene.end.type = SupportType::free;
    scene.duration = 0.4;
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.status, RunStatus::separated) << run.failure;
    std::vector<int> left;
    for (const Event& event : run.events) {
      if (event.type == EventType::separation) left.push_back(event.joint);
    }
    EXPECT_EQ(left, (std::vector<int>{1, 0})) << "the one ahead first";
    const Sample& last = run.samples.back();
    EXPECT_FALSE(last.joints[0].position || last.joints[1].position);
    EXPECT_NEAR((*last.joints[1].mass_position)[0], 1.7 + 3 * 0.4, 1e-6) << "nothing holds it back on a straight beam";
    EXPECT_NEAR((*last.joints[0].mass_position)[0], 1.2 + 3 * 0.4, 1e-6);
  }
}

TEST(SeveralJoints, ThatMeetEndTheRunByName) {
  Scene scene = test::rope({slider(0.5, 0.3, 3), slider(1.2, 0.3)});
  scene.gravity = {0, 0, 0};
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::failed);
  EXPECT_NE(run.failure.find("joints 0 and 1 met"), std::string::npos) << run.failure;
  const Sample& last = run.samples.back();
  EXPECT_NEAR(*last.joints[1].position - *last.joints[0].position, 0.1 * 2 / 16, 1e-9);
}

TEST(SeveralJoints, MayShareAnElementThatBothAskToCut) {
  Scene scene = test::rope({slider(14.0 / 15, 0.3, -2), slider(16.0 / 15, 0.3, 2)});
  scene.beam.elements = 15;
  const RunResult run = test::completed(scene);
  EXPECT_GE(run.events.size(), 3U);
  EXPECT_LE(largest_ledger(run), 1e-9);
  for (const Sample& sample : run.samples) {
    EXPECT_NEAR(*sample.joints[0].position + *sample.joints[1].position, 2, 1e-9) << "at " << sample.t;
  }
  EXPECT_GT(*run.samples.back().joints[1].position - *run.samples.back().joints[0].position, 0.25) << "they part";
}

TEST(SeveralJoints, ThatShareTheLastNodeBetweenThemMeet) {
  Scene scene = test::rope({slider(0.4, 0.5, 1.5), slider(1.6, 0.5, -1.5)});
  scene.gravity = {0, 0, 0};
  scene.duration = 0.5;
  const RunResult run = simulate(scene);
  EXPECT_NE(run.failure.find("joints 0 and 1 met"), std::string::npos) << run.failure;
  const Sample& last = run.samples.back();
  EXPECT_NEAR(*last.joints[0].position, 1 - 0.05 * 2 / 16, 1e-9);
  EXPECT_NEAR(*last.joints[1].position, 1 + 0.05 * 2 / 16, 1e-9);
  EXPECT_LE(largest_ledger(run), 1e-9);
}

TEST(SeveralJoints, MeetWhateverTheMeshBetweenThemIs) {
  for (const double other : {1.15, 1.18}) {
    Scene scene = test::rope({slider(0.5, 0.3, 3), slider(other, 0.3)});
    scene.gravity = {0, 0, 0};
    scene.duration = 0.5;
    const RunResult run = simulate(scene);
    EXPECT_NE(run.failure.find("joints 0 and 1 met"), std::string::npos) << run.failure;
    EXPECT_NEAR(*run.samples.back().joints[1].position, other, 1e-6);
    EXPECT_NEAR(*run.samples.back().joints[0].position, other - 0.1 * 2 / 16, 1e-6);
  }
}

TEST(SeveralJoints, ThatGoOneWayAreTheMirrorImageOfThoseThatGoTheOther) {
  const RunResult forward = test::completed(test::rope({slider(0.4, 0.5, 2), slider(0.65, 0.5, 2)}));
  const RunResult backward = test::completed(test::rope({slider(1.35, 0.5, -2), slider(1.6, 0.5, -2)}));
  EXPECT_GE(forward.events.size(), 2U);
  ASSERT_EQ(forward.samples.size(), backward.samples.size());
  for (std::size_t i = 0; i < forward.samples.size(); ++i) {
    EXPECT_NEAR(*forward.samples[i].joints[0].position + *backward.samples[i].joints[1].position, 2, 1e-9);
    EXPECT_NEAR(*forward.samples[i].joints[1].position + *backward.samples[i].joints[0].position, 2, 1e-9);
  }
}

TEST(SeveralJoints, RefuseWhatTheyDoNotKnow) {
  const Scene good = test::rope({slider(0.5, 0.3), slider(1.2, 0.3)});
  Scene scene = good;
  std::swap(scene.sliding_joints[0], scene.sliding_joints[1]);
  EXPECT_EQ(test::refused(scene), "/sliding_joints/1/position");
  scene = good;
  scene.sliding_joints[1].position = 0.5;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/1/position");
  scene = good;
  scene.sliding_joints[1].position = 2;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/1/position");
  scene = good;
  scene.sliding_joints[1].mass = 0;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/1/mass");
  scene = good;
  scene.integrator.type = IntegratorType::energy_momentum;
  EXPECT_EQ(test::refused(scene), "/integrator/type");
  scene = good;
  for (const double lower : {0.6, 0.0}) {
    scene.length_control.lower = lower;
    EXPECT_EQ(test::refused(scene), "/length_control/lower");
  }
  scene = good;
  scene.length_control.hysteresis = 0;  // what a cut leaves would be merged at once
  EXPECT_EQ(test::refused(scene), "/length_control/hysteresis");
}

}  // namespace
}  // namespace vlbeam
