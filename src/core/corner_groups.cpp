#include "corner_groups.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "corner_lanes.hpp"
#include "cotan/portable.hpp"

namespace cotan::tangents {

Edges edgesAt(const MeshView& mesh, std::size_t f, std::size_t k)
{
    const std::uint32_t a = mesh.indices[3 * f + k], b = mesh.indices[3 * f + (k + 1) % 3],
                        c = mesh.indices[3 * f + (k + 2) % 3];
    const glm::dvec3 p(mesh.positions[a]);
    const glm::dvec2 t(mesh.texcoords[a]);
    return {glm::dvec3(mesh.positions[b]) - p, glm::dvec3(mesh.positions[c]) - p, glm::dvec2(mesh.texcoords[b]) - t,
            glm::dvec2(mesh.texcoords[c]) - t};
}

Side sideAt(const Edges& e, glm::vec3 normal)
{
    const glm::dvec3 face = glm::cross(e.dp1, e.dp2);
    const glm::dvec3 n(normal);
    // A vertex without a normal uses the triangle's normal.
    const double facing = n == glm::dvec3(0) ? glm::dot(face, face) : glm::dot(face, n);
    const double side = e.uvArea() * facing;
    if (!std::isfinite(side) || side == 0)
        return Side::none;
    return side > 0 ? Side::mirrored : Side::unmirrored;
}

// The weight of a triangle when the side of a vertex is decided: |cosine| of the angle between the two normals. Seen
// edge-on along the vertex normal, a corner can have an angle of 180 degrees, and rounding can flip its side.
static float openness(const Edges& e, glm::vec3 normal)
{
    const glm::dvec3 face = glm::cross(e.dp1, e.dp2);
    const double lengths = glm::length(face) * glm::length(glm::dvec3(normal));
    return lengths > 0 ? float(std::abs(glm::dot(face, glm::dvec3(normal))) / lengths) : 1.0f;
}

std::vector<Side> cornerSides(const MeshView& mesh, std::size_t threads)
{
    std::vector<Side> sides(mesh.indices.size());
    runParts(sides.size(), threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c != end; ++c)
            sides[c] = sideAt(edgesAt(mesh, c / 3, c % 3), mesh.normals[mesh.indices[c]]);
    });
    return sides;
}

namespace {

// Linked lists of equal vertices and of the corners at each vertex, in ascending order; kNone ends them.
struct Chains {
    LargeArray<std::uint32_t> equalVertex; // the next equal vertex; a list begins at its first vertex
    // Empty if corner k is the only one of vertex k.
    LargeArray<std::uint32_t> firstOfVertex, nextOfCorner;

    bool cornersAreVertices() const { return !nextOfCorner; }
    std::uint32_t firstCorner(std::uint32_t vertex) const { return firstOfVertex ? firstOfVertex[vertex] : vertex; }
    std::uint32_t nextCorner(std::uint32_t corner) const { return nextOfCorner ? nextOfCorner[corner] : kNone; }
};

bool eachCornerHasItsVertex(const MeshView& mesh)
{
    std::uint32_t other = 0; // branch-free, so that compilers vectorise the loop
    for (std::uint32_t c = 0; c < mesh.indices.size(); ++c)
        other |= mesh.indices[c] ^ c;
    return other == 0 && mesh.indices.size() == mesh.positions.size();
}

Chains chainsOf(const MeshView& mesh, const LargeArray<std::uint32_t>& first)
{
    const std::size_t count = mesh.positions.size();
    Chains chains{makeLargeArray<std::uint32_t>(count), {}, {}};
    std::fill_n(chains.equalVertex.get(), count, kNone);
    for (std::size_t v = count; v-- > 0;)
        if (first[v] != v) {
            chains.equalVertex[v] = chains.equalVertex[first[v]];
            chains.equalVertex[first[v]] = std::uint32_t(v);
        }
    if (eachCornerHasItsVertex(mesh))
        return chains;
    chains.firstOfVertex = makeLargeArray<std::uint32_t>(count);
    chains.nextOfCorner = makeLargeArray<std::uint32_t>(mesh.indices.size());
    std::fill_n(chains.firstOfVertex.get(), count, kNone);
    for (std::size_t c = mesh.indices.size(); c-- > 0;)
        chains.nextOfCorner[c] = std::exchange(chains.firstOfVertex[mesh.indices[c]], std::uint32_t(c));
    return chains;
}

// The sum over the triangles on one side.
struct Sum {
    glm::vec3 u{0}, v{0};
    float weight = 0;

