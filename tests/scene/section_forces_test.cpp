// Moments, shear, axial force, torque and stress along a beam and at places, angles and tensions at its ends, and their
// extremes over time, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "scene/sample_quantities.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double L = 10, EI = 1e7, P = 1000;

/// A girder on two supports, so stiff that it stays straight but for 1e-6.
Scene girder(int elements) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.gravity = {0, 0, 0};
  scene.beam.curve.end = {L, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e9, .EI = EI, .rhoA = 100};
  scene.beam.elements = elements;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  return scene;
}

Scene with_force(Scene scene, double x, double size = P) {
  LoadSpec load;
  load.at = LoadPlace::point;
  load.x.value = x;
  load.magnitude.value = size;
  load.direction = {0, -1, 0};
  scene.loads.push_back(load);
  return scene;
}

Sample last(const Scene& scene) {
  const RunResult result = simulate(scene);
  EXPECT_NE(result.status, RunStatus::failed) << result.failure;
  return result.samples.back();
}

TEST(SectionForces, OfAGirderUnderItsWeightAreTheParabola) {
  Scene scene = girder(8);
  scene.gravity = {0, -10, 0};
  scene.places = {{.name = "off", .x = 2.3}, {.name = "left", .end = BeamEnd::start}};
  const double q = 1000, x = 2.3;
  const Sample sample = last(scene);
  const SectionSample& seen = *sample.sections;
  EXPECT_NEAR(seen.moment->largest, q * L * L / 8, 1e-4 * q * L * L / 8);
  EXPECT_NEAR(seen.moment->at_largest, L / 2, 1e-6);
  EXPECT_NEAR(seen.moment->least, 0, 1e-6 * q * L * L);
  EXPECT_NEAR(seen.shear->largest, q * L / 2, 1e-4 * q * L / 2);
  EXPECT_NEAR(seen.shear->at_largest, 0, 1e-9);
  EXPECT_NEAR(seen.shear->least, -q * L / 2, 1e-4 * q * L / 2);
  EXPECT_NEAR(seen.places[0]->force.moment, q * x * (L - x) / 2, 1e-4 * q * x * (L - x) / 2);
  EXPECT_NEAR(seen.places[0]->force.shear, q * (L / 2 - x), 1e-4 * q * L);
  EXPECT_NEAR(seen.places[1]->force.shear, sample.reactions[0].position[1], 1e-4 * q * L);
  EXPECT_NEAR(seen.places[0]->position[0], x, 1e-4);
  EXPECT_NEAR(seen.angles[0], -q * L * L * L / (24 * EI) * 180 / std::numbers::pi, 1e-5);
}

TEST(SectionForces, HaveTheirKinkWhereAForceActsInsideAnElement) {
  for (const double x : {5.0, 3.3, 4.9, 0.2}) {  // at a node, inside elements, in the first one
    const SectionSample seen = *last(with_force(girder(8), x)).sections;
    const double most = P * x * (L - x) / L;
    EXPECT_NEAR(seen.moment->largest, most, 1e-5 * most) << x;
    EXPECT_NEAR(seen.moment->at_largest, x, 1e-9) << x;
    EXPECT_NEAR(seen.shear->largest, P * (L - x) / L, 1e-5 * P) << x;
    EXPECT_NEAR(seen.shear->least, -P * x / L, 1e-5 * P) << x;
  }
}

TEST(SectionForces, OfABentCantileverAreInEquilibriumWithOrderThree) {
  // far beyond small deflections; M(x) = P (x_tip - x) and N = P sin(angle) hold for every shape
  const auto errors = [](int elements) {
    Scene scene = girder(elements);
    scene.start = {.type = SupportType::clamp, .clamp = ClampType::full};
    scene.end = {};
    scene.loads.clear();
    LoadSpec load;
    load.node = elements;
    load.magnitude.value = 3 * EI / (L * L);
    load.direction = {0, -1, 0};
    scene.loads.push_back(load);
    scene.places = {{.name = "root", .x = 0}, {.name = "off", .x = 0.37 * L}};
    const Sample sample = last(scene);
    const double size = load.magnitude.value;
    double error = 0;
    for (const auto& place : sample.sections->places) {
      const double arm = sample.end[0] - place->position[0];
      error = std::max(error, std::abs(place->force.moment + size * arm) / (size * L));
      const double angle = place->angle * std::numbers::pi / 180;
      error = std::max(error, std::abs(place->force.shear - size * std::cos(angle)) / size);
    }
    return error;
  };
  const double coarse = errors(8), fine = errors(16);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(std::log2(coarse / fine), 2.5) << coarse << " " << fine;
}

