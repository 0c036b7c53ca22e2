// Joints that strike each other, and supports that several of them strike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

using test::slider;

constexpr double of_rope = 2.0 / 16;  // L_std of test::rope() [m]

Scene rebounding(const std::vector<SlidingJointSpec>& joints, double restitution, double distance = 0.1) {
  Scene scene = test::rope(joints);
  scene.contact = ContactSpec{AtSupport::rebound, restitution, distance};
  return scene;
}

double at_contacts(const RunResult& run) {
  double sum = 0;
  for (const Event& event : run.events) sum += event.type == EventType::contact ? event.energy_jump.total() : 0;
  return sum;
}

std::ptrdiff_t contacts(const RunResult& run) {
  return std::ranges::count(run.events, EventType::contact, &Event::type);
}

/// On a straight beam that nothing bends masses pass over the matter without a force: their collision is that of two
/// points, and the beam takes no part in it.
TEST(JointContact, OnAStraightBeamIsTheCollisionOfTwoPoints) {
  constexpr double m_1 = 0.5, m_2 = 0.2, v_1 = 2, v_2 = -1, x_1 = 0.6, x_2 = 1.2;
  for (const double e : {1.0, 0.6}) {
    Scene scene = rebounding({slider(x_1, m_1, v_1), slider(x_2, m_2, v_2)}, e);
    scene.gravity = {};
    const RunResult run = test::completed(scene);
    ASSERT_EQ(contacts(run), 1);
    const double t = (x_2 - x_1 - 0.1 * of_rope) / (v_1 - v_2), J = (1 + e) * (v_1 - v_2) / (1 / m_1 + 1 / m_2);
    const double w_1 = v_1 - J / m_1, w_2 = v_2 + J / m_2, rest = scene.duration - t;
    const auto hit = std::ranges::find(run.events, EventType::contact, &Event::type);
    EXPECT_NEAR(hit->t, t, 1e-11);
    const Sample& last = run.samples.back();
    EXPECT_NEAR(*last.joints[0].position, x_1 + v_1 * t + w_1 * rest, 1e-9);
    EXPECT_NEAR(*last.joints[1].position, x_2 + v_2 * t + w_2 * rest, 1e-9);
    const double loss = (1 - e * e) * (v_1 - v_2) * (v_1 - v_2) / (1 / m_1 + 1 / m_2) / 2;
    EXPECT_NEAR(at_contacts(run), -loss, 1e-10);
    EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
  }
}

TEST(JointContact, OfThreeAtOnceIsThatOfEachPair) {
  Scene scene = rebounding({slider(0.5, 0.5, 2), slider(1, 0.3), slider(1.5, 0.5, -2)}, 1);
  scene.gravity = {};
  scene.duration = 0.4;
  const RunResult run = test::completed(scene);
  EXPECT_EQ(contacts(run), 1) << "both at one instant";
  const double t = (0.5 - 0.1 * of_rope) / 2, back = 2 * (scene.duration - t);
  const Sample& last = run.samples.back();
  EXPECT_NEAR(*last.joints[0].position, 0.5 + 2 * t - back, 1e-9);
  EXPECT_NEAR(*last.joints[1].position, 1, 1e-9) << "the one between stays";
  EXPECT_NEAR(*last.joints[2].position, 1.5 - 2 * t + back, 1e-9);
}

TEST(JointContact, OfEqualMassesOnASaggingBeamKeepsTheMirrorImageAndTheEnergy) {
  Scene scene = rebounding({slider(0.7, 0.5, 1.5), slider(1.3, 0.5, -1.5)}, 1);
  scene.duration = 0.4;
  const RunResult run = test::completed(scene);
  EXPECT_GE(contacts(run), 1);
  EXPECT_LE(std::abs(at_contacts(run)), 1e-12 * run.max_kinetic);
  EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
  for (const Sample& sample : run.samples) {
    EXPECT_NEAR(*sample.joints[0].position + *sample.joints[1].position, 2, 1e-9) << "at " << sample.t;
    EXPECT_GE(*sample.joints[1].position - *sample.joints[0].position, 0.09 * of_rope);
  }
  EXPECT_GT(*run.samples.back().joints[1].position - *run.samples.back().joints[0].position, 0.2) << "they part";
}

