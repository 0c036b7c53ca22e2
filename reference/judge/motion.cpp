#include "motion.hpp"

#include <boost/numeric/odeint.hpp>
#include <chrono>
#include <cmath>

#include "beam.hpp"

namespace judge {
namespace {

constexpr double unit = 0.01;  // of time, in which rates are counted [s]

}  // namespace

Motion move(const nlohmann::json& scene, const Level& level, const std::vector<double>& times) {
  namespace odeint = boost::numeric::odeint;
  const auto begun = std::chrono::steady_clock::now();
  Beam beam(scene, level.degrees, level.points, level.between);
  const std::size_t n = beam.unknowns();
  State y = beam.initial(), plain(2 * n);
  for (std::size_t i = n; i < 2 * n; ++i) y[i] *= unit;
  const auto in_seconds = [&](const State& scaled) {
    for (std::size_t i = 0; i < n; ++i) {
      plain[i] = scaled[i];
      plain[n + i] = scaled[n + i] / unit;
    }
  };
  const auto rates = [&](const State& scaled, State& out, double t) {
    in_seconds(scaled);
    beam.rates(plain, out, t);
    for (std::size_t i = n; i < 2 * n; ++i) out[i] *= unit;
  };
  in_seconds(y);
  const double before = beam.energies(plain, 0).total();

  Motion motion;
  motion.unknowns = n;
  motion.length = beam.length();
  const auto keep = [&](const State& scaled, double t) {
    in_seconds(scaled);
    std::vector<double> row;
    motion.names.clear();
    for (const auto& [name, value] : beam.quantities(plain, t)) {
      motion.names.push_back(name);
      row.push_back(value);
    }
    motion.values.push_back(row);
    motion.energy_drift = std::max(motion.energy_drift, std::abs(beam.energies(plain, t).total() - before));
  };
  std::vector<double> from_rest = {0};  // a motion starts at t = 0, whether that is wanted or not
  for (const double t : times) {
    if (t > 0) from_rest.push_back(t);
  }
  const double first = 1e-6, tolerance = level.tolerance;
  if (level.method == Method::fehlberg78) {
    motion.steps =
        odeint::integrate_times(odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(tolerance, tolerance),
                                rates, y, from_rest.begin(), from_rest.end(), first, keep);
  } else {
    motion.steps = odeint::integrate_times(odeint::bulirsch_stoer<State>(tolerance, tolerance), rates, y,
                                           from_rest.begin(), from_rest.end(), first, keep);
  }
  if (from_rest.size() > times.size()) motion.values.erase(motion.values.begin());
  motion.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return motion;
}

}  // namespace judge
