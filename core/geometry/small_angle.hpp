#pragma once

#include <cmath>

#include "core/geometry/elementary.hpp"

namespace vlbeam {

template <class Real>
struct SineCosine {
  Real sine, cosine;
};

/// Of an angle that is small as a rule, by their series, which portable::sin and cos take ten times as long for.
inline SineCosine<double> sine_cosine(double x) {
  constexpr double small = 0.6;
  if (!(std::abs(x) < small)) return {portable::sin(x), portable::cos(x)};
  const double x2 = x * x;
  double sine = 1, cosine = 1;
  for (int n = 16; n > 0; n -= 2) {
    sine = 1 - x2 * sine / (n * (n + 1));
    cosine = 1 - x2 * cosine / (n * (n - 1));
  }
  return {x * sine, cosine};
}

/// The angle of (x, y), by its series where it is small.
inline double angle_of(double y, double x) {
  constexpr double small = 0.1;
  if (!(std::abs(y) < small * x)) return portable::atan2(y, x);
  const double z = y / x, z2 = z * z;
  double sum = 0;
  for (int n = 17; n > 0; n -= 2) sum = 1.0 / n - z2 * sum;
  return z * sum;
}

}  // namespace vlbeam
