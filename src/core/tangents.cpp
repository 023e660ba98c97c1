#include "cotan/tangents.hpp"

#include <algorithm>
#include <array>

#include "cotan/portable.hpp"
#include "tangents_mesh.hpp"

namespace cotan {

namespace {

// The edges of a triangle in space and in uv, from one of its corners.
struct Edges {
    glm::dvec3 dp1, dp2;
    glm::dvec2 duv1, duv2;

    double uvArea() const { return duv1.x * duv2.y - duv1.y * duv2.x; }
};

// From corner k of triangle f to the next and to the previous one.
Edges edgesAt(const MeshView& mesh, std::size_t f, std::size_t k)
{
    const std::uint32_t a = mesh.indices[3 * f + k], b = mesh.indices[3 * f + (k + 1) % 3],
                        c = mesh.indices[3 * f + (k + 2) % 3];
    const glm::dvec3 p(mesh.positions[a]);
    const glm::dvec2 t(mesh.texcoords[a]);
    return {glm::dvec3(mesh.positions[b]) - p, glm::dvec3(mesh.positions[c]) - p,
            glm::dvec2(mesh.texcoords[b]) - t, glm::dvec2(mesh.texcoords[c]) - t};
}

// On which side of its vertices' tangent plane a triangle's image reads: unmirrored where (dP/du,
// dP/dv, normal) is left-handed, as it is for an image that is seen from outside with v downwards.
enum class Side : std::uint8_t { unmirrored = 0, mirrored = 1, none = 2 };

// `none` where the triangle has no area in space, none in uv, or none seen along the normal.
Side sideAt(const Edges& e, glm::vec3 normal)
{
    const glm::dvec3 face = glm::cross(e.dp1, e.dp2);
    const glm::dvec3 n(normal);
    // A vertex without a normal takes the triangle's.
    const double facing = n == glm::dvec3(0) ? glm::dot(face, face) : glm::dot(face, n);
    const double side = e.uvArea() * facing;
    if (!std::isfinite(side) || side == 0)
        return Side::none;
    return side > 0 ? Side::mirrored : Side::unmirrored;
}

std::vector<Side> cornerSides(const MeshView& mesh)
{
    std::vector<Side> sides(mesh.indices.size());
    for (std::size_t c = 0; c < sides.size(); ++c)
        sides[c] = sideAt(edgesAt(mesh, c / 3, c % 3), mesh.normals[mesh.indices[c]]);
    return sides;
}

std::size_t slot(std::uint32_t vertex, Side side)
{
    return 2 * std::size_t(vertex) + std::size_t(side);
}

// The unit direction of dP/du, or zero.
glm::vec3 alongU(const Edges& e)
{
    const glm::dvec3 t = (e.dp1 * e.duv2.y - e.dp2 * e.duv1.y) * (e.uvArea() < 0 ? -1.0 : 1.0);
    const double length = glm::length(t);
    return length > 0 && std::isfinite(length) ? glm::vec3(t / length) : glm::vec3(0);
}

// What a corner without a side of its own takes: that of the vertex, where it has any.
Side sideOrNearest(Side side, std::uint32_t vertex, const auto& isEmpty)
{
    if (side != Side::none)
        return side;
    return isEmpty(slot(vertex, Side::unmirrored)) && !isEmpty(slot(vertex, Side::mirrored))
        ? Side::mirrored
        : Side::unmirrored;
}

struct CotangentSums {
    std::vector<glm::vec3> u, v;
    std::vector<float> weight;

