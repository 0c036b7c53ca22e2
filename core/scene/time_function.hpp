#pragma once

#include <cmath>
#include <numbers>

#include "core/beam/mesh_motion.hpp"
#include "core/scene/scene.hpp"

namespace vlbeam {

/// The function that a scene describes, with its derivatives.
inline TimeFunction time_function(const TimeSpec& spec) {
  return [spec](double t) -> Prescribed {
    const double omega = 2 * std::numbers::pi * spec.frequency;
    const double angle = omega * t + spec.phase_degrees * (std::numbers::pi / 180);
    const double sine = spec.amplitude * std::sin(angle), cosine = spec.amplitude * std::cos(angle);
    const double value = spec.value + t * (spec.rate + t * spec.acceleration / 2) + sine;
    const double rate = spec.rate + t * spec.acceleration + omega * cosine;
    const double acceleration = spec.acceleration - omega * omega * sine;
    const Prescribed share = smooth_ramp(t, spec.ramp);
    return {share.value * value, share.rate * value + share.value * rate,
            share.acceleration * value + 2 * share.rate * rate + share.value * acceleration};
  };
}

}  // namespace vlbeam
