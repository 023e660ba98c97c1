#include "cotan/bake/bake.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cotan/bake/low_points.hpp"
#include "cotan/parallel/loops.hpp"
#include "cotan/surface/uv_raster.hpp"

namespace cotan {

namespace {

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

    // The lines on which the high surface is looked for from places of the low one.
    void aim(const LowPoints& points, std::span<const UvPlace> places, Probes& probes) const
    {
        probes.count = places.size();
        probes.point = points.position;
        probes.direction = points.normal;
        probes.reach.fill(distance_);
        probes.only.fill(Probes::kAny);
        if (!options_.matched.empty())
            for (std::size_t i = 0; i < places.size(); ++i) // -1 becomes kAny
                probes.only[i] = std::uint32_t(options_.matched[low_.triangleInstance[places[i].triangle]]);
        if (!options_.cage.empty())
            for (std::size_t i = 0; i < places.size(); ++i)
                aimFromCage(places[i], i, probes);
    }

    // The points of the high surface that belong to places of the low one.
    void find(const Probes& probes, Hits& hits) const
    {
        if (options_.cage.empty())
            high_.nearest(probes, lift_, options_.highNormals, hits);
        else
            high_.outermost(probes, options_.cageReach, options_.highNormals, hits);
        if (options_.highMaps && showsNormals(options_.kind))
            for (std::size_t i = 0; i < probes.count; ++i)
                if (hits.found(i))
                    hits.normal.set(i,
                                    options_.highMaps->normalAt(hits.instance[i], hits.triangle[i], double(hits.b1[i]),
                                                                double(hits.b2[i]), hits.normal.at(i)));
    }

    // What the map says of each hit. Returns how many rays that took.
    std::size_t valuesOf(const LowPoints& points, const Probes& probes, const Hits& hits,
                         std::span<const glm::ivec2> samples, Lanes3& values) const
    {
        switch (options_.kind) {
        case BakeKind::normal: encode(points, hits.normal, values); return 0;
        case BakeKind::objectNormal: values = hits.normal; return 0;
        case BakeKind::height:
            for (std::size_t i = 0; i < kLanes; ++i)
                values.set(i, {hits.distance[i], 0, 1});
            return 0;
        case BakeKind::occlusion: break;
        }
        std::size_t rays = 0;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (hits.found(i)) {
                const glm::vec3 where = probes.point.at(i) + probes.direction.at(i) * hits.distance[i];
                const std::uint32_t pattern =
                    std::uint32_t(samples[i].x) * 7919u + std::uint32_t(samples[i].y) * 104729u;
                values.set(i, {openness(where, hits.normal.at(i), pattern), 0, 1});
                rays += std::size_t(options_.occlusionRays);
            }
        return rays;
    }

private:
    void aimFromCage(const UvPlace& place, std::size_t i, Probes& probes) const
    {
        const std::uint32_t* v = &low_.indices[3 * std::size_t(place.triangle)];
        const glm::vec3 cage = options_.cage[v[0]] * (1 - place.b1 - place.b2) + options_.cage[v[1]] * place.b1
            + options_.cage[v[2]] * place.b2;
        const glm::vec3 way = cage - probes.point.at(i);
        probes.reach[i] = glm::length(way);
        probes.direction.set(i, probes.reach[i] > 0 ? way / probes.reach[i] : glm::vec3(0));
    }

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

using StateCounts = std::array<std::size_t, 256>; // how many texels are in each combination of TexelState

struct Counts {
    std::size_t rays = 0;
    StateCounts states{};
};

// Bakes the texels of blocks of rows. One for each thread: keeps its memory.
class BlockBaker {
public:
    BlockBaker(const LowSurface& low, const Baker& baker, const UvRaster& raster, const BakeOptions& options,
               Baked& out)
        : low_(low), baker_(baker), raster_(raster), options_(options), out_(out)
    {
    }

    // Bakes rows from `first` to before `last`, whose samples are a block of the raster, and counts its texels and
    // rays.
    void bake(int block, int first, int last, Counts& counts)
    {
        raster_.firsts(block, samples_);
        base_ = std::size_t(first) * std::size_t(out_.width);
        const std::size_t texels = std::size_t(last - first) * std::size_t(out_.width);
        sums_.assign(texels, glm::vec3(0));
        found_.assign(texels, 0);
        for (std::size_t i = 0; i < samples_.places.size(); i += kLanes) {
            const std::size_t count = std::min(kLanes, samples_.places.size() - i);
            counts.rays += bakePacket({&samples_.texels[i], count}, {&samples_.places[i], count});
        }
        for (const glm::ivec2& sample : samples_.again)
            mark(texelOf(sample), texelTwice);
        for (std::size_t i = 0; i < texels; ++i) {
            if (found_[i] > 0)
                out_.values[base_ + i] = finished(sums_[i], found_[i]);
            ++counts.states[out_.states[base_ + i]];
        }
    }

private:
    // Of the texel that a sample belongs to.
    std::size_t texelOf(glm::ivec2 sample) const
    {
        const glm::ivec2 texel = options_.samples > 1 ? sample / options_.samples : sample;
        return std::size_t(texel.y) * std::size_t(out_.width) + std::size_t(texel.x);
    }
    void mark(std::size_t texel, int flag) { out_.states[texel] = std::uint8_t(out_.states[texel] | flag); }

