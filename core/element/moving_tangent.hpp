#pragma once

#include "core/element/moving_element.hpp"

namespace vlbeam {

// A variable-length element with one moving end as an implicit method sees it.

/// Residual M a - Q of a variable-length element: (r_A, s_A, r_B, s_B) and that of the moving end.
template <class Real, int D>
struct MovingResidual {
  std::array<Vec<Real, D>, 4> nodes;
  Real end;
};

/// Adds the power lost to damping to `dissipation` [W], where there is one.
template <MovingEnds Ends, class Real, int D>
MovingResidual<Real, D> moving_residual(const MovingCoordinates<Real, D>& q, const MovingCoordinates<Real, D>& rate,
                                        const MovingCoordinates<Real, D>& a, const WeightFunction& weights,
                                        const ShapeTabulation& table, const MovingLaw<D>& law,
                                        Real* dissipation = nullptr) {
  const auto eq = moving_equations<Real, D, Ends>(q, rate, weights, table, law);
  const std::array<Vec<Real, D>, 4> nodal{a.e.r_a, a.e.s_a, a.e.r_b, a.e.s_b};
  constexpr bool at_a = Ends == MovingEnds::a;
  const auto& border = at_a ? eq.mass_a : eq.mass_b;
  const Real& end = at_a ? a.x_a : a.x_b;
  MovingResidual<Real, D> r;
  r.end = (at_a ? eq.mass_aa : eq.mass_bb) * end - (at_a ? eq.force_a : eq.force_b);
  for (std::size_t i = 0; i < 4; ++i) {
    r.nodes[i] = border[i] * end - eq.force[i];
    for (std::size_t j = 0; j < 4; ++j) r.nodes[i] += nodal[j] * eq.mass[i][j];
    r.end += border[i].dot(nodal[i]);
  }
  if (dissipation) *dissipation += eq.dissipation;
  return r;
}

/// Derivative of moving_residual by (r_A, s_A, r_B, s_B, x of the moving end), rates and accelerations following by
/// `by_v` and `by_a`. At a given x all kinematics are linear in the nodal coordinates and their rates: the same
/// kinematics of unit vectors are their derivatives, and what remains is that of the stresses. Only the column of the
/// moving end, one direction, is left to automatic differentiation.
template <MovingEnds Ends, int D>
Eigen::Matrix<double, 4 * D + 1, 4 * D + 1> moving_tangent(const MovingCoordinates<double, D>& q,
                                                           const MovingCoordinates<double, D>& rate,
                                                           const MovingCoordinates<double, D>& a, double by_v,
                                                           double by_a, const WeightFunction& weights,
                                                           const ShapeTabulation& table, const MovingLaw<D>& law);

}  // namespace vlbeam
