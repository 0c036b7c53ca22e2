// The outlet of a winch: the tension that it holds, what it does to the vibration of the element there, and the mass of
// what a drum has wound up.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/motion/system/implicit_beam.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/build.hpp"
#include "scene/energy_ledger.hpp"
#include "tests/core/support/differences.hpp"
#include "tests/core/support/random.hpp"
#include "tests/core/support/reference.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// A mass on a heavy rope that hangs from a winch, straight down, given by reference/winches.json.
Scene hanging_from_a_winch(const nlohmann::json& given, double EA, int elements) {
  Scene scene;
  scene.beam.curve.end = {0, -given.at("length").get<double>(), 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0, .rhoA = given.at("rhoA")};
  scene.beam.elements = elements;
  scene.start.type = SupportType::pin;
  scene.point_masses = {{elements, given.at("mass")}};
  scene.duration = given.at("t");
  scene.output.interval = scene.duration / 20;
  return scene;
}

Scene paid_out_by_its_weight(int elements) {
  const auto given = reference("winches.json").at("held_tension");
  Scene scene = hanging_from_a_winch(given, 2e4, elements);
  scene.start.held_tension = TimeSpec{.value = given.at("pull")};
  return scene;
}

// The inflow feeds the mode of a short element at the outlet: without damping its energy grows without bound. The bound
// is the rope's own stretch, 8 N/20 kN of 2 m.
TEST(WinchOutlet, FeedsNoVibrationOfTheElementThere) {
  const double right = reference("winches.json").at("held_tension").at("paid_out");
  for (const int elements : {12, 24}) {
    for (const auto type : {IntegratorType::generalized_alpha, IntegratorType::dopri5}) {
      for (const int dimension : {2, 3}) {
        SCOPED_TRACE(testing::Message() << elements << " elements, integrator " << static_cast<int>(type) << ", D "
                                        << dimension);
        Scene scene = paid_out_by_its_weight(elements);
        scene.dimension = dimension;
        set_tolerance(scene, type, 1e-7);
        scene.integrator.adaptive = type == IntegratorType::generalized_alpha;
        const RunResult run = completed(scene);
        EXPECT_GE(run.events.size(), static_cast<std::size_t>(elements / 3));
        EXPECT_NEAR(run.samples.back().winches[0]->length, right, 8e-4);
        EXPECT_LE(energy_ledger(run).largest_unexplained, 1e-3 * run.max_kinetic);
        for (const Sample& sample : run.samples) EXPECT_NEAR(sample.winches[0]->tension, 8, 8e-6);
      }
    }
  }
}

TEST(WinchOutlet, PullsInAndMeetsAnEndStop) {
  Scene scene = paid_out_by_its_weight(12);
  scene.start.held_tension = TimeSpec{.value = 15};
  scene.start.end_stop = EndStopSpec{.least = -0.5, .most = 0.3, .stiffness = 1e4, .depth = 0.01, .damping = 50};
  scene.duration = 1.5;
  const RunResult run = completed(scene);
  EXPECT_NEAR(run.samples.back().winches[0]->length, -0.5, 0.05);
  scene.start.held_tension = TimeSpec{.value = 6};
  const RunResult out = completed(scene);
  EXPECT_NEAR(out.samples.back().winches[0]->length, 0.3, 0.05);
}

// A light rope without damping, drawn unstrained, swings as it is pulled in: its waves ring for ever. Weights of a
// merged element that follow them let the third merge make 14.7 J of 0.005 J.
TEST(WinchOutlet, MergesATautRopeWithoutABlow) {
  Scene scene;
  scene.beam.curve.end = {0.6, -1.8, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e5, .EI = 0, .rhoA = 0.01};
  scene.beam.elements = 10;
  scene.start.type = SupportType::pin;
  scene.start.held_tension = TimeSpec{.value = 12};
  scene.point_masses = {{10, 1}};
  scene.duration = 0.72;
  scene.output.interval = 0.02;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = completed(scene);
  EXPECT_EQ(run.events.size(), 3U);
  const EnergyLedger ledger = energy_ledger(run);
  EXPECT_LE(std::abs(ledger.at_events), 1e-4 * run.max_kinetic);
  EXPECT_LE(ledger.largest_unexplained, 1e-2 * run.max_kinetic);
}

