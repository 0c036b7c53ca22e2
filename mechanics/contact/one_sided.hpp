#pragma once

namespace vlbeam {

/// A spring that only pushes: at a depth p it gives k S(p), S = p^2/(2 d) for 0 < p < d, and p - d/2 from there on.
struct OneSided {
  double stiffness = 0;  ///< k
  double depth = 0;      ///< d, over which it sets in

  template <class Real>
  Real push(const Real& p) const {
    if (p < Real(0)) return Real(0);
    if (p < Real(depth)) return p * p * Real(stiffness / (2 * depth));
    return (p - Real(depth / 2)) * Real(stiffness);
  }
  /// S'(p): how much of it is there.
  template <class Real>
  Real share(const Real& p) const {
    if (p < Real(0)) return Real(0);
    return p < Real(depth) ? Real(p / Real(depth)) : Real(1);
  }
};

}  // namespace vlbeam
