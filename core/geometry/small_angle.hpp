#pragma once

#include <cmath>

#include "core/geometry/elementary.hpp"

namespace vlbeam {

template <class Real>
struct SineCosine {
  Real sine, cosine;
};

namespace small_angle {

constexpr double sine_below = 0.6, tangent_below = 0.1;

/// Sine and cosine of angles up to `sine_below`.
template <class Real>
SineCosine<Real> series(const Real& x) {
  const Real x2 = x * x;
  Real sine(1), cosine(1);
#pragma GCC unroll 8
  for (int n = 16; n > 0; n -= 2) {
    sine = Real(1) - x2 * sine * Real(1.0 / (n * (n + 1)));
    cosine = Real(1) - x2 * cosine * Real(1.0 / (n * (n - 1)));
  }
  return {Real(x * sine), cosine};
}

/// The angle whose tangent is z, up to `tangent_below`.
template <class Real>
Real angle_series(const Real& z) {
  const Real z2 = z * z;
  Real sum(0);
#pragma GCC unroll 9
  for (int n = 17; n > 0; n -= 2) sum = Real(1.0 / n) - z2 * sum;
  return z * sum;
}

}  // namespace small_angle

/// Of an angle that is small as a rule, by their series, which portable::sin and cos take ten times as long for.
inline SineCosine<double> sine_cosine(double x) {
  if (!(std::abs(x) < small_angle::sine_below)) return {portable::sin(x), portable::cos(x)};
  return small_angle::series(x);
}

/// The angle of (x, y), by its series where it is small.
inline double angle_of(double y, double x) {
  if (!(std::abs(y) < small_angle::tangent_below * x)) return portable::atan2(y, x);
  return small_angle::angle_series(y / x);
}

}  // namespace vlbeam
