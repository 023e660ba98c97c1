#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <glm/geometric.hpp>

#include "cotan/lint/texel.hpp"
#include "parts.hpp"

namespace cotan::lint {

namespace {

constexpr int kTiles = 16;          // along each side of the map
constexpr double kSteepest = 4;     // slope; beyond, x/z is mostly rounding
constexpr double kBiggestStep = 0.8; // of the slope between neighbours; beyond, a border of two charts
constexpr double kLeastDetail = 1e-7; // mean square of the mixed differences; below, it is quantisation

struct Slope {
    double u = 0, v = 0;
    bool usable = false;
};

Slope slopeAt(const Image& map, const f64::cotan_normal_format& format, int x, int y)
{
    const glm::dvec3 m = f64::cotan_decode(storedTexel(map, x, y), format);
    const double length = glm::length(m);
    if (!(length > 0.7 && length < 1.3 && m.z > 0))
        return {};
    const Slope s{-m.x / m.z, -m.y / m.z, true};
    return std::abs(s.u) < kSteepest && std::abs(s.v) < kSteepest ? s : Slope{};
}

// Sums over texels of the products of p = d(h_u)/dv and q = d(h_v)/du.
struct Sums {
    double pp = 0, qq = 0, pq = 0;
    double correlation() const { return pp + qq > 0 ? 2 * pq / (pp + qq) : 0; }
};

} // namespace

// For a height h(u,v) the mixed second derivatives are equal: p = q. With green the other way h_v
// changes its sign, and p = -q. Central differences of neighbouring texels.
GreenEvidence greenEvidence(const Image& map, const Material& material)
{
    GreenEvidence e;
    e.name = map.name;
    if (!hasPixels(map) || map.width < 4 || map.height < 4)
        return e;
    f64::cotan_normal_format format = formatOf(material);
    format.strength = 1;
    std::vector<Sums> tiles(std::size_t(kTiles) * kTiles);
    std::vector<std::vector<Slope>> rows(3, std::vector<Slope>(std::size_t(map.width)));
    auto readRow = [&](int y) {
        for (int x = 0; x < map.width; ++x)
            rows[std::size_t(y % 3)][std::size_t(x)] = slopeAt(map, format, x, y);
    };
    readRow(0);
    readRow(1);
    std::size_t counted = 0;
    for (int y = 1; y + 1 < map.height; ++y) {
        readRow(y + 1);
        const auto &above = rows[std::size_t((y - 1) % 3)], &here = rows[std::size_t(y % 3)],
                   &below = rows[std::size_t((y + 1) % 3)];
        for (std::size_t x = 1; x + 1 < std::size_t(map.width); ++x) {
            const Slope &n = above[x], &s = below[x], &w = here[x - 1], &o = here[x + 1];
            if (!n.usable || !s.usable || !w.usable || !o.usable)
                continue;
            const double p = s.u - n.u, q = o.v - w.v;
            const double steps = std::max({std::abs(p), std::abs(q), std::abs(s.v - n.v), std::abs(o.u - w.u)});
            if (steps > kBiggestStep)
                continue;
            ++counted;
            Sums& t = tiles[std::size_t(y) * kTiles / std::size_t(map.height) * kTiles
                            + x * kTiles / std::size_t(map.width)];
            t.pp += p * p;
            t.qq += q * q;
            t.pq += p * q;
        }
    }
    Sums all;
    for (const Sums& t : tiles) {
        all.pp += t.pp;
        all.qq += t.qq;
        all.pq += t.pq;
    }
    e.correlation = all.correlation();
    e.asDeclared = e.correlation >= 0;
    double same = 0, weight = 0;
    for (const Sums& t : tiles) {
        const double w = std::abs(t.pq);
        weight += w;
        same += (t.pq >= 0) == e.asDeclared ? w : 0;
    }
    e.agreement = weight > 0 ? same / weight : 0;
    const bool detailed = counted > 0 && (all.pp + all.qq) / double(counted) > kLeastDetail;
    const bool bothWays = std::min(all.pp, all.qq) > 0.01 * std::max(all.pp, all.qq);
    e.decided = detailed && bothWays && std::abs(e.correlation) > 0.05 && e.agreement > 0.7;
    return e;
}

} // namespace cotan::lint
