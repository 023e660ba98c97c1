// Triangles per second of the three generators on a wavy grid; linear if the rate does not fall.
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "cotan/tangents.hpp"

namespace cotan {
namespace {

struct Grid {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> indices;
    MeshView view() const { return {positions, normals, texcoords, indices}; }
};

Grid makeGrid(int side)
{
    Grid g;
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i) {
            const float u = float(i) / float(side), v = float(j) / float(side);
            g.positions.emplace_back(u, v, 0.1f * std::sin(20 * u));
            const float slope = 2 * std::cos(20 * u);
            const float length = std::sqrt(1 + slope * slope);
            g.normals.emplace_back(-slope / length, 0.0f, 1 / length);
            g.texcoords.emplace_back(u, 1 - v);
        }
    const auto row = std::uint32_t(side + 1);
    for (std::uint32_t j = 0; j < std::uint32_t(side); ++j)
        for (std::uint32_t i = 0; i < std::uint32_t(side); ++i) {
            const std::uint32_t a = j * row + i;
            for (std::uint32_t k : {a, a + 1, a + row + 1, a, a + row + 1, a + row})
                g.indices.push_back(k);
        }
    return g;
}

template<class Generate> void generate(benchmark::State& state, Generate generator)
{
    const Grid grid = makeGrid(int(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(generator(grid.view()));
    state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(grid.indices.size() / 3));
}

BENCHMARK_CAPTURE(generate, mikktspace, mikktspaceTangents)->Arg(128)->Arg(707)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generate, vertex, vertexTangents)->Arg(128)->Arg(707)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generate, smooth, smoothCotangents)->Arg(128)->Arg(707)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace cotan
