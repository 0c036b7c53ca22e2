#pragma once

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
  for (std::size_t g = 0; g < basis.points.size(); ++g) {
    const auto& point = basis.points[g];
    const Vector r_x = chord * point.s_x[0] + e.s_a * point.s_x[1] + e.s_b * point.s_x[2];
    const Vector r_xx = chord * point.s_xx[0] + e.s_a * point.s_xx[1] + e.s_b * point.s_xx[2];
    const RestStress<Real, D> stress(r_x, r_xx, rest[g], section);
    const Vector p = stress.p * Real(-point.weight), m = stress.m * Real(-point.weight);
    force.r_b += p * point.s_x[0] + m * point.s_xx[0];
    force.s_a += p * point.s_x[1] + m * point.s_xx[1];
    force.s_b += p * point.s_x[2] + m * point.s_xx[2];
  }
  return force;
}

/// Derivative of minus that force, for the element in lane `lane` of a pack.
template <int D>
ChordTangent<double, D> rest_tangent(const FixedBasis<Pack>& basis, const std::vector<RestStrain<Pack>>& rest, int lane,
                                     const NodalCubic<double, D>& e, const BeamSection& section) {
  using Vector = Vec<double, D>;
  using Matrix = Eigen::Matrix<double, D, D>;
  ChordTangent<double, D> tangent;
  for (auto& row : tangent) row.fill(Matrix::Zero());
  const Vector chord = e.r_b - e.r_a;
  for (std::size_t g = 0; g < basis.points.size(); ++g) {
    const auto& point = basis.points[g];
    const Vector r_x = chord * point.s_x[0][lane] + e.s_a * point.s_x[1][lane] + e.s_b * point.s_x[2][lane];
    const Vector r_xx = chord * point.s_xx[0][lane] + e.s_a * point.s_xx[1][lane] + e.s_b * point.s_xx[2][lane];
    const RestStrain<double> strain{rest[g].axial[lane], rest[g].curvature[lane], {}, {}, {}};
    const RestTangent<D> k(r_x, r_xx, strain, section);
    for (std::size_t j = 0; j < 3; ++j) {
      const Matrix by_p = point.weight[lane] * (k.pp * point.s_x[j][lane] + k.pm * point.s_xx[j][lane]);
      const Matrix by_m = point.weight[lane] * (k.pm.transpose() * point.s_x[j][lane] + k.mm * point.s_xx[j][lane]);
      for (std::size_t i = 0; i < 3; ++i) {
        tangent[i][j] += by_p * point.s_x[i][lane] + by_m * point.s_xx[i][lane];
      }
    }
  }
  return tangent;
}

}  // namespace vlbeam
