#pragma once

#include "scene/scene.hpp"
#include "tests/core/support/by_greens_law.hpp"

namespace vlbeam::test {

constexpr double steel = 2.1e11, rubber = 2e7;

/// A clamped beam of 1 m on which a mass slides, of this Young's modulus.
inline Scene wire(double youngs_modulus) {
  Scene scene = test::by_greens_law();
  scene.start.type = SupportType::clamp;
  scene.sliding_mass = SlidingMassSpec{};
  scene.beam.elements = 10;
  scene.beam.material.youngs_modulus = youngs_modulus;
  return scene;
}

}  // namespace vlbeam::test
