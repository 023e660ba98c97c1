// MikkTSpace, implemented from its description. The steps: weld equal vertices; derive a tangent direction and an
// orientation for every triangle; find neighbours across shared edges; form groups of triangles of one orientation that
// are connected around a vertex; average each group, weighted by angle, or for areaWeightedTangents by angle and sides.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <utility>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "mikktspace.hpp"

namespace cotan {

namespace {

using namespace mikktspace;
using tangents::normalizeOrZero;
using tangents::projectedUnit;

// ---- corners at a vertex, and which of them are neighbours ----------------------------------

// The corners at each welded vertex, in order; those of degenerate triangles are left out.
struct CornersAt {
    LargeArray<std::uint32_t> first; // per vertex; kNone: no corners
    LargeArray<std::uint32_t> next;  // per corner; kNone: the last of its vertex

    // Lists the corners in `corners` as far as they fit. Returns the first one that does not fit, or kNone.
    std::uint32_t list(std::size_t vertex, std::span<std::uint32_t> corners, std::uint32_t& count) const
    {
        std::uint32_t c = first[vertex];
        for (count = 0; c != kNone && count < corners.size(); c = next[c])
            corners[count++] = c;
        return c;
    }

    // Lists all corners.
    void list(std::size_t vertex, std::vector<std::uint32_t>& corners) const
    {
        corners.clear();
        for (std::uint32_t c = first[vertex]; c != kNone; c = next[c])
            corners.push_back(c);
    }
};

// Fills `at`, which has no corners yet.
void addCorners(const Triangles& t, std::size_t threads, CornersAt& at)
{
    const std::size_t vertices = t.mesh.positions.size();
    // Each thread adds the corners of its own vertices, in descending order, and skips blocks without such vertices.
    runTasks(threads, threads, [&](std::size_t part) {
        const std::size_t begin = partBegin(vertices, part, threads);
        const std::size_t size = partBegin(vertices, part + 1, threads) - begin;
        for (std::size_t block = t.ranges.size(); block-- > 0;) {
            const VertexRange range = t.ranges[block];
            if (range.minimum >= begin + size || range.maximum < begin)
                continue;
            for (std::size_t f = std::min((block + 1) * kBlock, t.count); f-- > block * kBlock;)
                if (!t.has(f, kDegenerate))
                    for (std::size_t c = 3 * f + 3; c-- > 3 * f;)
                        if (const std::size_t v = t.vertices[c]; v - begin < size)
                            at.next[c] = std::exchange(at.first[v], static_cast<std::uint32_t>(c));
        }
    });
}

// Neighbours among the corners at one vertex: left[i] is the corner across the edge that leaves the vertex at corner i,
// right[i] the one across the edge that returns to it; kNone if there is none. Values are indices into the list of
// corners. The arrays keep the size of the longest list so far. Of several edges between the same two vertices, the
// k-th in one direction is paired with the k-th in the other.
struct Ring {
    std::vector<std::uint32_t> left, right;

