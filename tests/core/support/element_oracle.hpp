#pragma once

#include <optional>

#include "core/element/moving_element.hpp"
#include "tests/core/support/element_state.hpp"

namespace vlbeam::test {

/// The mechanics of one variable-length element from its definitions alone: where a material point is, what the strains
/// are, what the Lagrangian is. Every velocity, mass and force follows by automatic differentiation; no formula of the
/// element's own derivation is repeated.
template <int D>
struct ElementOracle {
  using Vector = Vec<double, D>;
  using Column = ElementColumn<double, D>;

  BeamSection section;
  WeightTransport transport = WeightTransport::frozen;
  WeightFunction stored;
  BeamRule rule;
  Vector gravity = Vector::Zero();
  /// The rest curve, as a polynomial of the material coordinate, where it is not straight. The element's rest shape is
  /// the same element between ends on it.
  std::optional<std::array<Vector, 4>> rest;

  /// Material coordinate at the reference point u.
  static double material_point(const Column& q, double u) { return q[4 * D] * (1 - u) + q[4 * D + 1] * u; }

  /// Position of the material point x and its first three derivatives with respect to x.
  std::array<Vector, 4> point(const Column& q, double x) const;
  /// Rates of the same along q + q' t, at the fixed material point.
  std::array<Vector, 4> point_rate(const Column& q, const Column& rate, double x) const;
  /// Second time derivative of the position of the material point x along q + q' t.
  Vector remainder(const Column& q, const Column& rate, double x) const;

  double elastic_energy(const Column& q) const;
  /// -dU/dq of the elastic energy.
  Column elastic_force(const Column& q) const;

  /// Lagrange's equations M q'' = Q of sum_g w_g l (rhoA v.v/2 - W + rhoA g.r), the reference points fixed.
  DenseEquations<D> variational(const Column& q, const Column& rate) const;
  /// Virtual work at fixed material points: sum_g w_g l (rhoA (g - r_v).dr - dW), with r_v the acceleration at q'' = 0.
  DenseEquations<D> virtual_work(const Column& q, const Column& rate) const;
  /// Minus the gradient by q' of Rayleigh's function sum_g w_g l c (EA eps'^2 + EI kappa'^2)/2, strain rates at fixed
  /// material points; in space kappa'^2 = (kappa kappa')^2/(kappa^2 + kappa_reg^2).
  Column viscous_force(const Column& q, const Column& rate) const;
};

extern template struct ElementOracle<2>;
extern template struct ElementOracle<3>;

}  // namespace vlbeam::test
