#pragma once

#include <vector>

#include "scene/run_support.hpp"

namespace vlbeam {

/// A beam at rest.
struct AtRest {
  const Eigen::VectorXd& y;          ///< its state
  double factor;                     ///< of the loads
  StaticSample equilibrium;          ///< what the sample says of it
  std::vector<double> holding = {};  ///< along the beam, of each joint [N]; none: 0
};

/// The sample of an equilibrium. `forces` and `shape` are those of it.
template <int D>
Sample static_sample(BeamSystem<D>& system, const AtRest& at, double number, const Scene& scene,
                     const std::vector<PlaceSpec>& places, const OuterForces<D>& forces, const Configuration& shape);

}  // namespace vlbeam
