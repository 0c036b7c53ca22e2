#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

// What slides along the beam of a scene. All throw InvalidInput.

/// Where joints are, and what holds, moves and guides them.
void validate_joints(const Scene& scene);

/// How the mesh follows them.
void validate_length_control(const Scene& scene);

/// Slopes and friction, by what the integrator knows of them.
void validate_joint_choices(const Scene& scene);

}  // namespace vlbeam
