#include "tools/rigid_wire.hpp"

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>

#include "core/geometry/elementary.hpp"
#include "core/geometry/prescribed.hpp"

namespace vlbeam {

std::vector<double> on_rigid_arc(const Scene& scene, const std::vector<double>& times) {
  using State = std::array<double, 2>;
  constexpr double longest_step = 5e-4;  // [s]: order 8, and the motion takes tenths of a second
  const double R = scene.beam.curve.radius, g = -scene.gravity[1];
  const auto rate = [&](const State& at, State& out, double t) {
    out = {at[1], g / R * smooth_ramp(t, scene.gravity_ramp).value * portable::cos(at[0])};
  };
  boost::numeric::odeint::runge_kutta_fehlberg78<State> method;
  State angle{scene.sliding_mass->position / R, 0};
  std::vector<double> lengths;
  double t = 0;
  for (const double until : times) {
    const double steps = std::ceil((until - t) / longest_step);
    for (double i = 0; i < steps; ++i) method.do_step(rate, angle, t + i * (until - t) / steps, (until - t) / steps);
    t = until;
    lengths.push_back(R * angle[0]);
  }
  return lengths;
}

}  // namespace vlbeam
