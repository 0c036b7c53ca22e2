#pragma once

#include <cmath>
#include <complex>

/// Elementary functions with the same digits on every x86-64 machine. The C library picks its `double` versions by the
/// processor (fused multiply-add or not), and they differ in the last place. Of `long double` it has one version each,
/// but most of these end in instructions of the x87, whose last bits differ between makers: only sines, cosines,
/// tangents, arc sines, cube roots and hypotenuses are sums and products of their own. All others but tanh are computed
/// in quadruple precision, in software, and rounded once (0.6 to 1.8 us). Square roots are exact everywhere and stay
/// std::sqrt. A test of the build finds calls that go past this header.
namespace vlbeam::portable {

namespace wide {

#if defined(__x86_64__) && defined(__GLIBC__)
__extension__ using Real = __float128;
extern "C" {
Real acosf128(Real) noexcept;
Real atan2f128(Real, Real) noexcept;
Real coshf128(Real) noexcept;
Real asinhf128(Real) noexcept;
Real expf128(Real) noexcept;
Real logf128(Real) noexcept;
Real log10f128(Real) noexcept;
Real powf128(Real, Real) noexcept;
}
inline Real acos(Real x) { return acosf128(x); }
inline Real atan2(Real y, Real x) { return atan2f128(y, x); }
inline Real cosh(Real x) { return coshf128(x); }
inline Real asinh(Real x) { return asinhf128(x); }
inline Real exp(Real x) { return expf128(x); }
inline Real log(Real x) { return logf128(x); }
inline Real log10(Real x) { return log10f128(x); }
inline Real pow(Real x, Real power) { return powf128(x, power); }
#else
using Real = long double;
using std::acos, std::atan2, std::cosh, std::asinh, std::exp, std::log, std::log10, std::pow;
#endif

}  // namespace wide

inline double sin(double x) { return static_cast<double>(std::sin(static_cast<long double>(x))); }
inline double cos(double x) { return static_cast<double>(std::cos(static_cast<long double>(x))); }
inline double tan(double x) { return static_cast<double>(std::tan(static_cast<long double>(x))); }
inline double asin(double x) { return static_cast<double>(std::asin(static_cast<long double>(x))); }
inline double acos(double x) { return static_cast<double>(wide::acos(wide::Real(x))); }
inline double atan2(double y, double x) { return static_cast<double>(wide::atan2(wide::Real(y), wide::Real(x))); }
inline double cosh(double x) { return static_cast<double>(wide::cosh(wide::Real(x))); }
inline double asinh(double x) { return static_cast<double>(wide::asinh(wide::Real(x))); }
inline double exp(double x) { return static_cast<double>(wide::exp(wide::Real(x))); }
inline double log(double x) { return static_cast<double>(wide::log(wide::Real(x))); }
inline double log10(double x) { return static_cast<double>(wide::log10(wide::Real(x))); }
inline double cbrt(double x) { return static_cast<double>(std::cbrt(static_cast<long double>(x))); }
inline double pow(double x, double power) { return static_cast<double>(wide::pow(wide::Real(x), wide::Real(power))); }
inline double hypot(double x, double y) {
  return static_cast<double>(std::hypot(static_cast<long double>(x), static_cast<long double>(y)));
}
/// Sums and products: Lambert's continued fraction, and tanh 2x = 2 tanh x/(1 + tanh^2 x). Friction asks for it at
/// every evaluation. To 1e-15 of its value.
inline double tanh(double x) {
  if (std::abs(x) > 20) return x > 0 ? 1 : -1;
  int doublings = 0;
  for (; std::abs(x) > 0.25; x /= 2) ++doublings;
  const double z = x * x;
  double value = x / (1 + z / (3 + z / (5 + z / (7 + z / (9 + z / 11)))));
  for (; doublings > 0; --doublings) value = 2 * value / (1 + value * value);
  return value;
}
inline double hypot(double x, double y, double z) { return std::hypot(x, y, z); }  // by std::sqrt alone
inline double abs(const std::complex<double>& z) { return hypot(z.real(), z.imag()); }

}  // namespace vlbeam::portable
