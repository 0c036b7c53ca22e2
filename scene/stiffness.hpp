#pragma once

#include <optional>
#include <string>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Bound of the beam's angular frequencies at t = 0 [rad/s]: the largest of one element of mean length l with free ends
/// and consistent masses. Along the axis it is sqrt(170.1 EA/rhoA)/l, in bending sqrt(8400 EI/rhoA)/l^2.
double largest_frequency(const Scene& scene);

/// Its mean over a run [rad/s]. Elements beside a joint or a feed that passes get shorter than the mean length L_std,
/// down to a L_std, a = 2 - upper (1 + hysteresis). In passing, the shorter one takes all lengths from a L_std to L_std
/// for equal times. So the means of 1/l and 1/l^2 are ln(1/a)/(1 - a) and 1/a times those of L_std, 1.39 and 2.0 by
/// default. The second holds for beams that are stiff in bending (EI large against EA l^2/50).
double mean_largest_frequency(const Scene& scene);

/// Warns where an explicit run has taken many steps because of stability, not of accuracy.
std::optional<Warning> stability_warning(const Scene& scene, const RunResult& result);

/// Why the steps of a run are short, `step` [s] in the mean, and what would help; empty if nothing is known to help.
std::string why_slow(const Scene& scene, double step);

}  // namespace vlbeam
