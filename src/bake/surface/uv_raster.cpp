#include "bake/surface/uv_raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/groups.hpp"

namespace cotan {

namespace {

constexpr double kFarthest = 1e6;     // larger uv are too coarse in float to tell texels apart
constexpr double kReach = 0.70710678; // half the diagonal of a texel
constexpr int kTile = 4;              // side of the squares that first samples are ordered by
constexpr int kMaxCopies = 64;        // per axis, of a narrow triangle that wraps
constexpr int kSpread = 4;            // copies per axis of a triangle with space for as many whole ones

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Twice the area of (a, b, p). Exactly negated if a and b are exchanged, so that a point on the edge between two
// triangles is on the same side for both.
double edge(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p)
{
    const bool swapped = a.x > b.x || (a.x == b.x && a.y > b.y);
    if (swapped)
        std::swap(a, b);
    const double e = cross(b - a, p - a);
    return swapped ? -e : e;
}

// The fill rule: of two triangles on either side of an edge exactly one takes the points on it.
bool takesEdge(glm::dvec2 a, glm::dvec2 b) { return b.y < a.y || (b.y == a.y && b.x < a.x); }

glm::dvec2 nearestOn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p)
{
    const glm::dvec2 d = b - a;
    const double d2 = glm::dot(d, d);
    return a + d * std::clamp(d2 > 0 ? glm::dot(p - a, d) / d2 : 0, 0.0, 1.0);
}

// The copies of the image that show a triangle: `count` per axis, `step` apart from `from` on.
struct Copies {
    glm::ivec2 from{0, 0}, count{1, 1};
    int step = 1;
};

// All copies that the triangle's box touches. For a triangle with space for 4 by 4 whole ones, a square of 4 by 4 that
// is spread over its inscribed circle: these show every texel sixteen times.
Copies copiesOf(const glm::dvec2 (&uv)[3], double area)
{
    const glm::dvec3 sides(glm::length(uv[2] - uv[1]), glm::length(uv[0] - uv[2]), glm::length(uv[1] - uv[0]));
    const double around = sides.x + sides.y + sides.z, radius = std::abs(area) / around;
    if (const int step = int((std::numbers::sqrt2 * radius - 2) / (kSpread - 1)); step > 0) {
        const glm::dvec2 centre = (uv[0] * sides.x + uv[1] * sides.y + uv[2] * sides.z) / around;
        return {glm::ivec2(glm::ceil(centre - radius / std::numbers::sqrt2)), {kSpread, kSpread}, step};
    }
    const glm::ivec2 from(glm::floor(glm::min(uv[0], glm::min(uv[1], uv[2]))));
    const glm::dvec2 high = glm::max(uv[0], glm::max(uv[1], uv[2]));
    return {from, glm::clamp(glm::ivec2(glm::ceil(high)) - from, 1, kMaxCopies)};
}

// The first texel in [x, last] that may get a sample; last + 1 if none may. full: if null, all may.
int nextFree(const std::uint8_t* full, int x, int last)
{
    if (!full || x > last || full[x] == 0)
        return x;
    const void* const found = std::memchr(full + x, 0, std::size_t(last - x + 1));
    return found ? int(static_cast<const std::uint8_t*>(found) - full) : last + 1;
}

// A step whose multiples modulo n visit 0 to n - 1 once each: by the golden ratio, so that the first few spread evenly.
std::size_t spreadingStep(std::size_t n)
{
    std::size_t step = std::max<std::size_t>(std::size_t(double(n) * 0.6180339887), 1);
    while (std::gcd(step, n) > 1)
        ++step;
    return step;
}

} // namespace

