#pragma once

#include "core/scene/simulate.hpp"

namespace vlbeam::test {

/// Example 1 of Ding & Ouyang (2022): a mass slides along a beam that falls about its clamp.
inline Scene falling_beam(ElementKind element, int elements) {
  Scene scene;
  scene.beam.element = element;
  scene.beam.elements = elements;
  scene.beam.rest_shape = RestShape::paper;
  scene.start = {SupportType::clamp, ClampType::direction};
  scene.sliding_mass = SlidingMassSpec{};
  return scene;
}

/// The same beam without the mass, pinned and let go from the horizontal under a smooth gravity.
inline Scene flexible_pendulum(int elements) {
  Scene scene;
  scene.beam.element = ElementKind::ancf;
  scene.beam.elements = elements;
  scene.start.type = SupportType::pin;
  scene.gravity_ramp = 0.25;
  scene.duration = 0.5;
  return scene;
}

inline void set_tolerance(Scene& scene, IntegratorType type, double tolerance) {
  scene.integrator.type = type;
  scene.integrator.rtol = scene.integrator.atol = tolerance;
}

}  // namespace vlbeam::test
