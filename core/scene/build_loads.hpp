#pragma once

#include "core/parts/loads.hpp"
#include "core/scene/scene.hpp"

namespace vlbeam {

/// The loads of a scene: those at a node say which.
template <int D>
struct BeamLoads {
  std::vector<PointLoad<D>> points;
  std::function<Vec<double, D>(double t)> line_force;  ///< on the whole beam [N/m]
  std::function<double(double t)> line_torque;         ///< on the whole beam [N m/m]
};
template <int D>
BeamLoads<D> build_loads(const Scene& scene);

}  // namespace vlbeam
