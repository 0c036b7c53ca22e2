#pragma once

namespace vlbeam::event_limits {

inline constexpr double clearance = 1e-11;  // of L_std: by which a mass leaves a support, so that the guard is negative
inline constexpr double least_bounce = 1e-9;  // of L_std: a lower one is the last
inline constexpr double same_instant = 1e-9;  // of L_std: what is this near is due at once
inline constexpr double merge_slack = 1e-6;   // of the length below which is merged: a cut comes first

// On either side of a joint, in the part of a beam that an event looks at: behind them what it does to velocities is
// 0.28^32 = 2e-18 of what it is at the joint, with elements of equal length, and less with others.
inline constexpr int elements_beside = 32;

}  // namespace vlbeam::event_limits