    bool isEmpty() const { return !(weight > 0); }
    void add(const CornerGradients& g)
    {
        u += g.u;
        v += g.v;
        weight += g.weight;
    }
    Sum average() const
    {
        const float scale = isEmpty() ? 0 : 1 / weight;
        return {u * scale, v * scale, 1};
    }
};

// Adds the gradients of a corner's triangle; returns their weight.
float addCorner(const Edges& e, glm::vec3 n, Sum& sum)
{
    const glm::vec3 dp1(e.dp1), dp2(e.dp2);
    const f32::cotan_frame frame = f32::cotan_frame_gradient(n, dp1, dp2, glm::vec2(e.duv1), glm::vec2(e.duv2));
    const float weight = projectedAngle(glm::vec3(0), dp1, dp2, n);
    if (!(weight > 0) || (isZero(frame.t) && isZero(frame.b)))
        return 0;
    sum.u += frame.t * weight;
    sum.v += frame.b * weight;
    sum.weight += weight;
    return weight;
}

// The attributes that equal vertices share.
struct Shared {
    glm::vec3 position, normal, unit; // unit: the normal at length 1
    glm::vec2 texcoord;

    Shared(const MeshView& mesh, std::uint32_t vertex)
        : position(mesh.positions[vertex]), normal(mesh.normals[vertex]),
          unit(f32::cotan_normalize_or(normal, glm::vec3(0))), texcoord(mesh.texcoords[vertex])
    {
    }
};

// Returns the edges at corner c. kIsVertex: corner k is the only one of vertex k, so no index has to be read.
template<bool kIsVertex>
[[gnu::always_inline]] inline CornerEdges edgesIn(const MeshView& mesh, std::size_t c, const Shared& at)
{
    const std::size_t k = c % 3;
    // Without branches, which would be unpredictable.
    const std::size_t nextCorner = c + 1 - 3 * std::size_t(k == 2), previousCorner = c - 1 + 3 * std::size_t(k == 0);
    const std::size_t next = kIsVertex ? nextCorner : mesh.indices[nextCorner],
                      previous = kIsVertex ? previousCorner : mesh.indices[previousCorner];
    const glm::vec3 dp1 = mesh.positions[next] - at.position, dp2 = mesh.positions[previous] - at.position;
    const glm::vec2 duv1 = mesh.texcoords[next] - at.texcoord, duv2 = mesh.texcoords[previous] - at.texcoord;
    return {dp1, dp2, duv1, duv2, at.normal, at.unit};
}

// Averages over equal vertices. Corners of several vertices are derived side by side, except in WebAssembly, where
// deriving them one by one is faster and smaller.
#ifdef __EMSCRIPTEN__
constexpr bool kSideBySide = false;
#else
constexpr bool kSideBySide = true;
#endif

class Averaging {
public:
    Averaging(const MeshView& mesh, const Chains& chains, std::vector<Side>& sides, const Averages& averages)
        : mesh_(mesh), chains_(chains), sides_(sides), averages_(averages),
          lanes_(kSideBySide ? std::make_unique<CornerLanes>() : nullptr)
    {
    }

    // Averages `first` and the vertices that equal it, at the latest when finish() is called.
    void add(std::uint32_t first)
    {
        if constexpr (!kSideBySide) {
            addOneByOne(first);
        } else if (!gathered(first)) {
            finish();
            if (!gathered(first)) // more corners than there are lanes
                addOneByOne(first);
        }
    }

    void finish()
    {
        if constexpr (!kSideBySide)
            return;
        deriveGradients(*lanes_);
        std::size_t lane = 0;
        for (const Waiting& w : waiting_) {
            addLanes(w.first, lane, w.end);
            lane = w.end;
        }
        waiting_.clear();
        lanes_->count = 0;
    }

private:
    // Puts all corners of `first` into lanes, where they wait; returns false and adds none if they do not fit.
    bool gathered(std::uint32_t first)
    {
        return chains_.cornersAreVertices() ? gatheredAs<true>(first) : gatheredAs<false>(first);
    }

    template<bool kIsVertex> bool gatheredAs(std::uint32_t first)
    {
        const Shared at(mesh_, first);
        std::size_t lane = lanes_->count;
        for (std::uint32_t v = first; v != kNone; v = chains_.equalVertex[v])
            for (std::uint32_t c = kIsVertex ? v : chains_.firstCorner(v); c != kNone;
                 c = kIsVertex ? kNone : chains_.nextCorner(c)) {
                if (lane == CornerLanes::kLanes)
                    return false;
                lanes_->put(lane++, edgesIn<kIsVertex>(mesh_, c, at));
            }
        lanes_->count = lane;
        waiting_.push_back({first, lane});
        return true;
    }

    void addOneByOne(std::uint32_t first)
    {
        const Shared at(mesh_, first);
        Sum sums[2]; // indexed by Side
        for (std::uint32_t v = first; v != kNone; v = chains_.equalVertex[v])
            sides_[v] = addVertex(v, sums, [&](std::uint32_t c) { return gradientsOf(edgesIn<false>(mesh_, c, at)); });
        storeAll(first, sums);
    }

