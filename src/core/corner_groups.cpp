#include "corner_groups.hpp"

#include "cotan/portable.hpp"
#include "tangents_mesh.hpp"

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
    // A vertex without a normal takes the triangle's.
    const double facing = n == glm::dvec3(0) ? glm::dot(face, face) : glm::dot(face, n);
    const double side = e.uvArea() * facing;
    if (!std::isfinite(side) || side == 0)
        return Side::none;
    return side > 0 ? Side::mirrored : Side::unmirrored;
}

// How much a triangle has to say about which side a vertex is on: |cosine| of its plane to the vertex's. One that is
// seen edge-on can take half a turn as seen along the normal, and folds over to the other side by rounding.
static float openness(const Edges& e, glm::vec3 normal)
{
    const glm::dvec3 face = glm::cross(e.dp1, e.dp2);
    const double lengths = glm::length(face) * glm::length(glm::dvec3(normal));
    return lengths > 0 ? float(std::abs(glm::dot(face, glm::dvec3(normal))) / lengths) : 1.0f;
}

std::vector<Side> cornerSides(const MeshView& mesh)
{
    std::vector<Side> sides(mesh.indices.size());
    for (std::size_t c = 0; c < sides.size(); ++c)
        sides[c] = sideAt(edgesAt(mesh, c / 3, c % 3), mesh.normals[mesh.indices[c]]);
    return sides;
}

// Adds the gradients of a corner's triangle; returns the weight that they got.
static float addCorner(CotangentSums& sums, std::size_t at, const Edges& e, glm::vec3 n)
{
    const f32::cotan_frame frame =
        f32::cotan_frame_gradient(n, glm::vec3(e.dp1), glm::vec3(e.dp2), glm::vec2(e.duv1), glm::vec2(e.duv2));
    const float weight = projectedAngle(glm::vec3(0), glm::vec3(e.dp1), glm::vec3(e.dp2), n);
    if (!(weight > 0) || (isZero(frame.t) && isZero(frame.b)))
        return 0;
    sums.u[at] += frame.t * weight;
    sums.v[at] += frame.b * weight;
    sums.weight[at] += weight;
    return weight;
}

CornerGroups groupCorners(const MeshView& mesh)
{
    const std::size_t count = mesh.positions.size();
    CornerGroups g{weld(mesh), std::vector<Side>(mesh.indices.size()), CotangentSums(2 * count),
                   std::vector<std::size_t>(count)};
    std::vector<float> share(2 * count, 0.0f); // angle times openness by vertex as given and side
    for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
        const std::uint32_t vertex = mesh.indices[c];
        const Edges e = edgesAt(mesh, c / 3, c % 3);
        const Side side = g.sides[c] = sideAt(e, mesh.normals[vertex]);
        if (side != Side::none)
            share[slot(vertex, side)] += addCorner(g.sums, slot(g.first[vertex], side), e, mesh.normals[vertex])
                * openness(e, mesh.normals[vertex]);
    }
    const auto isEmpty = [&](std::size_t at) { return g.sums.isEmpty(at); };
    for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
        const float plain = share[slot(vertex, Side::unmirrored)];
        const float mirrored = share[slot(vertex, Side::mirrored)];
        const Side own = plain + mirrored == 0 ? Side::none : mirrored > plain ? Side::mirrored : Side::unmirrored;
        g.slots[vertex] = slot(g.first[vertex], sideOrNearest(own, g.first[vertex], isEmpty));
    }
    return g;
}

} // namespace cotan::tangents
