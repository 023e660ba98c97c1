// Nanoseconds per frame on the CPU, each frame applied to a texel. The last row is the cost of a stored MikkTSpace
// tangent; quote the others as ratios to it.
#include <vector>

#include <benchmark/benchmark.h>

#include "cotan/frame.hpp"
#include "truth/quad.hpp"
#include "truth/random.hpp"

namespace cotan {
namespace {

struct Pixel {
    Covector3f n;
    Differences<float> d;
    glm::vec3 m;
};

std::vector<Pixel> makePixels()
{
    Random random(1);
    std::vector<Pixel> pixels(4096);
    for (Pixel& p : pixels) {
        AffinePatch patch;
        patch.normal = random.direction();
        const glm::dvec3 e = glm::normalize(glm::cross(patch.normal, random.direction()));
        patch.gradU = e * random.range(0.5, 2);
        patch.gradV = glm::cross(patch.normal, e) + e * 0.3;
        const auto camera = PixelCamera::lookAt(patch.normal * 3.0, {0, 0, 0}, random.direction(), 1000);
        p.d = toFloat(screenDifferences(camera, patch, {0, 0, 0}));
        p.n = Covector3f(glm::vec3(patch.normal));
        p.m = glm::vec3(0.3f, -0.2f, 0.9f);
    }
    return pixels;
}

void frameAndTexel(benchmark::State& state, Frame frame)
{
    const auto pixels = makePixels();
    for (auto _ : state)
        for (const Pixel& p : pixels)
            benchmark::DoNotOptimize(perturb(makeFrame(frame, p.n, p.d), p.m));
    state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(pixels.size()));
}

void storedTangent(benchmark::State& state)
{
    const auto pixels = makePixels();
    for (auto _ : state)
        for (const Pixel& p : pixels)
            benchmark::DoNotOptimize(cotan_apply(f32::cotan_frame_mikktspace(p.n.raw(), p.d.dpdx.raw(), 1.0f), p.m));
    state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(pixels.size()));
}

BENCHMARK_CAPTURE(frameAndTexel, cotangent, Frame::cotangent);
BENCHMARK_CAPTURE(frameAndTexel, cotangent_2013, Frame::cotangent2013);
BENCHMARK_CAPTURE(frameAndTexel, paper_full, Frame::paperFull);
BENCHMARK_CAPTURE(frameAndTexel, orthonormal, Frame::orthonormal);
BENCHMARK_CAPTURE(frameAndTexel, gradient, Frame::gradient);
BENCHMARK_CAPTURE(frameAndTexel, exact, Frame::exact);
BENCHMARK(storedTangent);

} // namespace
} // namespace cotan
