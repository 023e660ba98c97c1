// MikkTSpace, written from its description. The steps: weld equal vertices; a tangent direction
// and an orientation for every triangle; neighbours across shared edges; groups of triangles of
// one orientation that hang together around a vertex; an angle-weighted average per group.
#include <algorithm>
#include <cstddef>
#include <memory>

#include "tangents_mesh.hpp"

namespace cotan {

namespace {

using tangents::kNone;
using tangents::normalizeOrZero;
using tangents::projectedUnit;

// One byte of state a triangle.
enum Flag : std::uint8_t {
    kPreserving = 1, // positive signed area in uv (v upwards or downwards, as given)
    kJoinsAny = 2,   // no usable direction: joins the first group that reaches it
    kDegenerate = 4, // two equal positions: takes part in nothing
};

struct Triangles {
    const MeshView& mesh;
    std::vector<std::uint32_t> vertices;   // welded, three a triangle
    std::vector<std::uint8_t> flags;       // of Flag, one a triangle
    std::vector<std::uint8_t> taken;       // 1 for corners that belong to a group
    std::vector<glm::vec3> alongU, alongV; // unit dP/du, dP/dv, or zero
    std::vector<std::uint32_t> neighbours; // per edge k = (corner k, corner k+1): triangle or kNone

    std::size_t count() const { return flags.size(); }
    glm::vec3 position(std::size_t corner) const { return mesh.positions[vertices[corner]]; }
    glm::vec2 texcoord(std::size_t corner) const { return mesh.texcoords[vertices[corner]]; }
};

std::vector<std::uint32_t> weldedIndices(const MeshView& mesh, std::size_t threads)
{
    const std::vector<std::uint32_t> first = tangents::weld(mesh, threads);
    std::vector<std::uint32_t> vertices(mesh.indices.size());
    runParts(vertices.size(), threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            vertices[c] = first[mesh.indices[c]];
    });
    return vertices;
}

// dP/du and dP/dv up to length, and whether uv keep the orientation.
void deriveTriangle(Triangles& t, std::size_t f)
{
    const glm::vec3 p0 = t.position(3 * f), p1 = t.position(3 * f + 1), p2 = t.position(3 * f + 2);
    if (p0 == p1 || p0 == p2 || p1 == p2) {
        t.flags[f] = kDegenerate | kJoinsAny;
        return;
    }
    const glm::vec3 d1 = p1 - p0, d2 = p2 - p0;
    const glm::vec2 e1 = t.texcoord(3 * f + 1) - t.texcoord(3 * f);
    const glm::vec2 e2 = t.texcoord(3 * f + 2) - t.texcoord(3 * f);
    const float area = e1.x * e2.y - e1.y * e2.x;
    const bool preserving = area > 0;
    t.flags[f] = static_cast<std::uint8_t>(kJoinsAny | (preserving ? kPreserving : 0));
    if (!(std::abs(area) > FLT_MIN))
        return;
    const float sign = preserving ? 1.0f : -1.0f;
    const glm::vec3 u = d1 * e2.y - d2 * e1.y, v = d2 * e1.x - d1 * e2.x;
    const float lengthU = std::sqrt(glm::dot(u, u)), lengthV = std::sqrt(glm::dot(v, v));
    if (lengthU > FLT_MIN)
        t.alongU[f] = u * (sign / lengthU);
    if (lengthV > FLT_MIN)
        t.alongV[f] = v * (sign / lengthV);
    if (lengthU / std::abs(area) > FLT_MIN && lengthV / std::abs(area) > FLT_MIN)
        t.flags[f] &= static_cast<std::uint8_t>(~kJoinsAny);
}

// Pairs the edges of one bucket, sorted by (far vertex, corner). Of the edges between the same two
// vertices the k-th that runs one way meets the k-th that runs the other way.
void pairEdges(Triangles& t, std::span<const std::uint64_t> edges)
{
    const auto farVertex = [](std::uint64_t e) { return static_cast<std::uint32_t>(e >> 32); };
    const auto corner = [](std::uint64_t e) { return static_cast<std::uint32_t>(e); };
    for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
        end = begin + 1;
        while (end < edges.size() && farVertex(edges[end]) == farVertex(edges[begin]))
            ++end;
        const auto forward = [&](std::size_t i) { // from the smaller vertex to the larger
            return t.vertices[corner(edges[i])] != farVertex(edges[begin]);
        };
        std::size_t f = begin, b = begin;
        for (;; ++f, ++b) {
            while (f < end && !forward(f))
                ++f;
            while (b < end && forward(b))
                ++b;
            if (f >= end || b >= end)
                break;
            t.neighbours[corner(edges[f])] = corner(edges[b]) / 3;
            t.neighbours[corner(edges[b])] = corner(edges[f]) / 3;
        }
    }
}

