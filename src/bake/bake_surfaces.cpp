#include "bake/bake_surfaces.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <mutex>
#include <span>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "bake/surface/uv_raster.hpp"
#include "baker.hpp"
#include "core/loops.hpp"
#include "core/try.hpp"
#include "scene/parts.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

constexpr double kMaxRows = 4e7; // of texels under all triangles, besides two per texel

// Bakes the texels of blocks of rows. Use one per thread; it reuses its memory.
class BlockBaker {
public:
    // out: a map of each kind; the states are those of the first.
    BlockBaker(const LowSurface& low, const Baker& baker, const UvRaster& raster, const BakeOptions& options,
               const std::vector<BakeKind>& kinds, const std::vector<StoreTexels>& stores, std::vector<Baked>& out)
        : low_(low), baker_(baker), raster_(raster), options_(options), kinds_(kinds), stores_(stores), maps_(out),
          out_(out.front()), sums_(kinds.size()), cancelled_(kinds.size()), below_(kinds.size()),
          shift_(std::countr_zero(unsigned(options.samples))), values_(kinds.size())
    {
        for (const BakeKind kind : kinds) {
            looksOut_ = looksOut_ || kind == BakeKind::occlusion || kind == BakeKind::bentNormal
                || kind == BakeKind::objectBentNormal;
            looksIn_ = looksIn_ || kind == BakeKind::thickness;
            readsMaterials_ = readsMaterials_ || readsMaterials(kind);
            hasIds_ = hasIds_ || kind == BakeKind::id;
        }
    }

    // Bakes the rows [first, last), whose samples are one block of the raster, and counts their texels and rays.
    void bake(int block, int first, int last)
    {
        raster_.firsts(block, samples_);
        base_ = std::size_t(first) * std::size_t(out_.width);
        const std::size_t texels = std::size_t(last - first) * std::size_t(out_.width);
        for (std::size_t m = 0; m < kinds_.size(); ++m)
            sums_[m].resize(planesOf(kinds_[m]) * texels);
        if (hasIds_)
            ids_.resize(texels * samplesPerTexel());
        found_.assign(texels, 0);
        packet_ = 0;
        suspicious_ = false;
        for (std::size_t i = 0; i < samples_.samples.size(); i += kLanes) {
            const std::size_t count = std::min(kLanes, samples_.samples.size() - i);
            bakePacket({&samples_.texels[i], count}, {&samples_.samples[i], count});
        }
        for (const glm::ivec2& rasterTexel : samples_.coveredTwice)
            mark(texelOf(rasterTexel), texelOverlapped);
        filled_.clear();
        for (std::size_t i = 0; i < texels;) {
            std::uint64_t eight = 1;
            if (texels - i >= sizeof eight)
                std::memcpy(&eight, &out_.states[base_ + i], sizeof eight);
            if (eight == 0) { // as most texels of most maps
                states_[0] += sizeof eight;
                i += sizeof eight;
                continue;
            }
            for (const std::size_t end = std::min(i + sizeof eight, texels); i < end; ++i) {
                ++states_[out_.states[base_ + i]];
                if (found_[i] > 0)
                    filled_.push_back(std::uint32_t(base_ + i));
            }
        }
        for (std::size_t m = 0; m < kinds_.size(); ++m)
            finish(m);
        if (!out_.found.empty())
            std::transform(found_.begin(), found_.end(), out_.found.begin() + std::ptrdiff_t(base_),
                           [](std::uint8_t n) { return std::uint8_t(n > 0); });
    }

