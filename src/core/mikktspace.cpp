// MikkTSpace, written from its description. The steps: weld equal vertices; a tangent direction
// and an orientation for every triangle; neighbours across shared edges; groups of triangles of
// one orientation that hang together around a vertex; an angle-weighted average per group.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>
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

// ---- corners: which meet at a vertex, and which of those are neighbours ---------------------

// The corners at each welded vertex, in order; those of degenerate triangles are left out.
struct CornersAt {
    LargeArray<std::uint32_t> first; // per vertex; kNone: it has none
    LargeArray<std::uint32_t> next;  // per corner; kNone: it is its vertex's last

    // Into `corners`, as far as they fit. Returns the first that does not fit, or kNone.
    std::uint32_t list(std::size_t vertex, std::span<std::uint32_t> corners, std::uint32_t& count) const
    {
        std::uint32_t c = first[vertex];
        for (count = 0; c != kNone && count < corners.size(); c = next[c])
            corners[count++] = c;
        return c;
    }

    // All of them.
    void list(std::size_t vertex, std::vector<std::uint32_t>& corners) const
    {
        corners.clear();
        for (std::uint32_t c = first[vertex]; c != kNone; c = next[c])
            corners.push_back(c);
    }
};

// at: without corners yet.
void addCorners(const Triangles& t, std::size_t threads, CornersAt& at)
{
    const std::size_t vertices = t.mesh.positions.size();
    // Each thread writes the corners of its own vertices, from the last, and reads the blocks that have such.
    runTasks(threads, threads, [&](std::size_t part) {
        const std::size_t begin = partBegin(vertices, part, threads);
        const std::size_t size = partBegin(vertices, part + 1, threads) - begin;
        for (std::size_t block = t.ranges.size(); block-- > 0;) {
            const VertexRange range = t.ranges[block];
            if (range.least >= begin + size || range.most < begin)
                continue;
            for (std::size_t f = std::min((block + 1) * kBlock, t.count); f-- > block * kBlock;)
                if (!t.has(f, kDegenerate))
                    for (std::size_t c = 3 * f + 3; c-- > 3 * f;)
                        if (const std::size_t v = t.vertices[c]; v - begin < size)
                            at.next[c] = std::exchange(at.first[v], static_cast<std::uint32_t>(c));
        }
    });
}

// Which of the corners at one vertex are neighbours: across the edge that leaves the vertex at corner i,
// and across the one that comes back to it, is the corner left[i], right[i]; kNone where there is none.
// As indices into the list of corners, in lists as long as the longest needed so far. Of the edges between the same two
// vertices the k-th that runs one way meets the k-th that runs the other way.
struct Ring {
    std::vector<std::uint32_t> left, right;

    // In time n log n.
    void make(const Triangles& t, std::span<const std::uint32_t> corners)
    {
        const auto count = static_cast<std::uint32_t>(corners.size());
        if (left.size() < count)
            for (auto* list : {&leaving, &coming, &left, &right})
                list->resize(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            leaving[i] = t.vertices[nextCorner(corners[i])];
            coming[i] = t.vertices[previousCorner(corners[i])];
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
        sorted(leaving, byLeaving);
        sorted(coming, byComing);
        for (std::size_t i = 0, j = 0; i < byLeaving.size() && j < byComing.size();) {
            const std::uint32_t a = leaving[byLeaving[i]], b = coming[byComing[j]];
            if (a == b) {
                left[byLeaving[i]] = byComing[j];
                right[byComing[j]] = byLeaving[i];
            }
            i += a <= b;
            j += b <= a;
        }
    }

private:
    std::vector<std::uint32_t> leaving, coming; // the edges' other vertices
    std::vector<std::uint32_t> byLeaving, byComing;
    std::vector<std::uint64_t> keys; // another vertex, and the corner below it
};

// The corners that hang together with `seed`, as far as take(corner) says yes: it is asked for each in
// order, to the left first, and says no to a neighbour that is none.
template<class List, class Take> void walk(std::uint32_t seed, const List& left, const List& right, const Take& take)
{
    for (std::uint32_t i = seed; take(i);)
        i = left[i];
    for (std::uint32_t i = right[seed]; take(i);)
        i = right[i];
}

// ---- averages -------------------------------------------------------------------------------

// With the threshold of 180 degrees two triangles are still kept apart where their directions are
// exactly opposite: member by member then. Large groups, which only a mesh made for the purpose
// has, are averaged whole, so that the time stays linear.
constexpr std::size_t kLargeGroup = 256;

glm::vec3 projected(glm::vec3 v, glm::vec3 n) { return v - n * glm::dot(n, v); }

// The whole group's weighted sum, and whether no two directions in it can be opposite: all within
// 90 degrees of the first, less a little for rounding. That is the usual case, and then every member has this sum.
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
        inOneHalf &= glm::dot(firstV, t.alongV[c / 3]) > kCosine; // along n there is nothing of the first
        sum += u;
    }
    return inOneHalf;
}

// What a corner has that no group reaches, as mikktspace.c has it.
constexpr glm::vec4 kNoGroup{1, 0, 0, 1};

// A sum that cancels out stays zero; one that is not finite, which mikktspace.c hands on, is dropped.
glm::vec4 storedTangent(glm::vec3 sum, bool preserving)
{
    const glm::vec3 unit = normalizeOrZero(sum);
    if (!std::isfinite(glm::dot(unit, unit)))
        return kNoGroup;
    return {unit, preserving ? -1.0f : 1.0f}; // v runs down, glTF's bitangent up
}

