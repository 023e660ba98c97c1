// Triangles per second of the three generators on a wavy grid. A constant rate means linear time.
#include <benchmark/benchmark.h>

#include "cotan/tangents.hpp"
#include "grid.hpp"

namespace cotan {
namespace {

template<class Generate> void generate(benchmark::State& state, Generate generator)
{
    const bench::Grid grid = bench::makeGrid(int(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(generator(grid.view()));
    state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(grid.indices.size() / 3));
}

BENCHMARK_CAPTURE(generate, mikktspace, [](const MeshView& mesh) { return mikktspaceTangents(mesh); })
    ->Arg(128)
    ->Arg(707)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generate, vertex, vertexTangents)->Arg(128)->Arg(707)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generate, smooth, smoothCotangents)->Arg(128)->Arg(707)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace cotan