    // Adds what all blocks that were baked found.
    void addTo(std::vector<Baked>& maps) const
    {
        for (std::size_t m = 0; m < kinds_.size(); ++m) {
            maps[m].cancelled.insert(maps[m].cancelled.end(), cancelled_[m].begin(), cancelled_[m].end());
            maps[m].below.insert(maps[m].below.end(), below_[m].begin(), below_[m].end());
        }
        BakeStatistics& s = maps.front().statistics;
        s.rays += rays_;
        for (std::size_t state = 0; state < states_.size(); ++state) {
            const std::size_t texels = states_[state];
            s.texels += texels;
            s.covered += (state & texelCovered) != 0 ? texels : 0;
            s.touched += (state & texelTouched) != 0 && (state & texelCovered) == 0 ? texels : 0;
            s.missed += (state & texelMissed) != 0 && (state & texelCovered) != 0 ? texels : 0;
            s.further += (state & texelFurther) != 0 && (state & texelCovered) != 0 ? texels : 0;
            s.nearer += (state & texelNearer) != 0 && (state & texelCovered) != 0 ? texels : 0;
            s.negative += (state & texelNegative) != 0 ? texels : 0;
            s.twice += (state & texelOverlapped) != 0 ? texels : 0;
        }
    }

private:
    struct Traced { // the result of a packet
        Probes probes;
        Hits hits;
        std::span<const glm::ivec2> rasterTexels;
    };

    // Index of the map's texel that a texel of the raster belongs to.
    std::size_t texelOf(glm::ivec2 rasterTexel) const
    {
        const glm::ivec2 texel = rasterTexel >> shift_;
        return std::size_t(texel.y) * std::size_t(out_.width) + std::size_t(texel.x);
    }
    void mark(std::size_t texel, int flag) { out_.states[texel] = std::uint8_t(out_.states[texel] | flag); }

    // The number of components whose sums make the values of a kind; the others do not vary.
    static std::size_t planesOf(BakeKind kind) { return kind == BakeKind::id ? 0 : holdsScalars(kind) ? 1 : 3; }