bool cornersOf(const UvTriangles& triangles, std::uint32_t triangle, glm::dvec2 (&uv)[3], double& area)
{
    bool usable = true;
    for (std::size_t k = 0; k < 3; ++k) {
        uv[k] = glm::dvec2(triangles.texcoords[triangles.indices[3 * std::size_t(triangle) + k]] * triangles.scale);
        usable = usable && std::abs(uv[k].x) <= kFarthest && std::abs(uv[k].y) <= kFarthest;
    }
    area = cross(uv[1] - uv[0], uv[2] - uv[0]);
    return usable && area != 0;
}

// Fraction of the way to the middle of the triangle by which samples on its edges are moved inwards.
constexpr double kInwards = 1e-4;

// Barycentric coordinates of a triangle in texels.
struct UvRaster::Weights {
    glm::dvec2 edge1, edge2;
    double perArea;

    explicit Weights(const Drawn& t)
        : edge1(t.corner[1] - t.corner[0]), edge2(t.corner[2] - t.corner[0]), perArea(1 / cross(edge1, edge2))
    {
    }

    UvSample at(const Drawn& t, glm::dvec2 p, bool covers) const
    {
        double b1 = cross(p - t.corner[0], edge2) * perArea, b2 = cross(edge1, p - t.corner[0]) * perArea;
        if (t.mirrored)
            std::swap(b1, b2);
        // The sample of a texel that is only touched is on an edge. Rays there hit either neighbour of a hard edge.
        if (!covers) {
            b1 += kInwards * (1.0 / 3 - b1);
            b2 += kInwards * (1.0 / 3 - b2);
        }
        return {t.triangle, float(b1), float(b2), covers};
    }
};

bool UvRaster::covers(const Drawn& t, glm::dvec2 p)
{
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.corner[k], b = t.corner[(k + 1) % 3];
        const double e = edge(a, b, p);
        if (e < 0 || (e == 0 && !takesEdge(a, b)))
            return false;
    }
    return true;
}

UvRaster::Drawn UvRaster::inTexels(const TriangleCopy& copy, const glm::dvec2 (&uv)[3], double area) const
{
    const glm::dvec2 size(width_, height_);
    Drawn t{copy.triangle, {}, area < 0, {}, {}};
    for (int k = 0; k < 3; ++k)
        t.corner[k] = (uv[k] - glm::dvec2(copy.tile)) * size;
    if (t.mirrored)
        std::swap(t.corner[1], t.corner[2]);
    const glm::dvec2 boxLow = glm::min(t.corner[0], glm::min(t.corner[1], t.corner[2]));
    const glm::dvec2 boxHigh = glm::max(t.corner[0], glm::max(t.corner[1], t.corner[2]));
    t.first = glm::ivec2(glm::clamp(glm::floor(boxLow - 0.5 - kReach), glm::dvec2(0), size));
    t.last = glm::ivec2(glm::clamp(glm::ceil(boxHigh - 0.5 + kReach), glm::dvec2(-1), size - 1.0));
    return t;
}

UvRaster::Drawn UvRaster::inTexels(const TriangleCopy& copy) const
{
    glm::dvec2 uv[3];
    double area = 0;
    cornersOf(triangles_, copy.triangle, uv, area);
    return inTexels(copy, uv, area);
}

template<class Use> void UvRaster::eachCopy(glm::ivec2 tile, bool wrap, const Use& use) const
{
    glm::dvec2 uv[3];
    double area = 0;
    for (std::uint32_t i = 0; i < triangles_.indices.size() / 3; ++i) {
        if (!cornersOf(triangles_, i, uv, area))
            continue;
        const Copies copies = wrap ? copiesOf(uv, area) : Copies{.from = tile};
        for (int y = 0; y < copies.count.y; ++y)
            for (int x = 0; x < copies.count.x; ++x) {
                const TriangleCopy copy{i, copies.from + copies.step * glm::ivec2(x, y)};
                const Drawn t = inTexels(copy, uv, area);
                if (t.first.x <= t.last.x && t.first.y <= t.last.y)
                    use(copy, t);
            }
    }
}

