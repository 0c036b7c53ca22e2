#pragma once

#include "core/element/moving_residual.hpp"

namespace vlbeam {

/// With rows and columns of `Unknown` ends, those that move; with 0 their motion is given, and x'' counts in M a alone.
template <MovingEnds Ends, int D, int Unknown = moving_ends<Ends>>
using MovingTangent = Eigen::Matrix<double, 4 * D + Unknown, 4 * D + Unknown>;

/// Tangent of moving_residual by (r_A, s_A, r_B, s_B, x of the unknown ends). At a given x all kinematics are linear in
/// the nodal coordinates and their rates: the same kinematics of unit vectors are their derivatives, and what remains
/// is that of the stresses. Only the columns of the ends, one direction each, are left to automatic differentiation.
template <MovingEnds Ends, int D, int Unknown = moving_ends<Ends>>
MovingTangent<Ends, D, Unknown> moving_tangent(const MovingCoordinates<double, D>& q,
                                               const MovingCoordinates<double, D>& rate,
                                               const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                               const WeightFunction& weights, const PointTables& tables,
                                               const MovingLaw<D>& law);

}  // namespace vlbeam
