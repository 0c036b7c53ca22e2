#pragma once

#include <memory>

#include "mechanics/motion/system/beam_system.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// The direction of a beam with the slope r_x [degrees]: in the plane from the first axis towards the second, -180 to
/// 180; in space above the horizontal, -90 to 90. Gravity says which way is up; without it the third axis does.
template <int D>
double beam_angle(const Scene& scene, const Vec<double, D>& r_x);

/// The places of a scene, those of point masses by their material coordinates.
std::vector<PlaceSpec> resolved_places(const Scene& scene);

/// The shape of a system's beam at the state y, with what acts on it. `forces` are those of this state.
template <int D>
Configuration shape_of(const Scene& scene, const BeamSystem<D>& system, const Eigen::VectorXd& y, double t,
                       const OuterForces<D>& forces);

/// What sections bear, how the ends are turned and pulled, and these places, at a state whose shape is given. `winches`
/// is what the sample says of them.
template <int D>
std::shared_ptr<const SectionSample> section_sample(const Scene& scene, const std::vector<PlaceSpec>& places,
                                                    const BeamSystem<D>& system, const Eigen::VectorXd& y,
                                                    const Configuration& shape, const OuterForces<D>& forces,
                                                    const std::array<std::optional<WinchSample>, 2>& winches);

}  // namespace vlbeam
