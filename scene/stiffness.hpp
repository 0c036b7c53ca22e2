#pragma once

#include <optional>
#include <string>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Bound of the beam's angular frequencies at t = 0 [rad/s]: the largest of one element of mean length with free ends,
/// along the axis sqrt(170.1 EA/rhoA)/l, or in bending sqrt(8400 EI/rhoA)/l^2, by consistent masses.
double largest_frequency(const Scene& scene);

/// The same as it is in the mean of a run [rad/s]: where a joint, or what is fed, passes through the beam, the elements
/// there get shorter than the mean length L_std, down to a = 2 - upper (1 + hysteresis) of it. In passing the shorter
/// one takes all lengths from a L_std to L_std for equal times: means of 1/l and of 1/l^2 are ln(1/a)/(1 - a) and 1/a
/// times those of L_std, 1.39 and 2.0 by default. What bends stiffly (EI large against EA l^2/50) feels the latter.
double mean_largest_frequency(const Scene& scene);

/// Where an explicit run has taken many steps, and stability, not accuracy, made them as short as they are.
std::optional<Warning> stability_warning(const Scene& scene, const RunResult& result);

/// What makes the steps of a run short, `step` [s] in the mean, and what would help; empty where nothing is known to.
std::string why_slow(const Scene& scene, double step);

}  // namespace vlbeam