    void addLanes(std::uint32_t first, std::size_t lane, std::size_t end)
    {
        Sum sums[2];
        if (const Side side = lanes_->sideOf(lane, end); side != Side::none) { // all corners are usual and on one side
            Sum sum;
            for (; lane < end; ++lane)
                sum.add(lanes_->gradients(lane));
            sums[std::size_t(side)] = sum;
            for (std::uint32_t v = first; v != kNone; v = chains_.equalVertex[v])
                sides_[v] = chains_.firstCorner(v) == kNone ? Side::none : side;
        } else {
            for (std::uint32_t v = first; v != kNone; v = chains_.equalVertex[v])
                sides_[v] = addVertex(v, sums, [&](std::uint32_t) { return lanes_->gradients(lane++); });
        }
        storeAll(first, sums);
    }

    void storeAll(std::uint32_t first, const Sum (&sums)[2])
    {
        const Sum averages[2] = {sums[0].average(), sums[1].average()};
        const auto isEmpty = [&](std::size_t slot) { return sums[slot % 2].isEmpty(); };
        for (std::uint32_t v = first; v != kNone; v = chains_.equalVertex[v]) {
            sides_[v] = sideOrNearest(sides_[v], first, isEmpty);
            store(averages[std::size_t(sides_[v])], v);
            if (averages_.copies.empty() || averages_.copies[v] == kNone)
                continue;
            const Side other = averages_.keepers[v] == Side::mirrored ? Side::unmirrored : Side::mirrored;
            const bool known = !sums[std::size_t(other)].isEmpty();
            store(averages[std::size_t(sideOrNearest(known ? other : Side::none, first, isEmpty))],
                  averages_.copies[v]);
        }
    }

    void store(const Sum& average, std::uint32_t vertex)
    {
        if (!averages_.cotangents)
            return;
        averages_.cotangents->u[vertex] = average.u;
        averages_.cotangents->v[vertex] = average.v;
    }

    // Adds the corners of a vertex; calls gradients(c) for them in order. Returns the side whose average it takes.
    template<class Gradients> Side addVertex(std::uint32_t vertex, Sum (&sums)[2], const Gradients& gradients)
    {
        const glm::vec3 n = mesh_.normals[vertex];
        float weights[2] = {0, 0};
        for (std::uint32_t c = chains_.firstCorner(vertex); c != kNone; c = chains_.nextCorner(c)) {
            if (const CornerGradients g = gradients(c); g.usual) {
                const std::size_t side = std::size_t(g.mirrored ? Side::mirrored : Side::unmirrored);
                sums[side].add(g);
                weights[side] += g.weight;
                continue;
            }
            const Edges e = edgesAt(mesh_, c / 3, c % 3);
            if (const Side side = sideAt(e, n); side != Side::none)
                weights[std::size_t(side)] += addCorner(e, n, sums[std::size_t(side)]);
        }
        if (weights[0] > 0 && weights[1] > 0)
            return averages_.keepers.empty() ? largerSide(vertex, n) : averages_.keepers[vertex];
        return weights[0] > 0 ? Side::unmirrored : weights[1] > 0 ? Side::mirrored : Side::none;
    }

    // Returns the side with the larger sum of angle times openness, for a vertex that triangles of both sides use.
    Side largerSide(std::uint32_t vertex, glm::vec3 n) const
    {
        float shares[2] = {0, 0};
        for (std::uint32_t c = chains_.firstCorner(vertex); c != kNone; c = chains_.nextCorner(c)) {
            const Edges e = edgesAt(mesh_, c / 3, c % 3);
            Sum sum;
            if (const Side side = sideAt(e, n); side != Side::none)
                shares[std::size_t(side)] += addCorner(e, n, sum) * openness(e, n);
        }
        return shares[0] + shares[1] == 0 ? Side::none : shares[1] > shares[0] ? Side::mirrored : Side::unmirrored;
    }

    const MeshView& mesh_;
    const Chains& chains_;
    std::vector<Side>& sides_;
    const Averages& averages_;
    std::unique_ptr<CornerLanes> lanes_;
    // A vertex whose corners are in the lanes, and the end of its lanes.
    struct Waiting {
        std::uint32_t first;
        std::size_t end;
    };
    std::vector<Waiting> waiting_;
};

} // namespace

CornerGroups groupCorners(const MeshView& mesh, std::size_t threads, const Averages& averages, const Listener& listener,
                          const Task& sideTask)
{
    constexpr double kWelded = 0.3, kChained = 0.4; // fractions of the time
    const std::size_t count = mesh.positions.size();
    CornerGroups groups{weld(mesh, threads, sideTask), std::vector<Side>(count)};
    if (!listener(kWelded))
        return {};
    const Chains chains = chainsOf(mesh, groups.first);
    const auto average = [&](std::size_t begin, std::size_t end) {
        Averaging averaging(mesh, chains, groups.sides, averages);
        for (std::size_t v = begin; v != end; ++v)
            if (groups.first[v] == v)
                averaging.add(std::uint32_t(v));
        averaging.finish();
    };
    const bool done = listener(kChained) && runPartsWithProgress(count, threads, listener, kChained, average);
    return done ? std::move(groups) : CornerGroups{};
}

} // namespace cotan::tangents
