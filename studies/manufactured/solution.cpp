#include "studies/manufactured/solution.hpp"

#include <array>
#include <boost/math/differentiation/autodiff.hpp>
#include <cmath>

#include "core/geometry/elementary.hpp"

namespace vlbeam::manufactured {

ChosenMotion ChosenMotion::from_json(const Json& waves) {
  std::vector<Wave> result;
  for (const Json& wave : waves) {
    const auto amplitude = wave.at("amplitude").get<std::array<double, 2>>();
    result.push_back({{amplitude[0], amplitude[1]}, wave.at("k"), wave.at("w"), wave.at("phase")});
  }
  return ChosenMotion(std::move(result));
}

Vector ChosenMotion::derivative(double x, double t, int by_x, int by_t) const {
  Vector sum = Vector::Zero();
  if (by_t == 0 && by_x == 0) sum[0] = x;
  if (by_t == 0 && by_x == 1) sum[0] = 1;
  for (const Wave& wave : waves_) {
    const double phase = wave.k * x + wave.w * t + wave.phase;
    const int turns = (by_x + by_t) % 4;  // each derivative turns it by a quarter
    const double value = turns % 2 == 0 ? portable::sin(phase) : portable::cos(phase);
    double factor = turns < 2 ? 1 : -1;
    for (int i = 0; i < by_x; ++i) factor *= wave.k;
    for (int i = 0; i < by_t; ++i) factor *= wave.w;
    sum += factor * value * wave.amplitude;
  }
  return sum;
}

namespace {

/// A number with two derivatives by x and one by a component of r_x or r_xx.
using Series = boost::math::differentiation::autodiff_fvar<double, 2, 1>;

Series energy(const Properties& of, const std::array<Series, 4>& r) {
  const Series stretch2 = r[0] * r[0] + r[1] * r[1];
  const Series strain = (stretch2 - 1) / 2;
  const Series bend = (r[0] * r[3] - r[1] * r[2]) / (stretch2 * sqrt(stretch2)) - of.rest_curvature;
  return of.EA / 2 * strain * strain + of.EI / 2 * bend * bend;
}

}  // namespace

Forces::Resultants Forces::resultants(double x, double t) const {
  const auto variables = boost::math::differentiation::make_ftuple<double, 2, 1>(0.0, 0.0);
  const Series ahead = std::get<0>(variables) + 0 * std::get<1>(variables);
  const Series change = 0 * std::get<0>(variables) + std::get<1>(variables);
  std::array<Series, 4> r;
  for (int order = 0; order < 2; ++order) {
    const Vector at = motion_.derivative(x, t, order + 1), slope = motion_.derivative(x, t, order + 2),
                 bend = motion_.derivative(x, t, order + 3);
    for (int c = 0; c < 2; ++c) {
      r[static_cast<std::size_t>(2 * order + c)] = at[c] + slope[c] * ahead + bend[c] / 2 * ahead * ahead;
    }
  }
  Resultants result;
  for (int c = 0; c < 2; ++c) {
    auto by_slope = r, by_bend = r;
    by_slope[static_cast<std::size_t>(c)] += change;
    by_bend[static_cast<std::size_t>(c + 2)] += change;
    const Series n = energy(of_, by_slope), m = energy(of_, by_bend);
    result.n[c] = n.derivative(0, 1);
    result.n_x[c] = n.derivative(1, 1);
    result.m[c] = m.derivative(0, 1);
    result.m_x[c] = m.derivative(1, 1);
    result.m_xx[c] = m.derivative(2, 1);
  }
  return result;
}

Vector Forces::body(double x, double t) const {
  const Resultants of = resultants(x, t);
  return of_.rhoA * motion_.derivative(x, t, 0, 2) - of.n_x + of.m_xx;
}

Forces::Cut Forces::cut(double x, double t) const {
  const Resultants of = resultants(x, t);
  return {of.n - of.m_x, of.m};
}

}  // namespace vlbeam::manufactured
