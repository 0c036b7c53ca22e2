#pragma once

#include <algorithm>
#include <limits>

namespace vlbeam {

/// x between two bounds.
inline double clamped(double x, double low, double high) { return std::clamp(x, low, high); }

/// A rope that bears no compression, over its stiffness EA: it pulls with psi'(eps), and stores psi(eps) a length. Over
/// the strain d it goes slack smoothly,
///   psi'' = 1/2 + s (3 - s^2)/4,  s = eps/d between -1 and 1,
/// so that psi' is 0 below -d and eps above d. `Real` needs `clamped`. Derived: docs/theory/equations.md, Slack ropes.
template <class Real>
struct SlackLaw {
  Real energy, pull, stiffness;  ///< psi, psi', psi''

  SlackLaw(const Real& eps, double d) {
    const Real s = clamped(eps * Real(1 / d), -1, 1), s2 = s * s;
    const Real taut = clamped(eps - Real(d), 0, std::numeric_limits<double>::max());  // beyond s = 1
    stiffness = Real(0.5) + Real(0.25) * s * (Real(3) - s2);
    pull = Real(d) * (Real(3.0 / 16) + s * (Real(0.5) + s * (Real(0.375) - s2 * Real(1.0 / 16)))) + taut;
    energy =
        Real(d * d) * (Real(0.05) + s * (Real(3.0 / 16) + s * (Real(0.25) + s * (Real(0.125) - s2 * Real(1.0 / 80))))) +
        taut * (Real(d) + Real(0.5) * taut);
  }
};

}  // namespace vlbeam
