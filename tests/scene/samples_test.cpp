// What a run observes, checked by what it must be: balances of momentum, differences in time, statics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/energy_ledger.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

using test::falling_beam;
using test::flexible_pendulum;
using test::set_tolerance;

const Sample& at(const RunResult& result, double t) {
  for (const Sample& sample : result.samples) {
    if (std::abs(sample.t - t) < 1e-12) return sample;
  }
  throw std::out_of_range("no sample");
}

/// The falling beam with samples and shapes around an instant.
RunResult falling_around(double t, double h, JointSlopes slopes = JointSlopes::continuous, double friction = 0,
                         int elements = 8) {
  Scene scene = falling_beam(ElementKind::ale_ancf, elements);
  set_tolerance(scene, IntegratorType::fehlberg78, elements == 8 ? 1e-12 : 1e-9);
  scene.sliding_mass->slopes = slopes;
  if (friction > 0) scene.sliding_mass->friction = AxialFriction{friction, 1e-3};
  scene.duration = t + h;
  scene.output.interval = h;
  scene.output.configurations = {t - h, t, t + h};
  return simulate(scene);
}

TEST(Samples, TheContactForceMovesTheMass) {
  constexpr double t = 0.15, h = 1e-3, m = 0.8;
  for (const JointSlopes slopes : {JointSlopes::continuous, JointSlopes::free}) {
    const RunResult run = falling_around(t, h, slopes);
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    const Sample &before = at(run, t - h), &now = at(run, t), &after = at(run, t + h);
    EXPECT_NEAR(now.joint->velocity, (*after.joint_position - *before.joint_position) / (2 * h), 1e-4);
    const Point &a = *before.mass_position, &b = *now.mass_position, &c = *after.mass_position;
    for (std::size_t i = 0; i < 2; ++i) {
      const double gravity = i == 1 ? -9.81 : 0;
      EXPECT_NEAR(now.joint->force[i], m * ((a[i] - 2 * b[i] + c[i]) / (h * h) - gravity), 2e-3) << i;
    }
    EXPECT_NEAR(std::hypot(now.joint->tangential, now.joint->normal),
                std::hypot(now.joint->force[0], now.joint->force[1]), 1e-12);
    EXPECT_GT(now.joint->normal, 1);
  }
}

TEST(Samples, FrictionIsWhatTheContactHasAlongTheBeam) {
  const auto tangential = [](double friction, int elements) {
    const JointSample joint = *at(falling_around(0.2, 1e-3, JointSlopes::continuous, friction, elements), 0.2).joint;
    EXPECT_GT(joint.velocity, 0.05) << "it slides towards the end";
    return joint.tangential / joint.normal;
  };
  EXPECT_NEAR(tangential(0, 16), 0, std::abs(tangential(0, 8)) / 2) << "what the mesh leaves";
  EXPECT_NEAR(tangential(0.3, 64), -0.3, 0.02);
  EXPECT_NEAR(tangential(0, 64), 0, 0.02);
}

TEST(Samples, NodesMoveAsTheirRatesSay) {
  constexpr double t = 0.15, h = 1e-3;
  const RunResult run = falling_around(t, h, JointSlopes::tangent);
  ASSERT_EQ(run.configurations.size(), 3U);
  const Configuration &before = run.configurations[0], &now = run.configurations[1], &after = run.configurations[2];
  ASSERT_EQ(before.x.size(), after.x.size());
  ASSERT_EQ(now.kinks.size(), 1U);
  for (std::size_t k = 0; k < now.x.size(); ++k) {
    const auto rate = [h](double a, double b) { return (b - a) / (2 * h); };
    EXPECT_NEAR(now.rates.x[k], rate(before.x[k], after.x[k]), 1e-4);
    for (std::size_t i = 0; i < 2; ++i) {
      const double node = now.rates.v[k][i] + now.r_x[k][i] * now.rates.x[k];
      EXPECT_NEAR(node, rate(before.r[k][i], after.r[k][i]), 1e-3) << k;
      EXPECT_NEAR(now.rates.r_x[k][i], rate(before.r_x[k][i], after.r_x[k][i]), 2e-2) << k;
    }
  }
  EXPECT_NE(now.rates.x[now.kinks.front().node], 0);
}

