#include "check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

#include <cotan/portable.hpp>
#include <cotan/triangle.hpp>

#include "motion.hpp"

namespace {

namespace f32 = cotan::f32;

// Length of a - b in radians, converted to degrees, for vectors of about unit length; 180 for NaN.
double errorOf(glm::vec3 a, glm::vec3 b)
{
    const double difference = glm::length(glm::dvec3(a) - glm::dvec3(b));
    return std::isfinite(difference) ? difference * 57.29577951308232 : 180;
}

// For each vertex: the corners that its group averages. Groups can differ between a pose and the rest pose, since
// vertices may become equal and degenerate triangles may get area.
std::vector<std::vector<std::uint32_t>> cornersOf(const cotan::Adjacency& a)
{
    std::vector<std::vector<std::uint32_t>> corners(a.vertices.size());
    for (std::uint32_t g = 0; g < a.groups(); ++g)
        for (std::uint32_t i = a.vertexBegin[g]; i < a.vertexBegin[g + 1]; ++i)
            corners[a.vertices[i]].assign(a.corners.begin() + a.cornerBegin[g],
                                          a.corners.begin() + a.cornerBegin[g + 1]);
    return corners;
}

// Whether the gradients at these corners cancel, as at poles where differently oriented patches meet. Their sum is then
// only rounding error, in the shaders and in C++.
bool cancel(const Mesh& mesh, const std::vector<std::uint32_t>& corners)
{
    glm::dvec3 u(0), v(0);
    double longest = 0;
    for (const std::uint32_t c : corners) {
        const std::uint32_t f = c / 3 * 3, v0 = mesh.indices[c], v1 = mesh.indices[f + (c + 1) % 3],
                            v2 = mesh.indices[f + (c + 2) % 3];
        const glm::dvec3 p(mesh.positions[v0]);
        const glm::dvec2 uv(mesh.texcoords[v0]);
        const cotan::f64::cotan_frame g = cotan::f64::cotan_frame_gradient(
            mesh.normals[v0], glm::dvec3(mesh.positions[v1]) - p, glm::dvec3(mesh.positions[v2]) - p,
            glm::dvec2(mesh.texcoords[v1]) - uv, glm::dvec2(mesh.texcoords[v2]) - uv);
        u += g.t;
        v += g.b;
        longest += std::max(glm::length(g.t), glm::length(g.b));
    }
    return std::max(glm::length(u), glm::length(v)) < 0.1 * longest;
}

// Whether each vertex has the same corners in the pose as at rest, a finite normal, and gradients that do not cancel.
std::vector<bool> comparable(const cotan::Adjacency& rest, const Mesh& pose)
{
    const auto before = cornersOf(rest), now = cornersOf(cotan::makeAdjacency(viewOf(pose)));
    std::vector<bool> out;
    for (std::size_t v = 0; v < before.size(); ++v)
        out.push_back(before[v] == now[v] && std::isfinite(glm::dot(pose.normals[v], pose.normals[v]))
                      && !cancel(pose, before[v]));
    return out;
}

double smoothError(const Mesh& pose, const std::vector<glm::vec4>& packed, const std::vector<bool>& compared)
{
    const cotan::Cotangents expected = cotan::unitCotangents(cotan::smoothCotangents(viewOf(pose)));
    double maxDegrees = 0;
    for (std::size_t v = 0; v < packed.size(); ++v) {
        if (!compared[v])
            continue;
        const f32::cotan_covectors c = f32::cotan_unpack_smooth8(pose.normals[v], packed[v]);
        maxDegrees = std::max({maxDegrees, errorOf(c.t, expected.u[v]), errorOf(c.b, expected.v[v])});
    }
    return maxDegrees;
}

double trianglesError(const Mesh& pose, const std::vector<std::array<std::uint32_t, 3>>& packed)
{
    const std::vector<cotan::TriangleVectors> expected = cotan::triangleVectors(viewOf(pose));
    double maxDegrees = 0;
    for (std::size_t f = 0; f < packed.size(); ++f) {
        const f32::cotan_packed_triangle p{packed[f][0], packed[f][1], packed[f][2]};
        maxDegrees = std::max({maxDegrees, errorOf(f32::cotan_unpack_triangle_u(p), expected[f].u),
                               errorOf(f32::cotan_unpack_triangle_v(p), expected[f].v)});
    }
    return maxDegrees;
}

// MikkTSpace also splits where triangles share only a vertex. Its tangents differ there.
struct TangentErrors {
    double within = 0;       // maximum error in degrees of the corners whose error is at most a degree
    std::size_t further = 0; // number of corners whose error exceeds a degree
};
TangentErrors tangentErrors(const Mesh& pose, const std::vector<glm::vec4>& frames, const std::vector<bool>& compared)
{
    const std::vector<glm::vec4> expected = cotan::mikktspaceTangents(viewOf(pose));
    TangentErrors errors;
    for (std::size_t c = 0; c < expected.size(); ++c) {
        if (!compared[pose.indices[c]])
            continue;
        const glm::vec4 found = frames[pose.indices[c]];
        const double degrees = found.w * expected[c].w > 0 ? errorOf(glm::vec3(found), glm::vec3(expected[c])) : 180;
        errors.further += degrees > 1;
        errors.within = std::max(errors.within, degrees > 1 ? 0 : degrees);
    }
    return errors;
}

} // namespace

void check(const Gpu& gpu, const Mesh& rest)
{
    const auto start = std::chrono::steady_clock::now();
    const cotan::Adjacency adjacency = cotan::makeAdjacency(viewOf(rest));
    std::printf("%zu vertices in %u groups, %zu triangles, adjacency made in %.0f ms\n", rest.positions.size(),
                adjacency.groups(), rest.indices.size() / 3,
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    std::printf("degrees from the C++, at most: smooth (and vertices not compared), tangents (and corners "
                "further apart than 1), triangles; ms of each pass and of normals\n");
    Passes passes(gpu, rest, adjacency, cotan::makeNormalAdjacency(viewOf(rest)));
    for (const Pass pass : {Pass::normals, Pass::smooth, Pass::tangents, Pass::triangles})
        passes.run(pass); // the first run of a pipeline is slower
    for (const Motion& motion : kMotions) {
        const Mesh pose = posed(rest, motion, 1, Normals::exact);
        passes.pose(pose.positions, pose.normals);
        const std::vector<bool> compared = comparable(adjacency, pose);
        const double smoothTime = passes.run(Pass::smooth), smooth = smoothError(pose, passes.frames(), compared);
        const double tangentsTime = passes.run(Pass::tangents);
        const TangentErrors tangents = tangentErrors(pose, passes.frames(), compared);
        const double trianglesTime = passes.run(Pass::triangles), triangles = trianglesError(pose, passes.triangles());
        const double normalsTime = passes.run(Pass::normals);
        std::printf("%s %.4f %td %.4f %zu %.4f %.2f %.2f %.2f %.2f\n", motion.name, smooth,
                    std::count(compared.begin(), compared.end(), false), tangents.within, tangents.further, triangles,
                    smoothTime, tangentsTime, trianglesTime, normalsTime);
    }
}
