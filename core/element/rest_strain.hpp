#pragma once

#include <cmath>

#include "core/element/section.hpp"
#include "core/element/strain.hpp"

namespace vlbeam {

/// Strains of the stress-free shape at one point of an element. In the plane the curvature is signed; in space it is a
/// magnitude.
template <class Real>
struct RestStrain {
  Real axial, curvature;
  StrainChange<Real> along;       ///< derivatives along the beam
  StrainChange<Real> by_a, by_b;  ///< by x_A and x_B at a fixed material point, as far as the ends move

  /// At a fixed material point, while the ends move along the beam [1/s], [1/(m s)].
  StrainChange<Real> rate(const Real& x_rate_a, const Real& x_rate_b) const {
    return {by_a.axial * x_rate_a + by_b.axial * x_rate_b, by_a.curvature * x_rate_a + by_b.curvature * x_rate_b};
  }
};

/// Signed curvature f/g^(n/2) in the plane, f = r_x x r_xx, g = r_x.r_x, n = 3 (green) or 2 (engineering); in space
/// sqrt(kappa^2 + regularization^2). With its gradients.
template <class Real, int D>
struct Curvature {
  Real value;
  Vec<Real, D> by_slope, by_second;

  Curvature(const Vec<Real, D>& rx, const Vec<Real, D>& rxx, StrainLaw law, [[maybe_unused]] double regularization) {
    using std::sqrt;
    const bool green = law == StrainLaw::green;
    const double n = curvature_power(law);
    const Real g = rx.dot(rx), inverse = Real(1) / g;
    if constexpr (D == 2) {
      const Real scale = green ? Real(inverse / sqrt(g)) : inverse;
      const Real f = rx[0] * rxx[1] - rx[1] * rxx[0];
      value = f * scale;
      by_slope << rxx[1] * scale, -(rxx[0] * scale);
      by_second << -(rx[1] * scale), rx[0] * scale;
      by_slope -= rx * Real(Real(n) * value * inverse);
    } else {
      const Real scale = green ? Real(inverse * inverse * inverse) : Real(inverse * inverse);
      const CrossProduct<Real, D> cross(rx, rxx);
      const Real squared = cross.squared * scale;
      value = sqrt(squared + Real(regularization * regularization));
      const Real share = Real(1) / value;
      by_slope = (cross.by_slope * scale - rx * Real(Real(n) * squared * inverse)) * share;
      by_second = cross.by_second * Real(scale * share);
    }
  }
};

/// Axial strain and curvature with their gradients by r_x and r_xx; without stiffness in bending no curvature.
template <class Real, int D>
struct StrainGradients {
  Real axial, curvature;
  Vec<Real, D> axial_by_slope, curvature_by_slope, curvature_by_second;

  StrainGradients(const Vec<Real, D>& rx, const Vec<Real, D>& rxx, const BeamSection& section) {
    using std::sqrt;
    const Real g = rx.dot(rx);
    if (section.stiffness.green()) {
      axial = Real(0.5) * (g - Real(1));
      axial_by_slope = rx;
    } else {
      const Real stretch = sqrt(g);
      axial = stretch - Real(1);
      axial_by_slope = rx * Real(Real(1) / stretch);
    }
    curvature = Real(0);
    curvature_by_slope.setZero();
    curvature_by_second.setZero();
    if constexpr (D > 1) {  // the angle of a section, D = 1, has no curvature
      if (!section.bends()) return;
      const Curvature<Real, D> kappa(rx, rxx, section.stiffness.law, section.curvature_regularization);
      curvature = kappa.value;
      curvature_by_slope = kappa.by_slope;
      curvature_by_second = kappa.by_second;
    }
  }

  /// Of strains whose r_x and r_xx change like this.
  StrainChange<Real> change(const Vec<Real, D>& by_rx, const Vec<Real, D>& by_rxx) const {
    return {axial_by_slope.dot(by_rx), curvature_by_slope.dot(by_rx) + curvature_by_second.dot(by_rxx)};
  }
};

/// Strains of the rest shape at r_x and r_xx of it, where they need no derivatives.
template <int D>
RestStrain<double> rest_strain(const Vec<double, D>& r_x, const Vec<double, D>& r_xx, const BeamSection& section) {
  const StrainGradients<double, D> strain(r_x, r_xx, section);
  return {strain.axial, strain.curvature, {}, {}, {}};
}

/// Stress of a beam with the rest strains eps_0 and kappa_0: tension EA (eps - eps_0), moment EI (kappa - kappa_0), the
/// energies per length EA (eps - eps_0)^2/2 and EI (kappa - kappa_0)^2/2, and what is added to the p and m of
/// ElasticStress, - EA eps_0 deps - EI kappa_0 dkappa. In space both curvatures are regularized. A rope that goes slack
/// pulls with EA psi'(eps - eps_0) (SlackLaw).
template <class Real, int D>
struct RestStress {
  Vec<Real, D> p, m;
  Real axial, bending;
  Real tension, moment;

  RestStress(const Vec<Real, D>& rx, const Vec<Real, D>& rxx, const RestStrain<Real>& rest,
             const BeamSection& section) {
    const auto& k = section.stiffness;
    const StrainGradients<Real, D> strain(rx, rxx, section);
    const Real eps = strain.axial - rest.axial, kappa = strain.curvature - rest.curvature;
    tension = Real(k.EA) * eps;
    moment = Real(k.EI) * kappa;
    axial = Real(0.5) * tension * eps;
    bending = Real(0.5) * moment * kappa;
    Real missing_pull = Real(-k.EA) * rest.axial;
    if (k.slackens()) {
      const SlackLaw<Real> rope(eps, k.slack_over);
      tension = Real(k.EA) * rope.pull;
      axial = Real(k.EA) * rope.energy;
      missing_pull = tension - Real(k.EA) * SlackLaw<Real>(strain.axial, k.slack_over).pull;
    }
    p = strain.axial_by_slope * missing_pull;
    m.setZero();
    if (!section.bends()) return;
    const Real missing = Real(-k.EI) * rest.curvature;
    p += strain.curvature_by_slope * missing;
    m = strain.curvature_by_second * missing;
  }

  /// Work per length of the stresses on a change of the rest strains.
  Real work(const StrainChange<Real>& change) const { return tension * change.axial + moment * change.curvature; }
};

}  // namespace vlbeam
