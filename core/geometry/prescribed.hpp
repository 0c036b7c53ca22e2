#pragma once

#include <functional>

namespace vlbeam {

/// A quantity that is given as a function of time, with its first two derivatives.
struct Prescribed {
  double value = 0, rate = 0, acceleration = 0;
};
/// It may remember what it was asked last: threads do not share one.
using TimeFunction = std::function<Prescribed(double t)>;

/// value + rate t.
inline TimeFunction steadily(double value, double rate) {
  return [=](double t) { return Prescribed{value + rate * t, rate, 0}; };
}

/// What grows smoothly from 0 to 1 within `duration` [s]: S(t/duration), S(s) = s^4 (35 - 84 s + 70 s^2 - 20 s^3), with
/// three continuous derivatives; 0 before and 1 behind, and so a step at t = 0 where the duration is 0.
inline Prescribed smooth_ramp(double t, double duration) {
  if (t >= duration) return {1, 0, 0};
  if (t <= 0) return {0, 0, 0};
  const double s = t / duration, v = s * (1 - s);
  return {s * s * s * s * (35 + s * (-84 + s * (70 - 20 * s))), 140 * v * v * v / duration,
          420 * v * v * (1 - 2 * s) / (duration * duration)};
}

}  // namespace vlbeam
