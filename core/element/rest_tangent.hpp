#pragma once

#include <Eigen/Core>

#include "core/element/active.hpp"
#include "core/element/rest_strain.hpp"

namespace vlbeam {

/// RestStress with its derivatives by r_x and r_xx, by automatic differentiation: dp/dr_x, dp/dr_xx, dm/dr_xx (dm/dr_x
/// is the transpose of dp/dr_xx), and those of the work of its stresses on a change of the rest strains.
template <int D>
struct RestTangent {
  using Vector = Vec<double, D>;
  using Matrix = Eigen::Matrix<double, D, D>;

  Vector p, m;
  Matrix pp, pm, mm;

  /// Gradients of RestStress::work.
  struct Work {
    Vector by_slope, by_second;
  };
  Work work(const StrainChange<double>& change) const {
    return {tension_by_slope_ * change.axial + moment_by_slope_ * change.curvature,
            moment_by_second_ * change.curvature};
  }

  RestTangent(const Vector& rx, const Vector& rxx, const RestStrain<double>& rest, const BeamSection& section) {
    constexpr int N = 2 * D;
    using Real = Active<N>;
    auto seed = [](const Vector& value, int first) {
      Vec<Real, D> result;
      for (int c = 0; c < D; ++c) result[c] = Real(value[c], first + c);
      return result;
    };
    const RestStrain<Real> fixed{Real(rest.axial), Real(rest.curvature), {}, {}, {}};
    const RestStress<Real, D> stress(seed(rx, 0), seed(rxx, D), fixed, section);
    m.setZero();
    mm.setZero();
    moment_by_slope_.setZero();
    moment_by_second_.setZero();
    tension_by_slope_ = stress.tension.derivatives().template head<D>();
    for (int c = 0; c < D; ++c) {
      p[c] = stress.p[c].value();
      pp.row(c) = stress.p[c].derivatives().template head<D>().transpose();
      pm.row(c) = stress.p[c].derivatives().template tail<D>().transpose();
      if (section.bends()) {
        m[c] = stress.m[c].value();
        mm.row(c) = stress.m[c].derivatives().template tail<D>().transpose();
      }
    }
    if (!section.bends()) return;
    moment_by_slope_ = stress.moment.derivatives().template head<D>();
    moment_by_second_ = stress.moment.derivatives().template tail<D>();
  }

 private:
  Vector tension_by_slope_, moment_by_slope_, moment_by_second_;
};

}  // namespace vlbeam
