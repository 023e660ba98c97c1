#include "cotan/bake/bake.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cotan/bake/uv_raster.hpp"

namespace cotan {

namespace {

constexpr std::size_t kPacket = HighSurface::kPacket;

// A sample of the map that is on its way: where it belongs, and its place on the low surface.
struct Wanted {
    std::size_t texel = 0;    // of the row
    UvPlace place;
    std::uint32_t pattern = 0; // for directions that differ from texel to texel
};

struct Packet {
    std::array<Wanted, kPacket> wanted;
    std::size_t count = 0;
};

class Baker {
public:
    Baker(const LowSurface& low, const HighSurface& high, const BakeOptions& options)
        : low_(low), high_(high), options_(options)
    {
        const float diagonal = glm::length(high.high() - high.low());
        distance_ = options.maxDistance > 0 ? options.maxDistance : 0.05f * diagonal;
        lift_ = 1e-5f * diagonal;
    }

    float distance() const { return distance_; }
    std::size_t raysEach() const { return options_.cage.empty() ? 2 : 1; }

    // The line on which the high surface is looked for from a place of the low one.
    Probe probe(glm::vec3 position, glm::vec3 normal, const UvPlace& place) const
    {
        Probe p{position, normal, distance_, -1};
        if (!options_.matched.empty())
            p.only = options_.matched[low_.triangleInstance[place.triangle]];
        if (!options_.cage.empty()) {
            const std::uint32_t* v = &low_.indices[3 * std::size_t(place.triangle)];
            const glm::vec3 cage = options_.cage[v[0]] * (1 - place.b1 - place.b2) + options_.cage[v[1]] * place.b1
                + options_.cage[v[2]] * place.b2;
            p.reach = glm::length(cage - position);
            p.direction = p.reach > 0 ? (cage - position) / p.reach : glm::vec3(0);
        }
        return p;
    }

    // The points of the high surface that belong to places of the low one.
    void find(std::span<const Probe> probes, std::span<Hit> hits) const
    {
        if (options_.cage.empty())
            high_.nearest(probes, lift_, hits);
        else
            high_.outermost(probes, hits);
    }

    glm::vec3 surfaceNormal(const Hit& hit) const { return options_.faceNormals ? hit.faceNormal : hit.normal; }
    glm::vec3 normalOf(const Hit& hit) const
    {
        return options_.highMaps ? options_.highMaps->normalAt(hit.instance, hit.triangle, hit.b1, hit.b2, hit.normal)
                                 : surfaceNormal(hit);
    }

    // What the map says of a hit; `where`: the point hit.
    glm::vec3 value(const CotangentFrame<float>& frame, const Hit& hit, glm::vec3 where, std::uint32_t pattern) const
    {
        switch (options_.kind) {
        case BakeKind::normal: return encode(frame, Covector3f(normalOf(hit)));
        case BakeKind::objectNormal: return normalOf(hit);
        case BakeKind::height: return {hit.distance, 0, 1};
        case BakeKind::occlusion: break;
        }
        return {openness(where, surfaceNormal(hit), pattern), 0, 1};
    }

private:
    // Cosine-weighted directions of a golden-ratio spiral, turned by the texel's own angle.
    float openness(glm::vec3 where, glm::vec3 n, std::uint32_t pattern) const
    {
        const glm::vec3 side = std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const glm::vec3 t = glm::normalize(glm::cross(side, n)), b = glm::cross(n, t);
        const double turn = double(pattern * 2654435769u) / 4294967296.0 * 2 * std::numbers::pi;
        int open = 0;
        for (int i = 0; i < options_.occlusionRays; ++i) {
            const double r2 = (i + 0.5) / options_.occlusionRays, a = turn + i * 2.399963229728653;
            const float x = float(std::sqrt(r2) * std::cos(a)), y = float(std::sqrt(r2) * std::sin(a));
            const glm::vec3 d = t * x + b * y + n * float(std::sqrt(1 - r2));
            open += !high_.blocked({where + n * lift_, d, 0, 1e30f});
        }
        return float(open) / float(options_.occlusionRays);
    }

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    float distance_ = 0;
    float lift_ = 0;
};

// Rows of texels from the rows of their samples. One for each thread: keeps what neighbours share.
class RowBaker {
public:
    RowBaker(const LowSurface& low, const Baker& baker, const UvRaster& raster, const BakeOptions& options, Baked& out)
        : low_(low), baker_(baker), raster_(raster), options_(options), out_(out), sums_(std::size_t(out.width)),
          found_(std::size_t(out.width))
    {
    }

