#pragma once

#include "mechanics/ropes/drag.hpp"
#include "scene/build.hpp"

namespace vlbeam {

/// What a fluid does to a beam of that mass per length, and damping in proportion to its mass.
template <int D>
Drag<D> build_drag(const Scene& scene, const DragSpec& spec, double rhoA, int quadrature_points) {
  const double of_mass = scene.beam.material.mass_damping * rhoA;
  Drag<D> drag{{spec.linear.normal + of_mass, spec.linear.tangential + of_mass},
               {spec.quadratic.normal, spec.quadratic.tangential},
               quadrature_points};
  if (scene.fluid) drag.stream = vector_of<D>(scene.fluid->velocity);
  return drag;
}

}  // namespace vlbeam
