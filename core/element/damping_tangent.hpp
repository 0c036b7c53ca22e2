#pragma once

#include <Eigen/Core>

#include "core/element/active.hpp"
#include "core/element/moving_kinematics.hpp"
#include "core/element/section.hpp"
#include "core/element/strain.hpp"

namespace vlbeam {

/// Derivatives of the viscous stresses by r_x, r_xx, v_x and v_xx, by automatic differentiation. `rest`, unless null,
/// is the rate of the strains at rest.
template <int D>
struct DampingTangent {
  using Matrix = Eigen::Matrix<double, D, D>;
  std::array<Matrix, 4> p, m;
  std::array<Vec<double, D>, 4> tension, moment;
  Vec<double, D> viscous_p, viscous_m;

  DampingTangent(const PointMotion<double, D>& at, const BeamSection& section, const StrainChange<double>* rest) {
    constexpr int N = 4 * D;
    using Real = Active<N>;
    auto seed = [](const Vec<double, D>& value, int first) {
      Vec<Real, D> result;
      for (int c = 0; c < D; ++c) result[c] = Real(value[c], first + c);
      return result;
    };
    StrainChange<Real> given;
    if (rest != nullptr) given = {Real(rest->axial), Real(rest->curvature)};
    const DampingStress<Real, D> stress(seed(at.r_x, 0), seed(at.r_xx, D), seed(at.v_x, 2 * D), seed(at.v_xx, 3 * D),
                                        section.stiffness, section.damping, section.curvature_regularization,
                                        rest != nullptr ? &given : nullptr);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto by = static_cast<int>(i) * D;
      tension[i] = stress.tension.derivatives().template segment<D>(by);
      moment[i].setZero();
      if (section.bends()) moment[i] = stress.moment.derivatives().template segment<D>(by);
    }
    for (int c = 0; c < D; ++c) {
      viscous_p[c] = stress.p[c].value();
      viscous_m[c] = section.bends() ? stress.m[c].value() : 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto by = static_cast<int>(i) * D;
        p[i].row(c) = stress.p[c].derivatives().template segment<D>(by).transpose();
        m[i].row(c).setZero();
        if (section.bends()) m[i].row(c) = stress.m[c].derivatives().template segment<D>(by).transpose();
      }
    }
  }

  /// What the work on a change of the rest strains changes by with r_x, r_xx, v_x or v_xx.
  Vec<double, D> work(const StrainChange<double>& change, std::size_t by) const {
    return tension[by] * change.axial + moment[by] * change.curvature;
  }
};

}  // namespace vlbeam