UvRaster::UvRaster(const UvTriangles& triangles, int width, int height, glm::ivec2 tile, bool wrap)
    : triangles_(triangles), width_(width), height_(height)
{
    const auto eachBlock = [&](const auto& add) {
        eachCopy(tile, wrap, [&](const TriangleCopy& copy, const Drawn& t) {
            for (int block = t.first.y / kBlockRows; block * kBlockRows <= t.last.y; ++block)
                add(std::size_t(block), copy);
        });
    };
    listByGroup(std::size_t(blocks()), eachBlock, blockFirst_, copies_);
}

std::pair<int, int> UvRaster::span(const Drawn& t, double py, double reach, double& low, double& high) const
{
    low = 1e30, high = -1e30;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.corner[k], b = t.corner[(k + 1) % 3];
        for (double at : {py - reach, py + reach})
            if ((a.y - at) * (b.y - at) <= 0 && a.y != b.y) {
                const double x = a.x + (b.x - a.x) * ((at - a.y) / (b.y - a.y));
                low = std::min(low, x);
                high = std::max(high, x);
            }
        if (std::abs(a.y - py) <= reach) {
            low = std::min(low, a.x);
            high = std::max(high, a.x);
        }
    }
    return {int(std::clamp(std::floor(low - 0.5 - reach), 0.0, double(width_))),
            int(std::clamp(std::ceil(high - 0.5 + reach), -1.0, double(width_) - 1))};
}

template<class Emit> void UvRaster::scanCentres(const Drawn& t, int y, const std::uint8_t* full, const Emit& emit) const
{
    const double py = y + 0.5;
    double low, high;
    const auto [first, last] = span(t, py, 0, low, high);
    const int begin = nextFree(full, first, last);
    if (begin > last)
        return;
    const Weights weights(t);
    // Texels well inside need no test. If a corner is close to the row, an edge may lie along it, and the crossing of
    // edge and row is inaccurate.
    int inner = first, outer = last + 1;
    const bool corner = std::abs(t.corner[0].y - py) < 1e-3 || std::abs(t.corner[1].y - py) < 1e-3
        || std::abs(t.corner[2].y - py) < 1e-3;
    if (!corner) {
        inner = int(std::clamp(std::ceil(low - 0.5 + 1e-4), double(first), double(last) + 1));
        outer = int(std::clamp(std::floor(high - 0.5 - 1e-4) + 1, double(inner), double(last) + 1));
    }
    for (int x = begin; x <= last; x = nextFree(full, x + 1, last)) {
        const glm::dvec2 p(x + 0.5, py);
        if ((!corner && x >= inner && x < outer) || covers(t, p))
            emit(x, weights.at(t, p, true));
    }
}

template<class Emit>
void UvRaster::scanTouching(const Drawn& t, int y, const std::uint8_t* taken, const Emit& emit) const
{
    if (!std::memchr(taken + t.first.x, 0, std::size_t(t.last.x - t.first.x + 1)))
        return; // inside a chart: all texels are taken
    const double py = y + 0.5;
    double low, high;
    const auto [first, last] = span(t, py, kReach, low, high);
    const Weights weights(t);
    for (int x = nextFree(taken, first, last); x <= last; x = nextFree(taken, x + 1, last)) {
        const glm::dvec2 p(x + 0.5, py);
        glm::dvec2 nearest = p;
        double best = kReach * kReach;
        bool reached = false;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 q = nearestOn(t.corner[k], t.corner[(k + 1) % 3], p);
            const double d2 = glm::dot(q - p, q - p);
            if (d2 <= best) {
                best = d2;
                nearest = q;
                reached = true;
            }
        }
        if (reached)
            emit(x, weights.at(t, nearest, false));
    }
}

