#pragma once

#include <functional>

#include "core/scene/result.hpp"
#include "core/scene/scene.hpp"

namespace vlbeam {

/// Called now and then with the simulated time reached [s]; returning false interrupts the run.
using ProgressCallback = std::function<bool(double t)>;

/// Build the model a scene describes and run it to its duration.
/// Throws InvalidInput for a scene that cannot be modelled; a computation that breaks down is reported in the
/// result's status, with everything computed until then.
RunResult simulate(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace vlbeam
