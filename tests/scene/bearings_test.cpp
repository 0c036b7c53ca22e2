// Supports of points between the ends: rollers and pins that joints pass over, springs, hangers.
#include "scene/bearings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/reference.hpp"

namespace vlbeam {
namespace {
namespace bearings {

constexpr double L = 10, EI = 2e6, EA = 1e9, rhoA = 100, g = 1e-3;

/// A beam of two equal spans under its weight, so small that it is a linear one.
Scene two_spans(BearingType type = BearingType::roller) {
  Scene scene;
  scene.gravity = {0, -g, 0};
  scene.beam.curve.end = {2 * L, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = EI, .rhoA = rhoA};
  scene.beam.elements = 16;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.bearings = {{.x = L, .type = type}};
  scene.places = {{.name = "pier", .x = L}};
  scene.analysis = Analysis::statics;
  return scene;
}

double reaction_of(const RunResult& run) { return run.samples.back().sections->bearings.at(0).force[1]; }

TEST(Bearings, ARollerBearsFiveQuartersOfASpan) {
  for (const BearingType type : {BearingType::roller, BearingType::pin}) {
    const RunResult run = simulate(two_spans(type));
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    EXPECT_NEAR(reaction_of(run), 1.25 * rhoA * g * L, 1e-6 * rhoA * g * L);
    EXPECT_NEAR(run.samples.back().sections->moment->least, -rhoA * g * L * L / 8, 1e-6 * rhoA * g * L * L);
    EXPECT_NEAR(run.samples.back().sections->moment->at_least, L, 1e-12);
    EXPECT_NEAR(run.samples.back().sections->bearings[0].position[1], 0, 1e-14 * L);
    EXPECT_EQ(run.samples.back().equilibrium->negative_pivots, 0);
  }
}

TEST(Bearings, FrequenciesOfTwoSpansAreThoseOfBothKinds) {
  Scene scene = two_spans();
  scene.statics.frequencies = 2;
  const RunResult run = simulate(scene);
  const double unit = std::sqrt(EI / rhoA) / (2 * std::numbers::pi * L * L), clamped = 3.926602312047919;
  ASSERT_EQ(run.frequencies.size(), 2U);
  // of eight cubic elements a span: (pi/8)^4/1440 of it too large, as of any mode by its own half waves
  EXPECT_NEAR(run.frequencies[0], std::numbers::pi * std::numbers::pi * unit, 2e-4 * unit);  // of a span that is pinned
  EXPECT_NEAR(run.frequencies[1], clamped * clamped * unit, 4e-3 * unit);  // and of one whose inner end is clamped
}

TEST(Bearings, HoldABeamThatNothingElseHolds) {
  Scene scene = two_spans(BearingType::pin);
  scene.start.type = scene.end.type = SupportType::free;
  scene.bearings = {{.x = 0.4 * L, .type = BearingType::pin}, {.x = 1.6 * L}};
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  for (const BearingSample& bearing : run.samples.back().sections->bearings) {
    EXPECT_NEAR(bearing.force[1], rhoA * g * L, 1e-6 * rhoA * g * L);
  }
  // w = rho g x^2/2 over the ends, and what the middle has less
  const double middle = rhoA * g * (0.6 * L * 0.6 * L - 0.4 * L * 0.4 * L) / 2;
  scene.places[0].x = L;
  EXPECT_NEAR(simulate(scene).samples.back().sections->places[0]->force.moment, middle, 2e-5 * rhoA * g * L * L);
}

TEST(Bearings, ASpringGivesWayByItsForce) {
  Scene scene = two_spans(BearingType::spring);
  const double alone = 5 * rhoA * g * std::pow(2 * L, 4) / (384 * EI), soft = std::pow(2 * L, 3) / (48 * EI);
  for (const double stiffness : {1e3, 1e5}) {
    for (const Point& direction : {Point{}, Point{0, 1, 0}}) {
      scene.bearings = {{.x = L, .type = BearingType::spring, .stiffness = stiffness, .direction = direction}};
      const double force = alone / (soft + 1 / stiffness);
      EXPECT_NEAR(reaction_of(simulate(scene)), force, 2e-6 * force) << stiffness;
    }
    // a hanger that pulls, and one under the beam that would have to push
    scene.bearings = {
        {.x = L, .type = BearingType::spring, .stiffness = stiffness, .to = Point{L, 3, 0}, .tension_only = true}};
    EXPECT_NEAR(reaction_of(simulate(scene)), alone / (soft + 1 / stiffness), 1e-4 * alone / soft) << stiffness;
    scene.bearings[0].to = Point{L, -3, 0};
    EXPECT_EQ(reaction_of(simulate(scene)), 0) << stiffness;
  }
}

TEST(Bearings, ASpringMayStandAtAnEnd) {
  Scene scene = two_spans(BearingType::spring);
  scene.end.type = SupportType::free;
  scene.bearings = {{.x = 2 * L, .type = BearingType::spring, .stiffness = 1e3, .direction = {0, 1, 0}}};
  scene.places[0].x = 2 * L;
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  EXPECT_NEAR(reaction_of(run), rhoA * g * L, 1e-5 * rhoA * g * L);
  EXPECT_NEAR(run.samples.back().end[1], -rhoA * g * L / 1e3, 1e-5 * rhoA * g * L / 1e3);
}

/// A mass that slides over a roller, a pin and a spring.
Scene sliding(IntegratorType type, int dimension) {
  Scene scene;
  scene.dimension = dimension;
  scene.gravity = dimension == 2 ? Point{0, -9.81, 0} : Point{0, 0, -9.81};
  scene.gravity_ramp = 0.1;
  scene.beam.curve.end = {4, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 2e5, .EI = 2000, .rhoA = 5};
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  SlidingMassSpec& mass = scene.sliding_mass.emplace();
  mass.mass = 3;
  mass.position = 0.5;
  mass.velocity = 5;
  scene.bearings = {{.name = "first", .x = 1.5},
                    {.name = "second", .x = 2.2, .type = BearingType::spring, .stiffness = 2e4, .damping = 20},
                    {.name = "third", .x = 2.7, .type = BearingType::pin}};
  scene.integrator.type = type;
  scene.integrator.rtol = scene.integrator.atol = 1e-8;
  scene.integrator.step = 5e-4;
  scene.duration = 0.6;
  scene.output.interval = 0.02;
  return scene;
}

TEST(Bearings, AMassPassesThemAndNothingIsLost) {
  for (const int dimension : {2, 3}) {
    for (const IntegratorType type : {IntegratorType::dopri5, IntegratorType::generalized_alpha}) {
      const Scene scene = sliding(type, dimension);
      const RunResult run = simulate(scene);
      ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
      EXPECT_GT(*run.samples.back().joint_position, 3.2);
      const double motion = run.max_kinetic;
      EXPECT_LT(run.max_energy_drift, (type == IntegratorType::dopri5 ? 2e-8 : 1e-4) * motion);
      const auto up = static_cast<std::size_t>(dimension - 1);
      for (const Sample& sample : run.samples) {
        for (const std::size_t held : {0U, 2U}) {
          EXPECT_NEAR(sample.sections->bearings[held].position[up], 0, 1e-9) << sample.t;
        }
        EXPECT_NEAR(sample.sections->bearings[2].position[0], 2.7, 1e-9) << sample.t;
      }
    }
  }
}

TEST(Bearings, ASpringWithoutADamperTakesNothing) {
  Scene scene = sliding(IntegratorType::dopri5, 2);
  scene.bearings[1].damping = 0;
  for (const Point& direction : {Point{}, Point{0, 1, 0}}) {
    scene.bearings[1].direction = direction;
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    EXPECT_NEAR(run.samples.back().energy.dissipated, 0, 1e-9 * run.max_kinetic);
    EXPECT_GT(std::abs(run.samples.back().flow->ledger.loads), 1e-6 * run.max_kinetic) << "it stores something";
  }
}

TEST(Bearings, ExplicitAndImplicitMotionsAgree) {
  const RunResult a = simulate(sliding(IntegratorType::dopri5, 2));
  Scene scene = sliding(IntegratorType::generalized_alpha, 2);
  scene.integrator.step = 2.5e-5;  // waves of the elements beside the mass are followed
  const RunResult b = simulate(scene);
  scene.constraints = Constraints::multipliers;
  const RunResult c = simulate(scene);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_NEAR(*a.samples[i].joint_position, *b.samples[i].joint_position, 1e-5) << a.samples[i].t;
    EXPECT_NEAR(*c.samples[i].joint_position, *b.samples[i].joint_position, 1e-9) << a.samples[i].t;
  }
}

/// A beam of so many elements that a mass crosses by a pier: reference/bearings.py.
double error_of_crossing(int elements, double step) {
  const nlohmann::json reference = test::reference("bearings.json");
  const auto& bridge = reference.at("bridge");
  Scene scene;
  scene.gravity = {0, -bridge.at("gravity").get<double>(), 0};
  scene.gravity_ramp = bridge.at("gravity_ramp");
  scene.beam.curve.end = {bridge.at("length").get<double>(), 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 3e9, .EI = bridge.at("EI"), .rhoA = bridge.at("rhoA")};
  scene.beam.elements = elements;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.bearings = {{.name = "pier", .x = bridge.at("pier")}};
  SlidingJointSpec& mass = scene.sliding_joints.emplace_back();
  mass.mass = bridge.at("mass");
  mass.position = bridge.at("from");
  mass.x = TimeSpec{.rate = bridge.at("speed")};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = step;
  scene.duration = 1;
  scene.output.interval = 0.02;
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
  double error = 0;
  for (const auto& sample : reference.at("samples")) {
    const double t = sample.at("t");
    for (const Sample& seen : run.samples) {
      if (std::abs(seen.t - t) > 1e-9) continue;
      error = std::max(error, std::abs((*seen.mass_position)[1] - sample.at("deflection").get<double>()));
    }
  }
  return error / reference.at("largest_deflection").get<double>();
}

TEST(Bearings, AMassCrossesAPierAsAnotherProgramSays) {
  EXPECT_LT(error_of_crossing(22, 2e-4), 3e-4);
  EXPECT_LT(error_of_crossing(44, 1e-4), 1e-5);
}

TEST(Bearings, AreRefusedWhereTheyCannotBe) {
  const auto refused = [](Scene scene) {
    try {
      simulate(scene);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string("nothing");
  };
  Scene scene = two_spans();
  scene.bearings[0].x = 2 * L;
  EXPECT_EQ(refused(scene), "/bearings/0/at/x");
  scene = two_spans();
  scene.bearings.push_back({.name = "0", .x = 3});
  EXPECT_EQ(refused(scene), "/bearings/1/name");
  scene = two_spans(BearingType::spring);
  EXPECT_EQ(refused(scene), "/bearings/0/stiffness");
  scene.bearings[0].stiffness = 1;
  scene.bearings[0].to = Point{L, 0, 0};
  EXPECT_EQ(refused(scene), "/bearings/0/to");
  scene.bearings[0].to.reset();
  scene.bearings[0].tension_only = true;
  EXPECT_EQ(refused(scene), "/bearings/0/tension_only");
  scene = sliding(IntegratorType::dopri5, 2);
  scene.sliding_mass->friction = AxialFriction{0.1, 1e-2};
  EXPECT_EQ(refused(scene), "/sliding_mass/friction");
  scene = sliding(IntegratorType::dopri5, 2);
  scene.sliding_mass->slopes = JointSlopes::free;
  EXPECT_EQ(refused(scene), "/sliding_mass/slopes");
  scene = sliding(IntegratorType::rosenbrock4, 2);
  EXPECT_EQ(refused(scene), "/bearings/0/type");
}

}  // namespace bearings
}  // namespace
}  // namespace vlbeam
