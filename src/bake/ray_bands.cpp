#include "bake/ray_bands.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cotan/vector.hpp"

namespace cotan {

namespace {

constexpr float kSameCosine = 1 - 1e-6f; // between normals that count as equal: 0.08 degrees
constexpr float kWidth = 2;              // of a band, by how far its rays move sideways
constexpr std::size_t kMaxBands = 64;    // that reach a triangle; the nearest
constexpr float kLittle = 0.5f;          // a band this much less deep than another hardly changes its rays

// The depth of a point: 1 on the edge, 0 at the band's border, negative beyond. t: where on the edge the nearest point
// is.
float depthIn(const RayBands::Band& band, glm::vec3 p, float& t)
{
    const glm::vec3 along = band.to - band.from, off = p - band.from;
    const float length2 = glm::dot(along, along);
    t = length2 > 0 ? glm::clamp(glm::dot(off, along) / length2, 0.0f, 1.0f) : 0;
    return 1 - glm::length(off - along * t) / band.width;
}

// Bounds of depthIn over a triangle: the distance from a segment is largest at a corner; it is at least the distance
// from the slab across the edge that the segment spans, and at least that from its line.
struct Depths {
    float least = 1, most = 1;
};

Depths depthsIn(const RayBands::Band& band, const glm::vec3 (&corners)[3], glm::vec3 out)
{
    const glm::vec3 edge = unitOr(band.to - band.from, glm::vec3(0));
    float before = 1e30f, after = 1e30f, left = 1e30f, right = 1e30f;
    Depths depths;
    for (const glm::vec3 p : corners) {
        float t = 0;
        depths.least = std::min(depths.least, depthIn(band, p, t));
        before = std::min(before, glm::dot(band.from - p, edge));
        after = std::min(after, glm::dot(p - band.to, edge));
        left = std::min(left, glm::dot(p - band.from, out));
        right = std::min(right, glm::dot(band.from - p, out));
    }
    depths.most = 1 - std::max({0.0f, before, after, left, right}) / band.width;
    return depths;
}

struct Reach { // of a band into a triangle
    float depth;
    std::uint32_t triangle, band;

    // The deepest first, for std::priority_queue.
    bool operator<(const Reach& other) const
    {
        return std::tuple(depth, other.triangle, other.band) < std::tuple(other.depth, triangle, band);
    }
};

} // namespace

HardEdges hardEdgesOf(const LowSurface& low, std::span<const std::uint32_t> groups)
{
    struct Meeting { // of a triangle's edge with others between the same groups
        std::uint32_t a, b, edge;
    };
    HardEdges edges;
    edges.of.assign(low.indices.size(), HardEdges::kNone);
    edges.beyond = edges.of;
    const auto next = [](std::size_t i) { return i % 3 == 2 ? i - 2 : i + 1; };
    std::vector<Meeting> all;
    for (std::size_t i = 0; i < low.indices.size(); ++i) {
        const std::uint32_t a = groups[low.indices[i]], b = groups[low.indices[next(i)]];
        if (a != b)
            all.push_back({std::min(a, b), std::max(a, b), std::uint32_t(i)});
    }
    std::sort(all.begin(), all.end(), [](const Meeting& x, const Meeting& y) {
        return std::tie(x.a, x.b, x.edge) < std::tie(y.a, y.b, y.edge);
    });
    const auto normalAt = [&](const Meeting& m, std::uint32_t group) {
        const std::uint32_t v = low.indices[m.edge];
        return low.normals[groups[v] == group ? v : low.indices[next(m.edge)]];
    };
    const auto same = [&](const Meeting& x, const Meeting& y) {
        return glm::dot(normalAt(x, x.a), normalAt(y, x.a)) >= kSameCosine
            && glm::dot(normalAt(x, x.b), normalAt(y, x.b)) >= kSameCosine;
    };
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        bool smooth = true;
        for (end = begin + 1; end < all.size() && all[end].a == all[begin].a && all[end].b == all[begin].b; ++end)
            smooth = smooth && same(all[begin], all[end]);
        for (std::size_t i = begin; i < end && end - begin > 1; ++i)
            if (smooth)
                edges.beyond[all[i].edge] = all[i + 1 < end ? i + 1 : begin].edge / 3;
            else
                edges.of[all[i].edge] = edges.count;
        edges.count += smooth ? 0 : 1;
    }
    return edges;
}

