#pragma once

#include <type_traits>
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

/// Derivative of minus that force, for the element in lane `lane` of a pack; of a single element, for that.
template <int D, class Real>
ChordTangent<double, D> rest_tangent(const FixedBasis<Real>& basis, const std::vector<RestStrain<Real>>& rest, int lane,
                                     const NodalCubic<double, D>& e, const BeamSection& section) {
  const auto of = [lane](const Real& values) -> double {
    if constexpr (std::is_same_v<Real, double>) {
      return values;
    } else {
      return values[lane];
    }
  };
  using Vector = Vec<double, D>;
  using Matrix = Eigen::Matrix<double, D, D>;
  ChordTangent<double, D> tangent;
  for (auto& row : tangent) row.fill(Matrix::Zero());
  const Vector chord = e.r_b - e.r_a;
  basis.visit(section, [&](const auto& point, const BeamSection& felt, std::size_t g) {
    const Vector r_x = chord * of(point.s_x[0]) + e.s_a * of(point.s_x[1]) + e.s_b * of(point.s_x[2]);
    const Vector r_xx = chord * of(point.s_xx[0]) + e.s_a * of(point.s_xx[1]) + e.s_b * of(point.s_xx[2]);
    const RestStrain<double> strain{of(rest[g].axial), of(rest[g].curvature), {}, {}, {}};
    const RestTangent<D> k(r_x, r_xx, strain, felt);
    for (std::size_t j = 0; j < 3; ++j) {
      const Matrix by_p = of(point.weight) * (k.pp * of(point.s_x[j]) + k.pm * of(point.s_xx[j]));
      const Matrix by_m = of(point.weight) * (k.pm.transpose() * of(point.s_x[j]) + k.mm * of(point.s_xx[j]));
      for (std::size_t i = 0; i < 3; ++i) {
        tangent[i][j] += by_p * of(point.s_x[i]) + by_m * of(point.s_xx[i]);
      }
    }
  });
  return tangent;
}

}  // namespace vlbeam
