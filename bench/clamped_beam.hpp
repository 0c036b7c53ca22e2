#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// A clamped beam of elements of 25 mm, and a mass that slides on it, `elements_behind` of them from the clamp.
inline Scene clamped_beam(int elements, double elements_behind) {
  constexpr double length = 0.025;  // [m]
  Scene scene;
  scene.start.type = SupportType::clamp;
  scene.beam.curve.end[0] = length * elements;
  scene.beam.elements = elements;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.strain_law = StrainLaw::green;  // the falling beam's
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->position = length * elements_behind;
  return scene;
}

}  // namespace vlbeam