TEST(Samples, GravityAloneTurnsAFreeBeam) {
  Scene scene = falling_beam(ElementKind::ale_ancf, 6);
  scene.start = {};
  scene.beam.curve.start = {2, 0, 0};
  scene.beam.curve.end = {3, 0, 0};
  scene.duration = 0.02;
  scene.output.interval = 0.01;
  const RunResult run = simulate(scene);
  const double rhoA = 7200 * M_PI * 1e-4, moment = rhoA * 2.5 + 0.8 * 2.1;  // integral of x over the mass
  for (const Sample& sample : run.samples) {
    EXPECT_NEAR(sample.angular_momentum[2], -9.81 * moment * sample.t, 1e-9);
    EXPECT_NEAR(sample.momentum[1], -9.81 * (rhoA + 0.8) * sample.t, 1e-10);
  }
}

TEST(Samples, AngularMomentumOfAFreeCurvedBeamIsKept) {
  Scene scene = falling_beam(ElementKind::ale_ancf, 6);
  scene.beam.curve = {.type = CurveType::arc, .center = {0.3, 0.2, 0}, .radius = 0.6, .to_degrees = 90};
  scene.beam.rest_shape = RestShape::as_built;
  scene.start = {};
  scene.gravity = {};
  scene.sliding_mass->velocity = 1;
  scene.duration = 0.03;
  set_tolerance(scene, IntegratorType::dopri5, 1e-11);
  const RunResult run = simulate(scene);
  ASSERT_TRUE(run.events.empty());
  EXPECT_GT(std::abs(run.samples.front().angular_momentum[2]), 0.3);
  EXPECT_NEAR(run.samples.back().angular_momentum[2], run.samples.front().angular_momentum[2], 1e-9);
}

TEST(Samples, APulledBeamBearsWhatPullsIt) {
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    Scene scene;
    scene.gravity = {};
    scene.beam.strain_law = law;
    scene.beam.element = ElementKind::ale_ancf;
    scene.beam.elements = 3;
    scene.start.type = scene.end.type = SupportType::pin;
    scene.flow.emplace();
    scene.flow->tension = 300;  // of EA = 6283 N
    const double EA = 2e7 * M_PI * 1e-4, stretch = 1 + 300 / EA;
    scene.beam.curve.end = {law == StrainLaw::engineering ? stretch : 1.0457, 0, 0};
    scene.flow->nodes = {{.node = 0, .x = {}}, {.node = 3, .x = {.value = 1}}};
    scene.duration = scene.output.interval = 1e-4;
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    const StrainSample& strains = run.samples.front().strains;
    EXPECT_NEAR(strains.axial_force[0], 300, 1e-8);
    EXPECT_NEAR(strains.axial_force[1], 300, 1e-8);
    EXPECT_NEAR(run.samples.front().reactions[0].position[0], -300, 1e-8);
    EXPECT_NEAR(run.samples.front().reactions[1].position[0], 300, 1e-8);
    if (law == StrainLaw::engineering) {
      EXPECT_NEAR(strains.axial_strain[1], 300 / EA, 1e-12);
    }
    EXPECT_NEAR(strains.curvature, 0, 1e-12);
  }
}

TEST(Samples, ABentBeamBearsItsLoad) {
  Scene scene;
  scene.gravity = {};
  scene.beam.section = {Section::Type::stiffness, 0, 1e4, 10, 0.1};
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = 16;
  scene.start.type = SupportType::clamp;
  scene.flow.emplace().steady = true;  // static: nothing flows
  scene.loads.push_back({.node = 16, .x = {}, .magnitude = {.value = -0.3}, .turn = {}});
  scene.duration = scene.output.interval = 1e-4;
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  const Sample& sample = run.samples.front();
  EXPECT_NEAR(sample.reactions[0].position[1], 0.3, 1e-6);
  EXPECT_NEAR(sample.reactions[0].slope[1], 0.3, 1e-4) << "the moment P l at the clamp, across the slope (1, 0)";
  EXPECT_NEAR(sample.strains.curvature, 0.03, 1e-4) << "P l/(E I)";
}