// A line between two pins, without weight: the far pin feels what the winch is asked for.
TEST(WinchOutlet, HoldsTheTensionThatIsAskedOfLinesOfAllKinds) {
  for (const auto law : {StrainLaw::green, StrainLaw::engineering}) {
    for (const double length : {1.0, 100.0, 1e4}) {
      for (const double strain : {1e-5, 1e-3, 0.1}) {
        SCOPED_TRACE(testing::Message() << length << " m, strain " << strain);
        constexpr double pull = 1000, rhoA = 1;
        const double EA = pull / strain, period = length * std::sqrt(rhoA / EA);  // of a wave from end to end
        Scene scene;
        scene.gravity = {};
        scene.beam.curve.end = {length, 0, 0};
        scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0, .rhoA = rhoA};
        scene.beam.strain_law = law;
        scene.beam.material.mass_damping = 2 / period;
        scene.beam.material.damping = period / 100;
        scene.beam.elements = 8;
        scene.start.type = scene.end.type = SupportType::pin;
        scene.start.held_tension = TimeSpec{.value = pull, .ramp = 4 * period};
        scene.duration = 30 * period;
        scene.output.interval = period;
        const Sample last = completed(scene).samples.back();
        EXPECT_NEAR(last.winches[0]->tension, pull, 1e-6 * pull);
        EXPECT_NEAR(last.reactions[1].position[0], pull, 1e-6 * pull);
      }
    }
  }
}

TEST(WinchOutlet, AWeightHeldByItsWeightStays) {
  Scene scene = paid_out_by_its_weight(12);
  scene.start.held_tension = TimeSpec{.value = (0.5 + 0.3 * 2) * 9.81};
  scene.initial_shape = InitialShape::equilibrium;
  scene.duration = 1;
  const RunResult run = completed(scene);
  EXPECT_NEAR(run.samples.back().winches[0]->length, 0, 1e-9);
  EXPECT_LE(run.max_kinetic, 1e-15);
}

// The whole mass of rope, drum and bucket stays: what has run off no longer turns with the drum.
TEST(WinchOutlet, WhatRunsOffADrumLeavesItsInertia) {
  const auto given = reference("winches.json").at("drum");
  Scene scene = hanging_from_a_winch(given, 1e7, 10);  // the reference knows no stretch
  set_tolerance(scene, IntegratorType::generalized_alpha, 1e-6);
  scene.integrator.adaptive = true;
  scene.start.drum = DrumSpec{.radius = given.at("radius"), .inertia = given.at("inertia")};
  for (const bool told : {false, true}) {
    if (told) scene.start.drum->wound = 29;
    const RunResult run = completed(scene);
    EXPECT_NEAR(run.samples.back().winches[0]->length, given.at("paid_out").get<double>(), 5e-4);
    EXPECT_LE(energy_ledger(run).largest_unexplained, 1e-4 * run.max_kinetic);
  }
  scene.start.drum->wound = 3;
  const RunResult empty = simulate(scene);
  EXPECT_FALSE(empty.failure.empty());
  EXPECT_NEAR(empty.samples.back().winches[0]->length, 3, 0.5);
  scene.start.drum->wound = 60;  // 30 kg, which the drum's 29.5 cannot have
  EXPECT_EQ(refused(scene), "/supports/at=start/drum/inertia");
}

