#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "core/element/rest_strain.hpp"

namespace vlbeam {

/// RestStress with its derivatives by r_x and r_xx, by automatic differentiation: dp/dr_x, dp/dr_xx, dm/dr_xx (dm/dr_x
/// is the transpose of dp/dr_xx), and those of `along`.
template <int D>
struct RestTangent {
  using Vector = Vec<double, D>;
  using Matrix = Eigen::Matrix<double, D, D>;

  Vector p, m, along_by_slope, along_by_second;
  Matrix pp, pm, mm;

  RestTangent(const Vector& rx, const Vector& rxx, const RestStrain<double>& rest, const Stiffness& k,
              double curvature_regularization) {
    constexpr int N = 2 * D;
    using Real = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;
    auto seed = [](const Vector& value, int first) {
      Vec<Real, D> result;
      for (int c = 0; c < D; ++c) result[c] = Real(value[c], N, first + c);
      return result;
    };
    auto constant = [](double value) { return Real(value, Eigen::Matrix<double, N, 1>::Zero()); };
    const RestStrain<Real> fixed{constant(rest.axial), constant(rest.curvature), constant(rest.axial_x),
                                 constant(rest.curvature_x)};
    const RestStress<Real, D> stress(seed(rx, 0), seed(rxx, D), fixed, k, curvature_regularization);
    m.setZero();
    mm.setZero();
    for (int c = 0; c < D; ++c) {
      p[c] = stress.p[c].value();
      pp.row(c) = stress.p[c].derivatives().template head<D>().transpose();
      pm.row(c) = stress.p[c].derivatives().template tail<D>().transpose();
      if (k.bends()) {
        m[c] = stress.m[c].value();
        mm.row(c) = stress.m[c].derivatives().template tail<D>().transpose();
      }
    }
    along_by_slope = stress.along.derivatives().template head<D>();
    along_by_second = stress.along.derivatives().template tail<D>();
  }
};

}  // namespace vlbeam
