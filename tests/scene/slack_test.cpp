// Ropes that bear no compression, and what stops a winch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/energy_ledger.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double earth_g = 9.81;

/// A weight at the end of a rope that hangs in a bight from its support: it falls 2 m freely, then the rope is taut.
Scene dropped(double EA) {
  Scene scene;
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = {{0, 0, 0}, {0.01, -1, 0}, {0.02, 0, 0}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0, .rhoA = 1e-5};
  scene.beam.strain_law = StrainLaw::engineering;
  scene.beam.compression = Compression::none;
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.point_masses = {{8, 1}};
  scene.duration = 0.7;
  scene.output.interval = 1e-3;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.rtol = 1e-5;
  scene.integrator.atol = 1e-5;
  return scene;
}

// m g (h + u) = EA u^2/(2 L): the pull of a rope without mass as it stops the weight. It is that of the whole rope's
// stretch u, for at the support the rope's own waves come on top, as the snap happens to leave them.
TEST(Slack, ASnapLoadIsThatOfTheEnergyOfTheFall) {
  const double EA = 2000, L = 2 * std::hypot(0.01, 1);
  const RunResult run = test::completed(dropped(EA));
  double most = 0;
  for (const Sample& sample : run.samples) most = std::max(most, EA * (-sample.end[1] - L) / L);
  const double k = EA / L, fall = L, peak = earth_g + std::sqrt(earth_g * earth_g + 2 * k * earth_g * fall);
  EXPECT_NEAR(most, peak, 0.005 * peak);
  const auto taut = std::ranges::find_if(run.samples, [&](const Sample& s) { return s.end[1] < -L; });
  ASSERT_NE(taut, run.samples.end());
  EXPECT_NEAR(taut->t, std::sqrt(2 * L / earth_g), 3e-3);
  for (auto sample = run.samples.begin(); sample != taut; ++sample) {
    EXPECT_NEAR(sample->end[1], -earth_g / 2 * sample->t * sample->t, 5e-3) << "it falls freely until then";
  }
  EXPECT_LE(run.max_energy_drift, 1e-2 * run.max_kinetic);
}

// A rope that is pressed together pushes at nothing; one that bears compression does.
TEST(Slack, BearsNoCompression) {
  for (const bool slackens : {true, false}) {
    Scene scene = test::at_rest(4, 1000, 0);
    scene.analysis = Analysis::dynamics;
    scene.beam.compression = slackens ? Compression::none : Compression::full;
    scene.start.type = scene.end.type = SupportType::pin;
    scene.end.motion = SupportMotionSpec{{-1, 0, 0}, {.value = 0.01, .ramp = 0.5}, {}};
    scene.duration = 1;
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 2e-3;
    const RunResult run = test::completed(scene);
    const double push = std::abs(run.samples.back().reactions[1].position[0]);
    if (slackens) {
      EXPECT_LE(push, 1e-3);
    } else {
      EXPECT_NEAR(push, 10, 1);
    }
  }
}

// Explicit and implicit methods, elements at joints, at rest and in packs: one motion, whose energy is kept.
TEST(Slack, KeepsItsEnergyByEveryMethod) {
  Scene scene;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 500, .EI = 0, .rhoA = 1};
  scene.beam.compression = Compression::none;
  scene.beam.slack_over = 0.01;
  scene.beam.elements = 6;
  scene.beam.curve.end = {1, 0.4, 0};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.sliding_mass.emplace();
  scene.sliding_mass->mass = 0.5;
  scene.sliding_mass->position = 0.35;
  scene.duration = 0.3;
  scene.output.interval = 0.01;
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  const RunResult run = test::completed(scene);
  EXPECT_LE(run.max_energy_drift, 1e-7 * run.max_kinetic);
  Scene implicit = scene;
  implicit.integrator = IntegratorSpec{.type = IntegratorType::generalized_alpha, .step = 1e-4, .rho_inf = 1};
  const RunResult other = test::completed(implicit);
  EXPECT_NEAR(*run.samples.back().joint_position, *other.samples.back().joint_position, 1e-5);
  double least = 1;
  for (const Sample& sample : run.samples) least = std::min(least, sample.strains.axial_strain[0]);
  EXPECT_LT(least, -1e-3) << "somewhere it goes slack";
}

/// A weight on a drum that turns freely.
Scene on_a_drum() {
  Scene scene;
  scene.beam.curve.end = {0, -2, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 0, .rhoA = 1e-3};
  scene.beam.elements = 4;
  scene.start.type = SupportType::pin;
  scene.start.drum = DrumSpec{.radius = 0.2, .inertia = 0.04};
  scene.point_masses = {{4, 2}};
  scene.initial_shape = InitialShape::equilibrium;
  scene.duration = 1.2;
  scene.output.interval = 0.01;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.rtol = 1e-8;
  scene.integrator.atol = 1e-7;
  return scene;
}

