#pragma once

#include "mechanics/motion/system/beam_system.hpp"

namespace vlbeam {

/// Condition number (2-norm) of the mass matrix at a state `y`, in the coordinates that supports leave free and scaled
/// to a unit diagonal: that is without units, and within a factor of their number of the least that any scaling of the
/// coordinates gives (van der Sluis 1969). Infinite where the matrix is not positive
/// definite. The model's constraints must be eliminated and the beam not kinked at the joint. Dense: O(n^3).
template <int D>
double mass_condition(BeamSystem<D>& system, const Eigen::VectorXd& y);

}  // namespace vlbeam
