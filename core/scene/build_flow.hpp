#pragma once

#include "core/scene/scene.hpp"
#include "core/system/flowing_beam.hpp"

namespace vlbeam {

/// Whether a scene spins, flows or bears loads: its beam is then a FlowingBeam.
inline bool flows(const Scene& scene) { return scene.spin || scene.flow || !scene.loads.empty(); }

/// Whether its state holds a ledger of what crosses the boundary: methods of first-order equations integrate it along.
bool keeps_ledger(const Scene& scene);

/// What such a scene starts with where it does not say: the spin of its first drive [rad/s], and the velocity of the
/// matter along the axis at which node 0 stands still [m/s].
double initial_spin(const Scene& scene);
double initial_velocity(const Scene& scene);

/// The model of such a scene, validated or not; `D` is its dimension. Throws InvalidInput.
template <int D>
FlowingModel<D> build_flowing_model(const Scene& scene);

/// Its initial state: straight, stretched by the tension, moving and spinning evenly; or the steady flow near it.
/// Throws ComputationFailed where there is none.
template <int D>
Eigen::VectorXd initial_flow(const Scene& scene, FlowingBeam<D>& beam);

}  // namespace vlbeam
