#pragma once

#include <functional>

#include "mechanics/time/checkpoint.hpp"
#include "scene/result.hpp"
#include "scene/run_output.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Called now and then with the simulated time reached [s]; returning false interrupts the run.
using ProgressCallback = std::function<bool(double t)>;

/// Build the model a scene describes and run it to its duration.
/// Throws InvalidInput for a scene that cannot be modelled; a computation that breaks down is reported in the
/// result's status, with everything computed until then.
///
/// `checkpoints`, if not null, says from which checkpoint of the same scene the run goes on, and when it leaves some:
/// see integrate(). The digits are those of a run that was never interrupted; shapes before it are handed on once more.
/// Not in statics.
RunResult simulate(const Scene& scene, const ProgressCallback& progress = {}, const Checkpoints* checkpoints = nullptr,
                   const RunOutput& output = {});

}  // namespace vlbeam
