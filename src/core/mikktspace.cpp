// MikkTSpace, written from its description. The steps: weld equal vertices; a tangent direction
// and an orientation for every triangle; neighbours across shared edges; groups of triangles of
// one orientation that hang together around a vertex; an angle-weighted average per group.
#include <algorithm>
#include <cstddef>

#include "tangents_mesh.hpp"

namespace cotan {

namespace {

using tangents::kNone;
using tangents::normalizeOrZero;
using tangents::projectedUnit;

// One byte of state a triangle.
enum Flag : std::uint8_t {
    kTaken0 = 1, // corner 0 belongs to a group; << k for corner k
    kAllTaken = 7,
    kPreserving = 8,  // positive signed area in uv (v upwards or downwards, as given)
    kJoinsAny = 16,   // no usable direction: joins the first group that reaches it
    kDegenerate = 32, // two equal positions: takes part in nothing
};

struct Triangles {
    const MeshView& mesh;
    std::vector<std::uint32_t> vertices;   // welded, three a triangle
    std::vector<std::uint8_t> flags;       // of Flag, one a triangle
    std::vector<glm::vec3> alongU, alongV; // unit dP/du, dP/dv, or zero
    std::vector<std::uint32_t> neighbours; // per edge k = (corner k, corner k+1): triangle or kNone