    // Returns how many rays were traced.
    std::size_t bakePacket(std::span<const glm::ivec2> samples, std::span<const UvPlace> places)
    {
        pointsOf(low_, places, points_);
        baker_.aim(points_, places, probes_);
        baker_.find(probes_, hits_);
        const std::size_t more = baker_.valuesOf(points_, probes_, hits_, samples, values_);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const std::size_t texel = texelOf(samples[i]);
            int flags = places[i].covers ? texelCovered : texelTouched;
            if (hits_.found(i)) {
                const glm::vec3 value = values_.at(i);
                sums_[texel - base_] += value;
                ++found_[texel - base_];
                if (options_.kind == BakeKind::normal && value.z < 0)
                    flags |= texelNegative;
            } else {
                flags |= texelMissed;
            }
            mark(texel, flags);
        }
        return samples.size() * baker_.raysEach() + more;
    }

    // From the sum over samples that found something.
    glm::vec3 finished(glm::vec3 sum, int count) const
    {
        if (count == 1 && options_.kind != BakeKind::objectNormal)
            return sum;
        const glm::vec3 mean = sum / float(count);
        if (!showsNormals(options_.kind))
            return mean;
        const float length = glm::length(mean);
        return length > 1e-6f ? mean / length : glm::vec3(0);
    }

    const LowSurface& low_;
    const Baker& baker_;
    const UvRaster& raster_;
    const BakeOptions& options_;
    Baked& out_;
    UvFirsts samples_;
    std::size_t base_ = 0;            // the block's first texel
    std::vector<glm::vec3> sums_;     // over samples
    std::vector<std::uint8_t> found_; // how many samples of each texel found something
    LowPoints points_;
    Probes probes_;
    Hits hits_;
    Lanes3 values_;
};

void countTexels(const StateCounts& states, BakeStatistics& s)
{
    for (std::size_t state = 0; state < states.size(); ++state) {
        const std::size_t texels = states[state];
        s.texels += texels;
        s.covered += (state & texelCovered) != 0 ? texels : 0;
        s.touched += (state & texelTouched) != 0 && (state & texelCovered) == 0 ? texels : 0;
        s.missed += (state & texelMissed) != 0 && (state & texelCovered) != 0 ? texels : 0;
        s.negative += (state & texelNegative) != 0 ? texels : 0;
        s.twice += (state & texelTwice) != 0 ? texels : 0;
    }
}

void countTriangles(const LowSurface& low, BakeStatistics& statistics)
{
    for (std::size_t f = 0; f < low.triangleCount(); ++f) {
        const double area = edgesOf(low.positions, low.texcoords, low.cornersOf(f)).uvArea2();
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

Result<Image> expectedNormals(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                              const View& view)
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
        return traced.error();
    const Baker baker(low, high, options);
    parallelFor(0, view.height, [&](int y) {
        for (int x = 0; x < view.width; ++x) {
            const glm::vec3 d = rayThrough(view, view.camera, x, y);
            const Hit seen = traced->trace({view.camera.eye, d, 0, 1e30f});
            if (!seen.found || glm::dot(seen.faceNormal, d) >= 0)
                continue;
            const UvPlace place{seen.triangle, seen.b1, seen.b2, true};
            LowPoints point;
            Probes probe;
            Hits hit;
            pointsOf(low, {&place, 1}, point);
            baker.aim(point, {&place, 1}, probe);
            baker.find(probe, hit);
            if (!hit.found(0))
                continue;
            const glm::vec3 n = hit.normal.at(0);
            float* pixel = image.floats() + 4 * (std::size_t(y) * std::size_t(view.width) + std::size_t(x));
            pixel[0] = n.x;
            pixel[1] = n.y;
            pixel[2] = n.z;
            pixel[3] = 1;
        }
    });
    return image;
}

Result<Baked> bake(const LowSurface& low, const HighSurface& high, const BakeOptions& options, const Progress& progress)
{
    if (!options.cage.empty() && options.cage.size() != low.positions.size())
        return inputError(fmt::format("cage: expected {} vertices, as many as the low mesh has; found {}",
                                      low.positions.size(), options.cage.size()));
    if (options.frame != low.frame)
        return usageError(fmt::format("options.frame: expected {}, which the low surface was made for; found {}",
                                      name(low.frame), name(options.frame)));
    const auto start = std::chrono::steady_clock::now();
    Baked out;
    out.width = options.width;
    out.height = options.height;
    out.values.assign(std::size_t(options.width) * std::size_t(options.height), glm::vec3(0));
    out.states.assign(out.values.size(), 0);
    const UvRaster raster({low.texcoords, low.indices}, options.width * options.samples,
                          options.height * options.samples, options.tile);
    const Baker baker(low, high, options);
    std::mutex counting;
    CountedSteps done(progress, std::size_t(options.height)); // rows
    withThreads(options.threads, [&] {
        const int rows = UvRaster::kBlockRows / options.samples; // of texels in a block of samples
        parallelRanges(0, raster.blocks(), 1, [&](int begin, int end) {
            BlockBaker baking(low, baker, raster, options, out);
            Counts counts;
            for (int block = begin; block != end && !done.stopped(); ++block) {
                const int first = block * rows, last = std::min(first + rows, options.height);
                baking.bake(block, first, last, counts);
                for (int y = first; y < last; ++y)
                    done.step();
            }
            const std::lock_guard lock(counting);
            out.statistics.rays += counts.rays;
            countTexels(counts.states, out.statistics);
        });
    });
    if (done.stopped())
        return stoppedError();
    BakeStatistics& s = out.statistics;
    countTriangles(low, s);
    s.rayDistance = baker.distance();
    s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
}

} // namespace cotan
