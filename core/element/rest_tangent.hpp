#pragma once

#include "core/element/elastic_tangent.hpp"
#include "core/element/rest_strain.hpp"

namespace vlbeam {

/// Second derivatives of the curvature that Curvature measures. In the plane kappa = f g^(-n/2), f = r_x x r_xx; in
/// space kappa^2 = P + regularization^2, where ElasticTangent holds the second derivatives of P/2.
template <class Real, int D>
struct CurvatureTangent {
  using Vector = Vec<Real, D>;
  using Matrix = Eigen::Matrix<Real, D, D>;

  Matrix xx, xm, mm;  ///< by r_x twice, by r_x (rows) and r_xx, by r_xx twice

  /// `strain` are the strains there.
  CurvatureTangent(const Vector& rx, const Vector& rxx, const StrainGradients<Real, D>& strain, StrainLaw law) {
    using std::sqrt;
    const Vector &by_x = strain.curvature_by_slope, &by_m = strain.curvature_by_second;
    if constexpr (D == 2) {
      const Real n = Real(curvature_power(law)), inverse = Real(1) / rx.dot(rx);
      const Real scale = law == StrainLaw::green ? Real(inverse * sqrt(inverse)) : inverse;
      const Vector direction = rx * Real(n * inverse);
      // f is bilinear, and of a power of g the gradient is along r_x
      const Vector half = by_x + direction * Real((n - Real(2)) / (Real(2) * n) * strain.curvature);
      xx = -(half * direction.transpose() + direction * half.transpose());
      xx.diagonal().array() -= n * inverse * strain.curvature;
      xm = -(direction * by_m.transpose());
      xm(0, 1) += scale;
      xm(1, 0) -= scale;
      mm.setZero();
    } else {
      const ElasticTangent<Real, D> of_square(rx, rxx, {0, 1, law});
      const Real share = Real(1) / strain.curvature;
      xx = (of_square.pp - by_x * by_x.transpose()) * share;
      xm = (of_square.pm - by_x * by_m.transpose()) * share;
      mm = (of_square.mm - by_m * by_m.transpose()) * share;
    }
  }
};

/// RestStress with its derivatives by r_x and r_xx: dp/dr_x, dp/dr_xx, dm/dr_xx (dm/dr_x is the transpose of dp/dr_xx),
/// and those of the work of its stresses on a change of the rest strains. No branch on values.
template <class Real, int D>
struct RestTangent {
  using Vector = Vec<Real, D>;
  using Matrix = Eigen::Matrix<Real, D, D>;

  Vector p, m;
  Matrix pp, pm, mm;

  /// Gradients of RestStress::work.
  struct Work {
    Vector by_slope, by_second;
  };
  Work work(const StrainChange<Real>& change) const {
    return {tension_by_slope_ * change.axial + moment_by_slope_ * change.curvature,
            moment_by_second_ * change.curvature};
  }

  RestTangent(const Vector& rx, const Vector& rxx, const RestStrain<Real>& rest, const BeamSection& section) {
    const Stiffness& k = section.stiffness;
    const StrainGradients<Real, D> strain(rx, rxx, section);
    Real pull = Real(-k.EA) * rest.axial, pull_by_strain = Real(0), tension_by_strain = Real(k.EA);
    if (k.slackens()) {
      const SlackLaw<Real> rope(strain.axial - rest.axial, k.slack_over), unstrained(strain.axial, k.slack_over);
      pull = Real(k.EA) * (rope.pull - unstrained.pull);
      pull_by_strain = Real(k.EA) * (rope.stiffness - unstrained.stiffness);
      tension_by_strain = Real(k.EA) * rope.stiffness;
    }
    p = strain.axial_by_slope * pull;
    pp = (strain.axial_by_slope * pull_by_strain) * strain.axial_by_slope.transpose();
    if (k.green()) {
      pp.diagonal().array() += pull;
    } else {
      const Real by_stretch = pull / (strain.axial + Real(1));
      pp -= (strain.axial_by_slope * by_stretch) * strain.axial_by_slope.transpose();
      pp.diagonal().array() += by_stretch;
    }
    tension_by_slope_ = strain.axial_by_slope * tension_by_strain;
    m.setZero();
    pm.setZero();
    mm.setZero();
    moment_by_slope_.setZero();
    moment_by_second_.setZero();
    if constexpr (D > 1) {  // the angle of a section, D = 1, has no curvature
      if (!section.bends()) return;
      const Real moment = Real(-k.EI) * rest.curvature;
      p += strain.curvature_by_slope * moment;
      m = strain.curvature_by_second * moment;
      const CurvatureTangent<Real, D> curvature(rx, rxx, strain, k.law);
      pp += curvature.xx * moment;
      pm = curvature.xm * moment;
      mm = curvature.mm * moment;
      moment_by_slope_ = strain.curvature_by_slope * Real(k.EI);
      moment_by_second_ = strain.curvature_by_second * Real(k.EI);
    }
  }

 private:
  Vector tension_by_slope_, moment_by_slope_, moment_by_second_;
};

}  // namespace vlbeam
