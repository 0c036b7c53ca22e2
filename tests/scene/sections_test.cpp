// Beams of several sections: against reference/sections.py, and against beams of one.
#include "scene/sections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "scene/simulate.hpp"
#include "scene/validate.hpp"
#include "tests/core/support/reference.hpp"

namespace vlbeam {
namespace {
namespace sections {

BeamPieceSpec piece(std::optional<double> to, double EA, double EI, double rhoA) {
  return {.to = to, .section = {.type = Section::Type::stiffness, .EA = EA, .EI = EI, .rhoA = rhoA}};
}

/// From the first of `pieces` on, each of which names its length, and stiffnesses where it has them.
std::vector<BeamPieceSpec> pieces_of(const nlohmann::json& pieces, double EA) {
  std::vector<BeamPieceSpec> result;
  double to = 0;
  for (const auto& of : pieces) {
    to += of.at("length").get<double>();
    result.push_back(piece(to, of.value("EA", EA), of.value("EI", 0.0), of.value("rhoA", 1e-9)));
  }
  result.back().to.reset();
  return result;
}

Scene beam(double length, int elements) {
  Scene scene;
  scene.gravity = {};
  scene.beam.curve.end = {length, 0, 0};
  scene.beam.elements = elements;
  scene.start.type = SupportType::clamp;
  scene.end.type = SupportType::free;
  scene.analysis = Analysis::statics;
  return scene;
}

/// A line of chain and polyester: error of its pull along the horizontal, of the place where they meet, and of the
/// tension on both sides of it, each over its size.
std::array<double, 3> errors_of_line(int elements, int dimension) {
  const nlohmann::json of = test::reference("sections.json").at("catenary");
  Scene scene = beam(100, elements);
  scene.dimension = dimension;
  const auto up = static_cast<std::size_t>(dimension - 1);
  scene.gravity[up] = -of.at("gravity").get<double>();
  scene.beam.sections = pieces_of(of.at("pieces"), 0);
  scene.start.type = scene.end.type = SupportType::pin;
  SupportMotionSpec& motion = scene.end.motion.emplace();
  motion.x = TimeSpec{.value = of.at("end")[0].get<double>() - 100};
  (dimension == 2 ? motion.y : motion.z) = TimeSpec{.value = of.at("end")[1]};
  scene.places = {{.name = "before", .x = 40 - 1e-6}, {.name = "behind", .x = 40 + 1e-6}, {.name = "there", .x = 40}};
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
  const Sample& last = run.samples.back();
  const double pull = of.at("horizontal"), tension = of.at("tension").at("change");
  const Point& place = last.sections->places[2]->position;
  return {std::abs(-last.reactions[0].position[0] / pull - 1),
          std::hypot(place[0] - of.at("meets")[0].get<double>(), place[up] - of.at("meets")[1].get<double>()) / 100,
          std::max(std::abs(last.sections->places[0]->force.axial / tension - 1),
                   std::abs(last.sections->places[1]->force.axial / tension - 1))};
}

TEST(Sections, ALineOfChainAndPolyesterHangsAsTwoCatenaries) {
  for (const int dimension : {2, 3}) {
    const auto coarse = errors_of_line(20, dimension), fine = errors_of_line(40, dimension),
               finest = errors_of_line(80, dimension);
    EXPECT_LT(finest[0], 1e-8);
    EXPECT_LT(finest[1], 1e-8);
    EXPECT_LT(fine[2], 2e-5);
    EXPECT_GT(std::log2(coarse[0] / fine[0]), 3.7);
    EXPECT_GT(std::log2(coarse[1] / fine[1]), 3.7);
  }
}

TEST(Sections, FrequenciesOfASteppedBeamAreThoseOfTheDeterminant) {
  const nlohmann::json of = test::reference("sections.json").at("frequencies");
  std::array<std::vector<double>, 2> error;
  for (const std::size_t mesh : {0U, 1U}) {
    Scene scene = beam(2, mesh == 0 ? 10 : 20);
    scene.beam.sections = pieces_of(of.at("pieces"), 1e7);
    scene.statics.frequencies = 4;
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.frequencies.size(), 4U) << run.failure;
    for (std::size_t i = 0; i < 4; ++i) {
      const double exact = of.at("angular_frequencies")[i].get<double>() / (2 * std::numbers::pi);
      error[mesh].push_back(std::abs(run.frequencies[i] / exact - 1));
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(error[1][i], 1e-4) << i;
    if (i == 0) continue;  // too little is left of it
    EXPECT_NEAR(std::log2(error[0][i] / error[1][i]), 4, 0.3) << i;
  }
}

/// Of the tip of a cantilever that is bent far.
double error_of_cantilever(const nlohmann::json& of, int elements) {
  Scene scene = beam(1, elements);
  scene.beam.sections = pieces_of(of.at("pieces"), 0);
  LoadSpec& load = scene.loads.emplace_back();
  load.node = elements;
  load.direction = {0, -1, 0};
  load.magnitude.value = of.at("load");
  scene.places = {{.name = "clamp", .x = 0}};
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
  EXPECT_NEAR(run.samples.back().sections->places[0]->force.moment, of.at("moment").get<double>(), 2e-3);
  const Point& end = run.samples.back().end;
  return std::hypot(end[0] - of.at("tip")[0].get<double>(), end[1] - of.at("tip")[1].get<double>());
}

TEST(Sections, ACantileverOfTwoStiffnessesBendsAsItsElasticas) {
  const nlohmann::json of = test::reference("sections.json").at("elasticas");
  const double coarse = error_of_cantilever(of[0], 20), fine = error_of_cantilever(of[0], 40);
  EXPECT_LT(fine, 1e-7);
  EXPECT_GT(std::log2(coarse / fine), 3.5);
  // EA jumps, too, and the stretch with it, by 2e-4; but a beam that bends has one slope at the change
  EXPECT_LT(error_of_cantilever(of[1], 40), 2.5e-7);
  EXPECT_LT(error_of_cantilever(of[1], 80), 1e-7);
}

/// A mass that crosses a bridge whose section changes in the middle: its deflection, of the largest.
double error_of_crossing(int elements, double step, IntegratorType type) {
  const nlohmann::json of = test::reference("sections.json").at("bridge");
  Scene scene = beam(of.at("length"), elements);
  scene.analysis = Analysis::dynamics;
  scene.gravity = {0, -of.at("gravity").get<double>(), 0};
  scene.gravity_ramp = of.at("gravity_ramp");
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.beam.sections = {piece(of.at("change").get<double>(), 3e9, of.at("EI")[0], of.at("rhoA")[0]),
                         piece({}, 2e9, of.at("EI")[1], of.at("rhoA")[1])};
  SlidingJointSpec& mass = scene.sliding_joints.emplace_back();
  mass.mass = of.at("mass");
  mass.position = of.at("from");
  mass.x = TimeSpec{.rate = of.at("speed")};
  scene.integrator.type = type;
  scene.integrator.step = step;
  scene.integrator.rtol = scene.integrator.atol = 1e-10;
  scene.duration = 0.6;
  scene.output.interval = 0.01;
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
  double error = 0;
  for (const auto& sample : of.at("samples")) {
    const double t = sample.at("t");
    const auto at = std::ranges::min_element(run.samples, {}, [t](const Sample& s) { return std::abs(s.t - t); });
    EXPECT_NEAR(at->t, t, 1e-9);
    error = std::max(error, std::abs((*at->mass_position)[1] - sample.at("deflection").get<double>()));
  }
  return error / of.at("largest_deflection").get<double>();
}

TEST(Sections, AMassPassesFromOneToTheNext) {
  const double coarse = error_of_crossing(16, 2.5e-4, IntegratorType::generalized_alpha),
               fine = error_of_crossing(32, 6e-5, IntegratorType::generalized_alpha);
  EXPECT_LT(coarse, 5e-4);
  EXPECT_LT(fine, 1e-4);
}

/// A bead that slides freely along a stepped cantilever, and passes the step.
Scene bead(int elements, int dimension) {
  Scene scene = beam(3, elements);
  scene.analysis = Analysis::dynamics;
  scene.dimension = dimension;
  scene.gravity[static_cast<std::size_t>(dimension - 1)] = -9.81;
  scene.beam.sections = {piece(1.5, 1e6, 400, 3), piece({}, 5e5, 60, 1)};
  SlidingMassSpec& mass = scene.sliding_mass.emplace();
  mass.mass = 2;
  mass.position = 1.3;
  mass.velocity = 2;
  scene.integrator = {.type = IntegratorType::dopri5, .rtol = 1e-9, .atol = 1e-9};
  scene.duration = 0.3;
  return scene;
}

TEST(Sections, ABeadPassesWithoutLoss) {
  std::array<double, 3> x{};
  for (const std::size_t mesh : {0U, 1U, 2U}) {
    const Scene scene = bead(8 << mesh, 2);
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    x[mesh] = *run.samples.back().joint_position;
    EXPECT_GT(x[mesh], 1.9);
    EXPECT_EQ(std::ranges::count(run.events, EventType::passage, &Event::type), 1);
    const Energy before = run.samples.front().energy, after = run.samples.back().energy;
    double events = 0;
    for (const Event& event : run.events)
      events +=
          event.energy_jump.kinetic + event.energy_jump.axial + event.energy_jump.bending + event.energy_jump.gravity;
    const auto total = [](const Energy& e) { return e.kinetic + e.axial + e.bending + e.gravity; };
    EXPECT_NEAR(total(after) - total(before), events, 1e-8 * run.max_kinetic) << "between events nothing is lost";
    EXPECT_LT(std::abs(events), (mesh == 0 ? 1e-3 : 1e-4) * run.max_kinetic);
  }
  EXPECT_NEAR(x[2], x[1], 1e-4);
  EXPECT_LT(std::abs(x[2] - x[1]), 0.7 * std::abs(x[1] - x[0]));
}

TEST(Sections, CutsAndMergesComeToAnEndWhereverItChanges) {
  for (const double to : {1.37, 1.45, 1.5, 1.6}) {
    Scene scene = bead(16, 2);
    scene.beam.sections[0].to = to;
    scene.beam.sections.insert(scene.beam.sections.begin() + 1, piece(to + 0.12, 8e5, 100, 2));
    scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 1e-3};
    for (const double speed : {2.0, -2.0}) {
      scene.sliding_mass->position = speed > 0 ? 1.2 : 1.9;
      scene.sliding_mass->velocity = speed;
      const RunResult run = simulate(scene);
      EXPECT_EQ(run.status, RunStatus::completed) << to << ' ' << speed << ' ' << run.failure;
      EXPECT_EQ(std::ranges::count(run.events, EventType::passage, &Event::type), 2);
      EXPECT_LT(run.events.size(), 40U);
      EXPECT_LT(run.max_energy_drift, 1e-2 * run.max_kinetic);
    }
  }
}

TEST(Sections, ImplicitAndExplicitMotionsAgreeAcrossAChange) {
  for (const int dimension : {2, 3}) {
    Scene scene = bead(12, dimension);
    const RunResult a = simulate(scene);
    scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 2e-5};
    const RunResult b = simulate(scene);
    ASSERT_EQ(b.status, RunStatus::completed) << b.failure;
    EXPECT_NEAR(*a.samples.back().joint_position, *b.samples.back().joint_position, 2e-5);
    EXPECT_LT(b.solver.newton.iterations, 4 * b.solver.steps) << "the tangent knows the change";
  }
}

TEST(Sections, PiecesOfOneSectionAreABeamOfOne) {
  for (const double EI : {0.0, 400.0}) {
    Scene one = bead(12, 2);
    if (EI == 0) {
      one.sliding_mass.reset();
      one.start.type = one.end.type = SupportType::pin;
      one.analysis = Analysis::statics;
    }
    Scene two = one;
    one.beam.sections.clear();
    one.beam.section = piece({}, 1e6, EI, 3).section;
    two.beam.sections = {piece(1.5, 1e6, EI, 3), piece({}, 1e6, EI, 3)};
    const RunResult a = simulate(one), b = simulate(two);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    EXPECT_NEAR(a.samples.back().energy.axial, b.samples.back().energy.axial,
                1e-6 * (1 + a.samples.back().energy.axial));
    if (EI == 0) continue;
    EXPECT_NEAR(*a.samples.back().joint_position, *b.samples.back().joint_position,
                2e-6);  // at the change points of the rule stand otherwise
  }
}

TEST(Sections, LoadsAlongBuoyancyAndDragKnowTheirPiece) {
  // a hanging line in water: what each piece weighs less
  Scene scene = beam(10, 10);
  scene.gravity = {0, -10, 0};
  scene.beam.curve.end = {0, -10, 0};
  scene.beam.sections = {piece(4, 1e6, 0, 3), piece({}, 2e6, 0, 5)};
  scene.beam.sections[0].area = 1e-3;
  scene.beam.sections[1].area = 2e-3;
  scene.fluid = FluidSpec{.density = 1000};
  scene.start.type = SupportType::pin;
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  EXPECT_NEAR(run.samples.back().reactions[0].position[1], 4 * (3 - 1) * 10 + 6 * (5 - 2) * 10, 1e-5);
  // and a load along all of it
  scene.fluid.reset();
  LoadSpec& load = scene.loads.emplace_back();
  load.at = LoadPlace::beam;
  load.direction = {0, -1, 0};
  load.magnitude.value = 7;
  EXPECT_NEAR(simulate(scene).samples.back().reactions[0].position[1], 4 * 30 + 6 * 50 + 70, 1e-5);
}

TEST(Sections, StressesAreThoseOfTheSectionThere) {
  Scene scene = beam(2, 8);
  scene.beam.material = {.name = MaterialName::steel};
  scene.beam.sections = {{.to = 1, .section = {.radius = 0.02}}, {.section = {.radius = 0.01}}};
  LoadSpec& load = scene.loads.emplace_back();
  load.node = 8;
  load.direction = {1, 0, 0};
  load.magnitude.value = 1000;
  scene.places = {{.name = "thick", .x = 0.5}, {.name = "thin", .x = 1.5}};
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  const auto& places = run.samples.back().sections->places;
  EXPECT_NEAR(places[0]->force.stress, 1000 / (std::numbers::pi * 4e-4), 1);
  EXPECT_NEAR(places[1]->force.stress, 1000 / (std::numbers::pi * 1e-4), 4);
}

TEST(Sections, WhatCannotBeIsRefusedByItsKey) {
  const auto refused = [](const Scene& scene) {
    try {
      validate(scene);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string();
  };
  Scene scene = beam(10, 10);
  scene.beam.sections = {piece(4, 1e6, 1, 3), piece({}, 2e6, 1, 5)};
  EXPECT_EQ(refused(scene), "");
  Scene wrong = scene;
  wrong.beam.sections[0].to.reset();
  EXPECT_EQ(refused(wrong), "/beam/sections/0/to");
  wrong = scene;
  wrong.beam.sections[0].to = 10;
  EXPECT_EQ(refused(wrong), "/beam/sections/0/to");
  wrong = scene;
  wrong.beam.sections[1].to = 11;
  EXPECT_EQ(refused(wrong), "/beam/sections/1/to");
  wrong = scene;
  wrong.beam.sections.insert(wrong.beam.sections.begin() + 1, piece(3, 1e6, 1, 1));
  EXPECT_EQ(refused(wrong), "/beam/sections/1/to");
  wrong = scene;
  wrong.beam.sections[1].section = {.type = Section::Type::tube, .radius = 0.1, .wall = 0.2};
  EXPECT_EQ(refused(wrong), "/beam/sections/1/section/wall");
  wrong = scene;
  wrong.fluid = FluidSpec{.density = 1000};
  EXPECT_EQ(refused(wrong), "/beam/sections/0/area");
  wrong = scene;
  wrong.beam.sections[1].section.EI = 0;
  EXPECT_EQ(refused(wrong), "");
  wrong.sliding_mass.emplace().position = 5;
  EXPECT_EQ(refused(wrong), "/beam/sections");
  wrong = scene;
  wrong.dimension = 3;
  wrong.beam.space_law = SpaceLaw::frames;
  EXPECT_EQ(refused(wrong), "/beam/sections");
}

}  // namespace sections
}  // namespace
}  // namespace vlbeam