EdgeSide sideOf(const LowSurface& low, std::span<const glm::vec3> directions, std::size_t edgeOfTriangle)
{
    const std::size_t f = edgeOfTriangle / 3 * 3, k = edgeOfTriangle % 3;
    const std::uint32_t v[3] = {low.indices[f + k], low.indices[f + (k + 1) % 3], low.indices[f + (k + 2) % 3]};
    EdgeSide side{low.positions[v[0]], low.positions[v[1]]};
    const glm::vec3 edge = unitOr(side.to - side.from, glm::vec3(0)), off = low.positions[v[2]] - side.from;
    side.out = unitOr(edge * glm::dot(off, edge) - off, glm::vec3(0));
    const glm::vec3 up = glm::cross(edge, side.out);
    side.up = glm::dot(up, low.normals[v[0]] + low.normals[v[1]] + low.normals[v[2]]) < 0 ? -up : up;
    for (std::size_t end = 0; end < 2; ++end) {
        // The lean from the vertex's own normal, in the plane across the edge.
        const glm::vec3 n = low.normals[v[end]], d = directions[v[end]];
        const glm::vec2 own(glm::dot(n, side.out), glm::dot(n, side.up));
        const glm::vec2 bent(glm::dot(d, side.out), glm::dot(d, side.up));
        const float product = glm::length(own) * glm::length(bent);
        const float sine = product > 0 ? (bent.x * own.y - bent.y * own.x) / product : 0;
        if (std::abs(sine) >= std::abs(side.sine)) {
            side.sine = sine;
            side.cosine = product > 0 ? glm::dot(own, bent) / product : 1;
        }
    }
    return side;
}

RayBands::Bend RayBands::bendAt(std::uint32_t triangle, glm::vec3 point) const
{
    Bend bend;
    for (std::uint32_t i = first[triangle]; i < first[triangle + 1]; ++i) {
        const Band& band = bands[lists[i]];
        float t = 0;
        const float depth = depthIn(band, point, t);
        if (!(depth > 0))
            continue;
        const float amount = depth * depth * (3 - 2 * depth); // even at both ends: details do not break at the border
        bend.amount = std::max(bend.amount, amount);
        // On an edge its direction alone counts, as on the other side.
        bend.direction += glm::mix(band.directions[0], band.directions[1], t) * (amount / (1 - amount + 1e-6f));
    }
    bend.direction = unitOr(bend.direction, glm::vec3(0));
    return bend;
}

RayBands makeBands(const LowSurface& low, const HardEdges& edges, std::span<const glm::vec3> directions,
                   std::span<const float> needs)
{
    RayBands made;
    std::vector<glm::vec3> outs; // of the bands' edges
    std::priority_queue<Reach> queue;
    for (std::size_t i = 0; i < edges.of.size(); ++i) {
        if (edges.of[i] == HardEdges::kNone)
            continue;
        const EdgeSide side = sideOf(low, directions, i);
        const float width = kWidth * needs[edges.of[i]] * std::abs(side.sine);
        if (!(width > 0))
            continue;
        queue.push({1, std::uint32_t(i / 3), std::uint32_t(made.bands.size())});
        const std::uint32_t a = low.indices[i], b = low.indices[i % 3 == 2 ? i - 2 : i + 1];
        made.bands.push_back({side.from, side.to, {directions[a], directions[b]}, width});
        outs.push_back(side.out);
    }
    // Bands grow over the triangles, the deepest first, and end where another is much deeper.
    std::vector<std::vector<std::uint32_t>> reaching(low.triangleCount());
    std::vector<float> least(low.triangleCount(), 0);
    while (!queue.empty()) {
        const Reach reach = queue.top();
        queue.pop();
        const std::size_t f = reach.triangle;
        std::vector<std::uint32_t>& list = reaching[f];
        if (!(reach.depth > std::max(0.0f, least[f] - kLittle)) || list.size() == kMaxBands
            || std::find(list.begin(), list.end(), reach.band) != list.end())
            continue;
        list.push_back(reach.band);
        const auto cornersOf = [&](std::size_t triangle, glm::vec3(&corners)[3]) {
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = low.positions[low.indices[3 * triangle + k]];
        };
        glm::vec3 corners[3];
        cornersOf(f, corners);
        least[f] = std::max(least[f], depthsIn(made.bands[reach.band], corners, outs[reach.band]).least);
        for (std::size_t k = 0; k < 3; ++k)
            if (const std::uint32_t beyond = edges.beyond[3 * f + k]; beyond != HardEdges::kNone) {
                cornersOf(beyond, corners);
                const float most = depthsIn(made.bands[reach.band], corners, outs[reach.band]).most;
                if (most > std::max(0.0f, least[beyond] - kLittle))
                    queue.push({std::min(most, reach.depth), beyond, reach.band});
            }
    }
    made.first.push_back(0);
    for (const std::vector<std::uint32_t>& list : reaching) {
        made.lists.insert(made.lists.end(), list.begin(), list.end());
        made.first.push_back(std::uint32_t(made.lists.size()));
    }
    return made;
}

} // namespace cotan
