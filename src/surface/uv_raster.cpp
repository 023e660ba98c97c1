#include "cotan/surface/uv_raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cotan {

namespace {

constexpr double kFarthest = 1e6;     // uv beyond have no texel of their own in float
constexpr double kReach = 0.70710678; // half the diagonal of a texel
constexpr int kTile = 4;              // side of the squares in which first places come
constexpr int kMostCopies = 64;       // of one triangle that wraps: per axis

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

// Of two triangles on either side of an edge exactly one takes the points on it: the fill rule of
// rasterisers.
bool takesEdge(glm::dvec2 a, glm::dvec2 b) { return b.y < a.y || (b.y == a.y && b.x < a.x); }

glm::dvec2 nearestOn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p)
{
    const glm::dvec2 d = b - a;
    const double d2 = glm::dot(d, d);
    return a + d * std::clamp(d2 > 0 ? glm::dot(p - a, d) / d2 : 0, 0.0, 1.0);
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

    UvPlace at(const Shown& t, glm::dvec2 p, bool covers) const
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

bool UvRaster::uvOf(std::uint32_t triangle, glm::dvec2 (&uv)[3], double& area) const
{
    bool usable = true;
    for (std::size_t k = 0; k < 3; ++k) {
        uv[k] = glm::dvec2(triangles_.texcoords[triangles_.indices[3 * std::size_t(triangle) + k]] * triangles_.scale);
        usable = usable && std::abs(uv[k].x) <= kFarthest && std::abs(uv[k].y) <= kFarthest;
    }
    area = cross(uv[1] - uv[0], uv[2] - uv[0]);
    return usable && area != 0;
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
    uvOf(listed.triangle, uv, area);
    return shownAt(listed, uv, area);
}

template<class Use> void UvRaster::eachPlace(glm::ivec2 tile, bool wrap, const Use& use) const
{
    glm::dvec2 uv[3];
    double area = 0;
    for (std::uint32_t i = 0; i < triangles_.indices.size() / 3; ++i) {
        if (!uvOf(i, uv, area))
            continue;
        glm::ivec2 from = tile, to = tile;
        if (wrap) {
            from = glm::ivec2(glm::floor(glm::min(uv[0], glm::min(uv[1], uv[2]))));
            const glm::dvec2 high = glm::max(uv[0], glm::max(uv[1], uv[2]));
            to = glm::max(glm::min(glm::ivec2(glm::ceil(high)) - 1, from + kMostCopies - 1), from);
        }
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                const Listed listed{i, {x, y}};
                const Shown t = shownAt(listed, uv, area);
                if (t.first.x <= t.last.x && t.first.y <= t.last.y)
                    use(listed, t);
            }
    }
}