    // Returns how many rays were traced.
    std::size_t bake(int y)
    {
        const std::size_t samples = std::size_t(options_.samples);
        base_ = std::size_t(y) * std::size_t(out_.width);
        std::fill(sums_.begin(), sums_.end(), glm::vec3(0));
        std::fill(found_.begin(), found_.end(), 0);
        rays_ = 0;
        for (std::size_t sub = 0; sub < samples; ++sub) {
            const std::size_t line = std::size_t(y) * samples + sub;
            raster_.row(int(line), UvReach::gaps, row_);
            for (std::size_t x = 0; x + 1 < row_.first.size(); ++x)
                if (row_.first[x] < row_.first[x + 1])
                    add(x, x / samples, std::uint32_t(x) * 7919u + std::uint32_t(line) * 104729u);
        }
        flush();
        for (std::size_t x = 0; x < sums_.size(); ++x)
            if (found_[x] > 0)
                out_.values[base_ + x] = sums_[x] / float(found_[x]);
        return rays_;
    }

private:
    void add(std::size_t x, std::size_t texel, std::uint32_t pattern)
    {
        const UvPlace& chosen = row_.places[row_.first[x]]; // the first that covers, else the first that touches
        const bool twice = chosen.covers && row_.first[x + 1] - row_.first[x] > 1;
        std::uint8_t& state = out_.states[base_ + texel];
        state = std::uint8_t(state | (chosen.covers ? texelCovered : texelTouched) | (twice ? texelTwice : 0));
        packet_.wanted[packet_.count++] = {texel, chosen, pattern};
        if (packet_.count == kPacket)
            flush();
    }