/// Action and reaction have one line: a beam that nothing holds keeps its momenta, about the origin, too.
TEST(JointContact, KeepsTheMomentaOfABeamThatNothingHolds) {
  Scene scene = rebounding({slider(0.7, 0.5, 1.5), slider(1.2, 0.2, -1)}, 0.5);
  scene.beam.curve = {.type = CurveType::arc, .center = {0, 0, 0}, .radius = 1, .from_degrees = 0, .to_degrees = 110};
  scene.gravity = {};
  scene.start.type = scene.end.type = SupportType::free;
  scene.initial_velocity = InitialVelocitySpec{.rotation = 2};
  const RunResult run = test::completed(scene);
  ASSERT_GE(contacts(run), 1);
  EXPECT_LT(at_contacts(run), -0.05);
  for (const Event& event : run.events) {
    if (event.type != EventType::contact) continue;
    for (const double jump : event.momentum_jump) EXPECT_NEAR(jump, 0, 1e-12);
  }
}

/// What strikes a support at a distance is what rides up to it, in the limit.
TEST(JointContact, WithASupportTendsToThatOfASingleMassThatRidesThere) {
  SlidingJointSpec mass = slider(1.6, 0.5, 3);
  mass.at_support = AtSupport::rebound;
  mass.restitution = 0.8;
  const auto place = [&](double distance) {
    Scene scene = test::rope({mass});
    if (distance > 0) {
      scene.sliding_joints.insert(scene.sliding_joints.begin(), slider(0.3, 1e-9));
      scene.contact = ContactSpec{.distance = distance};
    }
    scene.gravity = {};
    const RunResult run = test::completed(scene);
    EXPECT_EQ(contacts(run), 1);
    return distance > 0 ? *run.samples.back().joints[1].position : *run.samples.back().joint_position;
  };
  const double exact = place(0), coarse = place(0.1), fine = place(0.05);
  // it turns where its node is at that distance
  EXPECT_NEAR(coarse - exact, -1.8 * 0.1 * of_rope, 1e-9);
  EXPECT_NEAR(fine - exact, -1.8 * 0.05 * of_rope, 1e-9);
}

/// The guide of a joint that is struck does work in the impact, which is supplied: the ledger of an elastic one closes.
TEST(JointContact, WithAGuidedJointHasTheWorkOfTheGuide) {
  SlidingJointSpec led = slider(0.5, 0.3);
  led.x = TimeSpec{.rate = 2};
  Scene scene = rebounding({led, slider(1, 0.5)}, 1);
  scene.duration = 0.35;
  const RunResult run = test::completed(scene);
  EXPECT_GE(contacts(run), 1);
  EXPECT_LE(std::abs(at_contacts(run)), 1e-9 * run.max_kinetic);
  EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
}

TEST(JointContact, RefusesWhatItDoesNotKnow) {
  const Scene good = rebounding({slider(0.5, 0.3), slider(1.2, 0.3)}, 1);
  Scene scene = good;
  scene.sliding_joints.pop_back();
  EXPECT_EQ(test::refused(scene), "/contact");
  scene = good;
  scene.contact->distance = 0.4;
  EXPECT_EQ(test::refused(scene), "/contact/distance");
  scene = good;
  scene.contact->distance = 0.3;
  scene.sliding_joints[1].position = 0.5 + 0.25 * of_rope;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/1/position");
  scene = good;
  scene.sliding_joints[0].position = 0.012;
  scene.sliding_joints[0].at_support = AtSupport::rebound;
  EXPECT_EQ(test::refused(scene), "/sliding_joints/0/position");
  scene = good;
  scene.analysis = Analysis::statics;
  EXPECT_EQ(test::refused(scene), "/contact");
}

}  // namespace
}  // namespace vlbeam
