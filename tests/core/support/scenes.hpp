#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/derived.hpp"
#include "scene/simulate.hpp"
#include "tests/core/support/by_greens_law.hpp"

namespace vlbeam::test {

/// Example 1 of Ding & Ouyang (2022): a mass slides along a beam that falls about its clamp.
inline Scene falling_beam(ElementKind element, int elements) {
  Scene scene = test::by_greens_law();
  scene.beam.element = element;
  scene.beam.elements = elements;
  scene.beam.axial_strain = AxialStrain::full;
  scene.beam.rest_shape = RestShape::paper;
  scene.length_control.velocities = VelocityTransfer::nodal;
  scene.start = {SupportType::clamp, ClampType::direction};
  scene.sliding_mass = SlidingMassSpec{};
  return scene;
}

/// The same beam without the mass, pinned and let go from the horizontal under a smooth gravity.
inline Scene flexible_pendulum(int elements) {
  Scene scene = test::by_greens_law();
  scene.beam.element = ElementKind::ancf;
  scene.beam.elements = elements;
  scene.beam.axial_strain = AxialStrain::full;
  scene.start.type = SupportType::pin;
  scene.gravity_ramp = 0.25;
  scene.duration = 0.5;
  return scene;
}

/// A shaft that spins and bears a load that turns about it and travels along it, with the node in the middle.
inline Scene shaft_under_turning_load(int elements) {
  Scene scene = test::by_greens_law();
  scene.dimension = 3;
  scene.gravity = {};
  scene.beam.curve.end = {0, 0, 1};
  scene.beam.elements = elements;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.axial_strain = AxialStrain::full;
  scene.beam.material.density = 7800;
  scene.beam.material.youngs_modulus = 2.1e11;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.spin.emplace().drives = {{0, {.rate = 300}}};
  const int middle = elements / 2;
  scene.flow.emplace().nodes = {{0, {}}, {middle, {.value = 0.01, .rate = 20}}, {elements, {.value = 1}}};
  scene.loads = {{.node = middle, .x = {}, .magnitude = {.value = 10}, .direction = {1, 0, 0}, .turn = {.rate = 60}}};
  return scene;
}

/// A weightless beam whose equilibria are sought.
inline Scene at_rest(int elements, double EA, double EI) {
  Scene scene = test::by_greens_law();
  scene.analysis = Analysis::statics;
  scene.gravity = {};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = EI, .rhoA = 1};
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = elements;
  scene.beam.axial_strain = AxialStrain::full;
  scene.beam.compression = Compression::full;
  return scene;
}

/// A run that has to go to its end.
inline RunResult completed(const Scene& scene) {
  RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
  return run;
}

/// The field that a scene is refused for.
inline std::string refused(const Scene& scene) {
  try {
    simulate(scene);
  } catch (const InvalidInput& error) {
    return error.field;
  }
  return "nothing";
}

inline void set_tolerance(Scene& scene, IntegratorType type, double tolerance) {
  scene.integrator.type = type;
  scene.integrator.rtol = scene.integrator.atol = tolerance;
}

inline SlidingJointSpec slider(double position, double mass, double velocity = 0) {
  SlidingJointSpec joint;
  joint.mass = mass;
  joint.position = position;
  joint.velocity = velocity;
  return joint;
}

/// A soft beam of 2 m between two pins, with something that slides on it.
inline Scene rope(const std::vector<SlidingJointSpec>& joints, ElementKind element = ElementKind::ale_ancf) {
  Scene scene = test::by_greens_law();
  scene.beam.element = element;
  scene.beam.elements = 16;
  scene.beam.curve.end = {2, 0, 0};
  scene.beam.section.radius = 0.015;
  scene.beam.material = {.density = 1200, .youngs_modulus = 5e7};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.sliding_joints = joints;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-12);
  scene.duration = 0.3;
  scene.output.interval = 0.01;
  return scene;
}

/// Example 3 of Ding & Ouyang (2022): a mass slides along a semicircle suspended at both ends.
inline Scene semicircle(int elements) {
  Scene scene = test::by_greens_law();
  scene.beam.curve = {.type = CurveType::arc, .radius = 2, .from_degrees = 180, .to_degrees = 360};
  scene.beam.section.radius = 0.02;
  scene.beam.material.youngs_modulus = 2e8;
  scene.beam.elements = elements;
  scene.start.type = scene.end.type = SupportType::pin;
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->position = beam_length(scene) / 16;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  scene.duration = 0.4;
  scene.output.interval = 0.05;
  return scene;
}

}  // namespace vlbeam::test
