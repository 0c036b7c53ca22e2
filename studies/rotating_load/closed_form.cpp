#include "studies/rotating_load/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/elementary.hpp"

namespace vlbeam {
namespace {

using namespace std::complex_literals;
constexpr int modes = 400;  // amplitudes fall with the fourth power
constexpr double pi = std::numbers::pi;

std::complex<double> turned(double angle) { return {portable::cos(angle), portable::sin(angle)}; }  // exp(i angle)

/// (exp(i a t) - exp(i b t))/(a - b), also where a and b meet.
std::complex<double> difference(double a, double b, double t) {
  if (std::abs(a - b) < 1e-9 * std::max(std::abs(a), std::abs(b))) return 1i * t * turned(a * t);
  return (turned(a * t) - turned(b * t)) / (a - b);
}

/// One mode: m q'' - i g q' + k q.
struct Mode {
  double m, g, k;

  /// Of  m q'' - i g q' + k q = exp(i nu t), at rest at t = 0.
  std::complex<double> response(double nu, double t) const {
    const double root = std::sqrt(g * g + 4 * m * k);
    double near = (g + root) / (2 * m), far = (g - root) / (2 * m);
    if (std::abs(nu - far) < std::abs(nu - near)) std::swap(near, far);
    return (difference(near, far, t) - difference(nu, near, t)) / (m * (nu - far));
  }
};

}  // namespace

std::complex<double> closed_form(const RotatingLoad& set, double load, double z) {
  const double omega = 2 * pi * set.k_omega;
  std::complex<double> sum = 0;
  for (int n = 1; n <= modes; ++n) {
    const double natural = n * n * pi / set.a, passing = n * pi;
    const double turning = portable::pow(set.slenderness * passing / 2, 2);  // J k^2/A
    const Mode mode{1 + turning, 2 * turning * set.spin, natural * natural};
    const auto q = (mode.response(omega + passing, load) - mode.response(omega - passing, load)) / 1i;
    sum += q * portable::sin(passing * z);
  }
  return sum * 48.0 / (pi * set.a * pi * set.a);
}

}  // namespace vlbeam
