// A joint that is held in space: a ring, through which the beam runs, and a sleeve, which holds its direction, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "scene/energy_ledger.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

/// A cantilever that runs through a ring at `position`, pulled and pushed at its free end.
Scene through(SupportType support, ElementKind element = ElementKind::ale_ancf) {
  Scene scene;
  scene.gravity = {0, 0, 0};
  scene.beam.element = element;
  scene.beam.elements = 8;
  scene.beam.section.radius = 0.02;
  scene.beam.material = {.density = 7200, .youngs_modulus = 2e7};
  scene.start.type = SupportType::clamp;
  SlidingJointSpec joint;
  joint.support = support;
  joint.position = 0.55;
  scene.sliding_joints = {joint};
  scene.loads = {
      {.node = 8, .x = {}, .magnitude = {.value = 200, .ramp = 0.05}, .direction = {-0.6, 1, 0}, .turn = {}}};
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-12);
  scene.duration = 0.1;
  scene.output.interval = 0.01;
  return scene;
}

/// A scene is not told to take what it would be refused for.
TEST(Ring, IsNotAdvisedToConserveAtEvents) {
  RunResult result;
  result.samples.resize(2);
  result.max_kinetic = 1;
  Event& event = result.events.emplace_back();
  event.energy_jump.kinetic = 0.1;
  const auto advice = [&](const Scene& scene) { return energy_warnings(scene, result).at(0).remedy; };
  Scene guided = through(SupportType::pin);
  guided.sliding_joints.front().x.emplace();
  const Scene mass = test::falling_beam(ElementKind::ale_ancf, 10);
  EXPECT_EQ(advice(guided).find("conservative"), std::string::npos) << advice(guided);
  EXPECT_NE(advice(mass).find("conservative"), std::string::npos) << advice(mass);
}

TEST(Ring, HoldsThePlaceAndASleeveTheDirection) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    Scene scene = through(support);
    scene.output.configurations = {0.05, 0.1};
    const RunResult run = test::completed(scene);
    EXPECT_GT(std::abs(*run.samples.back().joint_position - 0.55), 1e-5) << "the beam runs through it";
    EXPECT_GT(std::abs(run.samples.back().end[1]), 0.01) << "and moves";
    for (const Sample& sample : run.samples) {
      EXPECT_NEAR((*sample.mass_position)[0], 0.55, 1e-13);
      EXPECT_NEAR((*sample.mass_position)[1], 0, 1e-13);
    }
    for (const Configuration& shape : run.configurations) {
      const auto at = std::min_element(shape.r.begin(), shape.r.end(), [](const Point& a, const Point& b) {
        return std::abs(a[0] - 0.55) + std::abs(a[1]) < std::abs(b[0] - 0.55) + std::abs(b[1]);
      });
      const double slope = shape.r_x[static_cast<std::size_t>(at - shape.r.begin())][1];
      if (support == SupportType::clamp) {
        EXPECT_NEAR(slope, 0, 1e-13);
      } else {
        EXPECT_GT(std::abs(slope), 0.02);
      }
    }
  }
}

// A mass that is heavy enough stays where it is.
TEST(Ring, IsTheLimitOfAHeavyMass) {
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    const Scene held = through(SupportType::pin, element);
    const RunResult ring = test::completed(held);
    std::vector<double> differences;
    for (const double mass : {1e3, 1e4, 1e5}) {
      Scene scene = held;
      scene.sliding_joints.front().support = SupportType::free;
      scene.sliding_joints.front().mass = mass;
      const RunResult run = test::completed(scene);
      differences.push_back(std::abs(run.samples.back().end[1] - ring.samples.back().end[1]));
    }
    EXPECT_NEAR(differences[0] / differences[1], 10, 0.5) << differences[0];
    EXPECT_NEAR(differences[1] / differences[2], 10, 0.5) << differences[1];
  }
}

TEST(Ring, KeepsTheEnergyAndTheMomentum) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      const RunResult run = test::completed(through(support, element));
      const double largest = run.samples.back().flow->ledger.loads;
      EXPECT_GT(largest, 0.1);
      EXPECT_LT(run.max_energy_drift, 1e-9 * largest) << run.max_energy_drift;
    }
  }
}

// What the beam does to the ring is what the momentum of the beam lacks.
TEST(Ring, BearsWhatTheMomentumLacks) {
  Scene scene = through(SupportType::pin);
  scene.gravity = {0, -9.81, 0};
  constexpr double t = 0.06, h = 1e-4;
  scene.duration = t + h;
  scene.output.interval = h;
  const RunResult run = test::completed(scene);
  const auto at = [&](double time) {
    return *std::min_element(run.samples.begin(), run.samples.end(), [time](const Sample& a, const Sample& b) {
      return std::abs(a.t - time) < std::abs(b.t - time);
    });
  };
  const Sample before = at(t - h), now = at(t), after = at(t + h);
  const double weight = 7200 * M_PI * 4e-4 * 9.81, load = 200;
  const std::array<double, 2> outer{load * -0.6 / std::hypot(0.6, 1), load / std::hypot(0.6, 1) - weight};
  for (std::size_t i = 0; i < 2; ++i) {
    const double rate = (after.momentum[i] - before.momentum[i]) / (2 * h);
    const double supports = now.reactions[0].position[i] + now.reactions[1].position[i];
    EXPECT_NEAR(supports - now.joint->force[i] + outer[i], rate, 2e-3 * (std::abs(rate) + 1)) << i;
  }
}