TEST(SectionForces, OfARectangleInSpaceHaveTorqueAndStress) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.dimension = 3;
  scene.gravity = {0, 0, 0};
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.section = {.type = Section::Type::rectangle, .width = 0.02, .height = 0.05, .orientation = {0, 1, 0}};
  scene.beam.material.youngs_modulus = 2e11;
  scene.beam.elements = 8;
  scene.start = {.type = SupportType::clamp, .clamp = ClampType::full};
  const auto add = [&scene](LoadType type, const Point& direction, double size) {
    LoadSpec load;
    load.type = type;
    load.node = 8;
    load.direction = direction;
    load.magnitude.value = size;
    scene.loads.push_back(load);
  };
  add(LoadType::force, {0, 1, 0}, 10);
  add(LoadType::force, {0, 0, -1}, 20);
  add(LoadType::force, {1, 0, 0}, 0.5);
  add(LoadType::torque, {1, 0, 0}, 3);
  const SectionSample seen = *last(scene).sections;
  EXPECT_NEAR(seen.moment->largest, std::hypot(20, 40), 1e-3 * std::hypot(20, 40));
  EXPECT_NEAR(seen.moment->at_largest, 0, 1e-9);
  EXPECT_NEAR(seen.torque->largest, 3, 1e-2);
  const double area = 0.02 * 0.05;
  const double stress = 0.5 / area + 20 / (area * 0.02 / 6) + 40 / (area * 0.05 / 6);
  EXPECT_NEAR(seen.stress->largest, stress, 2e-3 * stress);
  EXPECT_FALSE(seen.shear) << "not known with frames";
  EXPECT_NEAR(*seen.tension[0], 0.5, 0.02);
}

TEST(SectionForces, TensionAndAngleOfAHangingRopeAreTheCatenarys) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.gravity = {0, -9.81, 0};
  scene.beam.curve = {
      .type = CurveType::arc, .center = {0, 0, 0}, .radius = 10, .from_degrees = 200, .to_degrees = 340};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e9, .rhoA = 2};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.places = {{.name = "low", .x = 10 * 70 * std::numbers::pi / 180}};
  const SectionSample seen = *last(scene).sections;
  const double length = 10 * 140 * std::numbers::pi / 180, span = 20 * std::cos(20 * std::numbers::pi / 180);
  double low = 1, high = 100;  // of the catenary's parameter
  for (int i = 0; i < 100; ++i) {
    const double a = (low + high) / 2;
    (2 * a * std::sinh(span / 2 / a) > length ? low : high) = a;
  }
  const double weight = 2 * 9.81, top = weight * low * std::cosh(span / 2 / low);
  EXPECT_NEAR(*seen.tension[0], top, 1e-4 * top);
  EXPECT_NEAR(*seen.tension[1], top, 1e-4 * top);
  EXPECT_NEAR(seen.places[0]->force.axial, weight * low, 2e-3 * weight * low);
  EXPECT_NEAR(seen.angles[1], std::atan(std::sinh(span / 2 / low)) * 180 / std::numbers::pi, 0.02);
  EXPECT_FALSE(seen.moment) << "a rope has none";
  EXPECT_NEAR(seen.places[0]->angle, 0, 0.01);
}

/// A force that passes over a girder.
Scene crossing(double interval) {
  Scene scene = with_force(girder(8), 0);
  scene.analysis = Analysis::dynamics;
  scene.loads[0].x.rate = L;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 2e-3;
  scene.duration = 1;
  scene.output.interval = interval;
  scene.output.extremes = true;
  return scene;
}

TEST(SectionForces, ExtremesOverTimeAreThoseOfTheSteps) {
  const auto largest = [](const RunResult& result, std::size_t number) {
    return (*result.samples.back().extremes)[number];
  };
  std::size_t number = 0;
  for (const SampleQuantity& quantity : sample_quantities(crossing(1))) {
    if (quantity.path == "bending_moment/max") break;
    if (quantity.path != "t") number += quantity.columns.size();
  }
  const RunResult seldom = simulate(crossing(0.5)), often = simulate(crossing(2e-3));
  const Extreme coarse = largest(seldom, number), fine = largest(often, number);
  EXPECT_NEAR(coarse.largest, fine.largest, 1e-6 * fine.largest);
  EXPECT_NEAR(coarse.at_largest, fine.at_largest, 1e-9);
  double of_samples = 0;
  for (const Sample& sample : often.samples) of_samples = std::max(of_samples, sample.sections->moment->largest);
  EXPECT_NEAR(fine.largest, of_samples, 1e-6 * of_samples);
  double seen_seldom = 0;
  for (const Sample& sample : seldom.samples) seen_seldom = std::max(seen_seldom, sample.sections->moment->largest);
  EXPECT_LT(seen_seldom, 0.99 * coarse.largest) << "samples alone would miss it";
}

