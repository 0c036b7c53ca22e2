#pragma once

#include <vector>

#include "mechanics/motion/system/beam_system.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

// Vehicles that come onto a beam, roll along it and leave it.

/// Throws InvalidInput, by the pointers of the option table.
void validate_vehicles(const Scene& scene);

/// Adds them to a model.
template <int D>
void add_vehicles(const Scene& scene, const Axis<D>& axis, BeamModel<D>& model);

/// Where their axles are and what they do at time t, one behind the other in the order of the scene.
template <int D>
std::vector<AxleSample> axle_samples(const Scene& scene, const BeamSystem<D>& system, const Eigen::VectorXd& y,
                                     double t, const OuterForces<D>& forces);

/// A push of a wheel as a force on the beam.
Point pushed_down(const Scene& scene, double push);

/// What to say where a wheel would lift off.
std::vector<Warning> lifting_wheels(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