    explicit CotangentSums(std::size_t n) : u(n, glm::vec3(0)), v(n, glm::vec3(0)), weight(n, 0.0f)
    {
    }
};

float angleAt(const Edges& e, glm::vec3 n)
{
    return tangents::projectedAngle(glm::vec3(0), glm::vec3(e.dp1), glm::vec3(e.dp2), n);
}

// Adds the gradients of a corner's triangle; returns the weight that they got.
float addCorner(CotangentSums& sums, std::size_t at, const Edges& e, glm::vec3 n)
{
    const f32::cotan_frame frame = f32::cotan_frame_gradient(n, glm::vec3(e.dp1), glm::vec3(e.dp2),
                                                             glm::vec2(e.duv1), glm::vec2(e.duv2));
    const float weight = angleAt(e, n);
    if (!(weight > 0) || (tangents::isZero(frame.t) && tangents::isZero(frame.b)))
        return 0;
    sums.u[at] += frame.t * weight;
    sums.v[at] += frame.b * weight;
    sums.weight[at] += weight;
    return weight;
}

} // namespace

std::vector<glm::vec4> vertexTangents(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const LargeArray<std::uint32_t> first = tangents::weld(mesh);
    const std::vector<Side> sides = cornerSides(mesh);
    std::vector<glm::vec3> sums(2 * mesh.positions.size(), glm::vec3(0));
    for (std::size_t c = 0; c < sides.size(); ++c)
        if (sides[c] != Side::none)
            sums[slot(first[mesh.indices[c]], sides[c])] += alongU(edgesAt(mesh, c / 3, c % 3));

    const auto isEmpty = [&](std::size_t at) { return tangents::isZero(sums[at]); };
    std::vector<glm::vec4> out(sides.size());
    for (std::size_t c = 0; c < out.size(); ++c) {
        const std::uint32_t vertex = first[mesh.indices[c]];
        const glm::vec3 n = mesh.normals[vertex];
        const Side side = sideOrNearest(sides[c], vertex, isEmpty);
        const glm::vec3 t = tangents::projectedUnit(sums[slot(vertex, side)], n);
        out[c] = glm::dot(t, t) > 0.5f ? glm::vec4(t, side == Side::mirrored ? -1 : 1)
                                       : glm::vec4(tangents::anyPerpendicular(n), 1);
    }
    return out;
}

Cotangents smoothCotangents(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const LargeArray<std::uint32_t> first = tangents::weld(mesh);
    const std::size_t count = mesh.positions.size();
    CotangentSums sums(2 * count);
    std::vector<float> share(2 * count, 0.0f); // angle by vertex as given and side
    for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
        const std::uint32_t vertex = mesh.indices[c];
        const Edges e = edgesAt(mesh, c / 3, c % 3);
        const Side side = sideAt(e, mesh.normals[vertex]);
        if (side != Side::none)
            share[slot(vertex, side)] +=
                addCorner(sums, slot(first[vertex], side), e, mesh.normals[vertex]);
    }

    const auto isEmpty = [&](std::size_t at) { return !(sums.weight[at] > 0); };
    Cotangents out{std::vector<glm::vec3>(count), std::vector<glm::vec3>(count)};
    for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
        const float plain = share[slot(vertex, Side::unmirrored)];
        const float mirrored = share[slot(vertex, Side::mirrored)];
        const Side own = plain + mirrored == 0 ? Side::none
            : mirrored > plain                 ? Side::mirrored
                                               : Side::unmirrored;
        const std::size_t at = slot(first[vertex], sideOrNearest(own, first[vertex], isEmpty));
        const float scale = isEmpty(at) ? 0 : 1 / sums.weight[at];
        out.u[vertex] = sums.u[at] * scale;
        out.v[vertex] = sums.v[at] * scale;
    }
    return out;
}

VertexSplit splitVertices(std::size_t vertexCount, std::span<const std::uint32_t> indices,
                          std::span<const glm::vec4> corners)
{
    if (corners.size() != indices.size() || vertexCount >= tangents::kNone
        || indices.size() >= tangents::kNone
        || std::any_of(indices.begin(), indices.end(), [&](auto i) { return i >= vertexCount; }))
        return {};
    const auto first =
        tangents::firstEqual(static_cast<std::uint32_t>(indices.size()), [&](std::uint32_t c) {
            const glm::vec4 x = corners[c];
            return std::array{indices[c],
                              0u,
                              tangents::bitsOf(x.x),
                              tangents::bitsOf(x.y),
                              tangents::bitsOf(x.z),
                              tangents::bitsOf(x.w)};
        });
    VertexSplit split{std::vector<std::uint32_t>(vertexCount), {indices.begin(), indices.end()}};
    for (std::uint32_t i = 0; i < vertexCount; ++i)
        split.sources[i] = i;
    std::vector<bool> claimed(vertexCount); // by the first value met, which stays where it is
    for (std::uint32_t c = 0; c < indices.size(); ++c) {
        if (first[c] != c) {
            split.indices[c] = split.indices[first[c]];
        } else if (claimed[indices[c]]) {
            split.indices[c] = static_cast<std::uint32_t>(split.sources.size());
            split.sources.push_back(indices[c]);
        }
        claimed[indices[c]] = true;
    }
    return split;
}

VertexSplit splitMirrored(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const std::vector<Side> sides = cornerSides(mesh);
    std::vector<std::array<bool, 2>> used(mesh.positions.size(), {false, false});
    for (std::size_t c = 0; c < sides.size(); ++c)
        if (sides[c] != Side::none)
            used[mesh.indices[c]][std::size_t(sides[c])] = true;
    std::vector<glm::vec4> values(sides.size(), glm::vec4(0));
    for (std::size_t c = 0; c < sides.size(); ++c) {
        const bool unmirrored = used[mesh.indices[c]][0];
        const bool mirrored = sides[c] == Side::mirrored || (sides[c] == Side::none && !unmirrored);
        values[c].x = mirrored ? 1.0f : 0.0f;
    }
    return splitVertices(mesh.positions.size(), mesh.indices, values);
}

} // namespace cotan
