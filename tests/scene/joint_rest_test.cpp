// Several joints that rest against supports and against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

using test::slider;

constexpr double d_of_8 = 0.1 * 2 / 8;  // where things touch on test::rope() of eight elements [m]

enum class By { explicit_steps, implicit, multipliers };

void integrate_by(Scene& scene, By method, double step = 1e-4) {
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  if (method == By::explicit_steps) return;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = step;
  if (method == By::multipliers) scene.constraints = Constraints::multipliers;
}

/// Of few elements and soft, so that explicit steps are not too short while the short piece between is there.
Scene beam_with(const std::vector<SlidingJointSpec>& joints, ElementKind element = ElementKind::ale_ancf) {
  Scene scene = test::rope(joints, element);
  scene.beam.elements = 8;
  scene.beam.material.youngs_modulus = 5e6;
  return scene;
}

SlidingJointSpec resting(SlidingJointSpec joint) {
  joint.at_support = AtSupport::rest;
  return joint;
}

std::vector<Event> those(const RunResult& run, EventType type) {
  std::vector<Event> events;
  std::ranges::copy_if(run.events, std::back_inserter(events), [type](auto& event) { return event.type == type; });
  return events;
}

double taken(const RunResult& run) {
  double sum = 0;
  for (const Event& event : those(run, EventType::contact)) sum += event.energy_jump.total();
  return sum;
}

/// On a straight beam that nothing bends it is the impact of two points, after which they are one.
TEST(JointRest, TwoThatMeetOnAStraightBeamGoOnAsOne) {
  constexpr double m_1 = 0.5, m_2 = 0.2, v_1 = 2, v_2 = -1, x_1 = 0.5, x_2 = 1;
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const By method : {By::explicit_steps, By::implicit, By::multipliers}) {
      Scene scene = beam_with({slider(x_1, m_1, v_1), slider(x_2, m_2, v_2)}, element);
      integrate_by(scene, method);
      scene.gravity = {};
      scene.contact = ContactSpec{.joints = AtSupport::rest};
      const RunResult run = test::completed(scene);
      const double t = (x_2 - x_1 - d_of_8) / (v_1 - v_2), v = (m_1 * v_1 + m_2 * v_2) / (m_1 + m_2);
      const auto hits = those(run, EventType::contact);
      ASSERT_EQ(hits.size(), 1U);
      EXPECT_TRUE(those(run, EventType::lift_off).empty());
      EXPECT_NEAR(hits[0].t, t, 1e-11);
      const Sample& last = run.samples.back();
      const double x = x_1 + v_1 * t + v * (scene.duration - t);
      EXPECT_NEAR(*last.joints[0].position, x, 1e-9);
      EXPECT_NEAR(*last.joints[1].position, x + d_of_8, 1e-9);
      EXPECT_NEAR(taken(run), -(v_1 - v_2) * (v_1 - v_2) / (1 / m_1 + 1 / m_2) / 2, 1e-10);
      EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
    }
  }
}

