#include "cotan/bake/bake.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cotan/bake/uv_raster.hpp"

namespace cotan {

namespace {

struct Sample {
    bool found = false, negative = false;
    glm::vec3 value{0};
    int rays = 0;
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

    Sample sample(const UvPlace& place, std::uint32_t pattern) const
    {
        const LowPoint p = pointOf(low_, options_.frame, place.triangle, place.b1, place.b2);
        Sample s;
        glm::vec3 out;
        const Hit hit = find(p, place, out, s.rays);
        if (!hit.found)
            return s;
        s.found = true;
        store(s, p, hit, glm::vec3(p.position) + out * hit.distance, pattern);
        return s;
    }

    // The point of the high surface that belongs to a point of the low one; `out`: the direction in which
    // the hit's signed distance is measured.
    Hit find(const LowPoint& p, const UvPlace& place, glm::vec3& out, int& rays) const
    {
        const std::int64_t only = options_.matched.empty()
            ? -1 : options_.matched[low_.triangleInstance[place.triangle]];
        const glm::vec3 position(p.position), n(p.normal);
        out = n;
        float reach = distance_;
        if (!options_.cage.empty()) {
            const std::uint32_t* v = &low_.indices[3 * std::size_t(place.triangle)];
            const glm::vec3 cage = options_.cage[v[0]] * (1 - place.b1 - place.b2) + options_.cage[v[1]] * place.b1
                + options_.cage[v[2]] * place.b2;
            reach = glm::length(cage - position);
            out = reach > 0 ? (cage - position) / reach : n;
        }
        if (glm::dot(out, out) == 0 || reach <= 0)
            return {};
        return options_.cage.empty() ? nearestHit(position, out, reach, only, rays)
                                     : fromCage(position, out, reach, only, rays);
    }

private:
    // Forward and back from the low surface; the distance carries the sign.
    Hit nearestHit(glm::vec3 position, glm::vec3 out, float reach, std::int64_t only, int& rays) const
    {
        // Each ray starts a little on the other side, so that a surface through the point is found.
        Hit outwards = high_.trace({position - out * lift_, out, 0, reach + lift_}, only);
        outwards.distance -= lift_;
        const float left = outwards.found ? std::min(reach, std::abs(outwards.distance)) : reach;
        Hit inwards = high_.trace({position + out * lift_, -out, 0, left + lift_}, only);
        inwards.distance = -(inwards.distance - lift_);
        rays += 2;
        if (!inwards.found)
            return outwards;
        return !outwards.found || std::abs(inwards.distance) < std::abs(outwards.distance) ? inwards : outwards;
    }

    // From the cage inwards: the outermost surface, to as far behind the low one.
    Hit fromCage(glm::vec3 position, glm::vec3 out, float reach, std::int64_t only, int& rays) const
    {
        Hit hit = high_.trace({position + out * reach, -out, 0, 2 * reach}, only);
        hit.distance = reach - hit.distance;
        ++rays;
        return hit;
    }

    void store(Sample& s, const LowPoint& p, const Hit& hit, glm::vec3 where, std::uint32_t pattern) const
    {
        const glm::vec3 normal = options_.faceNormals ? hit.faceNormal : hit.normal;
        switch (options_.kind) {
        case BakeKind::normal: {
            const glm::dvec3 m = encode(p.frame, Covector3d(glm::dvec3(normal)));
            s.negative = m.z < 0;
            s.value = glm::vec3(m);
            break;
        }
        case BakeKind::objectNormal: s.value = normal; break;
        case BakeKind::height: s.value = glm::vec3(hit.distance, 0, 1); break;
        case BakeKind::occlusion: s.value = glm::vec3(openness(where, normal, pattern, s.rays), 0, 1); break;
        }
    }

    // Cosine-weighted directions of a golden-ratio spiral, turned by the texel's own angle.
    float openness(glm::vec3 where, glm::vec3 n, std::uint32_t pattern, int& rays) const
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
        rays += options_.occlusionRays;
        return float(open) / float(options_.occlusionRays);
    }

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    float distance_ = 0;
    float lift_ = 0;
};

// One row of texels from the rows of their samples.
struct RowBaker {
    const Baker& baker;
    const UvRaster& raster;
    int samples;
    Baked& out;
    std::atomic<std::size_t>& rays;

    void bake(int y) const
    {
        const std::size_t width = std::size_t(out.width), base = std::size_t(y) * width;
        std::vector<glm::vec3> sums(width, glm::vec3(0));
        std::vector<int> found(width, 0);
        std::size_t rowRays = 0;
        UvRow row;
        for (int sub = 0; sub < samples; ++sub) {
            raster.row(y * samples + sub, true, row);
            for (std::size_t x = 0; x + 1 < row.first.size(); ++x)
                rowRays += addSample(row, x, base + x / std::size_t(samples), std::uint32_t(y * samples + sub),
                                     sums[x / std::size_t(samples)], found[x / std::size_t(samples)]);
        }
        for (std::size_t x = 0; x < width; ++x)
            if (found[x] > 0)
                out.values[base + x] = sums[x] / float(found[x]);
        rays += rowRays;
    }

    std::size_t addSample(const UvRow& row, std::size_t x, std::size_t texel, std::uint32_t y, glm::vec3& sum,
                          int& found) const
    {
        const UvPlace* chosen = nullptr;
        int covering = 0;
        for (std::uint32_t i = row.first[x]; i < row.first[x + 1]; ++i) {
            const UvPlace& place = row.places[i];
            covering += place.covers;
            if (!chosen || (place.covers && !chosen->covers))
                chosen = &place; // the first that covers, else the first that touches
        }
        if (!chosen)
            return 0;
        std::uint8_t& state = out.states[texel];
        state = std::uint8_t(state | (chosen->covers ? texelCovered : texelTouched) | (covering > 1 ? texelTwice : 0));
        const Sample s = baker.sample(*chosen, std::uint32_t(x) * 7919u + y * 104729u);
        if (s.found) {
            sum += s.value;
            ++found;
        } else {
            state = std::uint8_t(state | texelMissed);
        }
        state = std::uint8_t(state | (s.negative ? texelNegative : 0));
        return std::size_t(s.rays);
    }
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
            glm::vec3 out;
            int rays = 0;
            const Hit hit = baker.find(pointOf(low, options.frame, place.triangle, place.b1, place.b2), place, out, rays);
            if (!hit.found)
                continue;
            const glm::vec3 n = options.faceNormals ? hit.faceNormal : hit.normal;
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
    const RowBaker rows{baker, raster, options.samples, out, rays};
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<int>(0, options.height, 4), [&](const tbb::blocked_range<int>& range) {
            for (int y = range.begin(); y != range.end(); ++y) {
                rows.bake(y);
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
