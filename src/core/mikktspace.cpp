// MikkTSpace, written from its description. The steps: weld equal vertices; a tangent direction
// and an orientation for every triangle; neighbours across shared edges; groups of triangles of
// one orientation that hang together around a vertex; an angle-weighted average per group.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "mikktspace_triangles.hpp"

namespace cotan {

namespace {

using namespace mikktspace;
using tangents::kNone;
using tangents::normalizeOrZero;
using tangents::projectedUnit;

// The corners at each welded vertex, in order; those of degenerate triangles are left out.
struct CornersAt {
    std::vector<std::uint32_t> start; // per vertex, and one more at the end
    std::unique_ptr<std::uint32_t[]> corners;

    std::span<const std::uint32_t> operator[](std::size_t vertex) const
    {
        return {corners.get() + start[vertex], start[vertex + 1] - start[vertex]};
    }
};

CornersAt cornersByVertex(const Triangles& t, std::size_t threads)
{
    const std::size_t vertices = t.mesh.positions.size();
    // Each thread reads all corners and writes those of its own vertices. each(vertex, corner), from the last.
    const auto forCorners = [&](const auto& each) {
        runTasks(threads, threads, [&](std::size_t part) {
            const std::size_t begin = partBegin(vertices, part, threads),
                              size = partBegin(vertices, part + 1, threads) - begin;
            for (auto c = static_cast<std::uint32_t>(t.corners()); c-- > 0;)
                if (const std::size_t v = t.vertices[c]; v - begin < size && !t.has(c / 3, kDegenerate))
                    each(v, c);
        });
    };
    CornersAt at{std::vector<std::uint32_t>(vertices + 1), nullptr};
    forCorners([&](std::size_t v, std::uint32_t) { ++at.start[v]; });
    std::uint32_t end = 0;
    for (std::uint32_t& start : at.start) // to where each vertex's corners end
        start = end += start;
    at.corners = std::make_unique_for_overwrite<std::uint32_t[]>(end);
    forCorners([&](std::size_t v, std::uint32_t c) { at.corners[--at.start[v]] = c; });
    return at;
}

// Which of the corners at one vertex are neighbours: across the edge that leaves the vertex at corner i,
// and across the one that comes back to it, is the corner left[i], right[i]; kNone where there is none.
// As indices into the list of corners. Of the edges between the same two vertices the k-th that runs one
// way meets the k-th that runs the other way.
struct Ring {
    std::vector<std::uint32_t> left, right;

    void make(const Triangles& t, std::span<const std::uint32_t> corners)
    {
        count = static_cast<std::uint32_t>(corners.size());
        if (left.size() < count)
            for (auto* list : {&leaving, &coming, &left, &right})
                list->resize(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            leaving[i] = t.vertices[nextCorner(corners[i])];
            coming[i] = t.vertices[previousCorner(corners[i])];
            left[i] = right[i] = kNone;
        }
        if (count <= kFew)
            pairFew();
        else
            pairMany();
    }

private:
    static constexpr std::uint32_t kFew = 16;
    std::uint32_t count = 0;                    // of corners; the lists are as long as the longest needed so far
    std::vector<std::uint32_t> leaving, coming; // the edges' other vertices
    std::vector<std::uint32_t> byLeaving, byComing;

    void join(std::uint32_t i, std::uint32_t j)
    {
        left[i] = j;
        right[j] = i;
    }

    void pairFew()
    {
        for (std::uint32_t i = 0; i < count; ++i)
            for (std::uint32_t j = 0; j < count; ++j)
                if (coming[j] == leaving[i] && right[j] == kNone) {
                    join(i, j);
                    break;
                }
    }

