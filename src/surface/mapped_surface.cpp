#include "cotan/lint/surface.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "cotan/scene/texture_uv.hpp"
#include "cotan/tangents.hpp"

namespace cotan {

namespace {

struct Transform {
    glm::dmat3 vectors{1};
    glm::dmat3 covectors{1}; // the matrix of cofactors, with the sign of the determinant
    double handedness = 1;
};

Transform transformOf(const glm::dmat3& m)
{
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double sign = glm::dot(m[0], cofactors[0]) < 0 ? -1 : 1;
    return {m, cofactors * sign, sign};
}

double finiteOrZero(double x) { return std::abs(x) <= 1e30 ? x : 0; }

std::vector<glm::vec2> uvOfMap(const Mesh& mesh, const Texture& map)
{
    std::vector<glm::vec2> uv = mesh.texcoords[map.present() && map.texcoord == 1 ? 1 : 0];
    if (uv.size() != mesh.vertexCount())
        return {};
    for (glm::vec2& c : uv) {
        c = textureUv(map, c);
        c = {float(finiteOrZero(c.x)), float(finiteOrZero(c.y))};
    }
    return uv;
}

// Tangents as glTF has them, to those that `vertex` and `mikktspace` take: theirs points along +v.
glm::dvec4 moved(const Transform& t, glm::vec4 tangent)
{
    const glm::dvec3 direction = f64::cotan_normalize_or(t.vectors * glm::dvec3(tangent), glm::dvec3(0));
    return {direction, -double(tangent.w) * t.handedness};
}

std::vector<glm::dvec4> moved(const Transform& t, const std::vector<glm::vec4>& corners)
{
    std::vector<glm::dvec4> result;
    result.reserve(corners.size());
    for (const glm::vec4& c : corners)
        result.push_back(moved(t, c));
    return result;
}

// Cotangents per corner, mirrored and unmirrored triangles apart.
void addCotangents(MappedSurface& surface, const MeshView& mesh, const Transform& t)
{
    const VertexSplit split = splitMirrored(mesh);
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uv;
    for (std::uint32_t s : split.sources) {
        positions.push_back(mesh.positions[s]);
        normals.push_back(mesh.normals[s]);
        uv.push_back(mesh.texcoords[s]);
    }
    const Cotangents c = smoothCotangents({positions, normals, uv, split.indices});
    if (c.u.empty())
        return;
    for (std::uint32_t i : split.indices) {
        surface.cotangentsU.push_back(t.covectors * glm::dvec3(c.u[i]));
        surface.cotangentsV.push_back(t.covectors * glm::dvec3(c.v[i]));
    }
}

const std::vector<glm::dvec4>& tangentsOf(const MappedSurface& s, Frame frame, TangentOrigin source)
{
    if (source == TangentOrigin::stored && !s.stored.empty())
        return s.stored;
    return frame == Frame::vertex ? s.vertex : s.mikktspace;
}

f64::cotan_frame frameOfVertices(const MappedSurface& s, Frame frame, TangentOrigin source, std::size_t triangle,
                                 glm::dvec3 barycentric, glm::dvec3 n)
{
    if (frame == Frame::smooth) {
        const bool has = !s.cotangentsU.empty();
        return f64::cotan_frame_smooth(n, has ? atPoint(s.cotangentsU, triangle, barycentric) : glm::dvec3(0),
                                       has ? atPoint(s.cotangentsV, triangle, barycentric) : glm::dvec3(0));
    }
    const std::vector<glm::dvec4>& tangents = tangentsOf(s, frame, source);
    const glm::dvec4 t = tangents.empty() ? glm::dvec4(0, 0, 0, 1) : atPoint(tangents, triangle, barycentric);
    return frame == Frame::vertex ? f64::cotan_frame_vertex(n, glm::dvec3(t), t.w)
                                  : f64::cotan_frame_mikktspace(n, glm::dvec3(t), t.w);
}

} // namespace

MappedSurface makeSurface(const Mesh& mesh, const Texture& map, const glm::dmat3& linear)
{
    MappedSurface surface;
    const Transform t = transformOf(linear);
    const std::vector<glm::vec2> uv = uvOfMap(mesh, map);
    const bool storedFits = mesh.tangents.size() == mesh.vertexCount();
    for (std::uint32_t i : mesh.indices) {
        surface.positions.push_back(t.vectors * glm::dvec3(mesh.positions[i]));
        surface.normals.push_back(
            i < mesh.normals.size()
                ? f64::cotan_normalize_or(t.covectors * glm::dvec3(mesh.normals[i]), glm::dvec3(0))
                : glm::dvec3(0));
        if (!uv.empty())
            surface.uv.push_back(glm::dvec2(uv[i]));
        if (storedFits)
            surface.stored.push_back(moved(t, mesh.tangents[i]));
    }
    if (surface.uv.empty())
        return surface;
    const MeshView view{mesh.positions, mesh.normals, uv, mesh.indices};
    surface.mikktspace = moved(t, mikktspaceTangents(view));
    surface.vertex = moved(t, vertexTangents(view));
    addCotangents(surface, view, t);
    return surface;
}

f64::cotan_frame frameAt(const MappedSurface& s, Frame frame, TangentOrigin tangents, std::size_t triangle,
                         glm::dvec3 barycentric)
{
    const std::size_t a = 3 * triangle;
    const glm::dvec3 e1 = s.positions[a + 1] - s.positions[a], e2 = s.positions[a + 2] - s.positions[a];
    const glm::dvec3 raw = atPoint(s.normals, triangle, barycentric);
    const f64::cotan_differences d = f64::cotan_scale_differences(e1, e2, glm::dvec2(0), glm::dvec2(0));
    const glm::dvec3 n = f64::cotan_safe_normal(raw, d.dpdx, d.dpdy);
    if (s.uv.empty())
        return {glm::dvec3(0), glm::dvec3(0), n};
    // `mikktspace` wants its normal as interpolated.
    if (info(frame).source == FrameSource::vertices)
        return frameOfVertices(s, frame, tangents, triangle, barycentric, frame == Frame::mikktspace ? raw : n);
    return evaluate(frame, n, e1, e2, s.uv[a + 1] - s.uv[a], s.uv[a + 2] - s.uv[a]);
}

double areaOf(const MappedSurface& s, std::size_t triangle)
{
    const std::size_t a = 3 * triangle;
    const double area =
        glm::length(glm::cross(s.positions[a + 1] - s.positions[a], s.positions[a + 2] - s.positions[a])) / 2;
    return std::isfinite(area) ? area : 0;
}

int orientationOf(const MappedSurface& s, std::size_t triangle)
{
    if (s.uv.empty())
        return 0;
    const std::size_t a = 3 * triangle;
    const glm::dvec2 d1 = s.uv[a + 1] - s.uv[a], d2 = s.uv[a + 2] - s.uv[a];
    const glm::dvec3 face = glm::cross(s.positions[a + 1] - s.positions[a], s.positions[a + 2] - s.positions[a]);
    const glm::dvec3 n = s.normals[a] + s.normals[a + 1] + s.normals[a + 2];
    // The corners' order is judged from the side that the normals point to.
    const double outside = glm::dot(face, n) < 0 ? -1 : 1;
    const double signedArea = -(d1.x * d2.y - d1.y * d2.x) * outside; // v runs down
    return signedArea > 0 ? 1 : signedArea < 0 ? -1 : 0;
}

} // namespace cotan
