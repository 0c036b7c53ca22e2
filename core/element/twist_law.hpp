#pragma once

#include "core/element/strain.hpp"

namespace vlbeam {

// The section's angle theta is a field of one component over the same moving elements as the axis: what the axis does
// with EA, rhoA and the stretch it does with G I_p, rho I_p and the twist theta_x, to which its strain energy
// G I_p theta_x^2/2 is a parabola.

template <class Real>
struct ElasticStress<Real, 1> {
  Vec<Real, 1> p, m;
  Real axial, bending;

  ElasticStress(const Vec<Real, 1>& twist, const Vec<Real, 1>& /*twist_x*/, const Stiffness& k)
      : p(twist * Real(k.EA)), m(Vec<Real, 1>::Zero()), axial(Real(0.5) * p.dot(twist)), bending(0) {}
};

template <class Real>
struct DampingStress<Real, 1> {
  Vec<Real, 1> p, m;
  Real power;

  DampingStress(const Vec<Real, 1>& /*twist*/, const Vec<Real, 1>& /*twist_x*/, const Vec<Real, 1>& twist_rate,
                const Vec<Real, 1>& /*twist_rate_x*/, const Stiffness& k, double c, double /*regularization*/,
                const StrainChange<Real>* /*rest*/ = nullptr)
      : p(twist_rate * Real(c * k.EA)), m(Vec<Real, 1>::Zero()), power(p.dot(twist_rate)) {}

  Real work(const StrainChange<Real>& change) const { return p[0] * change.axial; }
};

}  // namespace vlbeam
