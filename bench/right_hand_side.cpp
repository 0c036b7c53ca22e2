// One right-hand side with its mass solve, as time an element, 5 points: of the falling beam, of one with
// several sliding masses, and of a beam all of whose nodes travel.
#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>

#include "bench/clamped_beam.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/spin/circular_shaft.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "scene/build.hpp"

namespace {

using namespace vlbeam;

Scene falling_beam(int elements, ElementKind element) {
  Scene scene = clamped_beam(elements, 0.5 * elements - 0.3);
  scene.beam.element = element;
  scene.beam.rest_shape = RestShape::paper;
  scene.beam.quadrature_points = 5;
  if (element == ElementKind::ale_rancf) scene.beam.weights = {1, 0.9, 1.1, 1.05};
  return scene;
}

template <int D>
void right_hand_side(benchmark::State& state, Scene scene) {
  const int elements = scene.beam.elements;
  scene.dimension = D;
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

template <int D>
void right_hand_side(benchmark::State& state, ElementKind element, WeightTransport transport) {
  Scene scene = falling_beam(static_cast<int>(state.range(0)), element);
  scene.weights = transport;
  right_hand_side<D>(state, std::move(scene));
}

void planar(benchmark::State& state, ElementKind element, WeightTransport transport) {
  right_hand_side<2>(state, element, transport);
}
void spatial(benchmark::State& state, ElementKind element, WeightTransport transport) {
  right_hand_side<3>(state, element, transport);
}

/// A beam without a sliding mass.
void resting(benchmark::State& state, bool spins, AngleField angles) {
  Scene scene = falling_beam(static_cast<int>(state.range(0)), ElementKind::ale_ancf);
  scene.sliding_mass.reset();
  if (spins) scene.spin.emplace().angles = angles;
  right_hand_side<3>(state, std::move(scene));
}

/// Sliding masses next to each other, four elements apart.
template <int D>
void several(benchmark::State& state, JointSlopes slopes) {
  constexpr int elements = 100;
  Scene scene = falling_beam(elements, ElementKind::ale_ancf);
  scene.sliding_mass.reset();
  const int joints = static_cast<int>(state.range(0));
  for (int i = 0; i < joints; ++i) {
    SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
    joint.position = (50 - 2 * (joints - 1) + 4 * i - 0.3) / elements * scene.beam.curve.end[0];
    joint.mass = 0.5;
    joint.slopes = slopes;
  }
  right_hand_side<D>(state, std::move(scene));
}

void several_planar(benchmark::State& state, JointSlopes slopes) { several<2>(state, slopes); }
void several_spatial(benchmark::State& state, JointSlopes slopes) { several<3>(state, slopes); }

BENCHMARK_CAPTURE(several_planar, continuous, JointSlopes::continuous)->DenseRange(1, 4);
BENCHMARK_CAPTURE(several_planar, equal_stretch, JointSlopes::equal_stretch)->DenseRange(1, 4);
BENCHMARK_CAPTURE(several_spatial, continuous, JointSlopes::continuous)->DenseRange(1, 4);

BENCHMARK_CAPTURE(planar, ALE_ANCF, ElementKind::ale_ancf, WeightTransport::frozen)
    ->Arg(10)
    ->Arg(40)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(1000000);
BENCHMARK_CAPTURE(planar, ALE_RANCF, ElementKind::ale_rancf, WeightTransport::frozen)
    ->Arg(10)
    ->Arg(40)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000);
BENCHMARK_CAPTURE(planar, ALE_RANCF_transported, ElementKind::ale_rancf, WeightTransport::transported)->Arg(40);
BENCHMARK_CAPTURE(spatial, ALE_ANCF, ElementKind::ale_ancf, WeightTransport::frozen)->Arg(40);
BENCHMARK_CAPTURE(resting, no_spin, false, AngleField::linear)->Arg(40);
BENCHMARK_CAPTURE(resting, spin, true, AngleField::linear)->Arg(40);
BENCHMARK_CAPTURE(resting, spin_cubic, true, AngleField::hermite)->Arg(40);

/// A beam all of whose nodes travel, as one under a moving load.
template <int D>
void flowing(benchmark::State& state, bool spins) {
  const int elements = static_cast<int>(state.range(0));
  const CircularShaft shaft{.radius = 0.01, .density = 7200, .youngs_modulus = 2e7};
  BeamModel<D> model;
  model.section = shaft.section();
  if (spins) spin_in(model).section = shaft.spin();
  flow_in(model).motion =
      MeshMotion({{0, steadily(0, -0.1)}, {elements / 2, steadily(0.5, 1)}, {elements, steadily(1, 0.1)}});
  model.start = model.end = Support<D>::pin();
  flow_in(model).books = false;
  BeamSystem<D> beam(model, straight_chain(model));
  Eigen::VectorXd y = straight_state<D>(beam, Vec<double, D>::Zero(), Vec<double, D>::UnitX(), 1, 0, 0), dydt(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += 1e-6 * std::sin(static_cast<double>(i));
  for (auto _ : state) {
    beam.rhs(y, dydt, 0);
    benchmark::DoNotOptimize(dydt.data());
  }
  state.counters["per_element"] = benchmark::Counter(
      static_cast<double>(elements), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void flowing_planar(benchmark::State& state, bool spins) { flowing<2>(state, spins); }
void flowing_spatial(benchmark::State& state, bool spins) { flowing<3>(state, spins); }

BENCHMARK_CAPTURE(flowing_planar, no_spin, false)->Arg(40);
BENCHMARK_CAPTURE(flowing_spatial, no_spin, false)->Arg(40);
BENCHMARK_CAPTURE(flowing_spatial, spin, true)->Arg(40);

}  // namespace

BENCHMARK_MAIN();
