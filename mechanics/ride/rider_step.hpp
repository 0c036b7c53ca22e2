#pragma once

#include <cmath>

#include "mechanics/conserving/discrete_gradient.hpp"
#include "mechanics/ride/rider.hpp"

namespace vlbeam {

/// Residual of one step of length h for a rider, as conserving_residual() has it for an element: (p_1 - p_0)/h - f with
/// p = m N^T r' and f the discrete gradient in q = (e, x) of m (N v_0).(N v_1)/2 + m g.r, N = [S(x), r_x]. All of it is
/// bilinear in e and in functions of x, whose divided differences make f exact for any two states.
template <int D>
RiderForce<double, D> conserving_rider(const RiderElement& element, const TwoStates<NodalCubic<double, D>>& e,
                                       const TwoStates<NodalCubic<double, D>>& rate, const TwoStates<double>& x,
                                       const TwoStates<double>& x_rate, double h, double mass,
                                       const Vec<double, D>& gravity, bool held) {
  using Vector = Vec<double, D>;
  using Shape = std::array<double, 4>;
  constexpr double near = 1e-6;  // of the element: a derivative is then the better difference
  auto combine = [](const Shape& s, const NodalCubic<double, D>& c) { return combine_nodes<double, D>(s, c); };
  const auto s0 = rider_shape(element, x.before), s1 = rider_shape(element, x.after);
  const double dx = x.after - x.before;
  const bool close = std::abs(dx) < near * element.length;
  const auto middle = rider_shape(element, x.mean());
  auto mean_of = [&](std::size_t n) {
    Shape s;
    for (std::size_t i = 0; i < 4; ++i) s[i] = (s0[n][i] + s1[n][i]) / 2;
    return s;
  };
  auto difference_of = [&](std::size_t n) {
    Shape s;
    for (std::size_t i = 0; i < 4; ++i) s[i] = close ? middle[n + 1][i] : (s1[n][i] - s0[n][i]) / dx;
    return s;
  };
  const Shape s = mean_of(0), s_x = mean_of(1), by_x = difference_of(0), slope_by_x = difference_of(1);

  const Vector slope0 = combine(s0[1], e.before), slope1 = combine(s1[1], e.after);
  // velocities of the mass in a configuration (0, 1), with the rates of the state before (a) or after (b)
  const Vector a0 = combine(s0[0], rate.before) + slope0 * x_rate.before,
               a1 = combine(s1[0], rate.before) + slope1 * x_rate.before,
               b0 = combine(s0[0], rate.after) + slope0 * x_rate.after,
               b1 = combine(s1[0], rate.after) + slope1 * x_rate.after;
  const Vector f_a = mass / 2 * mean(b0, b1), f_b = mass / 2 * mean(a0, a1), f_r = mass * gravity;
  const Vector f_slope = f_a * x_rate.before + f_b * x_rate.after;
  const Vector slope_change = (combine(slope_by_x, e.before) + combine(slope_by_x, e.after)) / 2;
  const Vector change = (combine(by_x, e.before) + combine(by_x, e.after)) / 2;

  RiderForce<double, D> r;
  r.dissipation = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    r.nodes[i] = (s1[0][i] * b1 - s0[0][i] * a0) * (mass / h) - (f_slope * s_x[i] + f_r * s[i]);
  }
  if (held) {
    r.x = mass * (x_rate.after - x_rate.before) / h;
    return r;
  }
  r.x = mass / h * (slope1.dot(b1) - slope0.dot(a0)) - f_a.dot(combine(by_x, rate.before)) -
        f_b.dot(combine(by_x, rate.after)) - f_slope.dot(slope_change) - f_r.dot(change);
  return r;
}

}  // namespace vlbeam
