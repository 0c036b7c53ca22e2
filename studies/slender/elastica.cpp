#include "studies/slender/elastica.hpp"

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <stdexcept>

#include "core/geometry/elementary.hpp"

namespace vlbeam::slender {
namespace {

constexpr int steps = 4000;
constexpr int most_iterations = 100;

/// x, y, theta, m along the beam.
using State = std::array<double, 4>;

double stretch(double EA, double EI, double moment, double along) {
  double nu = 1;
  for (int i = 0; i < most_iterations; ++i) {
    const double f = EA * nu * (nu * nu - 1) / 2 - moment * moment * nu / EI - along;
    const double change = f / (EA * (3 * nu * nu - 1) / 2 - moment * moment / EI);
    nu -= change;
    if (std::abs(change) < 1e-15) break;
  }
  return nu;
}

State shoot(double EA, double EI, double force, double moment) {
  const auto rate = [&](const State& at, State& out, double /*x*/) {
    const double c = portable::cos(at[2]), s = portable::sin(at[2]);
    const double nu = stretch(EA, EI, at[3], force * s);
    out = {nu * c, nu * s, at[3] * nu * nu / EI, -nu * force * c};
  };
  boost::numeric::odeint::runge_kutta4<State> method;
  State at{0, 0, 0, moment};
  for (int i = 0; i < steps; ++i) method.do_step(rate, at, static_cast<double>(i) / steps, 1.0 / steps);
  return at;
}

}  // namespace

Point end_of_elastica(double EA, double EI, double force) {
  // the moment at the clamp for which none is left at the end, by secants; it is at most the force times the length
  double m0 = 0.4 * force, m1 = 0.45 * force;
  double f0 = shoot(EA, EI, force, m0)[3];
  for (int i = 0; i < most_iterations; ++i) {
    const State at = shoot(EA, EI, force, m1);
    if (std::abs(at[3]) < 1e-11 * force) return {at[0], at[1], 0};
    const double next = m1 - at[3] * (m1 - m0) / (at[3] - f0);
    m0 = m1;
    f0 = at[3];
    m1 = next;
  }
  throw std::runtime_error("the elastica's moment at the clamp was not found");
}

}  // namespace vlbeam::slender
