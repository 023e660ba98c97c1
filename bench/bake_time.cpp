// bake_time HIGH LOW [SIZE] [RUNS]: compares the baker with a bare Embree loop over exactly the same rays, on one
// thread each, in alternation. Prints medians of processor time.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "bake/packets.hpp"
#include "bake/surface/uv_raster.hpp"
#include "cotan/model.hpp"

using namespace cotan;

namespace {

double seconds()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
}

double timed(const std::function<void()>& work)
{
    const double start = seconds();
    work();
    return seconds() - start;
}

double median(std::vector<double> v)
{
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
}

struct Bare { // an Embree scene without anything around it
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);

    explicit Bare(const Scene& model)
    {
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        for (const Instance& instance : model.instances) {
            const Mesh& mesh = model.meshes[std::size_t(instance.mesh)];
            RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                  RTC_FORMAT_FLOAT3, 12, mesh.vertexCount()));
            for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
                const glm::vec3 p(instance.toWorld * glm::vec4(mesh.positions[i], 1));
                std::copy(&p.x, &p.x + 3, v + 3 * i);
            }
            auto* f = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                     RTC_FORMAT_UINT3, 12, mesh.triangleCount()));
            std::copy(mesh.indices.begin(), mesh.indices.end(), f);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcReleaseGeometry(geometry);
        }
        rtcCommitScene(scene);
    }
};

struct Texel {
    glm::ivec2 at;
    UvSample sample;
};

// All texels with their surface samples, row by row (`square` 1) or in squares of 4 x 4 (`square` 4), where sixteen
// consecutive rays are closest together; that was the fastest of the orders tried.
std::vector<Texel> texelsOf(const UvRaster& raster, int square)
{
    std::vector<Texel> texels;
    UvFirsts firsts;
    for (int block = 0; block < raster.blocks(); ++block) {
        raster.firsts(block, firsts);
        for (std::size_t i = 0; i < firsts.samples.size(); ++i)
            texels.push_back({firsts.texels[i], firsts.samples[i]});
    }
    std::stable_sort(texels.begin(), texels.end(), [square](const Texel& a, const Texel& b) {
        return std::pair(a.at.y / square, a.at.x / square) < std::pair(b.at.y / square, b.at.x / square);
    });
    return texels;
}

// The rays that bake() traces, starting in front of the low surface and going inwards, without those that only count
// texels where the older rule differs.
std::vector<RTCRayHit> raysOf(const LowSurface& low, const RayStarts& starts, int size, int square)
{
    std::vector<RTCRayHit> rays;
    for (const auto& [at, sample] : texelsOf(UvRaster({low.texcoords, low.indices}, size, size), square)) {
        const std::uint32_t* v = &low.indices[3 * std::size_t(sample.triangle)];
        const float b0 = 1 - sample.b1 - sample.b2;
        const glm::vec3 sum =
            starts.directions[v[0]] * b0 + starts.directions[v[1]] * sample.b1 + starts.directions[v[2]] * sample.b2;
        const float before =
            starts.distances[v[0]] * b0 + starts.distances[v[1]] * sample.b1 + starts.distances[v[2]] * sample.b2;
        const glm::vec3 d = -glm::normalize(sum),
                        o = glm::vec3(pointOf(low, sample.triangle, sample.b1, sample.b2).position) - d * before;
        RTCRayHit r{};
        r.ray = {o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, before + starts.limit, ~0u, 0, 0};
        r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rays.push_back(r);
    }
    rays.resize(rays.size() / 16 * 16);
    return rays;
}

std::vector<RTCRayHit16> packetsOf(const std::vector<RTCRayHit>& rays)
{
    std::vector<RTCRayHit16> packets(rays.size() / 16);
    for (std::size_t i = 0; i < packets.size() * 16; ++i) {
        RTCRay16& r = packets[i / 16].ray;
        const RTCRay& s = rays[i].ray;
        const std::size_t k = i % 16;
        r.org_x[k] = s.org_x;
        r.org_y[k] = s.org_y;
        r.org_z[k] = s.org_z;
        r.dir_x[k] = s.dir_x;
        r.dir_y[k] = s.dir_y;
        r.dir_z[k] = s.dir_z;
        r.tnear[k] = 0;
        r.tfar[k] = s.tfar;
        r.time[k] = 0;
        r.mask[k] = ~0u;
        r.id[k] = r.flags[k] = 0;
        packets[i / 16].hit.geomID[k] = packets[i / 16].hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    return packets;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 3) {
        fmt::print(stderr, "usage: bake_time HIGH LOW [SIZE] [RUNS]\n");
        return 1;
    }
    const int size = argc > 3 ? std::atoi(argv[3]) : 1024, runs = argc > 4 ? std::atoi(argv[4]) : 5;
    const auto highScene = loadScene(argv[1]), lowScene = loadScene(argv[2]);
    if (!highScene || !lowScene) {
        fmt::print(stderr, "{}\n", (highScene ? lowScene : highScene).error().message);
        return 2;
    }
    BakeOptions options;
    options.frame = Frame::smooth;
    options.samples = 1;
    options.width = options.height = size;
    options.threads = 1;
    const auto low = makeLowSurface(*lowScene, -1, options.frame, TangentOrigin::generated);
    const auto high = HighSurface::make({*highScene}, 1);
    if (!low || !high)
        return 2;
    const Bare bare(*highScene);
    RayQuery query(Coherence::coherent);
    alignas(64) const int valid[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    if (!measureRayStarts(*low, *high, options))
        return 2;
    const std::vector<RTCRayHit> inRows = raysOf(*low, *options.starts, size, 1),
                                 inSquares = raysOf(*low, *options.starts, size, 4);
    const auto packets = [&](const std::vector<RTCRayHit>& rays) {
        std::vector<RTCRayHit16> sixteen = packetsOf(rays);
        return timed([&] {
            for (RTCRayHit16& r : sixteen)
                intersect(valid, bare.scene, query, r);
        });
    };
    std::vector<double> ones, rows, squares, bakes;
    std::size_t bakedRays = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<RTCRayHit> one = inSquares;
        ones.push_back(timed([&] {
            for (RTCRayHit& r : one)
                intersect(bare.scene, query, r);
        }));
        rows.push_back(packets(inRows));
        squares.push_back(packets(inSquares));
        bakes.push_back(timed([&] { // into 8 bits, as the command does
            bakedRays = bakeMaps(*low, *high, options, {BakeKind::normal}, {}, {StoredAs{}})->front().statistics.rays;
        }));
    }
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const double baker = double(bakedRays) / median(bakes) / 1e6;
    fmt::print("{} rays, {}x{}, one thread, medians of {}\nbaker {:.2f} M rays/s\n", bakedRays, size, size, runs,
               baker);
    const auto print = [&](const char* name, const std::vector<double>& times) {
        const double rate = double(inRows.size()) / median(times) / 1e6;
        fmt::print("bare Embree, {:30} {:6.2f} M rays/s; the baker has {:.2f} of it\n", name, rate, baker / rate);
    };
    print("single rays", ones);
    print("packets of 16 along rows", rows);
    print("packets of 16 from 4 x 4 texels", squares);
    fmt::print("peak memory {} MiB (the recorded rays included)\n", usage.ru_maxrss / 1024);
}
