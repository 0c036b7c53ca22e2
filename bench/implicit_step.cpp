// One step of generalized-alpha on the falling beam with a new tangent, as time an element: planar, 5 points.
#include <benchmark/benchmark.h>

#include "bench/clamped_beam.hpp"
#include "mechanics/time/generalized_alpha.hpp"
#include "scene/build.hpp"

namespace {

using namespace vlbeam;

void implicit_step(benchmark::State& state, NewtonKind newton, Constraints constraints) {
  const int elements = static_cast<int>(state.range(0));
  Scene scene = clamped_beam(elements, 0.5 * elements - 0.3);
  scene.constraints = constraints;
  BeamSystem<2> system(build_model<2>(scene), build_chain<2>(scene));
  NewtonCounters counters;
  const auto stepper =
      make_generalized_alpha(*system.second_order(), {.step = 1e-3, .newton = newton, .tolerances = {}}, &counters);
  const Eigen::VectorXd start = system.initial_state();
  Eigen::VectorXd y = start;
  double t = 0, dt = 1e-3;
  if (!stepper->try_step(system, y, t, dt)) state.SkipWithError("Newton stalls");
  counters.iterations = counters.tangents = 0;
  double steps = 0;
  for (auto _ : state) {
    stepper->resume(*stepper);  // the same step again, without its tangent
    y = start;
    t = 0;
    dt = 1e-3;
    benchmark::DoNotOptimize(stepper->try_step(system, y, t, dt));
    ++steps;
  }
  state.counters["iterations"] = static_cast<double>(counters.iterations) / steps;
  state.counters["tangents"] = static_cast<double>(counters.tangents) / steps;
  state.counters["per_element"] = benchmark::Counter(
      static_cast<double>(elements), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(implicit_step, modified, NewtonKind::modified, Constraints::eliminated)
    ->Arg(40)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(1000000);
BENCHMARK_CAPTURE(implicit_step, full, NewtonKind::full, Constraints::eliminated)->Arg(40)->Arg(1000)->Arg(10000);
BENCHMARK_CAPTURE(implicit_step, multipliers, NewtonKind::modified, Constraints::multipliers)
    ->Arg(40)
    ->Arg(1000)
    ->Arg(10000);

}  // namespace

BENCHMARK_MAIN();
