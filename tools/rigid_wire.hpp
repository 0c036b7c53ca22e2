#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace vlbeam {

/// Arc lengths [m] at `times` [s], ascending from 0 on, of the scene's sliding mass as a bead on a rigid wire of the
/// shape of its beam, an arc that starts to the left of its centre. It is let go at rest: R angle'' = g(t) cos(angle).
/// Owes nothing to the elements; good to 1e-13 of the length.
std::vector<double> on_rigid_arc(const Scene& scene, const std::vector<double>& times);

}  // namespace vlbeam