TEST(Ring, IsTheSameWithEveryIntegrator) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    const RunResult exact = test::completed(through(support));
    for (const Constraints constraints : {Constraints::eliminated, Constraints::multipliers}) {
      std::vector<double> errors;
      for (const double step : {2e-4, 1e-4}) {
        Scene scene = through(support);
        scene.integrator.type = IntegratorType::generalized_alpha;
        scene.integrator.step = step;
        scene.constraints = constraints;
        const RunResult run = test::completed(scene);
        errors.push_back(std::abs(*run.samples.back().joint_position - *exact.samples.back().joint_position));
      }
      EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2) << errors[0] << ' ' << errors[1];
    }
    Scene stiff = through(support);
    stiff.integrator.type = IntegratorType::rosenbrock4;
    stiff.integrator.rtol = stiff.integrator.atol = 1e-8;
    EXPECT_NEAR(*test::completed(stiff).samples.back().joint_position, *exact.samples.back().joint_position, 1e-6);
  }
}

// A beam that hangs in a ring falls through it and is free.
TEST(Ring, IsLeftByABeamThatRunsOut) {
  Scene scene;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.curve.start = {0, 0, 0};
  scene.beam.curve.end = {0, 1, 0};
  scene.beam.elements = 8;
  scene.beam.section.radius = 0.02;
  scene.beam.material.youngs_modulus = 2e8;
  SlidingJointSpec ring;
  ring.support = SupportType::pin;
  ring.position = 0.4;
  scene.sliding_joints = {ring};
  scene.duration = 0.4;
  scene.output.interval = 0.01;
  for (const IntegratorType type : {IntegratorType::dopri5, IntegratorType::generalized_alpha}) {
    for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
      test::set_tolerance(scene, type, 1e-10);
      scene.integrator.step = 1e-4;
      scene.sliding_joints.front().support = support;
      const RunResult run = simulate(scene);
      ASSERT_EQ(run.status, RunStatus::separated) << run.failure;
      const Event& last = run.events.back();
      EXPECT_EQ(last.type, EventType::separation);
      EXPECT_GT(run.events.size(), 3U) << "nodes pass through it";
      EXPECT_NEAR(last.t, std::sqrt(2 * (1 - 0.4) / 9.81), 2e-3) << "frictionless, it falls freely";
      EXPECT_NEAR(run.samples.back().end[1], 1 - 9.81 / 2 * 0.4 * 0.4, 5e-3);
      EXPECT_FALSE(run.samples.back().mass_position) << "the ring is not of the beam any more";
      for (const Event& event : run.events) EXPECT_LT(std::abs(event.energy_jump.total()), 1e-4 * run.max_kinetic);
      EXPECT_LT(run.max_energy_drift, (type == IntegratorType::dopri5 ? 1e-7 : 1e-4) * run.max_kinetic);
    }
  }
}

TEST(Ring, IsRefusedWhereItCannotBe) {
  const auto field_of = [](const auto& change) {
    Scene scene = through(SupportType::pin);
    change(scene, scene.sliding_joints.front());
    try {
      simulate(scene);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string();
  };
  const std::string at = "/sliding_joints/0";
  EXPECT_EQ(field_of([](Scene& s, SlidingJointSpec&) { s.sliding_mass.emplace(); }), "/sliding_joints");
  EXPECT_EQ(field_of([](Scene& s, SlidingJointSpec& j) { s.sliding_joints.push_back(j); }),
            "/sliding_joints/1/position");
  EXPECT_EQ(field_of([](Scene&, SlidingJointSpec& j) { j.support = SupportType::free; }), at + "/mass");
  EXPECT_EQ(field_of([](Scene&, SlidingJointSpec& j) { j.support = SupportType::slide; }), at + "/support");
  EXPECT_EQ(field_of([](Scene&, SlidingJointSpec& j) { j.velocity = 1; }), at + "/velocity");
  EXPECT_EQ(field_of([](Scene&, SlidingJointSpec& j) { j.position = 0; }), at + "/position");
  EXPECT_EQ(field_of([](Scene&, SlidingJointSpec& j) { j.at_support = AtSupport::rest; }), at + "/at_support");
  EXPECT_EQ(field_of([](Scene& s, SlidingJointSpec&) { s.length_control.end_merge = 0.5; }),
            "/length_control/end_merge");
  EXPECT_EQ(field_of([](Scene& s, SlidingJointSpec&) { s.integrator.type = IntegratorType::energy_momentum; }),
            "/integrator/type");
}

}  // namespace
}  // namespace vlbeam
