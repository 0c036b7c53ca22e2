// Vehicles that come onto a beam and leave it, beside an independent program (reference/vehicles.py) and closed forms.
#include "scene/vehicles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/reference.hpp"

namespace vlbeam {
namespace {
namespace vehicles {

Scene bridge_of(const nlohmann::json& given, int elements) {
  const nlohmann::json reference = test::reference("vehicles.json");
  Scene scene;
  scene.gravity = {0, -reference.at("gravity").get<double>(), 0};
  scene.gravity_ramp = reference.at("gravity_ramp");
  scene.beam.curve.end = {given.at("length").get<double>(), 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 3e10, .EI = given.at("EI"), .rhoA = given.at("rhoA")};
  scene.beam.elements = elements;
  scene.beam.element = ElementKind::ale_ancf;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  if (!given.at("pier").is_null()) scene.bearings = {{.name = "pier", .x = given.at("pier")}};
  VehicleSpec& vehicle = scene.vehicles.emplace_back();
  vehicle.name = "train";
  vehicle.x = {.value = given.at("from"), .rate = given.at("speed")};
  for (const auto& axle : given.at("axles")) {
    vehicle.axles.push_back({axle.at("distance"), axle.at("force"), axle.at("mass"), axle.at("sprung_mass"),
                             axle.at("stiffness"), axle.at("damping")});
  }
  scene.places = {{.name = "there", .x = given.at("place")}};
  scene.integrator.type = IntegratorType::dopri5;
  scene.integrator.rtol = 1e-8;
  scene.integrator.atol = 1e-11;
  scene.duration = given.at("until");
  scene.output.interval = 0.1;
  return scene;
}

/// Largest errors over largest values: of the deflection, the push of the first axle and the height of its mass.
std::array<double, 3> errors(const nlohmann::json& given, const RunResult& run) {
  std::array<double, 3> off{}, size{};
  const auto& right = given.at("samples");
  EXPECT_EQ(run.samples.size(), right.size() + 1);
  for (std::size_t i = 0; i < right.size() && i + 1 < run.samples.size(); ++i) {
    const SectionSample& seen = *run.samples[i + 1].sections;
    const AxleSample& axle = seen.axles.front();
    EXPECT_EQ(axle.force.has_value(), !right[i][1].is_null()) << run.samples[i + 1].t;
    const std::array<double, 3> values{seen.places[0]->position[1], axle.force.value_or(0), axle.height};
    for (std::size_t k = 0; k < 3; ++k) {
      if (right[i][k].is_null()) continue;
      off[k] = std::max(off[k], std::abs(values[k] - right[i][k].get<double>()));
      size[k] = std::max(size[k], std::abs(right[i][k].get<double>()));
    }
  }
  for (std::size_t k = 0; k < 3; ++k) off[k] /= size[k];
  return off;
}

TEST(Vehicles, CrossABridgeAsAnotherProgramSays) {
  const nlohmann::json reference = test::reference("vehicles.json");
  for (const auto& given : reference.at("cases")) {
    const Scene scene = bridge_of(given, given.at("pier").is_null() ? 16 : 22);
    const RunResult run = simulate(scene);
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    const std::array<double, 3> off = errors(given, run);
    EXPECT_LT(off[0], 1e-4) << given.at("name");
    EXPECT_LT(off[1], 4e-3) << given.at("name");  // a wheel's inertia: its acceleration jumps from element to element
    EXPECT_LT(off[2], 1e-4) << given.at("name");
    const double work = std::abs(run.samples.back().flow->ledger.loads) + run.max_kinetic;
    EXPECT_LT(run.max_energy_drift, 1e-9 * work) << given.at("name");
  }
}

TEST(Vehicles, CrossItByAnImplicitMethodToo) {
  const nlohmann::json reference = test::reference("vehicles.json");
  for (const auto& given : reference.at("cases")) {
    Scene scene = bridge_of(given, given.at("pier").is_null() ? 16 : 22);
    scene.integrator = {};
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 2e-4;
    const RunResult implicitly = simulate(scene);
    ASSERT_EQ(implicitly.status, RunStatus::completed) << implicitly.failure;
    const std::array<double, 3> off = errors(given, implicitly);
    EXPECT_LT(off[0], 5e-5) << given.at("name");
    EXPECT_LT(off[2], 1e-4) << given.at("name");
    EXPECT_LT(implicitly.max_energy_drift, 1e-3 * std::abs(implicitly.samples.back().flow->ledger.loads));
    EXPECT_LT(implicitly.solver.newton.iterations, 4 * implicitly.solver.steps) << "the tangent is exact";
  }
}

/// A force is a force, whichever key has it.
TEST(Vehicles, AnAxleWithAForceAloneIsALoadThatTravels) {
  const auto given = test::reference("vehicles.json").at("cases")[0];
  Scene scene = bridge_of(given, 12);
  scene.gravity = {0, 0, 0};
  scene.vehicles[0].axles = {{.force = 100}};
  const RunResult a = simulate(scene);
  LoadSpec load;
  load.at = LoadPlace::point;
  load.x = scene.vehicles[0].x;
  load.magnitude.value = 100;
  load.direction = {0, -1, 0};
  scene.vehicles.clear();
  scene.loads = {load};
  const RunResult b = simulate(scene);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_NEAR(a.samples[i].sections->places[0]->position[1], b.samples[i].sections->places[0]->position[1], 1e-12);
  }
}

/// A wheel that stands still is a point mass, along gravity.
TEST(Vehicles, AWheelThatStandsIsAMassOnTheBeam) {
  const auto given = test::reference("vehicles.json").at("cases")[0];
  Scene scene = bridge_of(given, 8);
  scene.beam.section.EA = 1e9;
  scene.vehicles[0].x = {.value = 7.5};
  scene.vehicles[0].axles = {{.mass = 3000}};
  const RunResult a = simulate(scene);
  scene.vehicles.clear();
  scene.point_masses = {{.node = 3, .mass = 3000}};
  const RunResult b = simulate(scene);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const double right = b.samples[i].sections->places[0]->position[1];
    EXPECT_NEAR(a.samples[i].sections->places[0]->position[1], right, 1e-7 * std::abs(right) + 1e-12);
  }
}

TEST(Vehicles, ADrivenMassMayMeetATrain) {
  const auto given = test::reference("vehicles.json").at("cases")[2];
  Scene scene = bridge_of(given, 22);
  SlidingJointSpec& trolley = scene.sliding_joints.emplace_back();
  trolley.mass = 500;
  trolley.position = 14;
  trolley.x = TimeSpec{.rate = -4, .rate_ramp = 0.2};
  scene.vehicles[0].axles[0].mass = 300;
  const RunResult a = simulate(scene);
  ASSERT_EQ(a.status, RunStatus::completed) << a.failure;
  EXPECT_LT(a.max_energy_drift, 1e-8 * (std::abs(a.samples.back().flow->ledger.loads) + 1));
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 1e-4;
  const RunResult b = simulate(scene);
  ASSERT_EQ(b.status, RunStatus::completed) << b.failure;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_NEAR(a.samples[i].sections->axles[0].height, b.samples[i].sections->axles[0].height, 3e-8) << a.samples[i].t;
  }
}