constexpr std::size_t nextCorner(std::size_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

constexpr std::size_t previousCorner(std::size_t corner)
{
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

// Neighbours across shared edges. The edges are put into one bucket per smaller vertex, as
// (larger vertex, corner at which the edge starts).
void findNeighbours(Triangles& t, std::size_t threads)
{
    std::vector<std::uint32_t> start(t.mesh.positions.size() + 1);
    const auto forEdges = [&](const auto& each) { // each(smaller vertex, larger vertex, corner)
        for (std::uint32_t f = 0; f < t.count(); ++f) {
            if ((t.flags[f] & kDegenerate) != 0)
                continue;
            const std::uint32_t c = 3 * f, v0 = t.vertices[c], v1 = t.vertices[c + 1],
                                v2 = t.vertices[c + 2];
            each(std::min(v0, v1), std::max(v0, v1), c);
            each(std::min(v1, v2), std::max(v1, v2), c + 1);
            each(std::min(v2, v0), std::max(v2, v0), c + 2);
        }
    };
    forEdges([&](std::uint32_t smaller, std::uint32_t, std::uint32_t) { ++start[smaller + 1]; });
    for (std::size_t i = 1; i < start.size(); ++i)
        start[i] += start[i - 1];
    const std::size_t count = start.back();
    const auto edges = std::make_unique_for_overwrite<std::uint64_t[]>(count);
    // start[i + 1] ends bucket i and moves down to its begin.
    forEdges([&](std::uint32_t smaller, std::uint64_t larger, std::uint32_t corner) {
        edges[--start[smaller + 1]] = larger << 32 | corner;
    });
    t.neighbours.assign(t.vertices.size(), kNone);
    // An edge is in one bucket, so threads write to different neighbours.
    runParts(t.mesh.positions.size(), threads, [&](std::size_t firstVertex, std::size_t last) {
        for (std::size_t i = firstVertex + 1; i <= last; ++i) {
            const std::size_t begin = start[i];
            const std::size_t end = i + 1 < start.size() ? start[i + 1] : count;
            const std::span<std::uint64_t> bucket(edges.get() + begin, end - begin);
            std::sort(bucket.begin(), bucket.end());
            pairEdges(t, bucket);
        }
    });
}

// Marks the corner as taken and says so, if its triangle may join a group of that orientation.
bool join(Triangles& t, std::size_t corner, bool preserving)
{
    if (t.taken[corner] != 0)
        return false;
    std::uint8_t& flags = t.flags[corner / 3];
    const std::uint8_t* const taken = t.taken.data() + corner / 3 * 3;
    // The first group to reach a triangle without a direction decides its orientation.
    if ((flags & kJoinsAny) != 0 && (taken[0] | taken[1] | taken[2]) == 0)
        flags = static_cast<std::uint8_t>((flags & ~kPreserving) | (preserving ? kPreserving : 0));
    if (((flags & kPreserving) != 0) != preserving)
        return false;
    t.taken[corner] = 1;
    return true;
}

// Groups, one after the other.
struct Groups {
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> starts{0}; // into corners; one more at the end
};

// Adds all corners at the vertex of `seed` that hang together through edges. pending: scratch.
void collectGroup(Triangles& t, std::uint32_t seed, std::vector<std::uint32_t>& pending,
                  Groups& groups)
{
    const std::uint32_t vertex = t.vertices[seed];
    const bool preserving = (t.flags[seed / 3] & kPreserving) != 0;
    pending.assign(1, seed / 3);
    while (!pending.empty()) {
        const std::uint32_t first = pending.back() * 3; // corner
        pending.pop_back();
        const std::uint32_t k = t.vertices[first] == vertex ? 0
            : t.vertices[first + 1] == vertex               ? 1
                                                            : 2;
        if (!join(t, first + k, preserving))
            continue;
        groups.corners.push_back(first + k);
        const std::uint32_t right = t.neighbours[first + (k == 0 ? 2 : k - 1)];
        const std::uint32_t left = t.neighbours[first + k];
        if (right != kNone)
            pending.push_back(right);
        if (left != kNone) // on top: visited first, with all that lies behind it
            pending.push_back(left);
    }
    groups.starts.push_back(static_cast<std::uint32_t>(groups.corners.size()));
}

// The groups in parts, each of consecutive vertices. The corners of a group are all at one vertex,
// so the parts have nothing in common, unless there are triangles without a direction: which group
// those join depends on the order of the corners, so that all is one part then.
std::vector<Groups> collectGroups(Triangles& t, std::size_t threads)
{
    const bool ordered = std::any_of(t.flags.begin(), t.flags.end(),
                                     [](auto f) { return (f & kJoinsAny) != 0; });
    std::vector<Groups> parts(ordered ? 1 : threads);
    const std::size_t vertices = t.mesh.positions.size();
    runTasks(parts.size(), threads, [&](std::size_t part) {
        const std::size_t begin = vertices * part / parts.size();
        const std::size_t end = vertices * (part + 1) / parts.size();
        Groups& groups = parts[part];
        groups.corners.reserve(t.vertices.size() / parts.size());
        groups.starts.reserve(t.vertices.size() / parts.size() / 4);
        std::vector<std::uint32_t> pending;
        for (std::uint32_t c = 0; c < t.vertices.size(); ++c)
            if (t.vertices[c] >= begin && t.vertices[c] < end && t.taken[c] == 0
                && (t.flags[c / 3] & kJoinsAny) == 0)
                collectGroup(t, c, pending, groups);
    });
    return parts;
}

// One group while it is averaged.
struct Scratch {
    std::span<const std::uint32_t> group;  // corners
    std::vector<glm::vec3> alongU, alongV; // of their triangles, in the vertex's plane
    std::vector<float> angles;
};

glm::vec3 projected(glm::vec3 v, glm::vec3 n) { return v - n * glm::dot(n, v); }

inline float weightOf(const Triangles& t, std::size_t c, glm::vec3 n)
{
    if ((t.flags[c / 3] & kJoinsAny) != 0)
        return 0;
    return tangents::projectedAngle(t.position(c), t.position(previousCorner(c)),
                                    t.position(nextCorner(c)), n);
}

// The whole group's weighted sum, and whether no two directions in it can be opposite: all within
// 90 degrees of the first. That is the usual case, and then every member has this sum.
bool sumInOneHalf(const Triangles& t, std::span<const std::uint32_t> group, glm::vec3 n,
                  glm::vec3& sum)
{
    const glm::vec3 firstU = projected(t.alongU[group[0] / 3], n);
    const glm::vec3 firstV = projected(t.alongV[group[0] / 3], n);
    bool inOneHalf = true;
    sum = glm::vec3(0);
    for (const std::uint32_t c : group) {
        const glm::vec3 u = projectedUnit(t.alongU[c / 3], n);
        const glm::vec3 v = projected(t.alongV[c / 3], n);
        const bool any = (t.flags[c / 3] & kJoinsAny) != 0;
        inOneHalf = inOneHalf && !any && glm::dot(firstU, u) > 0 && glm::dot(firstV, v) > 0;
        sum += u * weightOf(t, c, n);
    }
    return inOneHalf;
}

void projectGroup(const Triangles& t, glm::vec3 n, Scratch& s)
{
    s.alongU.clear();
    s.alongV.clear();
    s.angles.clear();
    for (const std::size_t c : s.group) {
        s.alongU.push_back(projectedUnit(t.alongU[c / 3], n));
        s.alongV.push_back(projectedUnit(t.alongV[c / 3], n));
        s.angles.push_back(weightOf(t, c, n));
    }
}

glm::vec4 storedTangent(glm::vec3 sum, glm::vec3 n, bool preserving)
{
    const glm::vec3 unit = normalizeOrZero(sum);
    if (!(glm::dot(unit, unit) > 0.5f)) // zero or not finite
        return {tangents::anyPerpendicular(n), 1};
    return {unit, preserving ? -1.0f : 1.0f}; // v runs down, glTF's bitangent up
}

// With the threshold of 180 degrees two triangles are still kept apart where their directions are
// exactly opposite: member by member then. Large groups, which only a mesh made for the purpose
// has, are averaged whole, so that the time stays linear.
constexpr std::size_t kLargeGroup = 256;

// Starting a thread takes as long as some thousands of triangles.
constexpr std::size_t kTrianglesPerThread = 8192;

glm::vec3 sumFor(const Triangles& t, const Scratch& s, std::size_t member)
{
    const auto any = [&](std::size_t i) { return (t.flags[s.group[i] / 3] & kJoinsAny) != 0; };
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < s.group.size(); ++i)
        if (i == member || any(i) || any(member)
            || (glm::dot(s.alongU[member], s.alongU[i]) > -1
                && glm::dot(s.alongV[member], s.alongV[i]) > -1))
            sum += s.alongU[i] * s.angles[i];
    return sum;
}

void averageGroup(const Triangles& t, Scratch& s, std::vector<glm::vec4>& out)
{
    const glm::vec3 n = t.mesh.normals[t.vertices[s.group[0]]];
    const bool preserving = (t.flags[s.group[0] / 3] & kPreserving) != 0;
    glm::vec3 sum;
    if (sumInOneHalf(t, s.group, n, sum) || s.group.size() > kLargeGroup) {
        const glm::vec4 tangent = storedTangent(sum, n, preserving);
        for (const std::uint32_t c : s.group)
            out[c] = tangent;
        return;
    }
    projectGroup(t, n, s);
    for (std::size_t i = 0; i < s.group.size(); ++i)
        out[s.group[i]] = storedTangent(sumFor(t, s, i), n, preserving);
}

void averageGroups(const Triangles& t, const Groups& groups, std::size_t threads,
                   std::vector<glm::vec4>& out)
{
    runParts(groups.starts.size() - 1, threads, [&](std::size_t begin, std::size_t end) {
        Scratch scratch;
        for (std::size_t g = begin; g < end; ++g) {
            scratch.group = std::span(groups.corners)
                                .subspan(groups.starts[g], groups.starts[g + 1] - groups.starts[g]);
            averageGroup(t, scratch, out);
        }
    });
}

void fillUngrouped(const Triangles& t, std::vector<glm::vec4>& out)
{
    for (std::size_t c = 0; c < out.size(); ++c)
        if (t.taken[c] == 0)
            out[c] = {tangents::anyPerpendicular(t.mesh.normals[t.vertices[c]]), 1};
}

// A triangle with two equal positions takes over what the first sound triangle at each vertex has.
void inheritAtDegenerate(const Triangles& t, std::vector<glm::vec4>& out)
{
    const auto degenerate = [&](std::size_t c) { return (t.flags[c / 3] & kDegenerate) != 0; };
    std::vector<std::uint32_t> donor(t.mesh.positions.size(), kNone);
    for (std::size_t c = out.size(); c-- > 0;)
        if (!degenerate(c))
            donor[t.vertices[c]] = static_cast<std::uint32_t>(c);
    for (std::size_t c = 0; c < out.size(); ++c)
        if (degenerate(c) && donor[t.vertices[c]] != kNone)
            out[c] = out[donor[t.vertices[c]]];
}

} // namespace

std::vector<glm::vec4> mikktspaceTangents(const MeshView& mesh, int threads)
{
    if (!tangents::usable(mesh))
        return {};
    const std::size_t count = mesh.indices.size() / 3;
    const std::size_t used = threadsFor(count, kTrianglesPerThread, threads);
    Triangles t{mesh,
                weldedIndices(mesh, used),
                std::vector<std::uint8_t>(count),
                std::vector<std::uint8_t>(mesh.indices.size()),
                std::vector<glm::vec3>(count),
                std::vector<glm::vec3>(count),
                {}};
    runParts(count, used, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f)
            deriveTriangle(t, f);
    });
    findNeighbours(t, used);
    const std::vector<Groups> parts = collectGroups(t, used);
    t.neighbours = {};

    std::vector<glm::vec4> out(mesh.indices.size());
    for (const Groups& groups : parts)
        averageGroups(t, groups, used, out);
    fillUngrouped(t, out);
    if (std::any_of(t.flags.begin(), t.flags.end(), [](auto f) { return (f & kDegenerate) != 0; }))
        inheritAtDegenerate(t, out);
    return out;
}

} // namespace cotan
