#pragma once

namespace vlbeam::event_limits {

inline constexpr double clearance = 1e-11;  // of L_std: by which a mass leaves a support, so that the guard is negative
inline constexpr double least_bounce = 1e-9;  // of L_std: a lower one is the last
inline constexpr double same_instant = 1e-9;  // of L_std: what is this near is due at once
inline constexpr double merge_margin = 1e-6;  // of the length below which is merged: a cut comes first

// On either side of a joint, in the part of a beam that an event looks at. What it does to velocities falls by 0.28 an
// element where all are of equal length, by up to 0.47 where their weights are a hundred to one: to 2e-16.
inline constexpr int elements_beside = 48;

}  // namespace vlbeam::event_limits