TEST(Vehicles, AWheelThatWouldLiftOffIsToldOf) {
  const auto given = test::reference("vehicles.json").at("cases")[0];
  Scene scene = bridge_of(given, 12);
  scene.vehicles[0].axles = {{.force = -50, .mass = 10}};
  const RunResult run = simulate(scene);
  ASSERT_FALSE(run.warnings.empty());
  EXPECT_EQ(run.warnings.back().kind, WarningKind::lifting_wheel);
}

TEST(Vehicles, AreRefusedWhereTheyCannotBe) {
  const auto refused = [](const Scene& scene) {
    try {
      simulate(scene);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string("nothing");
  };
  const Scene right = bridge_of(test::reference("vehicles.json").at("cases")[0], 12);
  Scene scene = right;
  scene.vehicles.push_back(scene.vehicles[0]);
  EXPECT_EQ(refused(scene), "/vehicles/1/name");
  scene = right;
  scene.vehicles[0].axles[0].stiffness = 0;
  EXPECT_EQ(refused(scene), "/vehicles/0/axles/0/stiffness");
  scene = right;
  scene.vehicles[0].axles[0].sprung_mass = 0;
  scene.vehicles[0].axles[0].force = 5;
  EXPECT_EQ(refused(scene), "/vehicles/0/axles/0/sprung_mass");
  scene = right;
  scene.vehicles[0].axles = {{}};
  EXPECT_EQ(refused(scene), "/vehicles/0/axles/0");
  scene = right;
  scene.vehicles[0].axles.clear();
  EXPECT_EQ(refused(scene), "/vehicles/0/axles");
  scene = right;
  scene.vehicles[0].x.value = -1000;
  EXPECT_EQ(refused(scene), "/vehicles/0/x");
  scene = right;
  scene.analysis = Analysis::statics;
  EXPECT_EQ(refused(scene), "/analysis");
  scene = right;
  scene.integrator.type = IntegratorType::rosenbrock4;
  EXPECT_EQ(refused(scene), "/integrator/type");
}

}  // namespace vehicles
}  // namespace
}  // namespace vlbeam
