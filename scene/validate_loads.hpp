#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Each of these throws InvalidInput where what acts on the beam does not go with the rest of the scene.

/// Forces, moments and torques.
void validate_loads(const Scene& scene);
/// Their places on a beam whose nodes rest, or all of which but one do.
void validate_resting_parts(const Scene& scene);
/// The fluid, the ground and lumped masses.
void validate_surroundings(const Scene& scene);

}  // namespace vlbeam
