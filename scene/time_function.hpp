#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "core/geometry/prescribed.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// The function that a scene describes, with its derivatives.
inline TimeFunction time_function(const TimeSpec& spec) {
  const auto function = [spec](double t) -> Prescribed {
    const double omega = 2 * std::numbers::pi * spec.frequency;
    const double angle = omega * t + spec.phase_degrees * (std::numbers::pi / 180);
    const double sine = spec.amplitude * portable::sin(angle), cosine = spec.amplitude * portable::cos(angle);
    const double value = spec.value + t * (spec.rate + t * spec.acceleration / 2) + sine;
    const double rate = spec.rate + t * spec.acceleration + omega * cosine;
    const double acceleration = spec.acceleration - omega * omega * sine;
    const Prescribed share = smooth_ramp(t, spec.ramp);
    return {share.value * value, share.rate * value + share.value * rate,
            share.acceleration * value + 2 * share.rate * rate + share.value * acceleration};
  };
  if (!spec.until) return function;
  return [function, until = *spec.until](double t) -> Prescribed {
    if (t < until) return function(t);
    const Prescribed then = function(until);
    return {then.value + then.rate * (t - until), then.rate, 0};
  };
}

inline bool is_zero(const TimeSpec& f) {
  return f.value == 0 && f.rate == 0 && f.acceleration == 0 && f.amplitude == 0;
}

/// What the rate of a function of time may be at t = 0, but for its ramp: a cosine, of phase 90 degrees, has a rate of
/// rounding.
inline double largest_rate(const TimeSpec& f) { return std::abs(f.rate) + std::abs(f.amplitude * f.frequency); }

/// What a scene's load, or a displacement of its support, is as time goes on; in statics, where time is the load
/// factor, what is there after all ramps, times that.
inline TimeFunction acting(const TimeSpec& spec, Analysis analysis) {
  return analysis == Analysis::statics ? steadily(0, spec.value) : time_function(spec);
}

/// What of it does not grow with the load factor: directions and places.
inline TimeFunction beside_loads(const TimeSpec& spec, Analysis analysis) {
  return analysis == Analysis::statics ? steadily(spec.value, 0) : time_function(spec);
}

}  // namespace vlbeam