/// A mass falls along a taut wire whose supports are shaken along it. Nothing along the wire acts on it but gravity and
/// what it rests against: it is a body on a table that is shaken.
TEST(JointRest, AgainstASupportThatIsShakenIsThatOfABodyOnATable) {
  constexpr double g = 9.81, A = 0.02, omega = 2 * std::numbers::pi * 4, x = 1.94;
  const auto table = [](double t) { return 2 - d_of_8 + A * (std::cos(omega * t) - 1); };
  const auto root = [](const auto& f, double t, double step) {  // the first one from t on, where f grows
    while (f(t + step) < 0) t += step;
    for (; step > 1e-15; step /= 2) t += f(t + step / 2) < 0 ? step / 2 : 0;
    return t;
  };
  const double hits = root([&](double t) { return x + g * t * t / 2 - table(t); }, 0, 1e-3);
  const double leaves = std::acos(-g / (A * omega * omega)) / omega, off = -A * omega * std::sin(omega * leaves);
  const auto flies = [&](double t) { return table(leaves) + off * (t - leaves) + g * (t - leaves) * (t - leaves) / 2; };
  const double again = root([&](double t) { return flies(t) - table(t); }, leaves + 0.02, 1e-3);
  const auto relative = [&](double since, double v, double t) {
    return v + g * (t - since) + A * omega * std::sin(omega * t);
  };
  const double first = relative(0, 0, hits), second = relative(leaves, off, again);
  double error = 1e-6;
  for (const double E : {5e7, 5e8}) {
    Scene scene = test::rope({slider(0.5, 0.3), resting(slider(x, 0.5))});
    scene.beam.elements = 8;
    scene.beam.axial_strain = AxialStrain::full;
    scene.beam.material.youngs_modulus = E;
    integrate_by(scene, By::implicit, 5e-5);
    scene.gravity = {g, 0, 0};
    scene.start.motion = scene.end.motion =
        SupportMotionSpec{{1, 0, 0}, {.amplitude = A, .frequency = 4, .phase_degrees = 90}};
    const RunResult run = test::completed(scene);
    const auto contacts = those(run, EventType::contact), parts = those(run, EventType::lift_off);
    ASSERT_EQ(contacts.size(), 2U);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_NEAR(contacts[0].t, hits, 1e-7);
    EXPECT_NEAR(parts[0].t, leaves, 1e-7);
    const double now = std::abs(contacts[1].t - again);
    EXPECT_LT(now, error);
    error = now;
    EXPECT_NEAR(taken(run), -0.5 * 0.5 * (first * first + second * second), 1e-5) << "as a support sees it";
    EXPECT_LE(run.max_energy_drift, 1e-6 * run.max_kinetic) << "the work of the supports in impacts and while it rests";
  }
}

/// m g along the beam is what the support bears, at either end: nothing is left for the beam.
TEST(JointRest, OnAnInclineTheSupportBearsTheWeightAlongTheBeam) {
  const double angle = 30 * std::numbers::pi / 180, weight = 0.5 * 9.81;
  for (const bool down : {true, false}) {
    const SlidingJointSpec mass = resting(slider(down ? 1.9 : 0.1, 0.5));
    SlidingJointSpec ring = slider(down ? 0.6 : 1.4, 0);
    ring.support = SupportType::pin;
    Scene scene = test::rope(down ? std::vector{ring, mass} : std::vector{mass, ring});
    scene.beam.material.youngs_modulus = 2e10;
    scene.beam.material.damping = 1e-4;
    integrate_by(scene, By::implicit);
    scene.gravity = {(down ? 9.81 : -9.81) * std::sin(angle), -9.81 * std::cos(angle), 0};
    scene.duration = 1;
    const RunResult run = test::completed(scene);
    ASSERT_EQ(those(run, EventType::contact).size(), 1U);
    EXPECT_TRUE(those(run, EventType::lift_off).empty());
    const JointSample& last = *run.samples.back().joints[down ? 1 : 0].on_beam;
    EXPECT_NEAR(last.tangential, 0, 0.01 * weight);
    EXPECT_NEAR(last.normal, weight * std::cos(angle), 0.05 * weight);
  }
}

/// What rests bears what strikes it, and does not give way.
TEST(JointRest, OneThatRestsIsAWallForAnother) {
  Scene scene = beam_with({slider(0.5, 0.3), resting(slider(1.9, 0.5, 2))});
  integrate_by(scene, By::implicit);
  scene.gravity = {5, 0, 0};
  scene.contact = ContactSpec{AtSupport::rebound, 0.7};
  scene.duration = 0.9;
  const RunResult run = test::completed(scene);
  const auto hits = those(run, EventType::contact);
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_TRUE(those(run, EventType::lift_off).empty());
  const double way = 1.5 - 2 * d_of_8, t = std::sqrt(2 * way / 5), v = 5 * t, rest = scene.duration - t;
  EXPECT_NEAR(hits[1].t, t, 1e-6);
  EXPECT_NEAR(hits[1].energy_jump.total(), -0.5 * 0.3 * v * v * (1 - 0.49), 1e-4);
  EXPECT_NEAR((*run.samples.back().joints[0].mass_position)[0], 2 - 2 * d_of_8 - 0.7 * v * rest + 2.5 * rest * rest,
              1e-5);
  EXPECT_NEAR((*run.samples.back().joints[1].mass_position)[0], 2 - d_of_8, 1e-12);
}