TEST(Samples, DrivesAndInnerSupportsHoldAShaft) {
  Scene scene;
  scene.dimension = 3;
  scene.gravity = {0, -9.81, 0};
  scene.beam.curve.end = {0, 0, 1};
  scene.beam.material = {.density = 7800, .youngs_modulus = 2.1e11, .poisson_ratio = 0.3};
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.spin.emplace().drives = {{.node = 0, .angle = {.amplitude = 0.1, .frequency = 20}}};
  scene.flow.emplace().nodes = {{.node = 0, .x = {}},
                                {.node = 4, .x = {.value = 0.5}, .support = SupportType::slide},
                                {.node = 8, .x = {.value = 1}}};
  scene.flow->steady = true;
  scene.loads.push_back({.type = LoadType::torque, .node = 8, .x = {}, .magnitude = {.value = 0.3}, .turn = {}});
  scene.loads.push_back({.node = 4, .x = {}, .magnitude = {.value = 50}, .direction = {1, 0, 0}, .turn = {}});
  set_tolerance(scene, IntegratorType::dopri5, 1e-11);
  constexpr double h = 1e-6;
  scene.duration = 2e-4;
  scene.output.interval = h;
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  const double weight = 7800 * M_PI * 1e-4 * 9.81;
  for (const std::size_t i : {50U, 150U}) {
    const Sample& now = run.samples[i];
    const FlowSample &before = *run.samples[i - 1].flow, &after = *run.samples[i + 1].flow;
    const double rate = (after.spin_momentum - before.spin_momentum) / (2 * h);
    EXPECT_NEAR(now.flow->torques[0] + 0.3, rate, 2e-3 * std::abs(rate) + 1e-3);
    ASSERT_EQ(now.flow->supports.size(), 1U);
    for (std::size_t c = 0; c < 2; ++c) {  // along the shaft it rings
      const double held =
          now.reactions[0].position[c] + now.flow->supports[0].position[c] + now.reactions[1].position[c];
      const double load = c == 0 ? 50 : -weight;
      const double momentum = (run.samples[i + 1].momentum[c] - run.samples[i - 1].momentum[c]) / (2 * h);
      EXPECT_NEAR(held + load, momentum, 1e-5 * weight);
    }
    EXPECT_NEAR(now.flow->supports[0].position[0], -50, 1e-6);
  }
}

TEST(EnergyLedger, GrowingGravityDoesWork) {
  Scene pendulum = flexible_pendulum(6);
  set_tolerance(pendulum, IntegratorType::fehlberg78, 1e-12);
  const RunResult run = simulate(pendulum);
  EXPECT_GT(std::abs(run.samples.back().energy.supplied), 0.1);
  EXPECT_LE(run.max_energy_drift, 1e-10 * run.max_kinetic);
  const EnergyLedger ledger = energy_ledger(run);
  EXPECT_NEAR(ledger.change, ledger.supplied + ledger.unexplained, 1e-12);
  EXPECT_LE(ledger.largest_unexplained, 1e-9 * run.max_kinetic);
  EXPECT_TRUE(run.warnings.empty());

  // whatever the samples, with a mass that slides, and through events
  Scene scene = falling_beam(ElementKind::ale_ancf, 10);
  scene.gravity_ramp = 0.45;
  scene.output.interval = scene.duration = 0.5;
  set_tolerance(scene, IntegratorType::dopri5, 1e-11);
  const RunResult falling = simulate(scene);
  ASSERT_FALSE(falling.events.empty());
  ASSERT_LT(falling.events.front().t, scene.gravity_ramp);
  EXPECT_LE(falling.max_energy_drift, 2e-9 * falling.max_kinetic);

  // and of a beam that bears a load, with an implicit method, too
  scene = falling_beam(ElementKind::ale_ancf, 8);
  scene.sliding_mass.reset();
  scene.gravity_ramp = 0.1;
  scene.duration = 0.2;
  scene.loads.push_back({.node = 8, .x = {}, .magnitude = {.value = 0.1}, .turn = {}});
  set_tolerance(scene, IntegratorType::dopri5, 1e-11);
  const RunResult loaded = simulate(scene);
  EXPECT_EQ(loaded.samples.front().energy.gravity, 0) << "there is none yet";
  EXPECT_LE(loaded.max_energy_drift, 2e-9 * loaded.max_kinetic);
  EXPECT_GT(std::abs(loaded.samples.back().flow->ledger.loads), 1e-4 * loaded.max_kinetic);
  EXPECT_LE(energy_ledger(loaded).largest_unexplained, 1e-6 * loaded.max_kinetic);
  scene.loads.clear();
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.rho_inf = 1;
  scene.integrator.step = 1e-4;
  const RunResult implicit = simulate(scene);
  EXPECT_LE(implicit.max_energy_drift, 1e-4 * implicit.max_kinetic);
  EXPECT_GT(std::abs(implicit.samples.back().energy.supplied), 1e3 * implicit.max_energy_drift);
}

