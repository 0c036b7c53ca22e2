#pragma once

#include "core/parts/loads.hpp"
#include "core/parts/spin.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// The loads of a scene: those at a node say which, and a torque has a place among the loads, too.
template <int D>
struct BeamLoads {
  Loads<D> loads;
  Torques torques;
};
template <int D>
BeamLoads<D> build_loads(const Scene& scene);

}  // namespace vlbeam
