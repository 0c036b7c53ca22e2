#pragma once

#include <vector>

#include "mechanics/motion/system/beam_system.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

// What holds material points between the ends of the beam: supports whose place is {"x": ...}.

/// Throws InvalidInput, by the pointers of the option table.
void validate_bearings(const Scene& scene);

/// Adds them to a model; points are held where the axis is drawn.
template <int D>
void add_bearings(const Scene& scene, const Axis<D>& axis, BeamModel<D>& model);

/// Where they are and what they do, in the order of the scene.
template <int D>
std::vector<BearingSample> bearing_samples(const Scene& scene, const BeamSystem<D>& system, const Eigen::VectorXd& y,
                                           const OuterForces<D>& forces);

/// The name of one among the quantities.
std::string bearing_name(const Scene& scene, std::size_t which);

}  // namespace vlbeam