    void flush()
    {
        std::array<LowPointOf<float>, kPacket> points;
        std::array<Probe, kPacket> probes;
        std::array<Hit, kPacket> hits;
        const std::size_t count = packet_.count;
        for (std::size_t i = 0; i < count; ++i) {
            const UvPlace& place = packet_.wanted[i].place;
            if (place.triangle != triangle_) {
                triangle_ = place.triangle;
                const Differences<double> d = differencesOf(low_, options_.frame, triangle_);
                differences_ = {Vector3f(d.dpdx.raw()), Vector3f(d.dpdy.raw()), d.duvdx, d.duvdy};
            }
            points[i] = pointOf<float>(low_, options_.frame, triangle_, place.b1, place.b2, differences_);
            probes[i] = baker_.probe(points[i].position, points[i].normal, place);
        }
        baker_.find({probes.data(), count}, {hits.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            const Wanted& w = packet_.wanted[i];
            std::uint8_t& state = out_.states[base_ + w.texel];
            if (!hits[i].found) {
                state = std::uint8_t(state | texelMissed);
                continue;
            }
            const glm::vec3 where = probes[i].point + probes[i].direction * hits[i].distance;
            const glm::vec3 value = baker_.value(points[i].frame, hits[i], where, w.pattern);
            sums_[w.texel] += value;
            ++found_[w.texel];
            if (options_.kind == BakeKind::normal && value.z < 0)
                state = std::uint8_t(state | texelNegative);
            if (options_.kind == BakeKind::occlusion)
                rays_ += std::size_t(options_.occlusionRays);
        }
        rays_ += count * baker_.raysEach();
        packet_.count = 0;
    }

    const LowSurface& low_;
    const Baker& baker_;
    const UvRaster& raster_;
    const BakeOptions& options_;
    Baked& out_;
    std::size_t base_ = 0, rays_ = 0;
    std::vector<glm::vec3> sums_;
    std::vector<int> found_;
    UvRow row_;
    Packet packet_;
    std::uint32_t triangle_ = ~0u;
    Differences<float> differences_;
};

void countTriangles(const LowSurface& low, BakeStatistics& statistics)
{
    for (std::size_t f = 0; f < low.triangleCount(); ++f) {
        const glm::dvec2 a(low.texcoords[low.indices[3 * f]]), b(low.texcoords[low.indices[3 * f + 1]]),
            c(low.texcoords[low.indices[3 * f + 2]]);
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        statistics.mirroredTriangles += area > 0; // v runs down: charts that are not mirrored turn the other way
        statistics.degenerateTriangles += !(std::abs(area) > 0);
    }
}

glm::vec3 rayThrough(const View& view, const Camera& c, int x, int y)
{
    const glm::vec3 forward = glm::normalize(c.target - c.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, c.up)), up = glm::cross(right, forward);
    const float t = std::tan(c.verticalFieldOfView / 2);
    const float aspect = float(view.width) / float(view.height);
    const float px = (float(x) + 0.5f) / float(view.width) * 2 - 1, py = 1 - (float(y) + 0.5f) / float(view.height) * 2;
    return glm::normalize(forward + right * (px * t * aspect) + up * (py * t));
}

} // namespace

Image expectedNormals(const LowSurface& low, const HighSurface& high, const BakeOptions& options, const View& view)
{
    Image image = makeImage(view.width, view.height, PixelType::float32, "expected normals");
    Scene scene;
    Mesh mesh;
    mesh.positions = low.positions;
    mesh.normals = low.normals;
    mesh.indices = low.indices;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({});
    const auto traced = HighSurface::make({scene}, options.threads);
    if (!traced)
        return image;
    const Baker baker(low, high, options);
    tbb::parallel_for(0, view.height, [&](int y) {
        for (int x = 0; x < view.width; ++x) {
            const glm::vec3 d = rayThrough(view, view.camera, x, y);
            const Hit seen = traced->trace({view.camera.eye, d, 0, 1e30f});
            if (!seen.found || glm::dot(seen.faceNormal, d) >= 0)
                continue;
            const UvPlace place{seen.triangle, seen.b1, seen.b2, true};
            const LowPoint point = pointOf(low, options.frame, place.triangle, place.b1, place.b2);
            const Probe probe = baker.probe(glm::vec3(point.position), glm::vec3(point.normal), place);
            Hit hit;
            baker.find({&probe, 1}, {&hit, 1});
            if (!hit.found)
                continue;
            const glm::vec3 n = baker.normalOf(hit);
            float* pixel = image.floats() + 4 * (std::size_t(y) * std::size_t(view.width) + std::size_t(x));
            pixel[0] = n.x;
            pixel[1] = n.y;
            pixel[2] = n.z;
            pixel[3] = 1;
        }
    });
    return image;
}

Result<Baked> bake(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                   const std::function<void()>& progress)
{
    if (!options.cage.empty() && options.cage.size() != low.positions.size())
        return inputError(fmt::format("cage: expected {} vertices, as many as the low mesh has; found {}",
                                      low.positions.size(), options.cage.size()));
    const auto start = std::chrono::steady_clock::now();
    Baked out;
    out.width = options.width;
    out.height = options.height;
    out.values.assign(std::size_t(options.width) * std::size_t(options.height), glm::vec3(0));
    out.states.assign(out.values.size(), 0);
    const UvRaster raster({low.texcoords, low.indices}, options.width * options.samples,
                          options.height * options.samples, options.tile);
    const Baker baker(low, high, options);
    std::atomic<std::size_t> rays = 0;
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<int>(0, options.height, 8), [&](const tbb::blocked_range<int>& range) {
            RowBaker rows(low, baker, raster, options, out);
            for (int y = range.begin(); y != range.end(); ++y) {
                rays += rows.bake(y);
                if (progress)
                    progress();
            }
        });
    });
    if (options.kind == BakeKind::normal || options.kind == BakeKind::objectNormal)
        for (glm::vec3& v : out.values) {
            const float length = glm::length(v);
            v = length > 1e-6f ? v / length : glm::vec3(0);
        }
    BakeStatistics& s = out.statistics;
    s.texels = out.states.size();
    for (std::uint8_t state : out.states) {
        s.covered += (state & texelCovered) != 0;
        s.touched += (state & texelTouched) != 0 && (state & texelCovered) == 0;
        s.missed += (state & texelMissed) != 0 && (state & texelCovered) != 0;
        s.negative += (state & texelNegative) != 0;
        s.twice += (state & texelTwice) != 0;
    }
    countTriangles(low, s);
    s.rays = rays;
    s.rayDistance = baker.distance();
    s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
}

} // namespace cotan
