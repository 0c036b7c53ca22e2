#pragma once

#include <vector>

#include "core/element/fixed_tangent.hpp"
#include "core/element/rest_tangent.hpp"

namespace vlbeam {

// What a rest shape adds to a fixed-length element; `rest` holds its strains at the points of the basis.

template <class Real, int D>
FixedForce<Real, D> rest_force(const FixedBasis<Real>& basis, const std::vector<RestStrain<Real>>& rest,
                               const NodalCubic<Real, D>& e, const BeamSection& section) {
  using Vector = Vec<Real, D>;
  FixedForce<Real, D> force{Vector::Zero(), Vector::Zero(), Vector::Zero(), Real(0)};
  const Vector chord = e.r_b - e.r_a;
  basis.visit(section, [&](const auto& point, const BeamSection& felt, std::size_t g) {
    const Vector r_x = chord * point.s_x[0] + e.s_a * point.s_x[1] + e.s_b * point.s_x[2];
    const Vector r_xx = chord * point.s_xx[0] + e.s_a * point.s_xx[1] + e.s_b * point.s_xx[2];
    const RestStress<Real, D> stress(r_x, r_xx, rest[g], felt);
    const Vector p = stress.p * Real(-point.weight), m = stress.m * Real(-point.weight);
    force.r_b += p * point.s_x[0] + m * point.s_xx[0];
    force.s_a += p * point.s_x[1] + m * point.s_xx[1];
    force.s_b += p * point.s_x[2] + m * point.s_xx[2];
  });
  return force;
}

/// Derivative of minus that force.
template <class Real, int D>
ChordTangent<Real, D> rest_tangent(const FixedBasis<Real>& basis, const std::vector<RestStrain<Real>>& rest,
                                   const NodalCubic<Real, D>& e, const BeamSection& section) {
  return chord_tangent<Real, D>(basis, e, section,
                                [&rest](const auto& r_x, const auto& r_xx, const auto& felt, std::size_t index) {
                                  return RestTangent<Real, D>(r_x, r_xx, rest[index], felt);
                                });
}

}  // namespace vlbeam
