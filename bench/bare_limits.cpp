// Limits of this machine, time an element: forces and tangents of fixed elements from their tables alone, by each
// instruction set; a block tridiagonal matrix factored and solved; memory read and written.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/beam/block_tridiagonal.hpp"
#include "core/beam/span_kernels.hpp"
#include "core/element/beam_rule.hpp"

namespace {

using namespace vlbeam;

void per_element(benchmark::State& state, int elements) {
  state.counters["per_element"] = benchmark::Counter(
      static_cast<double>(elements), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Equal elements, slightly bent.
struct Beam {
  std::vector<PackOfElements> packs;
  Eigen::VectorXd q, force;
  BeamSection section{.rhoA = 1, .stiffness = {1000, 1}};

  explicit Beam(int elements) : q(4 * (elements + 1)), force(Eigen::VectorXd::Zero(q.size())) {
    auto tables = std::make_shared<PackTables>();
    const auto basis = fixed_basis(1, unit_weights, beam_rule(5));
    for (const auto& point : basis.points) {
      FixedBasis<Pack>::Point packed;
      packed.weight = Pack(point.weight);
      for (std::size_t c = 0; c < 3; ++c) {
        packed.s_x[c] = Pack(point.s_x[c]);
        packed.s_xx[c] = Pack(point.s_xx[c]);
      }
      tables->basis.points.push_back(packed);
    }
    for (int lane = 0; lane < Pack::width; ++lane) {
      tables->set_inertia(lane, fixed_inertia(1, unit_weights, beam_rule(5)));
    }
    for (int k = 0; k < elements; k += Pack::width) packs.push_back({k, std::min(Pack::width, elements - k), tables});
    for (int i = 0; i <= elements; ++i) q.segment<4>(4 * i) << i, 1e-3 * std::sin(i), 1, 1e-3 * std::cos(i);
  }
};

void forces(benchmark::State& state, InstructionSet set) {
  if (!available(set)) return state.SkipWithError("not on this machine");
  const int elements = static_cast<int>(state.range(0));
  Beam beam(elements);
  const auto kernels = span_kernels<2>(set);
  for (auto _ : state) {
    kernels.forces(beam.packs, beam.section, beam.q.data(), beam.q.data(), {0, -9.81}, beam.force.data());
    benchmark::DoNotOptimize(beam.force.data());
  }
  per_element(state, elements);
}

void tangents(benchmark::State& state, InstructionSet set) {
  if (!available(set)) return state.SkipWithError("not on this machine");
  const int elements = static_cast<int>(state.range(0));
  Beam beam(elements);
  const auto kernels = span_kernels<2>(set);
  const std::vector<NodeTangent<2>> zero(static_cast<std::size_t>(elements) + 1, NodeTangent<2>::Zero());
  auto diagonal = zero, upper = zero, lower = zero;
  for (auto _ : state) {
    kernels.tangents(beam.packs, beam.section, beam.q.data(), beam.q.data(), {1, 0, 1}, diagonal.data(), upper.data(),
                     lower.data());
    benchmark::DoNotOptimize(diagonal.data());
  }
  per_element(state, elements);
}

BorderedBlockTridiagonal<4> matrix(int nodes) {
  BorderedBlockTridiagonal<4> result;
  result.reset(nodes);
  for (auto& block : result.diagonal) block = 4 * NodeTangent<2>::Identity();
  for (auto& block : result.upper) block = -NodeTangent<2>::Identity();
  for (auto& block : result.lower) block = -NodeTangent<2>::Identity();
  return result;
}

void factor(benchmark::State& state) {
  const int nodes = static_cast<int>(state.range(0));
  auto tangent = matrix(nodes);
  for (auto _ : state) benchmark::DoNotOptimize(tangent.factor());
  per_element(state, nodes);
}

void solve(benchmark::State& state) {
  const int nodes = static_cast<int>(state.range(0));
  auto tangent = matrix(nodes);
  tangent.factor();
  Eigen::VectorXd x = Eigen::VectorXd::Ones(4 * nodes);
  for (auto _ : state) {
    tangent.solve(x.data());
    benchmark::DoNotOptimize(x.data());
    x.setOnes();
  }
  per_element(state, nodes);
}

void memory(benchmark::State& state) {
  const Eigen::VectorXd from = Eigen::VectorXd::Ones(1 << 24);
  Eigen::VectorXd to = from;
  for (auto _ : state) {
    to = from;
    benchmark::DoNotOptimize(to.data());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * 2 * from.size() *
                          static_cast<std::int64_t>(sizeof(double)));
}

BENCHMARK_CAPTURE(forces, portable, InstructionSet::portable)->Arg(40)->Arg(100000);
BENCHMARK_CAPTURE(forces, avx2, InstructionSet::avx2)->Arg(40)->Arg(100000);
BENCHMARK_CAPTURE(tangents, portable, InstructionSet::portable)->Arg(40)->Arg(100000);
BENCHMARK_CAPTURE(tangents, avx2, InstructionSet::avx2)->Arg(40)->Arg(100000);
BENCHMARK(factor)->Arg(40)->Arg(100000);
BENCHMARK(solve)->Arg(40)->Arg(100000);
BENCHMARK(memory);

}  // namespace

BENCHMARK_MAIN();
