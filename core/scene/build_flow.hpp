#pragma once

#include "core/scene/derived.hpp"
#include "core/system/flowing_beam.hpp"

namespace vlbeam {

/// The model of a scene that flows(), validated or not; `D` is its dimension. Throws InvalidInput.
template <int D>
FlowingModel<D> build_flowing_model(const Scene& scene);

/// Its initial state: straight, stretched by the tension, moving and spinning evenly; or the steady flow near it.
/// Throws ComputationFailed where there is none.
template <int D>
Eigen::VectorXd initial_flow(const Scene& scene, FlowingBeam<D>& beam);

}  // namespace vlbeam
