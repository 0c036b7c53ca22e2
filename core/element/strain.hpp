#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "core/element/slack_law.hpp"
#include "core/element/strain_law.hpp"
#include "core/geometry/vec.hpp"

namespace vlbeam {

/// F = r_x x r_xx with half the gradients of F.F: what curvature is made of, in the plane and in space.
template <class Real, int D>
struct CrossProduct {
  Real squared;            ///< F.F
  Vec<Real, D> by_slope;   ///< (dF/dr_x)^T F
  Vec<Real, D> by_second;  ///< (dF/dr_xx)^T F

  CrossProduct(const Vec<Real, D>& rx, const Vec<Real, D>& rxx) {
    if constexpr (D == 2) {
      const Real f = rx[0] * rxx[1] - rx[1] * rxx[0];
      squared = f * f;
      by_slope << f * rxx[1], -(f * rxx[0]);
      by_second << -(f * rx[1]), f * rx[0];
    } else {
      const Vec<Real, D> f = rx.cross(rxx);
      squared = f.dot(f);
      by_slope = rxx.cross(f);
      by_second = f.cross(rx);
    }
  }
};

/// Stiffness of the section, EA [N] and EI [N m^2], and the strains that it resists. Element laws branch on `law` and
/// on whether there is bending at every point: always the same way, which costs little, and each law is compiled once.
/// Kernels for packs of elements tell the compiler which way (`beam/span_kernels.cpp`).
struct Stiffness {
  double EA;
  double EI;
  StrainLaw law = StrainLaw::green;
  double slack_over = 0;  ///< strain over which a rope goes slack [-]; 0: it bears compression as tension

  bool slackens() const { return slack_over != 0; }
  bool bends() const { return EI != 0; }
  bool green() const { return law == StrainLaw::green; }
  double curvature_power() const { return vlbeam::curvature_power(law); }
};

/// Of it what resists stretching.
inline Stiffness axial_part(Stiffness stiffness) {
  stiffness.EI = 0;
  return stiffness;
}

/// Strain energy per length W = EA eps^2/2 + EI kappa^2/2 [J/m], or EA psi(eps) of a rope that goes slack (SlackLaw),
/// and its gradients, the generalized stresses
/// p = dW/dr_x [N] and m = dW/dr_xx [N m] (Ding & Ouyang 2022, Eq. 17-19).
/// Curvature enters as kappa dkappa only, which is smooth where the beam is straight. EI = 0 is a cable.
template <class Real, int D>
struct ElasticStress {
  Vec<Real, D> p, m;
  Real axial, bending;

  ElasticStress(const Vec<Real, D>& rx, const Vec<Real, D>& rxx, const Stiffness& k) {
    using std::sqrt;
    const Real g = rx.dot(rx);
    Real along;
    if (k.green()) {
      const Real eps = Real(0.5) * (g - Real(1));
      axial = Real(0.5 * k.EA) * eps * eps;
      along = Real(k.EA) * eps;
      if (k.slackens()) slacken(eps, Real(1), k, along);
    } else {
      const Real stretch = sqrt(g);
      const Real eps = stretch - Real(1);
      axial = Real(0.5 * k.EA) * eps * eps;
      along = Real(k.EA) * (Real(1) - Real(1) / stretch);
      if (k.slackens()) slacken(eps, stretch, k, along);
    }
    if (k.bends()) {
      // kappa^2 = F.F / g^n, n = 3 (green) or 2 (engineering)
      const CrossProduct<Real, D> cross(rx, rxx);
      const Real inverse = Real(1) / g;
      const Real scale = Real(k.EI) * (k.green() ? Real(inverse * inverse * inverse) : Real(inverse * inverse));
      const double n = k.curvature_power();
      bending = Real(0.5) * scale * cross.squared;
      along -= Real(n) * scale * cross.squared * inverse;
      p = rx * along + cross.by_slope * scale;
      m = cross.by_second * scale;
    } else {
      bending = Real(0);
      p = rx * along;
      m.setZero();
    }
  }