namespace {

// Sorts the samples found by texels, and those of each texel by the order of the triangles.
void sortFound(UvRow& row)
{
    auto& [found, taken, twice, next, orders, sorted] = row.scratch;
    row.first.assign(next.size(), 0);
    std::inclusive_scan(next.begin(), next.end() - 1, row.first.begin() + 1);
    std::copy(row.first.begin(), row.first.end(), next.begin());
    row.samples.resize(found.size());
    sorted.resize(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto [x, sample] = found[i];
        std::uint32_t at = next[std::size_t(x)]++;
        for (; at > row.first[std::size_t(x)] && sorted[at - 1] > orders[i]; --at) {
            row.samples[at] = row.samples[at - 1];
            sorted[at] = sorted[at - 1];
        }
        row.samples[at] = sample;
        sorted[at] = orders[i];
    }
}

} // namespace

void UvRaster::rowsOfBlock(int first, std::span<UvRow> results, const UvLimits& limits) const
{
    const std::span<const TriangleCopy> copies = copiesIn(first / kBlockRows);
    const bool limited = limits.maxPerTexel < copies.size();
    for (UvRow& row : results) {
        row.scratch.found.clear();
        row.scratch.orders.clear();
        row.scratch.next.assign(std::size_t(width_) + 1, 0); // samples of each texel so far
        row.scratch.taken.assign(std::size_t(width_), 0);
    }
    const std::size_t step = limited && limits.maxPerTexel > 1 ? spreadingStep(copies.size()) : 0; // 0: in order
    bool isOpen[kBlockRows] = {}; // whether a texel of the row may still get a sample
    const auto someAreOpen = [&] {
        for (std::size_t k = 0; k < results.size(); ++k) {
            const std::vector<std::uint8_t>& full = results[k].scratch.taken;
            isOpen[k] = isOpen[k] && std::memchr(full.data(), 0, full.size());
        }
        return std::find(std::begin(isOpen), std::end(isOpen), true) != std::end(isOpen);
    };
    const auto eachDrawn = [&](const auto& scan) {
        std::fill_n(isOpen, results.size(), true);
        for (std::size_t i = 0; i < copies.size(); ++i) {
            if (i % 128 == 0 && !someAreOpen())
                return;
            const auto order =
                std::uint32_t(step > 0 ? std::uint64_t(i) * step % copies.size() : i); // size_t may have 32 bits
            const Drawn t = inTexels(copies[order]);
            const int last = std::min(t.last.y - first, int(results.size()) - 1);
            for (int k = std::max(t.first.y - first, 0); k <= last; ++k)
                if (isOpen[k])
                    scan(t, first + k, results[std::size_t(k)], order);
        }
    };
    const auto emitTo = [&](UvRow& row, std::uint32_t order) {
        return [&row, &limits, order](int x, const UvSample& sample) {
            if (limits.accepts && !limits.accepts(sample))
                return;
            row.scratch.found.push_back({x, sample});
            row.scratch.orders.push_back(order);
            row.scratch.taken[std::size_t(x)] = ++row.scratch.next[std::size_t(x)] >= limits.maxPerTexel;
        };
    };
    eachDrawn([&](const Drawn& t, int y, UvRow& row, std::uint32_t order) {
        scanCentres(t, y, limited ? row.scratch.taken.data() : nullptr, emitTo(row, order));
    });
    for (UvRow& row : results)
        for (std::size_t x = 0; x < row.scratch.taken.size(); ++x)
            row.scratch.taken[x] = row.scratch.next[x] > 0;
    eachDrawn([&](const Drawn& t, int y, UvRow& row, std::uint32_t order) {
        scanTouching(t, y, row.scratch.taken.data(), emitTo(row, order));
    });
    for (UvRow& row : results)
        sortFound(row);
}

void UvRaster::rows(int first, std::span<UvRow> results, const UvLimits& limits) const
{
    for (std::size_t count = 0; !results.empty(); first += int(count), results = results.subspan(count)) {
        count = std::min(results.size(), std::size_t(kBlockRows - first % kBlockRows));
        rowsOfBlock(first, results.first(count), limits);
    }
}

