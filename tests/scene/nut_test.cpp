// A nut on a beam that spins, and joints beside spin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double pitch = 0.5, inertia = 1, nut_mass = 20;  // [m], [kg m], [kg]
constexpr double lead = pitch / (2 * std::numbers::pi);    // [m/rad]

/// A screw that turns, held at its start along its axis, with a nut that is in no gravity.
Scene screw(ElementKind element = ElementKind::ale_ancf) {
  Scene scene;
  scene.beam.element = element;
  scene.beam.elements = 5;
  scene.beam.curve.start = {0, 0, 0};
  scene.beam.curve.end = {1, 0, 0};
  scene.beam.section = {
      .type = Section::Type::stiffness, .EA = 1e5, .EI = 100, .rhoA = 10, .GIp = 1e4, .rhoIp = inertia};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.end.type = SupportType::free;
  SlidingJointSpec nut;
  nut.position = 0.7;
  nut.mass = nut_mass;
  nut.pitch = pitch;
  scene.sliding_joints = {nut};
  scene.gravity = {0, 0, 0};
  scene.spin.emplace().angles = AngleField::hermite;
  scene.spin->rate = 4;
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
  scene.duration = 1;
  scene.output.interval = 0.1;
  return scene;
}

LoadSpec torque(double size, double ramp) {
  LoadSpec load;
  load.type = LoadType::torque;
  load.at = LoadPlace::node;
  load.node = 0;
  load.magnitude = {.value = size, .ramp = ramp};
  return load;
}

/// Where an error falls as 1/stiffness: what is left at an infinite one, by a value and that at twice the stiffness.
double rigid(double at_one, double at_two) { return 2 * at_two - at_one; }

TEST(Nut, OfARigidScrewFollowsTheClosedForm) {
  for (const double hand : {1.0, -1.0}) {
    const double size = 2, ramp = 0.2, whole = inertia + nut_mass * lead * lead;
    const auto at = [&](double stiffness) {
      Scene scene = screw();
      scene.beam.elements = 2;
      scene.beam.section.EA = scene.beam.section.GIp = stiffness;
      scene.sliding_joints[0].pitch = hand * pitch;
      scene.integrator.rtol = scene.integrator.atol = 1e-11;
      scene.loads = {torque(size, ramp)};
      scene.duration = 0.3;
      scene.output.interval = 0.05;
      return test::completed(scene).samples;
    };
    const auto one = at(1e7), two = at(2e7);
    for (std::size_t i = 0; i < one.size(); ++i) {
      if (one[i].t < ramp) continue;
      const double spin = 4 + size * (one[i].t - ramp / 2) / whole;
      EXPECT_NEAR(rigid(one[i].flow->spin_momentum, two[i].flow->spin_momentum) / inertia, spin, 1e-9);
      const double way = rigid(*one[i].joint_position, *two[i].joint_position) - 0.7,
                   angle = rigid((*one[i].flow->end_angles)[0], (*two[i].flow->end_angles)[0]);
      EXPECT_NEAR(way, -hand * lead * angle, 1e-10);
    }
  }
}

// Held in its place, it moves the screw.
TEST(Nut, ThatIsHeldMovesTheScrew) {
  const double size = 2, ramp = 0.2, beam = 10, whole = inertia + beam * lead * lead;
  const auto at = [&](double stiffness) {
    Scene scene = screw();
    scene.beam.elements = 2;
    scene.beam.section.EA = scene.beam.section.GIp = stiffness;
    scene.start.type = SupportType::free;
    scene.sliding_joints[0].support = SupportType::pin;
    scene.sliding_joints[0].mass = 0;
    scene.spin->rate = 0;
    scene.loads = {torque(size, ramp)};
    scene.duration = 0.3;
    scene.output.interval = 0.05;
    return test::completed(scene).samples;
  };
  const auto one = at(1e7), two = at(2e7);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i].t < ramp) continue;
    const double spin = size * (one[i].t - ramp / 2) / whole;
    EXPECT_NEAR(rigid(one[i].flow->spin_momentum, two[i].flow->spin_momentum) / inertia, spin, 1e-9);
    EXPECT_NEAR(rigid(one[i].momentum[0], two[i].momentum[0]), beam * lead * spin, 1e-9);
  }
}