    // The same in time n log n.
    void pairMany()
    {
        const auto sorted = [this](const std::vector<std::uint32_t>& others, std::vector<std::uint32_t>& order) {
            order.resize(count);
            for (std::uint32_t i = 0; i < order.size(); ++i)
                order[i] = i;
            std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
                return std::pair(others[a], a) < std::pair(others[b], b);
            });
        };
        sorted(leaving, byLeaving);
        sorted(coming, byComing);
        for (std::size_t i = 0, j = 0; i < byLeaving.size() && j < byComing.size();) {
            const std::uint32_t a = leaving[byLeaving[i]], b = coming[byComing[j]];
            if (a == b)
                join(byLeaving[i], byComing[j]);
            i += a <= b;
            j += b <= a;
        }
    }
};

// The corners that hang together with `seed`, as far as take(corner) says yes: it is asked for each in
// order, to the left first.
template<class Take>
void walk(std::uint32_t seed, std::span<const std::uint32_t> left, std::span<const std::uint32_t> right,
          const Take& take)
{
    std::uint32_t i = seed;
    while (i != kNone && take(i))
        i = left[i];
    i = right[seed];
    while (i != kNone && take(i))
        i = right[i];
}

// ---- averages -------------------------------------------------------------------------------

// With the threshold of 180 degrees two triangles are still kept apart where their directions are
// exactly opposite: member by member then. Large groups, which only a mesh made for the purpose
// has, are averaged whole, so that the time stays linear.
constexpr std::size_t kLargeGroup = 256;

glm::vec3 projected(glm::vec3 v, glm::vec3 n) { return v - n * glm::dot(n, v); }

// The whole group's weighted sum, and whether no two directions in it can be opposite: all within
// 90 degrees of the first. That is the usual case, and then every member has this sum.
bool sumInOneHalf(const Triangles& t, std::span<const std::uint32_t> group, std::span<const glm::vec4> contributions,
                  glm::vec3 n, glm::vec3& sum)
{
    const glm::vec3 firstU(contributions[group[0]]), firstV = projected(t.alongV[group[0] / 3], n);
    bool inOneHalf = true;
    sum = glm::vec3(0);
    for (const std::uint32_t c : group) {
        const glm::vec3 u(contributions[c]);
        inOneHalf &= glm::dot(firstU, u) > 0;
        inOneHalf &= glm::dot(firstV, projected(t.alongV[c / 3], n)) > 0;
        sum += u;
    }
    return inOneHalf;
}

glm::vec4 storedTangent(glm::vec3 sum, glm::vec3 n, bool preserving)
{
    const glm::vec3 unit = normalizeOrZero(sum);
    if (!(glm::dot(unit, unit) > 0.5f)) // zero or not finite
        return {tangents::anyPerpendicular(n), 1};
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
        const glm::vec4 tangent = storedTangent(sum, n, preserving);
        for (const std::uint32_t c : group)
            out[c] = tangent;
        return;
    }
    members.project(t, group, out, n);
    for (std::size_t i = 0; i < group.size(); ++i)
        out[group[i]] = storedTangent(members.sumFor(t, group, i), n, preserving);
}

// ---- groups ---------------------------------------------------------------------------------

// Where every triangle has a direction, the groups of a vertex are nobody else's business.
void averageByVertex(const Triangles& t, const CornersAt& at, std::size_t threads, std::span<glm::vec4> out)
{
    runParts(t.mesh.positions.size(), threads, [&](std::size_t begin, std::size_t end) {
        Ring ring;
        Members members;
        std::vector<std::uint32_t> group;
        std::vector<std::uint8_t> taken;
        for (std::size_t v = begin; v < end; ++v) {
            const std::span<const std::uint32_t> corners = at[v];
            if (corners.empty()) // welded to another
                continue;
            ring.make(t, corners);
            taken.assign(corners.size(), 0);
            for (std::uint32_t seed = 0; seed < corners.size(); ++seed) {
                if (taken[seed] != 0)
                    continue;
                const bool preserving = t.has(corners[seed] / 3, kPreserving);
                group.clear();
                walk(seed, ring.left, ring.right, [&](std::uint32_t i) {
                    if (taken[i] != 0 || t.has(corners[i] / 3, kPreserving) != preserving)
                        return false;
                    taken[i] = 1;
                    group.push_back(corners[i]);
                    return true;
                });
                averageGroup(t, group, members, out);
            }
        }
    });
}