    std::size_t count() const { return flags.size(); }
    glm::vec3 position(std::size_t corner) const { return mesh.positions[vertices[corner]]; }
    glm::vec2 texcoord(std::size_t corner) const { return mesh.texcoords[vertices[corner]]; }
};

std::vector<std::uint32_t> weldedIndices(const MeshView& mesh)
{
    const std::vector<std::uint32_t> first = tangents::weld(mesh);
    std::vector<std::uint32_t> vertices(mesh.indices.size());
    std::transform(mesh.indices.begin(), mesh.indices.end(), vertices.begin(),
                   [&](std::uint32_t i) { return first[i]; });
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
void findNeighbours(Triangles& t)
{
    const std::size_t corners = t.vertices.size();
    std::vector<std::uint32_t> start(t.mesh.positions.size() + 1);
    const auto smaller = [&](std::size_t c) {
        return std::min(t.vertices[c], t.vertices[nextCorner(c)]);
    };
    const auto counts = [&](std::size_t c) { return (t.flags[c / 3] & kDegenerate) == 0; };
    for (std::size_t c = 0; c < corners; ++c)
        if (counts(c))
            ++start[smaller(c) + 1];
    for (std::size_t i = 1; i < start.size(); ++i)
        start[i] += start[i - 1];
    std::vector<std::uint64_t> edges(start.back());
    for (std::size_t c = corners; c-- > 0;) // backwards: start[i + 1] moves down to its bucket
        if (counts(c)) {
            const std::uint64_t larger = std::max(t.vertices[c], t.vertices[nextCorner(c)]);
            edges[--start[smaller(c) + 1]] = larger << 32 | c;
        }
    t.neighbours.assign(corners, kNone);
    for (std::size_t i = 1; i < start.size(); ++i) {
        const std::size_t begin = start[i];
        const std::size_t end = i + 1 < start.size() ? start[i + 1] : edges.size();
        const std::span<std::uint64_t> bucket(edges.data() + begin, end - begin);
        std::sort(bucket.begin(), bucket.end());
        pairEdges(t, bucket);
    }
}

// Marks the corner as taken and says so, if its triangle may join a group of that orientation.
bool join(Triangles& t, std::size_t corner, bool preserving)
{
    std::uint8_t& flags = t.flags[corner / 3];
    const auto taken = static_cast<std::uint8_t>(kTaken0 << corner % 3);
    if (flags & taken)
        return false;
    // The first group to reach a triangle without a direction decides its orientation.
    if ((flags & kJoinsAny) && (flags & kAllTaken) == 0)
        flags = static_cast<std::uint8_t>((flags & ~kPreserving) | (preserving ? kPreserving : 0));
    if (((flags & kPreserving) != 0) != preserving)
        return false;
    flags |= taken;
    return true;
}

struct Scratch {
    std::vector<std::size_t> pending;      // triangles to visit
    std::vector<std::size_t> group;        // corners
    std::vector<glm::vec3> alongU, alongV; // of the group's triangles, in the vertex's plane
    std::vector<float> angles;
};

// All corners at the vertex of `seed` that hang together through edges.
void collectGroup(Triangles& t, std::size_t seed, Scratch& s)
{
    const std::uint32_t vertex = t.vertices[seed];
    const bool preserving = (t.flags[seed / 3] & kPreserving) != 0;
    s.group.clear();
    s.pending.assign(1, seed / 3);
    while (!s.pending.empty()) {
        const std::size_t f = s.pending.back();
        s.pending.pop_back();
        const std::size_t corner = t.vertices[3 * f] == vertex ? 3 * f
            : t.vertices[3 * f + 1] == vertex                  ? 3 * f + 1
                                                               : 3 * f + 2;
        if (!join(t, corner, preserving))
            continue;
        s.group.push_back(corner);
        const std::uint32_t right = t.neighbours[previousCorner(corner)];
        const std::uint32_t left = t.neighbours[corner];
        if (right != kNone)
            s.pending.push_back(right);
        if (left != kNone) // on top: visited first, with all that lies behind it
            s.pending.push_back(left);
    }
}

void projectGroup(const Triangles& t, glm::vec3 n, Scratch& s)
{
    s.alongU.clear();
    s.alongV.clear();
    s.angles.clear();
    for (const std::size_t c : s.group) {
        s.alongU.push_back(projectedUnit(t.alongU[c / 3], n));
        s.alongV.push_back(projectedUnit(t.alongV[c / 3], n));
        const bool counts = (t.flags[c / 3] & kJoinsAny) == 0;
        s.angles.push_back(counts ? tangents::projectedAngle(t.position(c),
                                                             t.position(previousCorner(c)),
                                                             t.position(nextCorner(c)), n)
                                  : 0.0f);
    }
}

// Whether no two directions of the group can be opposite: all within 90 degrees of the first.
bool inOneHalf(const Triangles& t, const Scratch& s)
{
    for (std::size_t i = 0; i < s.group.size(); ++i) {
        const bool any = (t.flags[s.group[i] / 3] & kJoinsAny) != 0;
        if (any || !(glm::dot(s.alongU[0], s.alongU[i]) > 0)
            || !(glm::dot(s.alongV[0], s.alongV[i]) > 0))
            return false;
    }
    return true;
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

glm::vec3 sumFor(const Triangles& t, const Scratch& s, std::size_t member, bool all)
{
    const auto any = [&](std::size_t i) { return (t.flags[s.group[i] / 3] & kJoinsAny) != 0; };
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < s.group.size(); ++i)
        if (all || i == member || any(i) || any(member)
            || (glm::dot(s.alongU[member], s.alongU[i]) > -1
                && glm::dot(s.alongV[member], s.alongV[i]) > -1))
            sum += s.alongU[i] * s.angles[i];
    return sum;
}

void averageGroup(const Triangles& t, Scratch& s, std::vector<glm::vec4>& out)
{
    const glm::vec3 n = t.mesh.normals[t.vertices[s.group[0]]];
    const bool preserving = (t.flags[s.group[0] / 3] & kPreserving) != 0;
    projectGroup(t, n, s);
    const bool all = s.group.size() > kLargeGroup || inOneHalf(t, s);
    glm::vec4 tangent;
    for (std::size_t i = 0; i < s.group.size(); ++i) {
        if (i == 0 || !all)
            tangent = storedTangent(sumFor(t, s, i, all), n, preserving);
        out[s.group[i]] = tangent;
    }
}

void fillUngrouped(const Triangles& t, std::vector<glm::vec4>& out)
{
    for (std::size_t c = 0; c < out.size(); ++c)
        if ((t.flags[c / 3] & kTaken0 << c % 3) == 0)
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

std::vector<glm::vec4> mikktspaceTangents(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const std::size_t count = mesh.indices.size() / 3;
    Triangles t{mesh,
                weldedIndices(mesh),
                std::vector<std::uint8_t>(count),
                std::vector<glm::vec3>(count),
                std::vector<glm::vec3>(count),
                {}};
    for (std::size_t f = 0; f < count; ++f)
        deriveTriangle(t, f);
    findNeighbours(t);

    std::vector<glm::vec4> out(mesh.indices.size());
    Scratch scratch;
    for (std::size_t c = 0; c < out.size(); ++c) {
        if ((t.flags[c / 3] & (kJoinsAny | kTaken0 << c % 3)) != 0)
            continue;
        collectGroup(t, c, scratch);
        averageGroup(t, scratch, out);
    }
    fillUngrouped(t, out);
    if (std::any_of(t.flags.begin(), t.flags.end(), [](auto f) { return (f & kDegenerate) != 0; }))
        inheritAtDegenerate(t, out);
    return out;
}

} // namespace cotan
