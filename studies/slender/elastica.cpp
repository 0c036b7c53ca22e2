#include "studies/slender/elastica.hpp"

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <stdexcept>

#include "core/geometry/elementary.hpp"

namespace vlbeam::slender {
namespace {

constexpr int steps = 7680;  // a multiple of the points of all meshes
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

/// States from the clamp to the end.
std::vector<State> shoot(double EA, double EI, double force, double moment) {
  const auto rate = [&](const State& at, State& out, double /*x*/) {
    const double c = portable::cos(at[2]), s = portable::sin(at[2]);
    const double nu = stretch(EA, EI, at[3], force * s);
    out = {nu * c, nu * s, at[3] * nu * nu / EI, -nu * force * c};
  };
  boost::numeric::odeint::runge_kutta4<State> method;
  std::vector<State> states{{0, 0, 0, moment}};
  State at = states.front();
  for (int i = 0; i < steps; ++i) {
    method.do_step(rate, at, static_cast<double>(i) / steps, 1.0 / steps);
    states.push_back(at);
  }
  return states;
}

}  // namespace

Elastica elastica(double EA, double EI, double force) {
  // the moment at the clamp for which none is left at the end, by secants; it is at most the force times the length
  double m0 = 0.4 * force, m1 = 0.45 * force;
  double f0 = shoot(EA, EI, force, m0).back()[3];
  for (int i = 0; i < most_iterations; ++i) {
    const std::vector<State> states = shoot(EA, EI, force, m1);
    const State& end = states.back();
    if (std::abs(end[3]) < 1e-11 * force) {
      Elastica result{{end[0], end[1], 0}, {}};
      for (const State& at : states) {
        const double nu = stretch(EA, EI, at[3], force * portable::sin(at[2]));
        result.slopes.push_back({nu * portable::cos(at[2]), nu * portable::sin(at[2]), 0});
      }
      return result;
    }
    const double next = m1 - end[3] * (m1 - m0) / (end[3] - f0);
    m0 = m1;
    f0 = end[3];
    m1 = next;
  }
  throw std::runtime_error("the elastica's moment at the clamp was not found");
}

double slope_error(const Elastica& exact, const std::vector<ShapePoint>& points, int per_element) {
  const double intervals = static_cast<double>(exact.slopes.size() - 1);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int in_element = static_cast<int>(i) % (per_element + 1);
    const double share = in_element == 0 || in_element == per_element ? 1 : in_element % 2 == 1 ? 4 : 2;
    const Point& known = exact.slopes[static_cast<std::size_t>(std::lround(points[i].x * intervals))];
    const double dx = points[i].r_x[0] - known[0], dy = points[i].r_x[1] - known[1];
    sum += share * (dx * dx + dy * dy);
  }
  const double elements = static_cast<double>(points.size()) / (per_element + 1);
  return std::sqrt(sum / (3 * per_element * elements));
}

}  // namespace vlbeam::slender
