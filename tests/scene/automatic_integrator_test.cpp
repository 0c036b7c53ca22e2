#include "scene/automatic_integrator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/wire.hpp"

namespace vlbeam::test {
namespace {

double largest_difference(const RunResult& a, const RunResult& b) {
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i) {
    for (std::size_t c = 0; c < 2; ++c) {
      largest = std::max(largest, std::abs(a.samples[i].end[c] - b.samples[i].end[c]));
    }
    if (a.samples[i].joint_position && b.samples[i].joint_position) {
      largest = std::max(largest, std::abs(*a.samples[i].joint_position - *b.samples[i].joint_position));
    }
  }
  return largest;
}

TEST(AutomaticIntegrator, TakesTheMethodThatCostsLess) {
  const IntegratorSpec implicit = automatic_integrator(wire(steel));
  EXPECT_EQ(implicit.type, IntegratorType::generalized_alpha);
  EXPECT_TRUE(implicit.adaptive && implicit.automatic && implicit.atol_by_kind);
  EXPECT_FALSE(implicit.reason.empty());
  EXPECT_EQ(automatic_integrator(wire(rubber), 1e-9).type, IntegratorType::dopri5);
  EXPECT_EQ(automatic_integrator(wire(steel), 1e-6).type, IntegratorType::generalized_alpha);
}

TEST(AutomaticIntegrator, TakesWhatTheSceneAllows) {
  Scene scene = wire(rubber);
  ASSERT_EQ(automatic_integrator(scene, 1e-9).type, IntegratorType::dopri5);
  scene.constraints = Constraints::multipliers;  // dopri5 does not know them
  EXPECT_EQ(automatic_integrator(scene, 1e-9).type, IntegratorType::generalized_alpha);
  scene.beam.elements = -1;
  EXPECT_THROW(automatic_integrator(scene), InvalidInput);
}

TEST(AutomaticIntegrator, ToleratesByTheBeamsLength) {
  const IntegratorSpec metres = automatic_integrator(wire(steel));
  Scene longer = wire(steel);
  longer.beam.curve.end = {1000, 0};
  longer.beam.elements = 10000;
  EXPECT_NEAR(automatic_integrator(longer).atol_by_kind->length, 1000 * metres.atol_by_kind->length, 1e-12);
}

// A weight on a rope that turns freely about a pin: its angle, not the waves in the rope, says how long steps may be.
TEST(AutomaticIntegrator, FollowsWhatTurnsFromTheStart) {
  Scene scene;
  scene.gravity = {};
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 2e5, .EI = 0, .rhoA = 0.005};
  scene.beam.material.damping = 0.002;
  scene.beam.elements = 4;
  scene.start.type = SupportType::pin;
  scene.point_masses = {{4, 10}};
  scene.initial_velocity = InitialVelocitySpec{.rotation = 2.5};
  scene.duration = 2 * 3.14159265358979 / 2.5;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed);
  // the pull stretches it by 6e-4: its angular momentum turns it more slowly by twice as much
  const double stretch = 10 * 2.5 * 2.5 * 2 / 2e5, behind = 2 * stretch * 2 * 3.14159265358979 * 2;
  const Sample& last = run.samples.back();
  EXPECT_NEAR(last.end[1], -behind, 1e-4 * 2);
}

// All lengths and times a thousand times as long: the choice must not see it.
TEST(AutomaticIntegrator, ChoosesAlikeInAllUnits) {
  for (const double modulus : {steel, rubber}) {
    Scene scene = wire(modulus);
    const IntegratorSpec here = automatic_integrator(scene);
    scene.beam.curve.end[0] *= 1000;
    scene.beam.section.radius *= 1000;
    scene.gravity[1] /= 1000;
    scene.duration *= 1000;
    scene.sliding_mass->position *= 1000;
    const IntegratorSpec there = automatic_integrator(scene);
    EXPECT_EQ(there.type, here.type);
    EXPECT_NEAR(there.step / here.step, 1000, 1e-6);
  }
}

// A scene, and the same to twice its end: the same steps up to there.
TEST(AutomaticIntegrator, DoesNotSeeTheDuration) {
  for (const double modulus : {steel, rubber}) {
    Scene scene = wire(modulus);
    scene.duration = 0.2;
    scene.integrator = automatic_integrator(scene);
    const RunResult once = simulate(scene);
    scene.duration = 0.4;
    scene.integrator = automatic_integrator(scene);
    const RunResult twice = simulate(scene);
    ASSERT_LT(once.samples.size(), twice.samples.size());
    EXPECT_LE(largest_difference(once, twice), 1e-10);
  }
}

// Its own weight, let go: vibrations of 72 Hz and 0.16 mm, 36 periods of them.
TEST(AutomaticIntegrator, FollowsSmallVibrationsOfAStiffCantilever) {
  for (const double radius : {0.05, 0.01}) {
    Scene scene = wire(steel);
    scene.sliding_mass.reset();
    scene.beam.section.radius = radius;
    scene.duration = 0.5;
    scene.integrator = automatic_integrator(scene, 1e-5);
    const RunResult chosen = simulate(scene);
    scene.integrator = {};
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 1e-5;
    const RunResult fine = simulate(scene);
    double largest = 0, error = 0;
    for (std::size_t i = 0; i < fine.samples.size(); ++i) {
      largest = std::max(largest, std::abs(fine.samples[i].end[1]));
      error = std::max(error, std::abs(fine.samples[i].end[1] - chosen.samples[i].end[1]));
    }
    EXPECT_LE(error, 0.02 * largest) << radius;
  }
}