// Of the library's winch in small units, which started from a joint's mass that was lost beside 1 kg.
TEST(WinchOutlet, KnowsNoUnits) {
  const double length = 0.01, mass = 1e-6, time = 0.1;
  Scene scene;
  scene.gravity_ramp = 0.2 * time;
  scene.beam.curve.end = {0.6 * length, -1.9 * length, 0};
  scene.beam.section = {.type = Section::Type::stiffness,
                        .EA = 1e5 * mass * length / (time * time),
                        .EI = 0,
                        .rhoA = 1e-4 * mass / length};
  scene.beam.elements = 10;
  scene.start.type = SupportType::pin;
  scene.start.feed = TimeSpec{.rate = -0.5 * length / time, .ramp = 0.5 * time};
  scene.point_masses = {{10, mass}};
  scene.duration = 0.5 * time;
  scene.integrator = automatic_integrator(scene);
  EXPECT_LT(completed(scene).samples.back().beam_length, 2 * length);
}

template <int D>
void expect_a_sound_outlet(const Scene& scene, unsigned seed) {
  constexpr double now = 0.13;
  BeamSystem<D> system(build_model<D>(scene), build_chain<D>(scene));
  Eigen::VectorXd y = system.initial_state();
  const Eigen::Index n = system.coordinates();
  Random random(seed);
  for (Eigen::Index i = 0; i < 2 * n; ++i) y[i] += random.uniform(-0.05, 0.05);
  y.segment<D>(0).setZero();  // the pin
  y.segment<D>(n).setZero();
  // the rate of the energy is what is booked
  Eigen::VectorXd along(y.size());
  system.rhs(y, along, now);
  const EnergyBalance booked = system.model().balance().of(along);
  const double rate = slope_of([&](double s) {
    return Eigen::VectorXd::Constant(1, system.observe(y + s * along, now, own_points).energy.total());
  })[0];
  EXPECT_NEAR(rate, booked.loads, 1e-7 * (1 + std::abs(booked.loads)));
  EXPECT_GT(booked.dissipated, 0);
  // along (d, by.v d, by.a d) the solve with the tangent undoes the residual's change
  auto& implicit = *system.second_order();
  const TangentWeights by{1, 7, 300};
  Eigen::VectorXd q, v;
  implicit.expand(y, q, v);
  Eigen::VectorXd r(q.size());
  const Eigen::VectorXd a = Eigen::VectorXd::NullaryExpr(q.size(), [&] { return random.uniform(-3, 3); });
  Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(q.size(), [&] { return random.uniform(-1, 1); });
  ASSERT_TRUE(implicit.linearize(q, v, a, now, by));
  implicit.residual(q, v, a + d, now, r);
  implicit.solve(r);
  d = r / r.norm();
  Eigen::VectorXd change = slope_of([&](double s) {
    implicit.residual(q + s * d, v + s * by.v * d, a + s * by.a * d, now, r);
    return r;
  });
  implicit.solve(change);
  EXPECT_LE((change - d).norm(), 1e-6);
}

TEST(WinchOutlet, BooksItsPowerAndHasAnExactTangent) {
  unsigned seed = 3;
  for (const auto law : {StrainLaw::green, StrainLaw::engineering}) {
    for (const auto winding : {Winding::stretched, Winding::unstretched}) {
      for (const bool drum : {false, true}) {
        SCOPED_TRACE(testing::Message() << "drum " << drum << " law " << static_cast<int>(law));
        Scene scene;
        scene.beam.section = {.type = Section::Type::stiffness, .EA = 50, .EI = 0, .rhoA = 1};
        scene.beam.strain_law = law;
        scene.beam.curve.end = {3, 0, 0};
        scene.beam.elements = 3;
        scene.start.type = SupportType::pin;
        scene.start.winding = winding;
        if (drum) scene.start.drum = DrumSpec{.radius = 0.5, .inertia = 0.4, .torque = {.value = 0.7}, .wound = 1};
        if (!drum) scene.start.held_tension = TimeSpec{.value = 4};
        scene.start.end_stop = EndStopSpec{.most = 0, .stiffness = 30, .depth = 0.2, .damping = 4};
        expect_a_sound_outlet<2>(scene, ++seed);
        scene.dimension = 3;
        expect_a_sound_outlet<3>(scene, ++seed);
      }
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
