#pragma once

#include <functional>
#include <utility>

#include "scene/scene.hpp"

namespace vlbeam {

/// Checks the ends of a scene through which the beam is fed. Throws InvalidInput.
void validate_feeds(const Scene& scene);

/// The rate at which the beam comes in through a fed end at t = 0 [m/s].
double feed_rate(const SupportSpec& end);

/// Material coordinates of the first and the last point of the beam as functions of time [m].
std::function<std::pair<double, double>(double t)> beam_ends(const Scene& scene);

}  // namespace vlbeam