 private:
  void slacken(const Real& eps, const Real& stretch, const Stiffness& k, Real& along) {
    const SlackLaw<Real> rope(eps, k.slack_over);
    axial = Real(k.EA) * rope.energy;
    along = Real(k.EA) * rope.pull / stretch;
  }
};

/// Changes of both strains along one direction.
template <class Real>
struct StrainChange {
  Real axial = Real(0), curvature = Real(0);
};

/// Kelvin-Voigt stresses EA c (eps - eps_0)' and EI c (kappa - kappa_0)' as generalized stresses, rates at a fixed
/// material point; of a rope that goes slack EA c psi''(eps) eps' (SlackLaw), by its strain from a straight, unstrained
/// shape. The strains eps_0 and kappa_0 at rest change there while a node moves past: an element of the rest shape
/// follows the rest curve as well as its present ends allow. `rest`, unless null, is their rate. In space
/// kappa' dkappa is 0/0 where the beam is straight; it is regularised as
/// (kappa kappa')(kappa dkappa)/(kappa^2 + kappa_reg^2). In the plane the signed curvature needs no such thing.
template <class Real, int D>
struct DampingStress {
  Vec<Real, D> p, m;
  Real power;                     ///< dissipated power per length [W/m]
  Real tension, moment{Real(0)};  ///< [N], [N m]; the moment where the beam bends

  DampingStress(const Vec<Real, D>& rx, const Vec<Real, D>& rxx, const Vec<Real, D>& vx, const Vec<Real, D>& vxx,
                const Stiffness& k, double c, double curvature_regularization,
                const StrainChange<Real>* rest = nullptr) {
    using std::sqrt;
    const Real g = rx.dot(rx);
    const Vec<Real, D> strain_gradient = k.green() ? rx : Vec<Real, D>(rx * Real(Real(1) / sqrt(g)));
    Real strain_rate = strain_gradient.dot(vx);
    if (rest != nullptr) strain_rate -= rest->axial;
    Real resists = Real(c * k.EA);
    if (k.slackens()) {
      const Real eps = k.green() ? Real(Real(0.5) * (g - Real(1))) : Real(sqrt(g) - Real(1));
      resists *= SlackLaw<Real>(eps, k.slack_over).stiffness;
    }
    tension = resists * strain_rate;
    p = strain_gradient * tension;
    power = resists * strain_rate * strain_rate;
    m.setZero();
    if (k.bends()) {
      const double n = k.curvature_power();
      if constexpr (D == 2) {
        const Real f = rx[0] * rxx[1] - rx[1] * rxx[0];
        const Real scale = k.green() ? Real(Real(1) / (g * sqrt(g))) : Real(Real(1) / g);
        Vec<Real, D> by_slope, by_second;
        by_slope << rxx[1] * scale, -(rxx[0] * scale);
        by_slope -= rx * Real(Real(n) * f * scale / g);
        by_second << -(rx[1] * scale), rx[0] * scale;
        Real rate = by_slope.dot(vx) + by_second.dot(vxx);
        if (rest != nullptr) rate -= rest->curvature;
        moment = Real(c * k.EI) * rate;
        p += by_slope * moment;
        m = by_second * moment;
        power += Real(c * k.EI) * rate * rate;
      } else {
        const CrossProduct<Real, D> cross(rx, rxx);
        const Real inverse = Real(1) / g;
        const Real scale = k.green() ? Real(inverse * inverse * inverse) : Real(inverse * inverse);
        const Real curvature_squared = cross.squared * scale;
        const Vec<Real, D> by_slope = cross.by_slope * scale - rx * Real(Real(n) * curvature_squared * inverse);
        const Vec<Real, D> by_second = cross.by_second * scale;
        Real rate = by_slope.dot(vx) + by_second.dot(vxx);  // kappa kappa'
        const Real squared = curvature_squared + Real(curvature_regularization * curvature_regularization);
        const Real over = Real(c * k.EI) / squared;
        if (rest != nullptr) {
          const Real kappa = sqrt(squared);
          rate -= kappa * rest->curvature;
          moment = over * rate * kappa;
        }
        p += by_slope * Real(over * rate);
        m = by_second * Real(over * rate);
        power += over * rate * rate;
      }
    }
  }

  /// Work per length on a change of the rest strains, in space only with a rate of these.
  Real work(const StrainChange<Real>& change) const { return tension * change.axial + moment * change.curvature; }
};

}  // namespace vlbeam