// Against a bar of lumped inertias by central differences, exact to the step where a wave takes one step a cell. A
// point's inertia makes the twist jump, which the angles' cubics smear over an element: their error is of first order.
TEST(Nut, IsAFlywheelOnABarInTorsion) {
  const double mass = 0.5, torsion = 1e4, size = 1e-2, ramp = 0.004;
  Scene scene = screw();
  scene.beam.section.EA = 1e9;
  scene.beam.section.rhoA = 1e5;  // nothing else is fast or yields
  scene.beam.section.GIp = torsion;
  scene.spin->rate = 0;
  scene.sliding_joints[0] = {};
  scene.sliding_joints[0].position = 0.7;
  scene.sliding_joints[0].mass = mass;
  scene.sliding_joints[0].pitch = 2 * std::numbers::pi;  // a lead of 1 m a radian
  scene.loads = {torque(size, ramp)};
  scene.integrator.rtol = scene.integrator.atol = 1e-13;
  scene.duration = 0.03;
  scene.output.interval = 0.001;
  const auto at = [&](int elements) {
    scene.beam.elements = elements;
    return test::completed(scene).samples;
  };
  const auto coarse = at(10), fine = at(20);

  constexpr int cells = 1000, steps_a_sample = 100;
  const double dx = 1.0 / cells, dt = dx / std::sqrt(torsion / inertia);
  std::vector<double> inertias(cells + 1, inertia * dx), before(cells + 1, 0), angle = before, next = before;
  inertias.front() = inertias.back() = inertia * dx / 2;
  inertias[cells * 7 / 10] += mass;
  double largest = 0, error = 0;
  for (int step = 0; step <= steps_a_sample * 30; ++step) {
    if (step % steps_a_sample == 0) {
      const auto i = static_cast<std::size_t>(step / steps_a_sample);
      const double way = 2 * *fine[i].joint_position - *coarse[i].joint_position - 0.7;
      largest = std::max(largest, std::abs(way));
      error = std::max(error, std::abs(way + angle[cells * 7 / 10]));
    }
    const double s = std::min(step * dt / ramp, 1.0);
    for (std::size_t j = 0; j <= cells; ++j) {
      double torque = j == 0 ? size * s * s * s * s * (35 - 84 * s + 70 * s * s - 20 * s * s * s) : 0;
      if (j > 0) torque += torsion / dx * (angle[j - 1] - angle[j]);
      if (j < cells) torque += torsion / dx * (angle[j + 1] - angle[j]);
      next[j] = 2 * angle[j] - before[j] + dt * dt / inertias[j] * torque;
    }
    std::swap(before, angle);
    std::swap(angle, next);
  }
  EXPECT_LT(error, 2e-4 * largest) << largest;
}

/// A soft screw under a torque and its weight.
Scene soft(ElementKind element) {
  Scene scene = screw(element);
  scene.beam.section.EA = 1e4;
  scene.beam.section.EI = 20;
  scene.beam.section.GIp = 50;
  scene.gravity = {0, -9.81, 0};
  scene.start.type = SupportType::clamp;
  scene.end.type = SupportType::clamp;
  scene.loads = {torque(3, 0.1)};
  return scene;
}

TEST(Nut, LosesNoEnergy) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const int parts : {0, 1, 2, 3}) {
      Scene scene = soft(element);
      if (parts == 1) scene.sliding_joints[0].friction = AxialFriction{0.2, 1e-2};
      if (parts == 2) {
        scene.loads.clear();
        scene.spin->drives = {{.node = 0, .angle = {.rate = 4, .amplitude = 0.2, .frequency = 3}}};
      }
      if (parts == 3) {
        SlidingJointSpec bead;
        bead.position = 0.4;
        bead.velocity = -0.3;
        bead.mass = 1;
        scene.sliding_joints.insert(scene.sliding_joints.begin(), bead);
        scene.beam.material.damping = 1e-4;
        scene.beam.elements = 10;
        scene.duration = 0.5;
      }
      const RunResult run = test::completed(scene);
      EXPECT_FALSE(run.events.empty()) << parts;
      EXPECT_LT(run.max_energy_drift, 1e-9 * run.max_kinetic) << parts;
    }
  }
}