UvRaster::UvRaster(const UvTriangles& triangles, int width, int height, glm::ivec2 tile, bool wrap)
    : triangles_(triangles), width_(width), height_(height), blockFirst_(std::size_t(blocks()) + 1, 0)
{
    const auto eachBlock = [&](const auto& use) {
        eachPlace(tile, wrap, [&](const Listed& listed, const Shown& t) {
            for (int block = t.first.y / kBlockRows; block * kBlockRows <= t.last.y; ++block)
                use(std::size_t(block), listed);
        });
    };
    eachBlock([&](std::size_t block, const Listed&) { ++blockFirst_[block + 1]; });
    for (std::size_t block = 1; block < blockFirst_.size(); ++block)
        blockFirst_[block] += blockFirst_[block - 1];
    listed_.resize(blockFirst_.back());
    std::vector<std::size_t> next(blockFirst_.begin(), blockFirst_.end() - 1);
    eachBlock([&](std::size_t block, const Listed& listed) { listed_[next[block]++] = listed; });
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

template<class Emit> void UvRaster::scanCentres(const Shown& t, int y, const Emit& emit) const
{
    const double py = y + 0.5;
    double low, high;
    const auto [first, last] = span(t, py, 0, low, high);
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
    for (int x = first; x <= last; ++x) {
        const glm::dvec2 p(x + 0.5, py);
        if ((!corner && x >= inner && x < outer) || covers(t, p))
            emit(x, weights.at(t, p, true));
    }
}

template<class Emit>
void UvRaster::scanTouching(const Shown& t, int y, const std::uint8_t* taken, const Emit& emit) const
{
    if (taken && !std::memchr(taken + t.first.x, 0, std::size_t(t.last.x - t.first.x + 1)))
        return; // inside a chart: nothing left there
    const double py = y + 0.5;
    double low, high;
    const auto [first, last] = span(t, py, kReach, low, high);
    const Weights weights(t);
    for (int x = first; x <= last; ++x) {
        if (taken && taken[x])
            continue;
        const glm::dvec2 p(x + 0.5, py);
        if (!taken && covers(t, p)) {
            emit(x, weights.at(t, p, true));
            continue;
        }
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

void UvRaster::row(int y, UvReach reach, UvRow& result) const
{
    std::vector<std::pair<int, UvPlace>>& found = result.scratch.found;
    std::vector<std::uint8_t>& taken = result.scratch.taken;
    std::vector<std::uint32_t>& next = result.scratch.next;
    found.clear();
    const auto emit = [&found](int x, const UvPlace& place) { found.push_back({x, place}); };
    const auto eachShown = [&](const auto& scan) {
        for (const Listed& listed : listedIn(y / kBlockRows))
            if (const Shown t = shownAt(listed); t.first.y <= y && y <= t.last.y)
                scan(t);
    };
    if (reach == UvReach::touching)
        eachShown([&](const Shown& t) { scanTouching(t, y, nullptr, emit); });
    else
        eachShown([&](const Shown& t) { scanCentres(t, y, emit); });
    if (reach == UvReach::gaps) {
        taken.assign(std::size_t(width_), 0);
        for (const auto& [x, place] : found)
            taken[std::size_t(x)] = 1;
        eachShown([&](const Shown& t) { scanTouching(t, y, taken.data(), emit); });
    }
    result.first.assign(std::size_t(width_) + 1, 0);
    for (const auto& [x, place] : found)
        ++result.first[std::size_t(x) + 1];
    for (std::size_t x = 1; x < result.first.size(); ++x)
        result.first[x] += result.first[x - 1];
    result.places.resize(found.size());
    next.assign(result.first.begin(), result.first.end() - 1);
    for (const auto& [x, place] : found) // in the order of the triangles
        result.places[next[std::size_t(x)]++] = place;
}

void UvRaster::firsts(int block, UvFirsts& result) const
{
    const int top = block * kBlockRows, bottom = std::min(top + kBlockRows, height_) - 1;
    const int across = (width_ + kTile - 1) / kTile; // tiles
    std::vector<std::pair<glm::ivec2, UvPlace>>& found = result.scratch.found;
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
    const auto take = [&](glm::ivec2 texel, const UvPlace& place, std::uint8_t* row) {
        if (row[texel.x])
            return result.again.push_back(texel);
        row[texel.x] = 1;
        found.push_back({texel, place});
        ++next[tileOf(texel) + 1];
    };
    eachRow([&](const Shown& t, int y, std::uint8_t* row) {
        scanCentres(t, y, [&](int x, const UvPlace& place) { take({x, y}, place, row); });
    });
    eachRow([&](const Shown& t, int y, std::uint8_t* row) {
        scanTouching(t, y, row, [&](int x, const UvPlace& place) { take({x, y}, place, row); });
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

void UvRaster::centres(int block, std::vector<std::pair<glm::ivec2, UvPlace>>& result) const
{
    result.clear();
    const int top = block * kBlockRows, bottom = std::min(top + kBlockRows, height_) - 1;
    for (const Listed& listed : listedIn(block)) {
        const Shown t = shownAt(listed);
        for (int y = std::max(top, t.first.y); y <= std::min(bottom, t.last.y); ++y)
            scanCentres(t, y, [&](int x, const UvPlace& place) { result.push_back({{x, y}, place}); });
    }
}

UvCoverage coverage(const UvRaster& raster)
{
    UvCoverage c;
    UvRow row;
    for (int y = 0; y < raster.height(); ++y) {
        raster.row(y, UvReach::centres, row);
        for (std::size_t x = 0; x + 1 < row.first.size(); ++x) {
            const std::uint32_t n = row.first[x + 1] - row.first[x];
            c.covered += n > 0;
            c.overlapping += n > 1;
        }
    }
    return c;
}

} // namespace cotan
