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

constexpr double kFarthest = 1e6;     // uv beyond have no texel of their own in float
constexpr double kReach = 0.70710678; // half the diagonal of a texel
constexpr int kTile = 4;              // side of the squares in which first places come
constexpr int kMaxCopies = 64;        // of one narrow triangle that wraps: per axis
constexpr int kSpread = 4;            // copies per axis of one that has room for as many whole ones

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Twice the area of (a, b, p). Exactly the negative when a and b are exchanged, so that a point on
// the edge between two triangles is on the same side for both.
double edge(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p)
{
    const bool swapped = a.x > b.x || (a.x == b.x && a.y > b.y);
    if (swapped)
        std::swap(a, b);
    const double e = cross(b - a, p - a);
    return swapped ? -e : e;
}

// Of two triangles on either side of an edge exactly one takes the points on it: the fill rule of rasterisers.
bool takesEdge(glm::dvec2 a, glm::dvec2 b) { return b.y < a.y || (b.y == a.y && b.x < a.x); }

glm::dvec2 nearestOn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p)
{
    const glm::dvec2 d = b - a;
    const double d2 = glm::dot(d, d);
    return a + d * std::clamp(d2 > 0 ? glm::dot(p - a, d) / d2 : 0, 0.0, 1.0);
}

// A triangle in uv, scaled, and twice its area. False where it is not drawn.
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

// The copies of the image that a triangle is shown in: every `step`-th from `from` on.
struct Copies {
    glm::ivec2 from{0, 0}, count{1, 1};
    int step = 1;
};

// All that its box touches; of a triangle with room for a square of 4 by 4 whole ones such a square, spread as far as
// its inscribed circle goes: these show every texel sixteen times.
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

// The first texel from x to last that may get a place; last + 1 where none may. full: null: all may.
int nextFree(const std::uint8_t* full, int x, int last)
{
    if (!full || x > last)
        return x;
    const void* const found = std::memchr(full + x, 0, std::size_t(last - x + 1));
    return found ? int(static_cast<const std::uint8_t*>(found) - full) : last + 1;
}

// A step whose multiples modulo n are 0 to n - 1, each once: of the golden ratio, so that the first few are spread
// evenly over all.
std::size_t spreadingStep(std::size_t n)
{
    std::size_t step = std::max<std::size_t>(std::size_t(double(n) * 0.6180339887), 1);
    while (std::gcd(step, n) > 1)
        ++step;
    return step;
}

} // namespace

// How much closer to the middle of the triangle, as a part of the way, places on its edges are taken.
constexpr double kInwards = 1e-4;

// Barycentric coordinates of a triangle as it lies on the image.
struct UvRaster::Weights {
    glm::dvec2 edge1, edge2;
    double perArea;

    explicit Weights(const Shown& t)
        : edge1(t.corner[1] - t.corner[0]), edge2(t.corner[2] - t.corner[0]), perArea(1 / cross(edge1, edge2))
    {
    }

    UvSample at(const Shown& t, glm::dvec2 p, bool covers) const
    {
        double b1 = cross(p - t.corner[0], edge2) * perArea, b2 = cross(edge1, p - t.corner[0]) * perArea;
        if (t.mirrored)
            std::swap(b1, b2);
        // A texel that is only touched has its place on an edge, where rays find either neighbour of a hard one.
        if (!covers) {
            b1 += kInwards * (1.0 / 3 - b1);
            b2 += kInwards * (1.0 / 3 - b2);
        }
        return {t.triangle, float(b1), float(b2), covers};
    }
};

bool UvRaster::covers(const Shown& t, glm::dvec2 p)
{
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.corner[k], b = t.corner[(k + 1) % 3];
        const double e = edge(a, b, p);
        if (e < 0 || (e == 0 && !takesEdge(a, b)))
            return false;
    }
    return true;
}

UvRaster::Shown UvRaster::shownAt(const Listed& listed, const glm::dvec2 (&uv)[3], double area) const
{
    const glm::dvec2 size(width_, height_);
    Shown t{listed.triangle, {}, area < 0, {}, {}};
    for (int k = 0; k < 3; ++k)
        t.corner[k] = (uv[k] - glm::dvec2(listed.tile)) * size;
    if (t.mirrored)
        std::swap(t.corner[1], t.corner[2]);
    const glm::dvec2 least = glm::min(t.corner[0], glm::min(t.corner[1], t.corner[2]));
    const glm::dvec2 most = glm::max(t.corner[0], glm::max(t.corner[1], t.corner[2]));
    t.first = glm::ivec2(glm::clamp(glm::floor(least - 0.5 - kReach), glm::dvec2(0), size));
    t.last = glm::ivec2(glm::clamp(glm::ceil(most - 0.5 + kReach), glm::dvec2(-1), size - 1.0));
    return t;
}