    // Takes O(n log n) time.
    void make(const Triangles& t, std::span<const std::uint32_t> corners)
    {
        const auto count = static_cast<std::uint32_t>(corners.size());
        if (left.size() < count)
            for (auto* list : {&outgoing, &incoming, &left, &right})
                list->resize(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            outgoing[i] = t.vertices[nextCorner(corners[i])];
            incoming[i] = t.vertices[previousCorner(corners[i])];
            left[i] = right[i] = kNone;
        }
        const auto sorted = [&](const std::vector<std::uint32_t>& others, std::vector<std::uint32_t>& order) {
            keys.resize(count);
            order.resize(count);
            for (std::uint32_t i = 0; i < count; ++i)
                keys[i] = std::uint64_t(others[i]) << 32 | i;
            std::ranges::sort(keys);
            std::ranges::transform(keys, order.begin(), [](std::uint64_t key) { return std::uint32_t(key); });
        };
        sorted(outgoing, byOutgoing);
        sorted(incoming, byIncoming);
        for (std::size_t i = 0, j = 0; i < byOutgoing.size() && j < byIncoming.size();) {
            const std::uint32_t a = outgoing[byOutgoing[i]], b = incoming[byIncoming[j]];
            if (a == b) {
                left[byOutgoing[i]] = byIncoming[j];
                right[byIncoming[j]] = byOutgoing[i];
            }
            i += a <= b;
            j += b <= a;
        }
    }

private:
    std::vector<std::uint32_t> outgoing, incoming; // the other vertex of each edge
    std::vector<std::uint32_t> byOutgoing, byIncoming;
    std::vector<std::uint64_t> keys; // the other vertex in the high bits, the corner in the low ones
};

// Visits the corners connected to `seed`, to the left first, then to the right, until take(corner) returns false, as it
// must where there is no neighbour.
template<class List, class Take> void walk(std::uint32_t seed, const List& left, const List& right, const Take& take)
{
    for (std::uint32_t i = seed; take(i);)
        i = left[i];
    for (std::uint32_t i = right[seed]; take(i);)
        i = right[i];
}

// ---- averages -------------------------------------------------------------------------------

// Even with the threshold of 180 degrees, two triangles with exactly opposite directions are not averaged together.
// Groups that contain such directions are averaged separately for each member. Large groups, which occur only in meshes
// made for this purpose, are averaged as a whole, so that the time stays linear.
constexpr std::size_t kLargeGroup = 256;

glm::vec3 projected(glm::vec3 v, glm::vec3 n) { return v - n * glm::dot(n, v); }

// Computes the weighted sum of the group. Returns whether no two directions in it can be opposite: all are within 90
// degrees of the first, with a margin for rounding. In this usual case the sum applies to every member.
bool sumInOneHalf(const Triangles& t, std::span<const std::uint32_t> group, std::span<const glm::vec4> contributions,
                  glm::vec3 n, glm::vec3& sum)
{
    constexpr float kCosine = 0.001f, kMaxWeight = 3.15f;
    const glm::vec3 firstU(contributions[group[0]]), firstV = projected(t.alongV[group[0] / 3], n);
    const float minU = kCosine * kMaxWeight * std::sqrt(glm::dot(firstU, firstU));
    bool inOneHalf = true;
    sum = glm::vec3(0);
    for (const std::uint32_t c : group) {
        const glm::vec3 u(contributions[c]);
        inOneHalf &= glm::dot(firstU, u) > minU;
        inOneHalf &= glm::dot(firstV, t.alongV[c / 3]) > kCosine; // the first direction has no part along n
        sum += u;
    }
    return inOneHalf;
}

// The tangent of corners that no group reaches, as in mikktspace.c.
constexpr glm::vec4 kNoGroup{1, 0, 0, 1};

// Zero sums stay zero. Non-finite sums, which mikktspace.c passes on, give kNoGroup.
glm::vec4 storedTangent(glm::vec3 sum, bool preserving)
{
    const glm::vec3 unit = normalizeOrZero(sum);
    if (!std::isfinite(glm::dot(unit, unit)))
        return kNoGroup;
    return {unit, preserving ? -1.0f : 1.0f}; // v runs down, glTF's bitangent up
}

// A group that is averaged separately for each member.
struct Members {
    std::vector<glm::vec3> alongU, alongV; // of the triangles, in the tangent plane of the vertex
    std::vector<glm::vec3> contributions;

    void project(const Triangles& t, std::span<const std::uint32_t> group, std::span<const glm::vec4> all, glm::vec3 n)
    {
        alongU.clear();
        alongV.clear();
        contributions.clear();
        for (const std::size_t c : group) {
            contributions.emplace_back(all[c]);
            alongU.push_back(projectedUnit(mikktspace::alongU(t, c / 3), n));
            alongV.push_back(projectedUnit(t.alongV[c / 3], n));
        }
    }