// (m + I/r^2) v^2/2 = m g L is what the spring takes up: k S(d), S of the depth beyond the stop.
TEST(EndStop, StopsADrumByItsSpring) {
  Scene scene = on_a_drum();
  scene.start.end_stop = EndStopSpec{.most = 0.5, .stiffness = 2000, .depth = 0.02};
  const RunResult run = test::completed(scene);
  double most = 0;
  for (const Sample& sample : run.samples) most = std::max(most, sample.winches[0]->length);
  double beyond = 0;  // m g (0.5 + u) = k (u - d/2)^2/2 + k d^2/24
  for (int i = 0; i < 100; ++i) {
    const double energy = 2 * earth_g * (0.5 + beyond) - 2000 * 0.02 * 0.02 / 24;
    beyond = 0.01 + std::sqrt(2 * energy / 2000);
  }
  EXPECT_NEAR(most, 0.5 + beyond, 2e-3);
  EXPECT_LE(run.max_energy_drift, 1e-4 * run.max_kinetic);
  EXPECT_LE(energy_ledger(run).largest_unexplained, 1e-3 * run.max_kinetic);
}

TEST(EndStop, LosesToItsDamperWhatTheLedgerSays) {
  Scene scene = on_a_drum();
  scene.start.end_stop = EndStopSpec{.most = 0.3, .stiffness = 5000, .depth = 0.02, .damping = 150};
  scene.duration = 4;
  const RunResult run = test::completed(scene);
  const Sample& last = run.samples.back();
  EXPECT_NEAR(last.winches[0]->length, 0.3 + std::sqrt(2 * 0.02 * 2 * earth_g / 5000), 1e-4) << "it hangs on the stop";
  EXPECT_NEAR(last.winches[0]->rate, 0, 1e-2);
  EXPECT_GT(last.energy.dissipated, 0.5 * 2 * earth_g * 0.3);
  EXPECT_LE(run.max_energy_drift, 1e-3 * run.max_kinetic);
}

// Its push is that of a spring that only pushes, on either side, by the method's own derivative, too.
TEST(EndStop, StopsOnEitherSideByEveryMethod) {
  Scene scene = on_a_drum();
  scene.beam.section.EA = 5000;
  scene.beam.section.rhoA = 0.5;
  scene.beam.compression = Compression::full;
  scene.start.drum->torque = {.value = -8};  // against 4 N m of the weight
  scene.start.end_stop = EndStopSpec{.least = -0.1, .most = 3, .stiffness = 3000, .depth = 0.01, .damping = 20};
  scene.initial_shape = InitialShape::built;
  scene.duration = 0.6;
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
  const RunResult run = test::completed(scene);
  EXPECT_LE(run.max_energy_drift, 1e-7 * run.max_kinetic);
  Scene implicit = scene;
  implicit.integrator = IntegratorSpec{.type = IntegratorType::generalized_alpha, .step = 1e-4, .rho_inf = 1};
  const RunResult other = test::completed(implicit);
  EXPECT_NEAR(run.samples.back().winches[0]->length, other.samples.back().winches[0]->length, 1e-5);
  double least = 0;
  for (const Sample& sample : run.samples) least = std::min(least, sample.winches[0]->length);
  EXPECT_LT(least, -0.1);
  EXPECT_GT(least, -0.2);
}

// At an even rate a winch pulls with the weight, and gives it the power m g v; faster, it takes m (g + a).
TEST(Winch, TellsItsTensionAndItsPower) {
  Scene scene = on_a_drum();
  scene.start.drum.reset();
  scene.start.feed = TimeSpec{.rate = -0.5, .rate_ramp = 0.5};
  const RunResult run = test::completed(scene);
  const WinchSample& even = *run.samples.back().winches[0];
  EXPECT_NEAR(even.tension, 2 * earth_g, 0.05);
  EXPECT_NEAR(even.power, 2 * earth_g * 0.5, 0.03);
  EXPECT_NEAR(even.rate, -0.5, 1e-12);
  EXPECT_NEAR(even.length, -0.5 * (1.2 - 0.25), 1e-9);
  const auto rising = std::ranges::find_if(run.samples, [](const Sample& s) { return s.t > 0.2499; });
  EXPECT_NEAR(rising->winches[0]->tension, 2 * (earth_g + 0.5 / 0.5 * 140.0 / 64), 0.1);
  // over the run it is the work done
  double work = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    work += 0.01 * (run.samples[i].winches[0]->power + run.samples[i - 1].winches[0]->power) / 2;
  }
  const Sample &first = run.samples.front(), &last = run.samples.back();
  const double gain = last.energy.total() - first.energy.total();
  EXPECT_NEAR(work, gain, 0.01 * gain + 1e-3 * earth_g);
}

// What comes in is as fast as the rope outside: the winch pulls with the weight that hangs there, however fast it is.
TEST(Winch, PullsWithTheWeightOfTheRopeToo) {
  Scene scene = on_a_drum();
  scene.beam.section.rhoA = 0.8;
  scene.start.drum.reset();
  scene.beam.material.damping = 0.002;
  scene.start.feed = TimeSpec{.rate = 1, .rate_ramp = 0.4};
  const RunResult run = test::completed(scene);
  const WinchSample& paid = *run.samples.back().winches[0];
  EXPECT_NEAR(paid.tension, (2 + 0.8 * (2 + paid.length)) * earth_g, 0.02);
}

TEST(Winch, ADrumPullsWithItsMotorAndItsInertia) {
  Scene scene = on_a_drum();
  scene.start.drum->torque = {.value = -1};
  scene.beam.material.damping = 0.002;
  const RunResult run = test::completed(scene);
  const double a = (2 * earth_g - 5) / 3;
  EXPECT_NEAR(run.samples.back().winches[0]->tension, 5 + a, 0.05);
}

}  // namespace
}  // namespace vlbeam
