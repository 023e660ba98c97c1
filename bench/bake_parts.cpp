// bake_parts LOW HIGH SIZE [THREADS] [IMAGE]: prints wall-clock and processor seconds of each part of a bake, and the
// peak memory. HIGH may be grid:N for a wavy sphere of 2 N N triangles around the origin, radius 1.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>

#include "bake/bake_surfaces.hpp"
#include "cotan/image.hpp"
#include "cotan/model.hpp"

using namespace cotan;

namespace {

double processorSeconds()
{
    rusage u;
    getrusage(RUSAGE_SELF, &u);
    return double(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + double(u.ru_utime.tv_usec + u.ru_stime.tv_usec) * 1e-6;
}

void part(const char* name, const std::function<std::string()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    const double used = processorSeconds();
    const std::string more = work();
    rusage u;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                 processor = processorSeconds() - used;
    getrusage(RUSAGE_SELF, &u);
    fmt::print("{:8} {:.3f} {:.3f} {} (peak so far {} MiB)\n", name, wall, processor, more, u.ru_maxrss / 1024);
}

// A sphere of n x n quads with waves of a fiftieth of its radius.
Scene wavySphere(std::uint32_t n)
{
    Scene scene;
    Mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double u = 2 * std::numbers::pi * i / n, v = std::numbers::pi * j / n;
            const double r = 1 + 0.02 * std::sin(40 * u) * std::sin(40 * v);
            const glm::dvec3 d(std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u));
            mesh.positions.emplace_back(d * r);
            mesh.normals.emplace_back(d);
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
        }
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({});
    return scene;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 4) {
        fmt::print(stderr, "usage: bake_parts LOW HIGH SIZE [THREADS] [IMAGE]\n");
        return 1;
    }
    BakeOptions options;
    options.frame = Frame::cotangent;
    options.samples = 1; // as Cycles
    options.width = options.height = std::atoi(argv[3]);
    options.threads = argc > 4 ? std::atoi(argv[4]) : 0;
    const std::string highName = argv[2];
    std::vector<Scene> scenes;
    Scene lowScene;
    int failed = 0;
    const auto load = [&](const std::string& name, Scene& into) {
        auto loaded = loadScene(name);
        if (loaded)
            into = std::move(*loaded);
        else
            fmt::print(stderr, "{}\n", loaded.error().message), failed = 2;
    };
    part("load", [&] {
        load(argv[1], lowScene);
        scenes.emplace_back();
        if (highName.rfind("grid:", 0) == 0)
            scenes[0] = wavySphere(std::uint32_t(std::atoi(highName.c_str() + 5)));
        else
            load(highName, scenes[0]);
        return "";
    });
    if (failed)
        return failed;
    std::vector<LowSurface> low;
    std::vector<HighSurface> high;
    part("build", [&]() -> std::string {
        if (auto surface = makeLowSurface(lowScene, -1, options.frame, TangentOrigin::stored))
            low.push_back(std::move(*surface));
        if (auto surface = HighSurface::make(scenes, options.threads))
            high.push_back(std::move(*surface));
        return high.empty() ? "" : fmt::format("{} triangles", high[0].triangleCount());
    });
    if (low.empty() || high.empty())
        return 2;
    std::vector<Baked> baked;
    part("bake", [&] { // into 8 bits, as the command does
        baked = std::move(*bakeMaps(low[0], high[0], options, {options.kind}, {}, {StoredAs{}}));
        return std::to_string(baked[0].statistics.rays);
    });
    part("pad", [&] {
        padCharts(baked, 16);
        return "";
    });
    if (argc > 5)
        part("write", [&] { return writeImage(argv[5], baked[0].image) ? "" : "failed"; });
}