// left and right by corner: Ring for all vertices.
std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> allRings(const Triangles& t, const CornersAt& at)
{
    std::vector<std::uint32_t> left(t.corners(), kNone), right(t.corners(), kNone);
    Ring ring;
    for (std::size_t v = 0; v < t.mesh.positions.size(); ++v) {
        const std::span<const std::uint32_t> corners = at[v];
        ring.make(t, corners);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            left[corners[i]] = ring.left[i] == kNone ? kNone : corners[ring.left[i]];
            right[corners[i]] = ring.right[i] == kNone ? kNone : corners[ring.right[i]];
        }
    }
    return {std::move(left), std::move(right)};
}

// Marks the corner as taken and says so, if its triangle may join a group of that orientation.
bool join(Triangles& t, std::vector<std::uint8_t>& taken, std::size_t corner, bool preserving)
{
    if (taken[corner] != 0)
        return false;
    std::uint8_t& flags = t.flags[corner / 3];
    const std::uint8_t* const those = taken.data() + corner / 3 * 3;
    // The first group to reach a triangle without a direction decides its orientation.
    if ((flags & kJoinsAny) != 0 && (those[0] | those[1] | those[2]) == 0)
        flags = static_cast<std::uint8_t>((flags & ~kPreserving) | (preserving ? kPreserving : 0));
    if (((flags & kPreserving) != 0) != preserving)
        return false;
    taken[corner] = 1;
    return true;
}

// Which group a triangle without a direction joins depends on the order of the corners: one after the
// other. What no group reaches gets any tangent.
void averageInOrder(Triangles& t, const CornersAt& at, std::span<glm::vec4> out)
{
    const auto [left, right] = allRings(t, at);
    std::vector<std::uint8_t> taken(t.corners());
    std::vector<std::uint32_t> group, groups, starts{0};
    for (std::uint32_t c = 0; c < t.corners(); ++c) {
        if (taken[c] != 0 || t.has(c / 3, kJoinsAny))
            continue;
        const bool preserving = t.has(c / 3, kPreserving);
        walk(c, left, right, [&](std::uint32_t i) {
            const bool joined = join(t, taken, i, preserving);
            if (joined)
                groups.push_back(i);
            return joined;
        });
        starts.push_back(static_cast<std::uint32_t>(groups.size()));
    }
    Members members;
    for (std::size_t g = 0; g + 1 < starts.size(); ++g)
        averageGroup(t, std::span(groups).subspan(starts[g], starts[g + 1] - starts[g]), members, out);
    for (std::size_t c = 0; c < out.size(); ++c)
        if (taken[c] == 0)
            out[c] = {tangents::anyPerpendicular(t.normal(c)), 1};
}

// A triangle with two equal positions takes over what the first sound triangle at each vertex has.
void inheritAtDegenerate(const Triangles& t, const CornersAt& at, std::span<glm::vec4> out)
{
    for (std::size_t c = 0; c < out.size(); ++c)
        if (t.has(c / 3, kDegenerate))
            if (const auto sound = at[t.vertices[c]]; !sound.empty())
                out[c] = out[sound.front()];
}

// Starting a thread takes as long as some thousands of triangles.
constexpr std::size_t kTrianglesPerThread = 8192;

} // namespace

std::vector<glm::vec4> mikktspaceTangents(const MeshView& mesh, int threads)
{
    if (!tangents::usable(mesh))
        return {};
    const std::size_t used = threadsFor(mesh.indices.size() / 3, kTrianglesPerThread, threads);
    std::vector<glm::vec4> out(mesh.indices.size());
    Triangles t = makeTriangles(mesh, used, out);
    const CornersAt at = cornersByVertex(t, used);
    if (std::any_of(t.flags.get(), t.flags.get() + t.count, [](auto f) { return (f & kJoinsAny) != 0; })) {
        averageInOrder(t, at, out);
        inheritAtDegenerate(t, at, out);
    } else {
        averageByVertex(t, at, used, out);
    }
    return out;
}

} // namespace cotan