/// A scene by generalized-alpha with steps of this length.
RunResult implicitly(Scene scene, double step) {
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = step;
  return test::completed(scene);
}

// Against an explicit method, which solves for the accelerations; the ledger closes as the steps shrink.
TEST(Nut, IsOfSecondOrderWithGeneralizedAlpha) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const int parts : {0, 1, 2, 3}) {
      Scene scene = soft(element);
      scene.duration = 0.2;
      scene.gravity_ramp = 0.1;  // a jump would excite what steps do not resolve
      if (parts == 1) scene.sliding_joints[0].friction = AxialFriction{0.2, 0.5};
      if (parts == 2) {
        scene.loads.clear();
        scene.spin->drives = {{.node = 0, .angle = {.rate = 4, .amplitude = 0.2, .frequency = 3}}};
      }
      if (parts == 3) {
        scene.spin->rate = 0;
        scene.sliding_joints[0].support = SupportType::pin;
      }
      scene.output.interval = 0.01;
      const RunResult exact = test::completed(scene), coarse = implicitly(scene, 5e-4),
                      fine = implicitly(scene, 2.5e-4);
      ASSERT_EQ(exact.events.size(), fine.events.size()) << parts;
      const auto off = [&](const RunResult& run) {
        double largest = 0;
        for (std::size_t i = 0; i < run.samples.size(); ++i) {
          largest = std::max(largest, std::abs(*run.samples[i].joint_position - *exact.samples[i].joint_position));
        }
        return largest;
      };
      EXPECT_LT(off(fine), 1e-6) << parts;
      EXPECT_NEAR(off(coarse) / off(fine), 4, 0.5) << parts;
      EXPECT_NEAR(coarse.max_energy_drift / fine.max_energy_drift, 4, 0.5) << parts;
    }
  }
}

TEST(Nut, OfARigidScrewFollowsTheClosedFormWithGeneralizedAlpha) {
  const double size = 2, ramp = 0.2, whole = inertia + nut_mass * lead * lead;
  Scene scene = screw();
  scene.beam.elements = 2;
  scene.beam.section.EA = scene.beam.section.GIp = 1e9;
  scene.loads = {torque(size, ramp)};
  scene.duration = 0.3;
  const auto run = implicitly(scene, 1e-3);
  for (const Sample& sample : run.samples) {
    if (sample.t < ramp) continue;
    const double spin = 4 + size * (sample.t - ramp / 2) / whole;
    EXPECT_NEAR(sample.flow->spin_momentum / inertia, spin, 1e-6);
  }
}

TEST(Nut, ThatHasLeftLetsTheScrewTurn) {
  Scene scene = screw(ElementKind::ale_rancf);
  scene.spin->rate = -4;
  scene.integrator.rtol = scene.integrator.atol = 1e-8;
  scene.duration = 1.2;
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::separated) << run.failure;
  EXPECT_EQ(run.events.back().type, EventType::separation);
  EXPECT_NEAR(run.events.back().t, 0.3 / (4 * lead), 0.02);
  for (const Sample& s : run.samples) {
    EXPECT_NEAR(s.flow->spin_momentum, -4 * inertia, 1e-9) << s.t;
    EXPECT_NEAR(s.momentum[0], nut_mass * 4 * lead, 1e-8) << s.t;
  }
}

// The angles have nodes of their own, that the mesh's events leave alone.
TEST(Nut, TurnsABeamFreelyWithMoreElements) {
  Scene scene = soft(ElementKind::ale_ancf);
  scene.beam.strain_law = StrainLaw::green;
  scene.duration = 0.3;
  const auto at = [&](int elements) {
    scene.beam.elements = elements;
    return test::completed(scene).samples.back();
  };
  const Sample coarse = at(5), fine = at(10), finest = at(20);
  const double first = std::abs(*coarse.joint_position - *fine.joint_position),
               second = std::abs(*fine.joint_position - *finest.joint_position);
  EXPECT_LT(second, first / 4);
  EXPECT_LT(second, 1e-4);
}

