#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Whether the scene's beam bears compression. By default a rope (EI = 0) does not; it does with the integrator
/// energy-momentum, which knows no rope that goes slack.
Compression compression(const Scene& scene);

/// Strain over which the scene's rope goes slack. By default three hundredths of what all weights and loads strain it,
/// together, but at most 1e-3; a 1e-6th of it where a rope is drawn unstrained and all that it bears grows from
/// nothing; 1e-9 where it bears nothing.
double slack_over(const Scene& scene);

/// Whether an end of the beam is bare: nothing holds it, and it bears no lumped mass and no force. A rope has no
/// tension there, and so no stiffness across its axis: strain that is sampled at its end alone would leave the end's
/// slope any direction.
bool has_bare_end(const Scene& scene);

}  // namespace vlbeam
