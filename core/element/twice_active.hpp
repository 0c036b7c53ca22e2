#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/small_angle.hpp"

namespace vlbeam {

/// A number with its first and second derivatives by two variables, a and b.
class TwiceActive {
 public:
  double value, a = 0, b = 0, aa = 0, ab = 0, bb = 0;

  TwiceActive() = default;
  TwiceActive(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): a number is a constant
  TwiceActive(double value_, double a_, double b_, double aa_, double ab_, double bb_)
      : value(value_), a(a_), b(b_), aa(aa_), ab(ab_), bb(bb_) {}

  TwiceActive& operator+=(const TwiceActive& y) { return *this = *this + y; }
  TwiceActive& operator-=(const TwiceActive& y) { return *this = *this - y; }
  TwiceActive& operator*=(const TwiceActive& y) { return *this = *this * y; }
  TwiceActive& operator/=(const TwiceActive& y) { return *this = *this / y; }

  friend TwiceActive operator+(const TwiceActive& x, const TwiceActive& y) {
    return {x.value + y.value, x.a + y.a, x.b + y.b, x.aa + y.aa, x.ab + y.ab, x.bb + y.bb};
  }
  friend TwiceActive operator-(const TwiceActive& x, const TwiceActive& y) { return x + (-y); }
  friend TwiceActive operator-(const TwiceActive& x) { return {-x.value, -x.a, -x.b, -x.aa, -x.ab, -x.bb}; }
  friend TwiceActive operator*(const TwiceActive& x, const TwiceActive& y) {
    return {x.value * y.value,
            x.a * y.value + x.value * y.a,
            x.b * y.value + x.value * y.b,
            x.aa * y.value + 2 * x.a * y.a + x.value * y.aa,
            x.ab * y.value + x.a * y.b + x.b * y.a + x.value * y.ab,
            x.bb * y.value + 2 * x.b * y.b + x.value * y.bb};
  }
  friend TwiceActive operator/(const TwiceActive& x, const TwiceActive& y) {
    const double inverse = 1 / y.value, inverse2 = inverse * inverse;
    return x * y.chained(inverse, -inverse2, 2 * inverse2 * inverse);
  }
  friend bool operator<(const TwiceActive& x, const TwiceActive& y) { return x.value < y.value; }
  friend bool operator>(const TwiceActive& x, const TwiceActive& y) { return x.value > y.value; }
  friend bool operator==(const TwiceActive& x, const TwiceActive& y) { return x.value == y.value; }
  friend TwiceActive sqrt(const TwiceActive& x) {
    const double root = std::sqrt(x.value);
    return x.chained(root, 0.5 / root, -0.25 / (root * x.value));
  }
  /// A function of this number with these values of itself and its derivatives.
  TwiceActive chained(double of, double first, double second) const {
    return {of,
            first * a,
            first * b,
            first * aa + second * a * a,
            first * ab + second * a * b,
            first * bb + second * b * b};
  }
};

inline SineCosine<TwiceActive> sine_cosine(const TwiceActive& x) {
  const auto [sine, cosine] = sine_cosine(x.value);
  return {x.chained(sine, cosine, -sine), x.chained(cosine, -sine, -cosine)};
}

/// The angle of (x, y).
inline TwiceActive angle_of(const TwiceActive& y, const TwiceActive& x) {
  const double angle = angle_of(y.value, x.value), size = std::sqrt(x.value * x.value + y.value * y.value);
  // seen along (x, y) itself it is the arc tangent of a small number
  const double cosine = x.value / size, sine = y.value / size;
  const TwiceActive across = y * TwiceActive(cosine) - x * TwiceActive(sine);
  const TwiceActive along = x * TwiceActive(cosine) + y * TwiceActive(sine);
  TwiceActive small = across / along;  // 0, but for its derivatives: that of an arc tangent is 1, its second 0
  small.value = angle;
  return small;
}

}  // namespace vlbeam

/// @cond
template <>
struct Eigen::NumTraits<vlbeam::TwiceActive> : Eigen::NumTraits<double> {
  using Real = vlbeam::TwiceActive;
  using NonInteger = vlbeam::TwiceActive;
  using Nested = vlbeam::TwiceActive;
  using Literal = double;
  enum { RequireInitialization = 1 };
};
/// @endcond
