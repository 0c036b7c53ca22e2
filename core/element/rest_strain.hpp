#pragma once

#include <cmath>

#include "core/element/strain.hpp"

namespace vlbeam {

/// Strains of the stress-free shape at one material point, and their derivatives along the beam. In the plane the
/// curvature is signed; in space it is a magnitude.
template <class Real>
struct RestStrain {
  Real axial, curvature;
  Real axial_x, curvature_x;
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

/// What a rest shape other than a straight unstrained one adds to the strain energy per length and its gradients:
///   W_0 = - EA eps_0 (eps - eps_0/2) - EI kappa_0 (kappa - kappa_0/2),
/// so that W + W_0 = EA (eps - eps_0)^2/2 + EI (kappa - kappa_0)^2/2. `along` is the part of its derivative along the
/// beam that comes from the rest strains themselves.
template <class Real, int D>
struct RestStress {
  Vec<Real, D> p, m;
  Real axial, bending, along;

  RestStress(const Vec<Real, D>& rx, const Vec<Real, D>& rxx, const RestStrain<Real>& rest, const Stiffness& k,
             double curvature_regularization) {
    using std::sqrt;
    const Real g = rx.dot(rx);
    Real eps;
    if (k.green()) {
      eps = Real(0.5) * (g - Real(1));
      p = rx * Real(Real(-k.EA) * rest.axial);
    } else {
      const Real stretch = sqrt(g);
      eps = stretch - Real(1);
      p = rx * Real(Real(-k.EA) * rest.axial / stretch);
    }
    axial = Real(-k.EA) * rest.axial * (eps - Real(0.5) * rest.axial);
    along = Real(-k.EA) * (eps - rest.axial) * rest.axial_x;
    m.setZero();
    bending = Real(0);
    if constexpr (D > 1) {  // the angle of a section, D = 1, has no curvature
      if (!k.bends()) return;
      const Curvature<Real, D> kappa(rx, rxx, k.law, curvature_regularization);
      const Real moment = Real(-k.EI) * rest.curvature;
      p += kappa.by_slope * moment;
      m = kappa.by_second * moment;
      bending = moment * (kappa.value - Real(0.5) * rest.curvature);
      // in space both curvatures are regularized, the one of W is not
      if constexpr (D == 3) bending += Real(0.5 * k.EI * curvature_regularization * curvature_regularization);
      along += Real(-k.EI) * (kappa.value - rest.curvature) * rest.curvature_x;
    }
  }
};

}  // namespace vlbeam
