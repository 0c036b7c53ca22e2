#include "studies/rotating_load/closed_form.hpp"

#include <cmath>
#include <numbers>

namespace vlbeam {
namespace {

using namespace std::complex_literals;
constexpr int modes = 400;  // amplitudes fall with the fourth power
constexpr double pi = std::numbers::pi;

/// Of q'' + natural^2 q = exp(i nu t), at rest at t = 0.
std::complex<double> response(double natural, double nu, double t) {
  const std::complex<double> forced = std::exp(1i * nu * t);
  if (std::abs(std::abs(nu) - natural) < 1e-9 * natural) {
    return (t * forced - std::sin(natural * t) / natural) / (2i * nu);
  }
  return (forced - std::cos(natural * t) - 1i * nu / natural * std::sin(natural * t)) / (natural * natural - nu * nu);
}

}  // namespace

std::complex<double> closed_form(const RotatingLoad& set, double load, double z) {
  const double omega = 2 * pi * set.k_omega;
  std::complex<double> sum = 0;
  for (int n = 1; n <= modes; ++n) {
    const double natural = n * n * pi / set.a, passing = n * pi;
    const auto q = (response(natural, omega + passing, load) - response(natural, omega - passing, load)) / 1i;
    sum += q * std::sin(passing * z);
  }
  return sum * 48.0 / (pi * set.a * pi * set.a);
}

}  // namespace vlbeam
