#include <chrono>

#include "core/error.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/statics/equilibrium.hpp"
#include "scene/build.hpp"
#include "scene/initial_equilibrium.hpp"
#include "scene/run_support.hpp"
#include "scene/section_sample.hpp"
#include "scene/static_sample.hpp"

namespace vlbeam {
template <int D>
RunResult simulate_statics(const Scene& scene, const std::function<bool(double t)>& progress, const RunOutput& output) {
  BeamSystem<D> system(build_model<D>(scene), build_chain<D>(scene));
  const StaticsSpec& statics = scene.statics;
  const std::vector<PlaceSpec> places = resolved_places(scene);
  RunResult result;
  std::optional<Equilibrium> last;
  const auto started = std::chrono::steady_clock::now();
  const auto on_point = [&](const Equilibrium& at) {
    const auto number = static_cast<double>(result.samples.size());
    const OuterForces<D> forces = system.forces_at_rest(at.y, at.factor, at.links);
    Configuration shape = shape_of(scene, system, at.y, at.factor, forces);
    shape.t = number;
    result.samples.push_back(static_sample<D>(system, {at.y, at.factor, static_sample_of(at), at.holding}, number,
                                              scene, places, forces, shape));
    output.add(std::move(shape), result);
    last = at;
    const bool goes_on = !progress || progress(at.factor);
    if (!goes_on) result.status = RunStatus::interrupted;
    return goes_on;
  };
  try {
    if constexpr (has_room("statics")) {
      trace_equilibria<D>(system, equilibrium_options(scene), on_point, result.solver);
      if (last && statics.frequencies > 0) result.frequencies = natural_frequencies(system, *last, statics.frequencies);
    }
  } catch (const ComputationFailed& failure) {
    result.status = RunStatus::failed;
    result.failure = failure.what();
    result.failure_time = failure.t;
  }
  result.timing.motion = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return result;
}

template RunResult simulate_statics<2>(const Scene&, const std::function<bool(double)>&, const RunOutput&);
template RunResult simulate_statics<3>(const Scene&, const std::function<bool(double)>&, const RunOutput&);

}  // namespace vlbeam
