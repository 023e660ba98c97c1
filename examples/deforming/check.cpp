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

// How far apart two vectors are of which the longer of a pair is 1 long, as an angle. NaN counts as far.
double apart(glm::vec3 a, glm::vec3 b)
{
    const double difference = glm::length(glm::dvec3(a) - glm::dvec3(b));
    return std::isfinite(difference) ? difference * 57.29577951308232 : 180;
}

// Per vertex the corners that it gathers from. Smoothing a pose groups anew: vertices can be equal in it that are
// not at rest, and triangles without area can have some.
std::vector<std::vector<std::uint32_t>> cornersOf(const cotan::Adjacency& a)
{
    std::vector<std::vector<std::uint32_t>> corners(a.vertices.size());
    for (std::uint32_t g = 0; g < a.groups(); ++g)
        for (std::uint32_t i = a.vertexBegin[g]; i < a.vertexBegin[g + 1]; ++i)
            corners[a.vertices[i]].assign(a.corners.begin() + a.cornerBegin[g],
                                          a.corners.begin() + a.cornerBegin[g + 1]);
    return corners;
}

// Whether the gradients at these corners cancel, as at poles where patches meet that are turned against one
// another: what is left of them is rounding, here as there.
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

// Vertices that have the same triangles in the pose as at load, a normal, and a direction.
std::vector<bool> comparable(const cotan::Adjacency& rest, const Mesh& pose)
{
    const auto before = cornersOf(rest), now = cornersOf(cotan::makeAdjacency(viewOf(pose)));
    std::vector<bool> out;
    for (std::size_t v = 0; v < before.size(); ++v)
        out.push_back(before[v] == now[v] && std::isfinite(glm::dot(pose.normals[v], pose.normals[v]))
                      && !cancel(pose, before[v]));
    return out;
}

double smoothOff(const Mesh& pose, const std::vector<glm::vec4>& packed, const std::vector<bool>& compared)
{
    const cotan::Cotangents expected = cotan::unitCotangents(cotan::smoothCotangents(viewOf(pose)));
    double most = 0;
    for (std::size_t v = 0; v < packed.size(); ++v) {
        if (!compared[v])
            continue;
        const f32::cotan_covectors c = f32::cotan_unpack_smooth8(pose.normals[v], packed[v]);
        most = std::max({most, apart(c.t, expected.u[v]), apart(c.b, expected.v[v])});
    }
    return most;
}

double trianglesOff(const Mesh& pose, const std::vector<std::array<std::uint32_t, 3>>& packed)
{
    const std::vector<cotan::TriangleVectors> expected = cotan::triangleVectors(viewOf(pose));
    double most = 0;
    for (std::size_t f = 0; f < packed.size(); ++f) {
        const f32::cotan_packed_triangle p{packed[f][0], packed[f][1], packed[f][2]};
        most = std::max({most, apart(f32::cotan_unpack_triangle_u(p), expected[f].u),
                         apart(f32::cotan_unpack_triangle_v(p), expected[f].v)});
    }
    return most;
}

// MikkTSpace splits finer in places: where triangles meet at a vertex only. There its tangent is another.
struct TangentsOff {
    double within = 0;       // degrees, of the corners that are no further apart than a degree
    std::size_t further = 0; // corners
};
TangentsOff tangentsOff(const Mesh& pose, const std::vector<glm::vec4>& frames, const std::vector<bool>& compared)
{
    const std::vector<glm::vec4> expected = cotan::mikktspaceTangents(viewOf(pose));
    TangentsOff off;
    for (std::size_t c = 0; c < expected.size(); ++c) {
        if (!compared[pose.indices[c]])
            continue;
        const glm::vec4 found = frames[pose.indices[c]];
        const double degrees = found.w * expected[c].w > 0 ? apart(glm::vec3(found), glm::vec3(expected[c])) : 180;
        off.further += degrees > 1;
        off.within = std::max(off.within, degrees > 1 ? 0 : degrees);
    }
    return off;
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
        const double smoothTime = passes.run(Pass::smooth), smooth = smoothOff(pose, passes.frames(), compared);
        const double tangentsTime = passes.run(Pass::tangents);
        const TangentsOff tangents = tangentsOff(pose, passes.frames(), compared);
        const double trianglesTime = passes.run(Pass::triangles), triangles = trianglesOff(pose, passes.triangles());
        const double normalsTime = passes.run(Pass::normals);
        std::printf("%s %.4f %td %.4f %zu %.4f %.2f %.2f %.2f %.2f\n", motion.name, smooth,
                    std::count(compared.begin(), compared.end(), false), tangents.within, tangents.further, triangles,
                    smoothTime, tangentsTime, trianglesTime, normalsTime);
    }
}