// One group while it is averaged member by member.
struct Members {
    std::vector<glm::vec3> alongU, alongV; // of the triangles, in the vertex's plane
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
        const auto any = [&](std::size_t i) { return t.has(group[i] / 3, kJoinsAny); };
        glm::vec3 sum(0);
        for (std::size_t i = 0; i < group.size(); ++i)
            if (i == member || any(i) || any(member)
                || (glm::dot(alongU[member], alongU[i]) > -1 && glm::dot(alongV[member], alongV[i]) > -1))
                sum += contributions[i];
        return sum;
    }
};

// out: the contributions of the corners; those of the group become tangents.
void averageGroup(const Triangles& t, std::span<const std::uint32_t> group, Members& members, std::span<glm::vec4> out)
{
    const glm::vec3 n = t.normal(group[0]);
    const bool preserving = t.has(group[0] / 3, kPreserving);
    glm::vec3 sum;
    if (sumInOneHalf(t, group, out, n, sum) || group.size() > kLargeGroup) {
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

// The set of the positions in a list where `value` stands, as bits.
template<std::size_t kSize> std::uint32_t positionsOf(std::uint32_t value, const std::array<std::uint32_t, kSize>& list)
{
    std::uint32_t positions = 0;
#ifdef __SSE2__ // compilers do not find that
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

// The groups at a vertex with at most kMax corners: sets of corners are the bits of a word, and neighbours are
// found by comparing all with all.
template<std::size_t kMax>
void averageFew(const Triangles& t, std::span<const std::uint32_t> corners, Members& members, std::span<glm::vec4> out)
{
    constexpr std::uint32_t kNobody = 31; // no corner has that bit
    const auto count = static_cast<std::uint32_t>(corners.size());
    std::array<std::uint32_t, kMax> leaving, coming, left, right; // as in Ring
    std::uint32_t preserving = 0;
    coming.fill(kNone);
    right.fill(kNobody);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t f = corners[i] / 3, k = corners[i] - 3 * f;
        leaving[i] = t.vertices[k == 2 ? 3 * f : corners[i] + 1];
        coming[i] = t.vertices[k == 0 ? 3 * f + 2 : corners[i] - 1];
        preserving |= std::uint32_t(t.flags[f] & kPreserving) << i;
    }
    for (std::uint32_t i = 0, rest = ~0u; i < count; ++i) { // rest: nobody's right neighbour
        left[i] = kNobody;
        if (const std::uint32_t those = positionsOf(leaving[i], coming) & rest; those != 0) {
            left[i] = std::uint32_t(std::countr_zero(those));
            right[left[i]] = i;
            rest &= ~(1u << left[i]);
        }
    }
    std::uint32_t free = (1u << count) - 1; // in no group yet
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

// The same for any number of corners.
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

// Shares of the time after which each step is done.
constexpr double kWelded = 0.2, kDerived = 0.5, kListed = 0.6;

// Where every triangle has a direction, the groups of a vertex are nobody else's business.
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
            } else if (count > 0) { // not welded to another
                averageFew<8>(t, std::span(few).first(count), members, out);
            }
    };
    return runPartsWithProgress(t.mesh.positions.size(), threads, listener, kListed, average);
}

// left and right by corner: Ring for all vertices. left takes the place of at.next; returns right.
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

// Marks the corner as taken and says so, if its triangle may join a group of that orientation.
bool join(Triangles& t, std::size_t corner, bool preserving)
{
    std::uint8_t& flags = t.flags[corner / 3];
    if ((flags & takenFlag(corner)) != 0)
        return false;
    // The first group to reach a triangle without a direction decides its orientation.
    if ((flags & kJoinsAny) != 0 && flags < kTaken)
        flags = static_cast<std::uint8_t>((flags & ~kPreserving) | (preserving ? kPreserving : 0));
    if (((flags & kPreserving) != 0) != preserving)
        return false;
    flags |= takenFlag(corner);
    return true;
}

// Which group a triangle without a direction joins depends on the order of the corners: one after the
// other. What no group reaches gets kNoGroup.
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

// A triangle with two equal positions takes over what the first sound triangle at each vertex has.
void inheritAtDegenerate(const Triangles& t, const CornersAt& at, std::span<glm::vec4> out)
{
    for (std::size_t c = 0; c < out.size(); ++c)
        if (t.has(c / 3, kDegenerate))
            if (const std::uint32_t sound = at.first[t.vertices[c]]; sound != kNone)
                out[c] = out[sound];
}

// Starting a thread takes as long as some thousands of triangles.
constexpr std::size_t kTrianglesPerThread = 8192;

} // namespace

bool mikktspace::makeTangents(const MeshView& mesh, int threads, const Listener& listener, std::vector<glm::vec4>& out)
{
    const std::size_t used = threadsFor(mesh.indices.size() / 3, kTrianglesPerThread, threads);
    CornersAt at;
    auto makeRoom = [&] { // fresh memory takes half as long
        out = zeros<glm::vec4>(mesh.indices.size());
        at = {makeLargeArray<std::uint32_t>(mesh.positions.size()), makeLargeArray<std::uint32_t>(mesh.indices.size())};
        std::fill_n(at.first.get(), mesh.positions.size(), kNone);
    };
    const tangents::Task beside{[](void* room) { (*static_cast<decltype(makeRoom)*>(room))(); }, &makeRoom};
    LargeArray<std::uint32_t> firstVertex = tangents::weld(mesh, used, beside);
    if (!listener(kWelded))
        return false;
    Triangles t = makeTriangles(mesh, std::move(firstVertex), used, out);
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

std::vector<glm::vec4> mikktspaceTangents(const MeshView& mesh, int threads)
{
    std::vector<glm::vec4> out;
    if (tangents::usable(mesh, threadsFor(mesh.indices.size() / 3, kTrianglesPerThread, threads)))
        mikktspace::makeTangents(mesh, threads, {}, out);
    return out;
}

} // namespace cotan