    glm::vec3 sumFor(const Triangles& t, std::span<const std::uint32_t> group, std::size_t member) const
    {
        const auto joinsAny = [&](std::size_t i) { return t.has(group[i] / 3, kJoinsAny); };
        glm::vec3 sum(0);
        for (std::size_t i = 0; i < group.size(); ++i)
            if (i == member || joinsAny(i) || joinsAny(member)
                || (glm::dot(alongU[member], alongU[i]) > -1 && glm::dot(alongV[member], alongV[i]) > -1))
                sum += contributions[i];
        return sum;
    }
};

// Averages a group. out: the contributions of the corners; those of the group are replaced by tangents.
void averageGroup(const Triangles& t, std::span<const std::uint32_t> group, Members& members, std::span<glm::vec4> out)
{
    const glm::vec3 n = t.normal(group[0]);
    const bool preserving = t.has(group[0] / 3, kPreserving);
    glm::vec3 sum;
    // meshoptimizer averages opposite directions, too.
    if (sumInOneHalf(t, group, out, n, sum) || t.weight == Weight::area || group.size() > kLargeGroup) {
        const glm::vec4 tangent = storedTangent(sum, preserving);
        for (const std::uint32_t c : group)
            out[c] = tangent;
        return;
    }
    members.project(t, group, out, n);
    for (std::size_t i = 0; i < group.size(); ++i)
        out[group[i]] = storedTangent(members.sumFor(t, group, i), preserving);
}

// ---- groups ---------------------------------------------------------------------------------

// Returns the positions of `value` in a list, as a bit set.
template<std::size_t kSize> std::uint32_t positionsOf(std::uint32_t value, const std::array<std::uint32_t, kSize>& list)
{
    std::uint32_t positions = 0;
#ifdef __SSE2__ // compilers do not vectorise the loop this way
    const __m128i wanted = _mm_set1_epi32(static_cast<int>(value));
    const auto equal = [&](std::size_t i) {
        return _mm_cmpeq_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(&list[i])), wanted);
    };
    for (std::size_t i = 0; i < kSize; i += 8) {
        const __m128i words = _mm_packs_epi32(equal(i), equal(i + 4));
        positions |= static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(words, _mm_setzero_si128()))) << i;
    }
#else
    for (std::size_t i = 0; i < kSize; ++i)
        positions |= list[i] == value ? 1u << i : 0u;
#endif
    return positions;
}

// Averages the groups at a vertex with at most kMax corners. Sets of corners are the bits of a word, and comparing all
// pairs finds the neighbours.
template<std::size_t kMax>
void averageFew(const Triangles& t, std::span<const std::uint32_t> corners, Members& members, std::span<glm::vec4> out)
{
    constexpr std::uint32_t kNoNeighbour = 31; // not the bit of any corner
    const auto count = static_cast<std::uint32_t>(corners.size());
    std::array<std::uint32_t, kMax> outgoing, incoming, left, right; // as in Ring
    std::uint32_t preserving = 0;
    incoming.fill(kNone);
    right.fill(kNoNeighbour);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t f = corners[i] / 3, k = corners[i] - 3 * f;
        outgoing[i] = t.vertices[k == 2 ? 3 * f : corners[i] + 1];
        incoming[i] = t.vertices[k == 0 ? 3 * f + 2 : corners[i] - 1];
        preserving |= std::uint32_t(t.flags[f] & kPreserving) << i;
    }
    for (std::uint32_t i = 0, candidates = ~0u; i < count; ++i) { // corners that are not a right neighbour yet
        left[i] = kNoNeighbour;
        if (const std::uint32_t matches = positionsOf(outgoing[i], incoming) & candidates; matches != 0) {
            left[i] = std::uint32_t(std::countr_zero(matches));
            right[left[i]] = i;
            candidates &= ~(1u << left[i]);
        }
    }
    std::uint32_t free = (1u << count) - 1; // corners that are in no group yet
    while (free != 0) {
        const auto seed = std::uint32_t(std::countr_zero(free));
        const std::uint32_t alike = (preserving >> seed & 1) != 0 ? preserving : ~preserving;
        std::array<std::uint32_t, kMax> group;
        std::size_t size = 0;
        walk(seed, left, right, [&](std::uint32_t i) {
            if ((free & alike & 1u << i) == 0)
                return false;
            free &= ~(1u << i);
            group[size++] = corners[i];
            return true;
        });
        averageGroup(t, std::span(group).first(size), members, out);
    }
}

