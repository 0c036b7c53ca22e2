#pragma once

#include <cmath>
#include <complex>

/// Elementary functions with the same digits on every x86-64 machine. The C library picks its `double` versions by the
/// processor (fused multiply-add or not), and they differ in the last place; of `long double` it has one version. So
/// each function is computed in `long double` and rounded once. Square roots are exact everywhere and stay std::sqrt.
/// A test of the build finds calls that go past this header.
namespace vlbeam::portable {

inline double sin(double x) { return static_cast<double>(std::sin(static_cast<long double>(x))); }
inline double cos(double x) { return static_cast<double>(std::cos(static_cast<long double>(x))); }
inline double tan(double x) { return static_cast<double>(std::tan(static_cast<long double>(x))); }
inline double asin(double x) { return static_cast<double>(std::asin(static_cast<long double>(x))); }
inline double acos(double x) { return static_cast<double>(std::acos(static_cast<long double>(x))); }
inline double atan2(double y, double x) {
  return static_cast<double>(std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
}
inline double cosh(double x) { return static_cast<double>(std::cosh(static_cast<long double>(x))); }
inline double tanh(double x) { return static_cast<double>(std::tanh(static_cast<long double>(x))); }
inline double asinh(double x) { return static_cast<double>(std::asinh(static_cast<long double>(x))); }
inline double exp(double x) { return static_cast<double>(std::exp(static_cast<long double>(x))); }
inline double log(double x) { return static_cast<double>(std::log(static_cast<long double>(x))); }
inline double log10(double x) { return static_cast<double>(std::log10(static_cast<long double>(x))); }
inline double cbrt(double x) { return static_cast<double>(std::cbrt(static_cast<long double>(x))); }
inline double pow(double x, double power) {
  return static_cast<double>(std::pow(static_cast<long double>(x), static_cast<long double>(power)));
}
inline double hypot(double x, double y) {
  return static_cast<double>(std::hypot(static_cast<long double>(x), static_cast<long double>(y)));
}
inline double hypot(double x, double y, double z) { return std::hypot(x, y, z); }  // by std::sqrt alone
inline double abs(const std::complex<double>& z) { return hypot(z.real(), z.imag()); }

}  // namespace vlbeam::portable