    // Makes values of the sums of a map, and puts them into it.
    void finish(std::size_t m)
    {
        const BakeKind kind = kinds_[m];
        const std::size_t texels = found_.size();
        const float* const sums = sums_[m].data();
        finished_.resize(filled_.size());
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            const std::size_t texel = filled_[i] - base_;
            finished_[i] = kind == BakeKind::id
                ? glm::vec3(mostFrequent({&ids_[texel * samplesPerTexel()], found_[texel]}), 0, 1)
                : holdsScalars(kind)
                ? glm::vec3(sums[texel] / float(found_[texel]), 0, 1)
                : texelValue(kind, {sums[texel], sums[texels + texel], sums[2 * texels + texel]}, found_[texel]);
        }
        for (std::size_t i = 0; i < filled_.size() && kind == BakeKind::normal; ++i)
            if (finished_[i].z < 0)
                below_[m].push_back({filled_[i], finished_[i].z});
        if (!stores_[m]) {
            for (std::size_t i = 0; i < filled_.size(); ++i)
                maps_[m].values[filled_[i]] = finished_[i];
            return;
        }
        stores_[m](filled_, finished_, maps_[m].image);
        for (std::size_t i = 0; i < filled_.size() && holdsDirections(kind); ++i)
            if (finished_[i] == glm::vec3(0))
                cancelled_[m].push_back(filled_[i]);
    }

    void bakePacket(std::span<const glm::ivec2> rasterTexels, std::span<const UvSample> samples)
    {
        Traced& traced = traced_[packet_ % traced_.size()];
        Probes& probes = traced.probes;
        Hits& hits = traced.hits;
        traced.rasterTexels = rasterTexels;
        pointsOf(low_, samples, points_);
        baker_.aim(points_, samples, probes);
        rays_ += baker_.find(samples, probes, hits);
        if (looksOut_)
            rays_ += baker_.lookOut(probes, hits, rasterTexels, around_);
        if (looksIn_)
            rays_ += baker_.lookIn(probes, hits, rasterTexels, around_);
        if (readsMaterials_)
            options_.highMaterials->read(hits, materials_);
        for (std::size_t m = 0; m < kinds_.size(); ++m)
            baker_.valuesOf(kinds_[m], points_, probes, hits, around_, materials_, values_[m]);
        Lanes<int> further{};
        rays_ += baker_.findFurther(probes, hits, further);
        checkForNearer();
        std::array<Found, kLanes> all; // of each texel that something was found for
        std::size_t count = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const std::size_t texel = texelOf(rasterTexels[i]);
            mark(texel, samples[i].covers ? texelCovered : texelTouched);
            if (!hits.found(i)) {
                mark(texel, further[i] ? texelMissed | texelFurther : texelMissed);
                continue;
            }
            std::size_t n = options_.samples > 1 ? count : 0; // else each is alone
            while (n > 0 && all[n - 1].texel != texel - base_)
                --n;
            if (n == 0) {
                all[count] = {texel - base_, found_[texel - base_], 0, {}};
                n = ++count;
            }
            all[n - 1].lanes[all[n - 1].count++] = std::uint8_t(i);
            ++found_[texel - base_];
        }
        for (std::size_t m = 0; m < kinds_.size(); ++m)
            add(m, {all.data(), count});
    }

    struct Found {           // the samples of a texel in a packet that hit something
        std::size_t texel;   // of the block
        std::uint8_t before; // such samples in earlier packets
        std::uint8_t count;
        std::array<std::uint8_t, kLanes> lanes;
    };

    // Adds the values of a packet in one map to the sums of its texels, in the order of the samples.
    void add(std::size_t m, std::span<const Found> all)
    {
        const float* const components[3] = {values_[m].x, values_[m].y, values_[m].z};
        for (std::size_t plane = 0; plane < planesOf(kinds_[m]); ++plane) {
            float* const sums = sums_[m].data() + plane * found_.size();
            for (const Found& found : all) {
                float sum = found.before > 0 ? sums[found.texel] : 0.0f;
                for (std::size_t k = 0; k < found.count; ++k)
                    sum += components[plane][found.lanes[k]];
                sums[found.texel] = sum;
            }
        }
        if (kinds_[m] != BakeKind::id && kinds_[m] != BakeKind::normal)
            return;
        for (const Found& found : all)
            for (std::size_t k = 0; k < found.count; ++k)
                if (kinds_[m] == BakeKind::id)
                    ids_[found.texel * samplesPerTexel() + found.before + k] = values_[m].x[found.lanes[k]];
                else if (values_[m].z[found.lanes[k]] < 0)
                    mark(base_ + found.texel, texelNegative);
    }

    // Marks texels for which another surface is nearer. A check costs a ray, so only some packets are checked: those
    // with a distant hit, every fourth of the others, the three before a positive one, and those after it until a
    // negative one.
    void checkForNearer()
    {
        const std::size_t every = traced_.size(), now = packet_++;
        if (!suspicious_ && now % every != 0 && !baker_.anyFarInFront(traced_[now % every].hits))
            return;
        const bool before = suspicious_;
        suspicious_ = markNearer(traced_[now % every]);
        for (std::size_t back = 1; suspicious_ && !before && back < every && back <= now; ++back)
            markNearer(traced_[(now - back) % every]);
    }
    bool markNearer(const Traced& traced)
    {
        Lanes<int> nearer{};
        rays_ += baker_.findNearer(traced.probes, traced.hits, nearer);
        bool any = false;
        for (std::size_t i = 0; i < traced.rasterTexels.size(); ++i)
            if (nearer[i]) {
                any = true;
                mark(texelOf(traced.rasterTexels[i]), texelNearer);
            }
        return any;
    }

    std::size_t samplesPerTexel() const { return std::size_t(options_.samples) * std::size_t(options_.samples); }

    // Of equally frequent ones the first.
    static float mostFrequent(std::span<const float> ids)
    {
        if (std::all_of(ids.begin(), ids.end(), [&](float id) { return id == ids.front(); })) // nearly everywhere
            return ids.front();
        return *std::max_element(ids.begin(), ids.end(), [&](float a, float b) {
            return std::count(ids.begin(), ids.end(), a) < std::count(ids.begin(), ids.end(), b);
        });
    }

    // The texel's value from the sum over its samples that hit something.
    static glm::vec3 texelValue(BakeKind kind, glm::vec3 sum, int count)
    {
        if (count == 1 && kind != BakeKind::objectNormal)
            return sum;
        const glm::vec3 mean = sum / float(count);
        if (!holdsDirections(kind))
            return mean;
        const float length = glm::length(mean);
        return length > 1e-6f ? mean / length : glm::vec3(0);
    }

    const LowSurface& low_;
    const Baker& baker_;
    const UvRaster& raster_;
    const BakeOptions& options_;
    const std::vector<BakeKind>& kinds_;
    const std::vector<StoreTexels>& stores_; // of the maps that get images
    std::vector<Baked>& maps_;
    Baked& out_; // the first
    UvFirsts samples_;
    std::size_t base_ = 0;                 // the block's first texel
    std::vector<std::vector<float>> sums_; // of each map: a plane of a component after the other; per texel the sum
                                           // over its samples, if any hit something
    std::vector<std::uint8_t> found_;      // per texel: number of samples that hit something
    std::vector<std::uint32_t> filled_;    // texels of the map with such samples
    std::vector<glm::vec3> finished_;      // their values in one map
    std::vector<std::vector<std::uint32_t>> cancelled_; // of each map, as in Baked
    std::vector<std::vector<Baked::Below>> below_;
    std::vector<float> ids_; // per texel: those of these samples
    LowPoints points_;
    std::array<Traced, 4> traced_; // the most recent packets
    std::size_t packet_ = 0;       // number of packets of the block so far
    bool suspicious_ = false;      // the last check was positive
    bool looksOut_ = false, looksIn_ = false, hasIds_ = false, readsMaterials_ = false;
    Around around_;
    MaterialValues materials_;
    int shift_;                  // from the raster's texels to the map's
    std::vector<Lanes3> values_; // of each map
    std::size_t rays_ = 0;
    std::array<std::size_t, 256> states_{}; // number of texels for each combination of TexelState
};