/// Bounces that get lower without end, of a mass that falls along the beam: against a ring, and a support.
TEST(JointRest, IsWhatBouncesEndIn) {
  for (const bool support : {false, true}) {
    SlidingJointSpec falls = slider(1.5, 0.5), ring = slider(support ? 0.5 : 1.8, 0);
    ring.support = SupportType::pin;
    falls.at_support = AtSupport::rebound;
    falls.restitution = 0.3;
    Scene scene = test::rope(support ? std::vector{ring, falls} : std::vector{falls, ring});
    integrate_by(scene, By::implicit, 2e-5);
    scene.contact = ContactSpec{AtSupport::rebound, 0.3};
    scene.gravity = {9.81, 0, 0};
    scene.duration = 0.8;
    const RunResult run = test::completed(scene);
    const auto hits = those(run, EventType::contact);
    ASSERT_GE(hits.size(), 5U);
    EXPECT_LE(hits.size(), 20U);
    EXPECT_TRUE(those(run, EventType::lift_off).empty());
    // of a body that falls by h: sqrt(2 h/g) (1 + e)/(1 - e)
    const double h = (support ? 0.5 : 0.3) - 0.1 * 2 / 16;
    EXPECT_NEAR(hits.back().t, std::sqrt(2 * h / 9.81) * 1.3 / 0.7, 2e-3);
    EXPECT_NEAR((*run.samples.back().joints[support ? 1 : 0].mass_position)[0], 1.5 + h, 1e-8);
  }
}

/// Where friction keeps several joints from resting, or the method, the end of the bounces ends the run.
TEST(JointRest, OfJointsThatRubEndsTheRunByName) {
  SlidingJointSpec falls = slider(1.5, 0.5), ring = slider(0.5, 0);
  ring.support = SupportType::pin;
  ring.friction = AxialFriction{0.1, 1e-2};
  falls.at_support = AtSupport::rebound;
  falls.restitution = 0.3;
  Scene scene = test::rope({ring, falls});
  integrate_by(scene, By::implicit, 2e-5);
  scene.gravity = {9.81, 0, 0};
  scene.duration = 0.8;
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::failed);
  EXPECT_NE(run.failure.find("joint 1 comes to rest against the support at the beam's end"), std::string::npos)
      << run.failure;
}

/// A symmetric beam sags under two masses that meet in its middle, one of which a support has held before, as another
/// one the other.
TEST(JointRest, OfMirrorImagesAreMirrorImages) {
  Scene scene = beam_with(
      {resting(slider(0.07, 0.3, -1)), slider(0.7, 0.5, 1.5), slider(1.3, 0.5, -1.5), resting(slider(1.93, 0.3, 1))});
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  scene.contact = ContactSpec{.joints = AtSupport::rest};
  scene.duration = 0.22;
  const RunResult run = test::completed(scene);
  EXPECT_GE(those(run, EventType::contact).size(), 2U) << "at both supports at once, and in the middle";
  for (const Sample& sample : run.samples) {
    for (const std::size_t i : {0, 1}) {
      EXPECT_NEAR(*sample.joints[i].position + *sample.joints[3 - i].position, 2, 1e-9) << "at " << sample.t;
    }
  }
  EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
}

/// What acts between two has one line: where nothing is held, momenta stay while a beam that turns throws a mass
/// against a stop on it.
TEST(JointRest, OnABeamThatNothingHoldsKeepsTheMomenta) {
  SlidingJointSpec stop = slider(1.6, 0.2);
  stop.x.emplace();
  Scene scene = beam_with({slider(1.2, 0.5, 1), stop});
  scene.gravity = {};
  scene.start.type = scene.end.type = SupportType::free;
  scene.initial_velocity = InitialVelocitySpec{.rotation = 3, .about = {1, 0, 0}};
  scene.contact = ContactSpec{.joints = AtSupport::rest};
  scene.duration = 0.8;
  const RunResult run = test::completed(scene);
  const auto hits = those(run, EventType::contact), parts = those(run, EventType::lift_off);
  ASSERT_GE(hits.size(), 1U);
  EXPECT_LE(hits.size(), 20U) << "the beam, which gives way, throws it back";
  double together = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    together += (i < parts.size() ? parts[i].t : scene.duration) - hits[i].t;
    for (const double jump : hits[i].momentum_jump) EXPECT_NEAR(jump, 0, 1e-12);
  }
  EXPECT_GT(together, 0.01);
  const Sample& last = run.samples.back();
  for (const Sample& sample : run.samples) {
    if (sample.t < hits[0].t) continue;
    for (const std::size_t c : {0, 1}) EXPECT_NEAR(sample.momentum[c], last.momentum[c], 1e-9);
    EXPECT_NEAR(sample.angular_momentum[2], last.angular_momentum[2], 1e-9);
  }
  EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
}

