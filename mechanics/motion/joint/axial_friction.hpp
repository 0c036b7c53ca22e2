#pragma once

#include "core/geometry/elementary.hpp"

namespace vlbeam {

/// Coulomb friction, regularised: F = -coefficient N tanh(v/velocity), v = |r_x| x' and N the magnitude of the contact
/// force normal to the beam; around a kink of angle phi tensions T_+ = T_- e^(coefficient tanh(v/velocity) phi).
struct AxialFriction {
  double coefficient;      ///< mu
  double velocity = 1e-3;  ///< [m/s], below which friction fades

  /// Share of the normal force that resists the relative velocity `v` [m/s]: of its sign.
  template <class Real>
  Real share(const Real& v) const {
    using portable::tanh;
    return tanh(Real(v / velocity)) * coefficient;
  }
};

}  // namespace vlbeam
