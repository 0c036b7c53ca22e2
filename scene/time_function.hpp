#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/prescribed.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// The function that a scene describes, with its derivatives.
TimeFunction time_function(const TimeSpec& spec);

/// Throws InvalidInput where the parts of a function of time do not go together; `at` is its pointer.
void check_time_function(const std::string& at, const TimeSpec& spec);

inline bool is_zero(const TimeSpec& f) {
  const bool no_table = std::ranges::all_of(f.table, [](const Point& entry) { return entry[1] == 0; });
  return f.value == 0 && f.rate == 0 && f.acceleration == 0 && f.amplitude == 0 && no_table;
}

/// What the rate of a function of time may be at t = 0, but for its ramp: a cosine, of phase 90 degrees, has a rate of
/// rounding.
inline double largest_rate(const TimeSpec& f) { return std::abs(f.rate) + std::abs(f.amplitude * f.frequency); }

/// Of the rates between the entries of its table [1/s], and the shortest time between two [s]; 0 without one.
double steepest(const TimeSpec& f);
double shortest_interval(const TimeSpec& f);

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