TEST(Spin, BesideJointsChangesNothing) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const IntegratorType type : {IntegratorType::fehlberg78, IntegratorType::generalized_alpha}) {
      Scene scene = soft(element);
      scene.loads.clear();
      scene.sliding_joints[0].pitch.reset();
      scene.sliding_joints[0].velocity = 0.4;
      scene.duration = 0.4;
      const double allowed = type == IntegratorType::fehlberg78 ? 1e-8 : 1e-7;
      if (type == IntegratorType::generalized_alpha) {
        scene.integrator = {};
        scene.integrator.type = type;
        scene.integrator.step = 5e-4;
      }
      const RunResult with = test::completed(scene);
      EXPECT_NEAR(with.samples.back().flow->spin_momentum, 4 * inertia, 1e-9);
      scene.spin.reset();
      const RunResult without = test::completed(scene);
      ASSERT_EQ(with.events.size(), without.events.size());
      EXPECT_FALSE(with.events.empty());
      for (std::size_t i = 0; i < with.samples.size(); ++i) {
        EXPECT_NEAR(*with.samples[i].joint_position, *without.samples[i].joint_position, allowed);
        for (std::size_t c = 0; c < 2; ++c) {
          EXPECT_NEAR((*with.samples[i].mass_position)[c], (*without.samples[i].mass_position)[c], allowed);
        }
      }
    }
  }
}

TEST(Spin, UnderTorqueBesideABeadIsThatWithoutIt) {
  Scene scene = soft(ElementKind::ale_ancf);
  scene.sliding_joints[0].pitch.reset();
  scene.sliding_joints[0].velocity = 0.4;
  scene.beam.elements = 10;  // with a node where the bead is, so that the angles have the same ones
  scene.duration = 0.4;
  const RunResult with = test::completed(scene);
  EXPECT_FALSE(with.events.empty());
  scene.sliding_joints.clear();
  const RunResult without = test::completed(scene);
  for (std::size_t i = 0; i < with.samples.size(); ++i) {
    EXPECT_NEAR(with.samples[i].flow->spin_momentum, without.samples[i].flow->spin_momentum, 1e-9);
    EXPECT_NEAR((*with.samples[i].flow->end_angles)[1], (*without.samples[i].flow->end_angles)[1], 1e-9);
  }
}

TEST(Nut, IsRefusedByName) {
  const auto refused = [](const std::function<void(Scene&)>& change) {
    Scene scene = screw();
    change(scene);
    return test::refused(scene);
  };
  const std::string pitch_key = "/sliding_joints/0/pitch";
  EXPECT_EQ(refused([](Scene& s) { s.spin.reset(); }), "/spin");
  for (const double wrong : {0.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_EQ(refused([wrong](Scene& s) { s.sliding_joints[0].pitch = wrong; }), pitch_key);
  }
  EXPECT_EQ(refused([](Scene& s) { s.spin->angles = AngleField::linear; }), "/spin/angles");
  EXPECT_EQ(refused([](Scene& s) { s.analysis = Analysis::statics; }), "/spin");
  EXPECT_EQ(refused([](Scene& s) { s.integrator.type = IntegratorType::rosenbrock4; }), "/integrator/type");
  EXPECT_EQ(refused([](Scene& s) { s.length_control.velocities = VelocityTransfer::conservative; }),
            "/length_control/velocities");
  EXPECT_EQ(refused([](Scene& s) { s.length_control.end_merge = 0.1; }), "/length_control/end_merge");
  EXPECT_EQ(refused([](Scene& s) { s.start.feed.emplace(); }), "/spin");
  EXPECT_EQ(refused([](Scene& s) { s.beam.rotary_inertia = BendingInertia::rayleigh; }), pitch_key);
  EXPECT_EQ(refused([](Scene& s) { s.sliding_joints[0].x.emplace(); }), pitch_key);
  EXPECT_EQ(refused([](Scene& s) { s.sliding_joints[0].velocity = 1; }), "/sliding_joints/0/velocity");
  EXPECT_EQ(refused([](Scene& s) { s.sliding_joints[0].support = SupportType::pin; }), "/spin/rate");
  EXPECT_EQ(refused([](Scene& s) { s.sliding_joints[0].at_support = AtSupport::rest; }),
            "/sliding_joints/0/at_support");
  EXPECT_EQ(refused([](Scene& s) {
              s.sliding_joints.push_back(s.sliding_joints[0]);
              s.sliding_joints[1].position = 0.9;
            }),
            "/sliding_joints/1/pitch");
}

}  // namespace
}  // namespace vlbeam