bool warns(const RunResult& run, WarningKind kind) {
  return std::ranges::any_of(run.warnings, [kind](const Warning& warning) {
    return warning.kind == kind && !warning.message.empty() && !warning.remedy.empty();
  });
}

TEST(EnergyLedger, WarnsOfEnergyThatIsLostAtEvents) {
  Scene scene = falling_beam(ElementKind::ale_ancf, 5);
  scene.duration = 0.6;
  const RunResult nodal = simulate(scene);
  EXPECT_TRUE(warns(nodal, WarningKind::energy_at_events));
  EXPECT_FALSE(warns(nodal, WarningKind::energy_between_events));
  const EnergyLedger ledger = energy_ledger(nodal);
  EXPECT_GE(ledger.event_jumps, std::abs(ledger.at_events));
  EXPECT_NEAR(ledger.change, ledger.supplied + ledger.at_events + ledger.unexplained, 1e-12);

  scene.beam.elements = 20;
  scene.beam.element = ElementKind::ale_rancf;
  scene.length_control.velocities = VelocityTransfer::conservative;
  scene.beam.quadrature_points = 12;
  const RunResult conservative = simulate(scene);
  EXPECT_TRUE(conservative.warnings.empty()) << conservative.warnings.front().message;
  EXPECT_TRUE(std::ranges::all_of(conservative.events, &Event::restored));
}

TEST(EnergyLedger, SaysWhereConservativeVelocitiesCouldNotConserve) {
  Scene scene = falling_beam(ElementKind::ale_rancf, 3);
  scene.beam.rest_shape = RestShape::as_built;
  scene.beam.curve = {.type = CurveType::arc, .radius = 1, .from_degrees = 180, .to_degrees = 360};
  scene.end = scene.start;
  scene.sliding_mass->position = 0.3;
  scene.length_control.velocities = VelocityTransfer::conservative;
  scene.duration = 0.6;
  const RunResult run = simulate(scene);
  ASSERT_FALSE(run.events.empty());
  EXPECT_FALSE(run.events.front().restored);
  EXPECT_GT(std::abs(run.events.front().discrete_jump), 1);
  EXPECT_TRUE(warns(run, WarningKind::energy_not_restored));
}

TEST(EnergyLedger, WarnsOfEnergyThatIsLostBetweenEvents) {
  Scene scene = falling_beam(ElementKind::ale_ancf, 20);
  scene.duration = 0.5;
  scene.formulation = Formulation::virtual_work;
  scene.duration = 0.6;
  EXPECT_TRUE(warns(simulate(scene), WarningKind::energy_between_events));
}

TEST(EnergyLedger, WarnsOfEnergyThatTooFewPointsDoNotSee) {
  Scene scene = falling_beam(ElementKind::ale_rancf, 5);
  scene.beam.quadrature_points = 3;
  scene.duration = 0.4;
  const RunResult run = simulate(scene);
  EXPECT_LE(run.max_energy_drift, 1e-6 * run.max_kinetic);
  EXPECT_TRUE(warns(run, WarningKind::energy_unexplained));
}

TEST(EnergyLedger, ABeamAtRestIsNoCauseForWarnings) {
  Scene scene;
  scene.gravity = {};
  scene.beam.curve = {.type = CurveType::arc};
  scene.beam.elements = 6;
  scene.start.type = SupportType::clamp;
  scene.duration = 0.05;
  EXPECT_TRUE(simulate(scene).warnings.empty());
}

/// All the energy that there is in its first steps may be the method's own error.
TEST(Samples, AMotionFromRestIsNotCalledUnstableByItsFirstSteps) {
  Scene scene;
  scene.gravity = {};
  scene.beam.elements = 8;
  scene.beam.element = ElementKind::ancf;
  scene.start.type = SupportType::pin;
  scene.start.motion = {.direction = {-1, 0, 0}, .displacement = {.value = 0.1, .ramp = 0.8}};
  scene.duration = 0.1;
  scene.integrator.type = IntegratorType::generalized_alpha;
  for (const double interval : {0.02, 1e-3, 5e-4, 2.5e-4}) {
    scene.output.interval = interval;
    const RunResult run = simulate(scene);
    EXPECT_EQ(run.status, RunStatus::completed) << interval << ": " << run.failure;
  }
}

}  // namespace
}  // namespace vlbeam
