#pragma once

#include <Eigen/Core>

#include "core/element/active.hpp"
#include "core/element/elastic_tangent.hpp"
#include "core/element/fixed_element.hpp"
#include "core/pack.hpp"
#include "core/tangent_weights.hpp"

namespace vlbeam {

/// Derivative of a fixed-length element's elastic and viscous forces, with the sign of a stiffness: block (i, j) is
/// that of minus the force on the i-th of (r_B - r_A, s_A, s_B) by the j-th.
template <class Real, int D>
using ChordTangent = std::array<std::array<Eigen::Matrix<Real, D, D>, 3>, 3>;

/// Adds those of a point with the derivatives `k` of its stresses (ElasticTangent) to the blocks i <= j. Entry by entry
/// and unrolled: matrices of packs would go through memory.
template <class Real, int D, class PointTangent>
void add_point_tangent(const PointTangent& k, const typename FixedBasis<Real>::Point& point, bool bends,
                       ChordTangent<Real, D>& tangent) {
#pragma GCC unroll 3
  for (std::size_t j = 0; j < 3; ++j) {
    const Real w_x = point.weight * point.s_x[j], w_xx = point.weight * point.s_xx[j];
    for (int c = 0; c < D; ++c) {
      for (int d = 0; d < D; ++d) {
        Real by_p = k.pp(c, d) * w_x, by_m = Real(0);
        if (bends) {
          by_p += k.pm(c, d) * w_xx;
          by_m = k.pm(d, c) * w_x + k.mm(c, d) * w_xx;
        }
#pragma GCC unroll 3
        for (std::size_t i = 0; i <= j; ++i) {
          Real& sum = tangent[i][j](c, d);
          if (bends) sum += by_m * point.s_xx[i];
          sum += by_p * point.s_x[i];
        }
      }
    }
  }
}

/// Sum of add_point_tangent() over the points of an element, at(r_x, r_xx, section, index of the point) their `k`. No
/// branch on values: `Real` may be a Pack.
template <class Real, int D, class At>
ChordTangent<Real, D> chord_tangent(const FixedBasis<Real>& basis, const NodalCubic<Real, D>& e,
                                    const BeamSection& section, const At& at) {
  using Vector = Vec<Real, D>;
  ChordTangent<Real, D> tangent;
  for (auto& row : tangent) row.fill(Eigen::Matrix<Real, D, D>::Zero());
  const Vector chord = e.r_b - e.r_a;
  basis.visit(section, [&](const auto& point, const BeamSection& felt, std::size_t index) {
    const Vector r_x = chord * point.s_x[0] + e.s_a * point.s_x[1] + e.s_b * point.s_x[2];
    const Vector r_xx = chord * point.s_xx[0] + e.s_a * point.s_xx[1] + e.s_b * point.s_xx[2];
    add_point_tangent<Real, D>(at(r_x, r_xx, felt, index), point, felt.bends(), tangent);
  });
  for (std::size_t i = 1; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) tangent[i][j] = tangent[j][i].transpose();
  }
  return tangent;
}

/// Second derivative of the strain energy of a fixed-length element.
template <class Real, int D>
ChordTangent<Real, D> elastic_tangent(const FixedBasis<Real>& basis, const NodalCubic<Real, D>& e,
                                      const BeamSection& section) {
  return chord_tangent<Real, D>(basis, e, section, [](const auto& r_x, const auto& r_xx, const auto& felt, auto) {
    return ElasticTangent<Real, D>(r_x, r_xx, felt.stiffness);
  });
}

/// Tangent of minus the viscous forces, by automatic differentiation, for the element in lane `lane` of a pack.
template <int D>
ChordTangent<double, D> viscous_tangent(const FixedBasis<Pack>& basis, int lane, const NodalCubic<double, D>& e,
                                        const NodalCubic<double, D>& rate, const BeamSection& section,
                                        const TangentWeights& by) {
  constexpr int N = 2 * D;
  using Real = Active<N>;
  using Matrix = Eigen::Matrix<double, D, D>;
  ChordTangent<double, D> tangent;
  for (auto& row : tangent) row.fill(Matrix::Zero());
  auto combine = [lane](const std::array<Pack, 3>& s, const NodalCubic<double, D>& c) -> Vec<double, D> {
    return (c.r_b - c.r_a) * s[0][lane] + c.s_a * s[1][lane] + c.s_b * s[2][lane];
  };
  // directions of differentiation: the components of r_x, then of r_xx; by the weights of positions and rates
  auto seed = [](const Vec<double, D>& value, int first, double scale) {
    Vec<Real, D> result;
    for (int c = 0; c < D; ++c) {
      result[c].value() = value[c];
      result[c].derivatives() = scale * Eigen::Matrix<double, N, 1>::Unit(first + c);
    }
    return result;
  };
  basis.visit(section, [&](const auto& point, const BeamSection& felt, std::size_t /*index*/) {
    const DampingStress<Real, D> viscous(seed(combine(point.s_x, e), 0, by.q), seed(combine(point.s_xx, e), D, by.q),
                                         seed(combine(point.s_x, rate), 0, by.v),
                                         seed(combine(point.s_xx, rate), D, by.v), felt.stiffness, felt.damping,
                                         felt.curvature_regularization);
    Eigen::Matrix<double, D, N> by_p, by_m = Eigen::Matrix<double, D, N>::Zero();
    for (int c = 0; c < D; ++c) {
      by_p.row(c) = point.weight[lane] * viscous.p[c].derivatives().transpose();
      if (felt.bends()) by_m.row(c) = point.weight[lane] * viscous.m[c].derivatives().transpose();
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const Matrix dp =
          by_p.template leftCols<D>() * point.s_x[j][lane] + by_p.template rightCols<D>() * point.s_xx[j][lane];
      const Matrix dm =
          by_m.template leftCols<D>() * point.s_x[j][lane] + by_m.template rightCols<D>() * point.s_xx[j][lane];
      for (std::size_t i = 0; i < 3; ++i) tangent[i][j] += point.s_x[i][lane] * dp + point.s_xx[i][lane] * dm;
    }
  });
  return tangent;
}

}  // namespace vlbeam