// Averages the groups at a vertex with any number of corners.
struct ManyCorners {
    Ring ring;
    std::vector<std::uint32_t> group;
    std::vector<std::uint8_t> taken;

    void average(const Triangles& t, std::span<const std::uint32_t> corners, Members& members, std::span<glm::vec4> out)
    {
        ring.make(t, corners);
        taken.assign(corners.size(), 0);
        for (std::uint32_t seed = 0; seed < corners.size(); ++seed) {
            if (taken[seed] != 0)
                continue;
            const bool preserving = t.has(corners[seed] / 3, kPreserving);
            group.clear();
            walk(seed, ring.left, ring.right, [&](std::uint32_t i) {
                if (i == kNone || taken[i] != 0 || t.has(corners[i] / 3, kPreserving) != preserving)
                    return false;
                taken[i] = 1;
                group.push_back(corners[i]);
                return true;
            });
            averageGroup(t, group, members, out);
        }
    }
};

// Fractions of the time at the end of each step.
constexpr double kWelded = 0.2, kDerived = 0.5, kListed = 0.6;

// Averages the vertices independently, which is possible if every triangle has a direction.
bool averageByVertex(const Triangles& t, const CornersAt& at, std::size_t threads, const Listener& listener,
                     std::span<glm::vec4> out)
{
    const auto average = [&](std::size_t begin, std::size_t end) {
        Members members;
        ManyCorners many;
        std::vector<std::uint32_t> all;
        std::array<std::uint32_t, 16> few;
        std::uint32_t count = 0;
        for (std::size_t v = begin; v < end; ++v)
            if (at.list(v, few, count) != kNone) {
                at.list(v, all);
                many.average(t, all, members, out);
            } else if (count > 8) {
                averageFew<16>(t, std::span(few).first(count), members, out);
            } else if (count > 0) { // 0: welded to another vertex, or unused
                averageFew<8>(t, std::span(few).first(count), members, out);
            }
    };
    return runPartsWithProgress(t.mesh.positions.size(), threads, listener, kListed, average);
}

// Finds the neighbours of all corners, as Ring does. Stores left in at.next and returns right.
LargeArray<std::uint32_t> makeRings(const Triangles& t, CornersAt& at)
{
    LargeArray<std::uint32_t> right = makeLargeArray<std::uint32_t>(t.corners());
    Ring ring;
    std::vector<std::uint32_t> corners;
    for (std::size_t v = 0; v < t.mesh.positions.size(); ++v) {
        at.list(v, corners);
        ring.make(t, corners);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            at.next[corners[i]] = ring.left[i] == kNone ? kNone : corners[ring.left[i]];
            right[corners[i]] = ring.right[i] == kNone ? kNone : corners[ring.right[i]];
        }
    }
    return right;
}

std::uint8_t takenFlag(std::size_t corner) { return static_cast<std::uint8_t>(kTaken << corner % 3); }

// Marks the corner as taken and returns true if it is free and its triangle may join a group of that orientation.
bool join(Triangles& t, std::size_t corner, bool preserving)
{
    std::uint8_t& flags = t.flags[corner / 3];
    if ((flags & takenFlag(corner)) != 0)
        return false;
    // The first group that reaches a triangle without a direction decides its orientation.
    if ((flags & kJoinsAny) != 0 && flags < kTaken)
        flags = static_cast<std::uint8_t>((flags & ~kPreserving) | (preserving ? kPreserving : 0));
    if (((flags & kPreserving) != 0) != preserving)
        return false;
    flags |= takenFlag(corner);
    return true;
}

