#pragma once

#include <functional>

#include "core/dynamics/checkpoint.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Called now and then with the simulated time reached [s]; returning false interrupts the run.
using ProgressCallback = std::function<bool(double t)>;

/// Build the model a scene describes and run it to its duration.
/// Throws InvalidInput for a scene that cannot be modelled; a computation that breaks down is reported in the
/// result's status, with everything computed until then.
///
/// `checkpoints`, where it is not null, says from which checkpoint of the same scene the run goes on, with the digits
/// of one that was never interrupted, and when it leaves some: see integrate(). Not in statics.
RunResult simulate(const Scene& scene, const ProgressCallback& progress = {}, const Checkpoints* checkpoints = nullptr);

}  // namespace vlbeam
