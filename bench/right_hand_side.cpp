// One right-hand side of the falling beam with its mass solve, as time an element: planar, 5 points.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/scene/build.hpp"

namespace {

using namespace vlbeam;

Scene falling_beam(int elements, ElementKind element) {
  Scene scene;
  scene.start.type = SupportType::clamp;
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->position = 0.5 - 0.3 / elements;
  scene.beam.elements = elements;
  scene.beam.element = element;
  scene.beam.rest_shape = RestShape::paper;
  scene.beam.quadrature_points = 5;
  if (element == ElementKind::ale_rancf) scene.beam.weights = {1, 0.9, 1.1, 1.05};
  return scene;
}

template <int D>
void right_hand_side(benchmark::State& state, ElementKind element, WeightTransport transport) {
  const int elements = static_cast<int>(state.range(0));
  Scene scene = falling_beam(elements, element);
  scene.dimension = D;
  scene.weights = transport;
  BeamSystem<D> system(build_model<D>(scene), build_chain<D>(scene));
  Eigen::VectorXd y = system.initial_state(), dydt(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += 1e-6 * std::sin(static_cast<double>(i));  // a bent, moving beam
  for (auto _ : state) {
    system.rhs(y, dydt, 0);
    benchmark::DoNotOptimize(dydt.data());
  }
  state.counters["per_element"] = benchmark::Counter(
      static_cast<double>(elements), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void planar(benchmark::State& state, ElementKind element, WeightTransport transport) {
  right_hand_side<2>(state, element, transport);
}
void spatial(benchmark::State& state, ElementKind element, WeightTransport transport) {
  right_hand_side<3>(state, element, transport);
}

BENCHMARK_CAPTURE(planar, ALE_ANCF, ElementKind::ale_ancf, WeightTransport::frozen)
    ->Arg(10)
    ->Arg(40)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000);
BENCHMARK_CAPTURE(planar, ALE_RANCF, ElementKind::ale_rancf, WeightTransport::frozen)
    ->Arg(10)
    ->Arg(40)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000);
BENCHMARK_CAPTURE(planar, ALE_RANCF_transported, ElementKind::ale_rancf, WeightTransport::transported)->Arg(40);
BENCHMARK_CAPTURE(spatial, ALE_ANCF, ElementKind::ale_ancf, WeightTransport::frozen)->Arg(40);

}  // namespace

BENCHMARK_MAIN();