UvRaster::Shown UvRaster::shownAt(const Listed& listed) const
{
    glm::dvec2 uv[3];
    double area = 0;
    cornersOf(triangles_, listed.triangle, uv, area);
    return shownAt(listed, uv, area);
}

template<class Use> void UvRaster::eachPlace(glm::ivec2 tile, bool wrap, const Use& use) const
{
    glm::dvec2 uv[3];
    double area = 0;
    for (std::uint32_t i = 0; i < triangles_.indices.size() / 3; ++i) {
        if (!cornersOf(triangles_, i, uv, area))
            continue;
        const Copies copies = wrap ? copiesOf(uv, area) : Copies{.from = tile};
        for (int y = 0; y < copies.count.y; ++y)
            for (int x = 0; x < copies.count.x; ++x) {
                const Listed listed{i, copies.from + copies.step * glm::ivec2(x, y)};
                const Shown t = shownAt(listed, uv, area);
                if (t.first.x <= t.last.x && t.first.y <= t.last.y)
                    use(listed, t);
            }
    }
}

UvRaster::UvRaster(const UvTriangles& triangles, int width, int height, glm::ivec2 tile, bool wrap)
    : triangles_(triangles), width_(width), height_(height)
{
    const auto eachBlock = [&](const auto& add) {
        eachPlace(tile, wrap, [&](const Listed& listed, const Shown& t) {
            for (int block = t.first.y / kBlockRows; block * kBlockRows <= t.last.y; ++block)
                add(std::size_t(block), listed);
        });
    };
    listByGroup(std::size_t(blocks()), eachBlock, blockFirst_, listed_);
}

std::pair<int, int> UvRaster::span(const Shown& t, double py, double reach, double& low, double& high) const
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