// A stiff rod that turns about its end: it goes round and round, and what a turn errs by adds up.
TEST(AutomaticIntegrator, KeepsItsAccuracyOverManyTurns) {
  Scene scene;
  scene.gravity = {};
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e7, .EI = 1e5, .rhoA = 1};
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.initial_velocity = InitialVelocitySpec{.rotation = 3};
  scene.output.interval = 0.1;
  scene.duration = 10;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed);
  // its mean stretch under the centrifugal force, from angular momentum: by 4/5 rho w^2 L^2/(EA) more slowly
  const double slower = 0.8 * 9 * 4 / 1e7;
  for (const Sample& sample : run.samples) {
    const double angle = 3 * (1 - slower) * sample.t;
    EXPECT_LE(std::hypot(sample.end[0] - 2 * std::cos(angle), sample.end[1] - 2 * std::sin(angle)), 2e-4) << sample.t;
  }
  EXPECT_LE(run.max_energy_drift, 1e-4 * 12);
}

// So stiff a rod that Newton's iteration can find it turned round: 3.8 m in a step of 9 ms, of which the filtered error
// leaves 1.5e-5 m. It swings under gravity; no energy comes from nowhere.
TEST(AutomaticIntegrator, TakesNoOtherSolutionOfAStepOfAVeryStiffRod) {
  Scene scene;
  scene.beam.curve.end = {6.707497783041732, -4.83759997214427, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 2.34e12, .EI = 1.91e10, .rhoA = 3.45};
  scene.beam.elements = 12;
  scene.start.type = SupportType::pin;
  scene.initial_velocity = InitialVelocitySpec{.rotation = -0.686};
  scene.output.interval = 0.004;
  scene.duration = 0.26;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  const double L = std::hypot(scene.beam.curve.end[0], scene.beam.curve.end[1]);
  for (const Sample& sample : run.samples) EXPECT_NEAR(std::hypot(sample.end[0], sample.end[1]), L, 1e-8 * L);
  EXPECT_LE(run.max_energy_drift, 1e-4 * run.max_kinetic);
}

// A rope of a tenth of a milligram a metre, which a winch begins to pull: it swings by 1e-7 m, at metres a second, and
// was followed in 320,000 steps of 1e-8 s, for nothing had moved yet. The weight's motion is that of a constant force.
TEST(AutomaticIntegrator, DoesNotFollowAJoltThatMovesNothing) {
  Scene scene;
  scene.beam.curve.end = {0, -2.76, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 2.97e8, .EI = 0, .rhoA = 1.1e-7};
  scene.beam.elements = 10;
  const double mass = 3.03, tension = 24.8, t = 0.3;
  scene.point_masses = {{10, mass}};
  scene.start.type = SupportType::pin;
  scene.start.held_tension = TimeSpec{.value = tension};
  scene.output.interval = scene.duration = t;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  EXPECT_LT(run.solver.steps, 20000U);
  const double falls = 0.5 * (-scene.gravity[1] - tension / mass) * t * t;
  EXPECT_NEAR(run.samples.back().end[1], -2.76 - falls, 1e-4 * 2.76);
}

// A steel rod let go from the horizontal: the physical pendulum, by steps of Runge and Kutta's method.
TEST(AutomaticIntegrator, KeepsItsAccuracyOverTheSwingsOfAStiffRod) {
  Scene scene;
  scene.beam.section.radius = 0.01;
  scene.beam.material = {.density = 7850, .youngs_modulus = 2.1e11};
  scene.beam.elements = 10;
  scene.start.type = SupportType::pin;
  scene.output.interval = 0.05;
  scene.duration = 5;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed);
  double angle = 0, rate = 0;
  const auto acceleration = [](double at) { return -1.5 * 9.81 * std::cos(at); };
  constexpr int steps = 200;  // a sample
  constexpr double h = 0.05 / steps;
  for (const Sample& sample : run.samples) {
    EXPECT_LE(std::hypot(sample.end[0] - std::cos(angle), sample.end[1] - std::sin(angle)), 2e-4) << sample.t;
    for (int i = 0; i < steps; ++i) {
      const double a1 = acceleration(angle), a2 = acceleration(angle + h / 2 * rate),
                   a3 = acceleration(angle + h / 2 * rate + h * h / 4 * a1),
                   a4 = acceleration(angle + h * rate + h * h / 2 * a2);
      angle += h * rate + h * h / 6 * (a1 + a2 + a3);
      rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
  }
}

// The duration is named where it is too long for any step, not a step that the scene does not have.
TEST(AutomaticIntegrator, NamesTheDurationWhereItIsTooLong) {
  Scene scene = wire(steel);
  scene.sliding_mass.reset();
  scene.gravity = {};
  scene.output.interval = 1e4;
  scene.duration = 1.5e6;
  EXPECT_NO_THROW(automatic_integrator(scene));
  scene.duration = 1e12;
  scene.output.interval = 1e10;
  try {
    scene.integrator = automatic_integrator(scene);
    simulate(scene);
    ADD_FAILURE() << "it is taken";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/duration");
  }
}

// What the accuracy promises, against a run that resolves everything.
TEST(AutomaticIntegrator, KeepsItsAccuracy) {
  Scene scene = wire(rubber);
  scene.duration = 0.4;
  scene.integrator = {};
  scene.integrator.rtol = scene.integrator.atol = 1e-11;
  const RunResult exact = simulate(scene);
  for (const double accuracy : {1e-3, 1e-4, 1e-6}) {
    scene.integrator = automatic_integrator(scene, accuracy);
    EXPECT_LE(largest_difference(simulate(scene), exact), 2 * accuracy);
  }
}

}  // namespace
}  // namespace vlbeam::test
