#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/prescribed.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// The function that a scene describes, with its derivatives.
TimeFunction time_function(const TimeSpec& spec);

/// The same with tables read as those of motions are, unless it says how: smooth.
inline TimeSpec smooth_by_default(TimeSpec spec) {
  if (!spec.table.empty() && !spec.smooth) spec.smooth = true;
  return spec;
}

/// Throws InvalidInput where the parts of a function of time do not go together; `at` is its pointer.
void check_time_function(const std::string& at, const TimeSpec& spec);

inline bool is_zero(const TimeSpec& f) {
  const bool no_table = std::ranges::all_of(f.table, [](const Point& entry) { return entry[1] == 0; });
  const bool swings = f.amplitude != 0 && (f.frequency != 0 || f.phase_degrees != 0);
  return f.value == 0 && f.rate == 0 && f.acceleration == 0 && !swings && no_table;
}

/// Whether it never changes. What counts from t = 0 then does nothing.
inline bool is_constant(const TimeSpec& f) {
  TimeSpec change = f;
  change.value = 0;
  return is_zero(change) && f.ramp == 0 && f.rate_ramp == 0;
}

/// Bound of the rate of a function of time at t = 0, without its ramp. A rate far below it is rounding: that of a
/// cosine (a phase of 90 degrees) is not quite 0.
inline double largest_rate(const TimeSpec& f) { return std::abs(f.rate) + std::abs(f.amplitude * f.frequency); }

/// The steepest rate between two entries of its table [1/s]; 0 without a table.
double steepest(const TimeSpec& f);

/// A load of a scene, or a displacement of a support, as a function of time. In statics time is the load factor: it is
/// the value after all ramps, times the factor.
inline TimeFunction acting(const TimeSpec& spec, Analysis analysis) {
  return analysis == Analysis::statics ? steadily(0, spec.value) : time_function(spec);
}

/// The same for directions and places, which do not grow with the load factor.
inline TimeFunction beside_loads(const TimeSpec& spec, Analysis analysis) {
  return analysis == Analysis::statics ? steadily(spec.value, 0) : time_function(spec);
}

}  // namespace vlbeam