// Averages the groups in the order of the corners, which decides the group that a triangle without a direction joins.
// Corners that no group reaches get kNoGroup.
bool averageInOrder(Triangles& t, CornersAt& at, const Listener& listener, std::span<glm::vec4> out)
{
    const LargeArray<std::uint32_t> right = makeRings(t, at);
    const LargeArray<std::uint32_t>& left = at.next;
    Members members;
    std::vector<std::uint32_t> group;
    for (std::uint32_t c = 0; c < t.corners(); ++c) {
        if (c % 65536 == 0 && !listener(kListed + (1 - kListed) * c / double(t.corners())))
            return false;
        if (t.has(c / 3, takenFlag(c) | kJoinsAny))
            continue;
        const bool preserving = t.has(c / 3, kPreserving);
        group.clear();
        walk(c, left, right, [&](std::uint32_t i) {
            const bool joined = i != kNone && join(t, i, preserving);
            if (joined)
                group.push_back(i);
            return joined;
        });
        averageGroup(t, group, members, out);
    }
    for (std::size_t c = 0; c < out.size(); ++c)
        if (!t.has(c / 3, takenFlag(c)))
            out[c] = kNoGroup;
    return true;
}

// Corners of triangles with two equal positions copy the tangent of the first valid triangle at the vertex.
void inheritAtDegenerate(const Triangles& t, const CornersAt& at, std::span<glm::vec4> out)
{
    for (std::size_t c = 0; c < out.size(); ++c)
        if (t.has(c / 3, kDegenerate))
            if (const std::uint32_t sound = at.first[t.vertices[c]]; sound != kNone)
                out[c] = out[sound];
}

// Starting a thread takes as long as several thousand triangles.
constexpr std::size_t kTrianglesPerThread = 8192;

bool makeWeighted(const MeshView& mesh, Weight weight, int threads, const Listener& listener,
                  std::vector<glm::vec4>& out)
{
    const std::size_t used = threadsFor(mesh.indices.size() / 3, kTrianglesPerThread, threads);
    CornersAt at;
    auto allocate = [&] { // takes half as long as the welding, so it runs concurrently
        out = zeros<glm::vec4>(mesh.indices.size());
        at = {makeLargeArray<std::uint32_t>(mesh.positions.size()), makeLargeArray<std::uint32_t>(mesh.indices.size())};
        std::fill_n(at.first.get(), mesh.positions.size(), kNone);
    };
    const tangents::Task sideTask{[](void* function) { (*static_cast<decltype(allocate)*>(function))(); }, &allocate};
    LargeArray<std::uint32_t> firstVertex = tangents::weld(mesh, used, sideTask);
    if (!listener(kWelded))
        return false;
    Triangles t = makeTriangles(mesh, weight, std::move(firstVertex), used, out);
    if (!listener(kDerived))
        return false;
    addCorners(t, used, at);
    if (!listener(kListed))
        return false;
    const int flags = std::reduce(t.flags.get(), t.flags.get() + t.count, std::uint8_t(0), std::bit_or<std::uint8_t>());
    if ((flags & kJoinsAny) == 0)
        return averageByVertex(t, at, used, listener, out);
    if (!averageInOrder(t, at, listener, out))
        return false;
    inheritAtDegenerate(t, at, out);
    return listener(1);
}

std::vector<glm::vec4> weightedTangents(const MeshView& mesh, Weight weight, int threads)
{
    std::vector<glm::vec4> out;
    if (tangents::usable(mesh, threadsFor(mesh.indices.size() / 3, kTrianglesPerThread, threads)))
        makeWeighted(mesh, weight, threads, {}, out);
    return out;
}

} // namespace

bool mikktspace::makeTangents(const MeshView& mesh, int threads, const Listener& listener, std::vector<glm::vec4>& out)
{
    return makeWeighted(mesh, Weight::angle, threads, listener, out);
}

bool mikktspace::makeAreaWeighted(const MeshView& mesh, int threads, const Listener& listener,
                                  std::vector<glm::vec4>& out)
{
    return makeWeighted(mesh, Weight::area, threads, listener, out);
}

std::vector<glm::vec4> mikktspaceTangents(const MeshView& mesh, int threads)
{
    return weightedTangents(mesh, Weight::angle, threads);
}

std::vector<glm::vec4> areaWeightedTangents(const MeshView& mesh, int threads)
{
    return weightedTangents(mesh, Weight::area, threads);
}

} // namespace cotan