void UvRaster::firsts(int block, UvFirsts& result) const
{
    const int top = block * kBlockRows, bottom = std::min(top + kBlockRows, height_) - 1;
    const int across = (width_ + kTile - 1) / kTile; // squares
    std::vector<std::pair<glm::ivec2, UvSample>>& found = result.scratch.found;
    std::vector<std::uint8_t>& taken = result.scratch.taken;
    std::vector<std::uint32_t>& next = result.scratch.next; // per square
    taken.assign(std::size_t(bottom - top + 1) * std::size_t(width_), 0);
    next.assign(std::size_t(kBlockRows / kTile * across) + 1, 0);
    found.clear();
    result.coveredTwice.clear();
    const auto tileOf = [&](glm::ivec2 texel) {
        return std::size_t((texel.y - top) / kTile * across + texel.x / kTile);
    };
    const auto eachRow = [&](const auto& scan) {
        for (const TriangleCopy& copy : copiesIn(block)) {
            const Drawn t = inTexels(copy);
            for (int y = std::max(top, t.first.y); y <= std::min(bottom, t.last.y); ++y)
                scan(t, y, &taken[std::size_t(y - top) * std::size_t(width_)]);
        }
    };
    const auto take = [&](glm::ivec2 texel, const UvSample& sample, std::uint8_t* row) {
        row[texel.x] = 1;
        found.push_back({texel, sample});
        ++next[tileOf(texel) + 1];
    };
    std::vector<std::uint8_t>& twice = result.scratch.twice;
    twice.assign(taken.size(), 0);
    eachRow([&](const Drawn& t, int y, std::uint8_t* row) {
        std::uint8_t* const second = twice.data() + (row - taken.data());
        scanCentres(t, y, second, [&](int x, const UvSample& sample) {
            if (!row[x])
                return take({x, y}, sample, row);
            second[x] = 1;
            result.coveredTwice.push_back({x, y});
        });
    });
    eachRow([&](const Drawn& t, int y, std::uint8_t* row) {
        scanTouching(t, y, row, [&](int x, const UvSample& sample) { take({x, y}, sample, row); });
    });
    std::partial_sum(next.begin(), next.end(), next.begin());
    result.texels.resize(found.size());
    result.samples.resize(found.size());
    for (const auto& [texel, sample] : found) {
        const std::uint32_t at = next[tileOf(texel)]++;
        result.texels[at] = texel;
        result.samples[at] = sample;
    }
}

void UvRaster::eachSpan(const std::function<void(const UvSpan&)>& use) const
{
    for (int block = 0; block < blocks(); ++block)
        for (const TriangleCopy& copy : copiesIn(block)) {
            const Drawn t = inTexels(copy);
            const int top = block * kBlockRows, bottom = std::min(top + kBlockRows, height_) - 1;
            for (int y = std::max(top, t.first.y); y <= std::min(bottom, t.last.y); ++y) {
                const double py = y + 0.5;
                double low, high;
                auto [first, last] = span(t, py, 0, low, high);
                while (first <= last && !covers(t, {first + 0.5, py}))
                    ++first;
                while (first <= last && !covers(t, {last + 0.5, py}))
                    --last;
                if (first <= last)
                    use({t.triangle, y, first, last});
            }
        }
}

double rowsUnder(const UvTriangles& triangles, int height)
{
    double rows = 0;
    glm::dvec2 uv[3];
    for (std::uint32_t i = 0; i < triangles.indices.size() / 3; ++i) {
        double area = 0;
        if (!cornersOf(triangles, i, uv, area))
            continue;
        const Copies copies = copiesOf(uv, area);
        const double high = std::max({uv[0].y, uv[1].y, uv[2].y}) - std::min({uv[0].y, uv[1].y, uv[2].y});
        // A triangle over several rows of copies is cut into as many parts; two of them share a row of texels at each
        // border.
        rows += copies.count.x * (std::min(high, double(copies.count.y)) * height + copies.count.y);
    }
    return rows;
}

} // namespace cotan