TEST(SectionForces, LookingForExtremesChangesNoDigit) {
  for (const IntegratorType type : {IntegratorType::dopri5, IntegratorType::generalized_alpha}) {
    Scene scene = test::falling_beam(ElementKind::ale_rancf, 8);  // with events
    scene.integrator.type = type;
    scene.sliding_mass->friction = AxialFriction{0.1, 1e-3};
    scene.places = {{.name = "mass", .joint = 0}};
    scene.duration = 0.3;
    const RunResult without = simulate(scene);
    scene.output.extremes = true;
    const RunResult with = simulate(scene);
    ASSERT_EQ(with.samples.size(), without.samples.size());
    EXPECT_EQ(with.solver.steps, without.solver.steps);
    for (std::size_t i = 0; i < with.samples.size(); ++i) {
      EXPECT_EQ(with.samples[i].end, without.samples[i].end) << i;
      EXPECT_EQ(with.samples[i].joint_position, without.samples[i].joint_position) << i;
    }
  }
}

TEST(SectionForces, ALoadAtAnEndActsThatRoundingPutsBeyondIt) {
  for (const double beyond : {0.0, 1e-10}) {
    Scene scene = with_force(girder(8), L + beyond);
    scene.start = {.type = SupportType::clamp, .clamp = ClampType::full};
    scene.end = {};
    EXPECT_NEAR(last(scene).sections->moment->least, -P * L, 1e-4 * P * L) << beyond;
  }
}

TEST(SectionForces, PlacesFollowJointsAndMasses) {
  Scene scene = girder(8);
  scene.analysis = Analysis::dynamics;
  scene.gravity = {0, -10, 0};
  scene.gravity_ramp = 0.1;
  scene.sliding_joints.emplace_back();
  scene.sliding_joints[0].mass = 50;
  scene.sliding_joints[0].position = 2;
  scene.sliding_joints[0].x = TimeSpec{.rate = 10};
  scene.point_masses = {{.node = 6, .mass = 10}, {.node = 2, .mass = 20}};
  scene.places = {{.name = "trolley", .joint = 0}, {.name = "lamp", .point_mass = 1}, {.name = "gone", .x = 9.9}};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.duration = 0.4;
  scene.output.interval = 0.1;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const Sample& sample = result.samples.back();
  const auto& places = sample.sections->places;
  EXPECT_NEAR(places[0]->position[0], 6, 1e-4);
  EXPECT_NEAR(places[0]->velocity[0], 10, 1e-2);
  EXPECT_NEAR(places[1]->position[0], 2, 1e-4) << "of node 2, which the joint has drawn there";
  EXPECT_NEAR(places[1]->velocity[0], 0, 1e-2);
  EXPECT_EQ(places[0]->position, *sample.mass_position);
}

TEST(SectionForces, PlacesThatCannotBeAreRefusedByTheirKey) {
  const auto refused = [](const PlaceSpec& place) {
    Scene scene = girder(8);
    scene.places = {{.name = "first", .x = 1}, place};
    try {
      simulate(scene);
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused({.name = "first", .x = 2}), "/places/1/name");
  EXPECT_EQ(refused({.name = "a b", .x = 2}), "/places/1/name");
  EXPECT_EQ(refused({.name = "", .x = 2}), "/places/1/name");
  EXPECT_EQ(refused({.name = "far", .x = 11}), "/places/1/x");
  EXPECT_EQ(refused({.name = "none"}), "/places/1");
  EXPECT_EQ(refused({.name = "joint", .joint = 0}), "/places/1/joint");
  EXPECT_EQ(refused({.name = "two", .x = 1, .end = BeamEnd::end}), "/places/1");
  EXPECT_EQ(refused({.name = "mass", .point_mass = 0}), "/places/1/point_mass");
}

}  // namespace
}  // namespace vlbeam