/// On a beam that is bent, where an impact leaves a ringing that implicit steps damp before they resolve it.
TEST(JointRest, OfGeneralizedAlphaComesNearTheExplicitRun) {
  const auto place = [](By method, double step) {
    Scene scene = beam_with({slider(1.2, 0.3, 1.5), resting(slider(1.8, 0.5, 2))});
    integrate_by(scene, method, step);
    scene.gravity = {5, -2, 0};
    const RunResult run = test::completed(scene);
    EXPECT_EQ(those(run, EventType::contact).size(), 1U);
    const Point at = *run.samples.back().joints[1].mass_position;
    EXPECT_NEAR(std::hypot(at[0] - 2, at[1]), d_of_8, 1e-10) << "it turns with the beam about the support";
    EXPECT_LT(at[1], -0.005);
    return at;
  };
  const Point exact = place(By::explicit_steps, 0);
  for (const By method : {By::implicit, By::multipliers}) {
    const auto error = [&](double step) {
      const Point at = place(method, step);
      return std::hypot(at[0] - exact[0], at[1] - exact[1]);
    };
    const double coarse = error(2e-4), fine = error(2.5e-5);
    EXPECT_LT(coarse, 1e-5);
    EXPECT_LT(fine, coarse / 8) << "of first order at least";
  }
}

/// One after the other they leave a free end.
TEST(JointRest, DoesNotOutlastTheOther) {
  Scene scene = beam_with({slider(0.9, 0.3, 4), slider(1.4, 0.3, 2)});
  integrate_by(scene, By::implicit);
  scene.gravity = {};
  scene.end.type = SupportType::free;
  scene.contact = ContactSpec{.joints = AtSupport::rest};
  scene.duration = 0.4;
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::separated);
  EXPECT_EQ(those(run, EventType::contact).size(), 1U);
  EXPECT_EQ(those(run, EventType::separation).size(), 2U);
  EXPECT_LE(run.max_energy_drift, 1e-6 * run.max_kinetic);
}

TEST(JointRest, RefusesWhatItDoesNotKnow) {
  const Scene good = beam_with({slider(0.5, 0.3), resting(slider(1.2, 0.3))});
  const auto field = [&](const auto& change) {
    Scene scene = good;
    change(scene);
    return test::refused(scene);
  };
  const auto rubs = [](Scene& scene) { scene.sliding_joints[0].friction = AxialFriction{0.1, 1e-2}; };
  const auto derived = [](Scene& scene) { scene.integrator.type = IntegratorType::rosenbrock4; };
  const auto meets = [](Scene& scene, AtSupport law, double restitution) {
    scene.sliding_joints[1].at_support = AtSupport::stop;
    scene.contact = ContactSpec{law, restitution};
  };
  EXPECT_EQ(field(rubs), "/sliding_joints/1/at_support");
  EXPECT_EQ(field(derived), "/sliding_joints/1/at_support");
  EXPECT_EQ(field([&](Scene& s) { meets(s, AtSupport::rest, 1), rubs(s); }), "/contact/joints");
  EXPECT_EQ(field([&](Scene& s) { meets(s, AtSupport::rebound, 0), derived(s); }), "/contact/restitution");
  EXPECT_EQ(field([&](Scene& s) { s.sliding_joints[1].position = 1.99; }), "/sliding_joints/1/position");
  EXPECT_EQ(field([&](Scene& s) {
              s.sliding_joints[1].at_support = AtSupport::rebound;
              s.sliding_joints[1].restitution = 0;
              derived(s);
            }),
            "/sliding_joints/1/restitution");
}

}  // namespace
}  // namespace vlbeam
