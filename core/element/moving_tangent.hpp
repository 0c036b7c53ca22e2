#pragma once

#include "core/element/moving_element.hpp"
#include "core/tangent_weights.hpp"

namespace vlbeam {

// A variable-length element as an implicit method sees it.

template <MovingEnds Ends>
inline constexpr int moving_ends = Ends == MovingEnds::both ? 2 : 1;
/// Whether the moving end `e`, of those there are, is end A.
template <MovingEnds Ends>
constexpr bool is_end_a(int e) {
  return Ends == MovingEnds::a || (Ends == MovingEnds::both && e == 0);
}

/// Residual M a - Q of a variable-length element: (r_A, s_A, r_B, s_B) and that of the moving ends.
template <class Real, int D, MovingEnds Ends>
struct MovingResidual {
  std::array<Vec<Real, D>, 4> nodes;
  std::array<Real, moving_ends<Ends>> ends;
};

/// Adds the power lost to damping to `dissipation` [W], where there is one.
template <MovingEnds Ends, class Real, int D>
MovingResidual<Real, D, Ends> moving_residual(const MovingCoordinates<Real, D>& q,
                                              const MovingCoordinates<Real, D>& rate,
                                              const MovingCoordinates<Real, D>& a, const WeightFunction& weights,
                                              const ShapeTabulation& table, const MovingLaw<D>& law,
                                              Real* dissipation = nullptr) {
  const auto eq = MovingElement<Real, D, Ends>::forces(q, rate, a, weights, table, law);
  MovingResidual<Real, D, Ends> r;
  for (std::size_t i = 0; i < 4; ++i) r.nodes[i] = -eq.force[i];
  for (int e = 0; e < moving_ends<Ends>; ++e) {
    r.ends[static_cast<std::size_t>(e)] = -(is_end_a<Ends>(e) ? eq.force_a : eq.force_b);
  }
  if (dissipation) *dissipation += eq.dissipation;
  return r;
}

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
                                               const WeightFunction& weights, const ShapeTabulation& table,
                                               const MovingLaw<D>& law);

}  // namespace vlbeam