// The low surface's indices without triangles that have the same uv as two earlier ones: the first is baked, the second
// marks its texels as covered twice.
std::vector<std::uint32_t> withoutRepeated(const LowSurface& low)
{
    std::vector<std::uint32_t> indices = low.indices;
    const auto uv = [&](std::uint32_t v) { return glm::vec3(low.texcoords[v], 0); };
    const std::vector<std::uint8_t> repeated = repeatedTriangles(low.triangleCount(), [&](std::size_t f) {
        const std::uint32_t* const c = &low.indices[3 * f];
        return CornersOfTriangle{{uv(c[0]), uv(c[1]), uv(c[2])}};
    });
    for (std::size_t f = 0; f < repeated.size(); ++f)
        if (repeated[f] > 1)
            std::fill_n(indices.begin() + std::ptrdiff_t(3 * f), 3, low.indices[3 * f]); // no area: not drawn
    return indices;
}

// The number of rows of texels that each triangle touches, summed over the triangles. Without overlap the sum is not
// much larger than the number of texels.
double rowsOf(const UvTriangles& triangles, double height)
{
    double rows = 0;
    for (std::size_t i = 0; i + 2 < triangles.indices.size(); i += 3) {
        const auto v = [&](std::size_t k) { return double(triangles.texcoords[triangles.indices[i + k]].y) * height; };
        const auto [low, high] = std::minmax({v(0), v(1), v(2)});
        if (const bool drawn = high > low; drawn)
            rows += std::min(high - low, height);
    }
    return rows;
}

void countTriangles(const LowSurface& low, BakeStatistics& statistics)
{
    for (std::size_t f = 0; f < low.triangleCount(); ++f) {
        const double area = edgesOf(low, f).uvArea2();
        statistics.mirroredTriangles += area > 0; // v runs down, so unmirrored charts have negative area
        statistics.degenerateTriangles += !(std::abs(area) > 0);
    }
}

} // namespace

Result<std::vector<std::uint32_t>> indicesToDraw(const LowSurface& low, glm::ivec2 size)
{
    std::vector<std::uint32_t> indices = withoutRepeated(low);
    const double rows = rowsOf({low.texcoords, indices}, size.y), max = kMaxRows + 2 * double(size.x) * double(size.y);
    if (rows > max)
        return inputError(fmt::format("its triangles overlap in {:.3g} rows of texels; expected at most {:.3g}: use "
                                      "fewer triangles or a smaller map",
                                      rows, max));
    return indices;
}

Result<Baked> bake(const LowSurface& low, const HighSurface& high, const BakeOptions& options, const Progress& progress)
{
    COTAN_TRY(maps, bakeMaps(low, high, options, {options.kind}, progress));
    return std::move(maps->front());
}

