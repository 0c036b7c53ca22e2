// What a run does before it moves: it reads a scene, checks it, and builds a model and a beam of it.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/clamped_beam.hpp"
#include "io/scene_json.hpp"
#include "scene/build.hpp"

namespace {

using namespace vlbeam;

/// With each key written out.
std::string text_of_scene(int elements) { return scene_to_json(clamped_beam(elements, 0.5 * elements - 0.3)).dump(); }

void parse(benchmark::State& state) {
  const std::string text = text_of_scene(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(parse_scene(text));
}

void build(benchmark::State& state) {
  const Scene scene = parse_scene(text_of_scene(static_cast<int>(state.range(0))));
  for (auto _ : state) {
    BeamSystem<2> system(build_model<2>(scene), build_chain<2>(scene));
    benchmark::DoNotOptimize(system.size());
  }
}

BENCHMARK(parse)->Arg(40)->Unit(benchmark::kMicrosecond);
BENCHMARK(build)->Arg(40)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
