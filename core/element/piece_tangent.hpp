#pragma once

#include "core/element/moving_tangent.hpp"

namespace vlbeam {

/// moving_tangent() of an element in which the section changes, by automatic differentiation: rows and columns of
/// (r_A, s_A, r_B, s_B, x_A, x_B), whichever ends move. Of a law by law_between().
template <int D>
Eigen::Matrix<double, 4 * D + 2, 4 * D + 2> piece_tangent(const MovingCoordinates<double, D>& q,
                                                          const MovingCoordinates<double, D>& rate,
                                                          const MovingCoordinates<double, D>& a,
                                                          const TangentWeights& weigh, const WeightFunction& weights,
                                                          const ShapeTabulation& table, const MovingLaw<D>& law);

}  // namespace vlbeam