template<class Emit> void UvRaster::scanCentres(const Shown& t, int y, const std::uint8_t* full, const Emit& emit) const
{
    const double py = y + 0.5;
    double low, high;
    const auto [first, last] = span(t, py, 0, low, high);
    const int begin = nextFree(full, first, last);
    if (begin > last)
        return;
    const Weights weights(t);
    // Well inside needs no test. Where a corner is close to the row an edge may lie along it, and where it meets the
    // row is not known well.
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
void UvRaster::scanTouching(const Shown& t, int y, const std::uint8_t* taken, const Emit& emit) const
{
    if (!std::memchr(taken + t.first.x, 0, std::size_t(t.last.x - t.first.x + 1)))
        return; // inside a chart: nothing left there
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

// Sorts what was found by texels, and the places of each texel in the order of the triangles.
void sortFound(UvRow& row)
{
    auto& [found, taken, twice, next, orders, sorted] = row.scratch;
    row.first.assign(next.size(), 0);
    std::inclusive_scan(next.begin(), next.end() - 1, row.first.begin() + 1);
    std::copy(row.first.begin(), row.first.end(), next.begin());
    row.places.resize(found.size());
    sorted.resize(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto [x, place] = found[i];
        std::uint32_t at = next[std::size_t(x)]++;
        for (; at > row.first[std::size_t(x)] && sorted[at - 1] > orders[i]; --at) {
            row.places[at] = row.places[at - 1];
            sorted[at] = sorted[at - 1];
        }
        row.places[at] = place;
        sorted[at] = orders[i];
    }
}

} // namespace

void UvRaster::rowsOfBlock(int first, std::span<UvRow> results, const UvFew& few) const
{
    const std::span<const Listed> listed = listedIn(first / kBlockRows);
    const bool limited = few.most < listed.size();
    for (UvRow& row : results) {
        row.scratch.found.clear();
        row.scratch.orders.clear();
        row.scratch.next.assign(std::size_t(width_) + 1, 0); // places of each texel, so far
        row.scratch.taken.assign(std::size_t(width_), 0);
    }
    const std::size_t step = limited && few.most > 1 ? spreadingStep(listed.size()) : 0; // 0: in their order
    bool isOpen[kBlockRows] = {}; // whether a texel of the row may get a place
    const auto someAreOpen = [&] {
        for (std::size_t k = 0; k < results.size(); ++k) {
            const std::vector<std::uint8_t>& full = results[k].scratch.taken;
            isOpen[k] = isOpen[k] && std::memchr(full.data(), 0, full.size());
        }
        return std::find(std::begin(isOpen), std::end(isOpen), true) != std::end(isOpen);
    };
    const auto eachShown = [&](const auto& scan) {
        std::fill_n(isOpen, results.size(), true);
        for (std::size_t i = 0; i < listed.size(); ++i) {
            if (i % 128 == 0 && !someAreOpen())
                return;
            const auto order =
                std::uint32_t(step > 0 ? std::uint64_t(i) * step % listed.size() : i); // where size_t has 32 bits, too
            const Shown t = shownAt(listed[order]);
            const int last = std::min(t.last.y - first, int(results.size()) - 1);
            for (int k = std::max(t.first.y - first, 0); k <= last; ++k)
                if (isOpen[k])
                    scan(t, first + k, results[std::size_t(k)], order);
        }
    };
    const auto emitTo = [&](UvRow& row, std::uint32_t order) {
        return [&row, &few, order](int x, const UvSample& place) {
            if (few.counts && !few.counts(place))
                return;
            row.scratch.found.push_back({x, place});
            row.scratch.orders.push_back(order);
            row.scratch.taken[std::size_t(x)] = ++row.scratch.next[std::size_t(x)] >= few.most;
        };
    };
    eachShown([&](const Shown& t, int y, UvRow& row, std::uint32_t order) {
        scanCentres(t, y, limited ? row.scratch.taken.data() : nullptr, emitTo(row, order));
    });
    for (UvRow& row : results)
        for (std::size_t x = 0; x < row.scratch.taken.size(); ++x)
            row.scratch.taken[x] = row.scratch.next[x] > 0;
    eachShown([&](const Shown& t, int y, UvRow& row, std::uint32_t order) {
        scanTouching(t, y, row.scratch.taken.data(), emitTo(row, order));
    });
    for (UvRow& row : results)
        sortFound(row);
}

void UvRaster::rows(int first, std::span<UvRow> results, const UvFew& few) const
{
    for (std::size_t count = 0; !results.empty(); first += int(count), results = results.subspan(count)) {
        count = std::min(results.size(), std::size_t(kBlockRows - first % kBlockRows));
        rowsOfBlock(first, results.first(count), few);
    }
}

void UvRaster::firsts(int block, UvFirsts& result) const
{
    const int top = block * kBlockRows, bottom = std::min(top + kBlockRows, height_) - 1;
    const int across = (width_ + kTile - 1) / kTile; // tiles
    std::vector<std::pair<glm::ivec2, UvSample>>& found = result.scratch.found;
    std::vector<std::uint8_t>& taken = result.scratch.taken;
    std::vector<std::uint32_t>& next = result.scratch.next; // of each tile
    taken.assign(std::size_t(bottom - top + 1) * std::size_t(width_), 0);
    next.assign(std::size_t(kBlockRows / kTile * across) + 1, 0);
    found.clear();
    result.again.clear();
    const auto tileOf = [&](glm::ivec2 texel) {
        return std::size_t((texel.y - top) / kTile * across + texel.x / kTile);
    };
    const auto eachRow = [&](const auto& scan) {
        for (const Listed& listed : listedIn(block)) {
            const Shown t = shownAt(listed);
            for (int y = std::max(top, t.first.y); y <= std::min(bottom, t.last.y); ++y)
                scan(t, y, &taken[std::size_t(y - top) * std::size_t(width_)]);
        }
    };
    const auto take = [&](glm::ivec2 texel, const UvSample& place, std::uint8_t* row) {
        row[texel.x] = 1;
        found.push_back({texel, place});
        ++next[tileOf(texel) + 1];
    };
    std::vector<std::uint8_t>& twice = result.scratch.twice;
    twice.assign(taken.size(), 0);
    eachRow([&](const Shown& t, int y, std::uint8_t* row) {
        std::uint8_t* const second = twice.data() + (row - taken.data());
        scanCentres(t, y, second, [&](int x, const UvSample& place) {
            if (!row[x])
                return take({x, y}, place, row);
            second[x] = 1;
            result.again.push_back({x, y});
        });
    });
    eachRow([&](const Shown& t, int y, std::uint8_t* row) {
        scanTouching(t, y, row, [&](int x, const UvSample& place) { take({x, y}, place, row); });
    });
    std::partial_sum(next.begin(), next.end(), next.begin());
    result.texels.resize(found.size());
    result.places.resize(found.size());
    for (const auto& [texel, place] : found) {
        const std::uint32_t at = next[tileOf(texel)]++;
        result.texels[at] = texel;
        result.places[at] = place;
    }
}

void UvRaster::eachSpan(const std::function<void(const UvSpan&)>& use) const
{
    for (int block = 0; block < blocks(); ++block)
        for (const Listed& listed : listedIn(block)) {
            const Shown t = shownAt(listed);
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
        // A triangle of several rows of copies is cut into as many, a row of texels at their borders lies in two.
        rows += copies.count.x * (std::min(high, double(copies.count.y)) * height + copies.count.y);
    }
    return rows;
}

} // namespace cotan
