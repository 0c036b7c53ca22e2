// One event of length control: planar, a cut behind a sliding mass and a merge ahead of it, as time an event. No step
// is taken between two events: each one undoes the one before, at the same place of the mass.
#include <benchmark/benchmark.h>

#include <chrono>
#include <vector>

#include "bench/clamped_beam.hpp"
#include "scene/build.hpp"

namespace {

using namespace vlbeam;

/// Its mass has one and a half elements behind it, and half of one ahead.
Scene beam_at_an_event(int elements, VelocityTransfer velocities) {
  Scene scene = clamped_beam(elements, elements / 2 + 0.499);
  scene.sliding_mass->velocity = 1;  // that velocities have something to transfer
  scene.length_control.velocities = velocities;
  return scene;
}

/// Reads and writes more than the caches of a core hold, as a step of a long beam does.
void sweep_caches() {
  static std::vector<double> memory(8'000'000);
  for (double& each : memory) each += 1;
  benchmark::ClobberMemory();
}

void event(benchmark::State& state, VelocityTransfer velocities, bool cold) {
  using Clock = std::chrono::steady_clock;
  const Scene scene = beam_at_an_event(static_cast<int>(state.range(0)), velocities);
  BeamSystem<2> system(build_model<2>(scene), build_chain<2>(scene));
  Eigen::VectorXd y = system.initial_state();
  int guard = 0;  // of cutting behind a mass that moves forward; the next one is that of a mass that moves backward
  for (auto _ : state) {
    if (cold) sweep_caches();
    const auto started = Clock::now();
    system.handle_event(guard, y, 0);
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - started).count());
    guard = 1 - guard;
  }
}

void warm(benchmark::State& state, VelocityTransfer velocities) { event(state, velocities, false); }
void cold(benchmark::State& state, VelocityTransfer velocities) { event(state, velocities, true); }

void lengths(benchmark::internal::Benchmark* of) {
  for (const int elements : {40, 1000, 10000, 100000}) of->Arg(elements);
  of->UseManualTime()->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(warm, nodal, VelocityTransfer::nodal)->Apply(lengths);
BENCHMARK_CAPTURE(warm, projected, VelocityTransfer::projected)->Apply(lengths);
BENCHMARK_CAPTURE(warm, conservative, VelocityTransfer::conservative)->Apply(lengths);
BENCHMARK_CAPTURE(cold, projected, VelocityTransfer::projected)->Apply(lengths);

}  // namespace

BENCHMARK_MAIN();