Result<std::vector<Baked>> bakeMaps(const LowSurface& low, const HighSurface& high, const BakeOptions& given,
                                    const std::vector<BakeKind>& kinds, const Progress& progress,
                                    const std::vector<std::optional<StoredAs>>& images)
{
    BakeOptions options = given;
    if (std::ranges::find(kinds, BakeKind::curvature) != kinds.end() && !high.isCurved())
        return about("options.kinds", usageError("the high surface was opened without curvature among the kinds"));
    for (const BakeKind kind : kinds)
        if (readsMaterials(kind) && !options.highMaterials)
            return about("options.kinds",
                         usageError("the high surface was opened without a kind that reads materials"));
    if (options.highMaps && std::ranges::none_of(kinds, showsNormals))
        options.highMaps = nullptr;
    if (!options.cage.empty() && options.cage.size() != low.positions.size())
        return inputError(fmt::format("cage: expected {} vertices, as many as the low mesh has; found {}",
                                      low.positions.size(), options.cage.size()));
    if (options.frame != low.frame)
        return about("options.frame",
                     usageError(fmt::format("expected {}, which the low surface was made for; found {}",
                                            name(low.frame), name(options.frame))));
    if (options.starts && options.starts->directions.size() != low.positions.size())
        return about("options.starts", usageError("made for another low surface"));
    COTAN_CHECK(measureRayStarts(low, high, options));
    const auto start = std::chrono::steady_clock::now();
    const std::size_t texels = std::size_t(options.width) * std::size_t(options.height);
    const glm::ivec2 size(options.width * options.samples, options.height * options.samples);
    const Result<std::vector<std::uint32_t>> indices = indicesToDraw(low, size);
    if (!indices)
        return inputError("low: " + indices.error().message);
    const UvRaster raster({low.texcoords, *indices}, size.x, size.y, options.tile);
    const Baker baker(low, high, options);
    std::vector<Baked> maps(kinds.size(), {options.width, options.height, {}, {}, {}, high.box()});
    std::vector<StoreTexels> stores(kinds.size());
    Baked& out = maps.front();
    out.states.resize(texels);
    parallelFor(std::size_t(0), kinds.size(), [&](std::size_t m) {
        maps[m].unit = baker.unitOf(kinds[m]);
        if (m >= images.size() || !images[m]) {
            maps[m].values.resize(texels);
            return;
        }
        stores[m] = texelStore(maps[m], kinds[m], *images[m]);
        maps[m].image = emptyImage(maps[m], kinds[m], *images[m]);
    });
    if (std::ranges::any_of(stores, [](const StoreTexels& store) { return bool(store); }))
        out.found.resize(texels);
    std::mutex counting;
    CountedSteps done(progress, std::size_t(options.height)); // counts rows
    withThreads(options.threads, [&] {
        const int rows = UvRaster::kBlockRows / options.samples; // rows of texels per block of samples
        parallelRanges(0, raster.blocks(), 1, [&](int begin, int end) {
            BlockBaker baking(low, baker, raster, options, kinds, stores, maps);
            for (int block = begin; block != end && !done.stopped(); ++block) {
                const int first = block * rows, last = std::min(first + rows, options.height);
                baking.bake(block, first, last);
                for (int y = first; y < last; ++y)
                    done.step();
            }
            const std::lock_guard lock(counting);
            baking.addTo(maps);
        });
    });
    if (done.stopped())
        return stoppedError();
    for (Baked& map : maps) {
        std::sort(map.cancelled.begin(), map.cancelled.end());
        std::sort(map.below.begin(), map.below.end(),
                  [](const Baked::Below& a, const Baked::Below& b) { return a.texel < b.texel; });
    }
    BakeStatistics& s = out.statistics;
    countTriangles(low, s);
    s.rayDistance = baker.distance();
    s.rayStart = options.starts ? options.starts->farthest : 0;
    s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t m = 1; m < kinds.size(); ++m)
        maps[m].statistics = s;
    return maps;
}

} // namespace cotan
