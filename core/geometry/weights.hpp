#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace vlbeam {

/// The four Bezier weights of a rational cubic; equivalently the cubic weight function W in Bernstein form.
template <class Real>
using Weights = std::array<Real, 4>;

inline constexpr Weights<double> unit_weights{1, 1, 1, 1};

/// Whether the cubic is a polynomial, or next to one: what is merged of a straight beam has weights of 1 but for
/// rounding.
inline bool nearly_unit(const Weights<double>& w) {
  return std::ranges::all_of(w, [](double weight) { return std::abs(weight - 1) < 1e-6; });
}

/// Blossom of the cubic with Bernstein coefficients `c`, at the arguments (s, t, u).
/// Works for any coefficient type with a linear structure (weights or homogeneous points), inside [0, 1] or beyond.
template <class Coefficient, class Real>
Coefficient blossom(const std::array<Coefficient, 4>& c, const Real& s, const Real& t, const Real& u) {
  auto lerp = [](const Coefficient& a, const Coefficient& b, const Real& p) -> Coefficient {
    return a * (Real(1) - p) + b * p;
  };
  const Coefficient a0 = lerp(c[0], c[1], s), a1 = lerp(c[1], c[2], s), a2 = lerp(c[2], c[3], s);
  const Coefficient b0 = lerp(a0, a1, t), b1 = lerp(a1, a2, t);
  return lerp(b0, b1, u);
}

/// Bernstein coefficients of the same cubic on the interval [a, b] of its parameter (de Casteljau restriction).
template <class Coefficient, class Real>
std::array<Coefficient, 4> restrict_cubic(const std::array<Coefficient, 4>& c, const Real& a, const Real& b) {
  return {blossom(c, a, a, a), blossom(c, a, a, b), blossom(c, a, b, b), blossom(c, b, b, b)};
}

}  // namespace vlbeam
