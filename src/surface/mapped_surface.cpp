#include "cotan/surface/mapped_surface.hpp"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "cotan/covector.hpp"
#include "cotan/scene/texture_uv.hpp"
#include "cotan/tangents.hpp"

namespace cotan {

namespace {

double finiteOrZero(double x) { return std::abs(x) <= 1e30 ? x : 0; }

std::vector<glm::vec2> uvOfMap(const Mesh& mesh, const Texture& map)
{
    std::vector<glm::vec2> uv = textureUv(map, mesh);
    if (uv.size() != mesh.vertexCount())
        return {};
    for (glm::vec2& c : uv)
        c = {float(finiteOrZero(c.x)), float(finiteOrZero(c.y))};
    return uv;
}

// A tangent as glTF has it, moved, and as frames take it. Mirroring turns cross products round.
glm::dvec4 moved(const LinearMap<double>& m, glm::vec4 gltf)
{
    const glm::vec4 t = tangentAlongV(gltf);
    const glm::dvec3 direction = f64::cotan_normalize_or(m(Vector3d(glm::dvec3(t))).raw(), glm::dvec3(0));
    return {direction, double(t.w) * (m.determinant() < 0 ? -1 : 1)};
}

std::vector<glm::dvec4> moved(const LinearMap<double>& m, const std::vector<glm::vec4>& corners)
{
    std::vector<glm::dvec4> result;
    result.reserve(corners.size());
    for (const glm::vec4& c : corners)
        result.push_back(moved(m, c));
    return result;
}

glm::dvec3 movedCovector(const LinearMap<double>& m, glm::vec3 c)
{
    return m.planeImage(Covector3d(glm::dvec3(c))).raw();
}

// Cotangents per corner, mirrored and unmirrored triangles apart.
void addCotangents(MappedSurface& surface, const MeshView& mesh, const LinearMap<double>& m)
{
    const SplitCotangents made = splitSmoothCotangents(mesh);
    if (made.cotangents.u.empty())
        return;
    for (std::uint32_t i : made.split.indices) {
        surface.cotangentsU.push_back(movedCovector(m, made.cotangents.u[i]));
        surface.cotangentsV.push_back(movedCovector(m, made.cotangents.v[i]));
    }
}

const std::vector<glm::dvec4>& tangentsOf(const MappedSurface& s, Frame frame, TangentOrigin source)
{
    return source == TangentOrigin::stored && !s.stored.empty() ? s.stored : s.generated[std::size_t(frame)];
}

f64::cotan_frame frameOfVertices(const MappedSurface& s, Frame frame, TangentOrigin source, std::size_t triangle,
                                 glm::dvec3 barycentric, glm::dvec3 n)
{
    if (readsCotangents(frame)) {
        const bool has = !s.cotangentsU.empty();
        return evaluateCotangents(frame, n, has ? atPoint(s.cotangentsU, triangle, barycentric) : glm::dvec3(0),
                                  has ? atPoint(s.cotangentsV, triangle, barycentric) : glm::dvec3(0));
    }
    const std::vector<glm::dvec4>& tangents = tangentsOf(s, frame, source);
    const glm::dvec4 t = tangents.empty() ? glm::dvec4(0, 0, 0, 1) : atPoint(tangents, triangle, barycentric);
    return evaluateTangents(frame, n, glm::dvec3(t), t.w);
}

} // namespace

MappedSurface makeSurface(const Mesh& mesh, const Texture& map, const glm::dmat3& linear)
{
    MappedSurface surface;
    const LinearMap<double> m(linear);
    const std::vector<glm::vec2> uv = uvOfMap(mesh, map);
    const bool storedFits = mesh.tangents.size() == mesh.vertexCount();
    for (std::uint32_t i : mesh.indices) {
        surface.positions.push_back(linear * glm::dvec3(mesh.positions[i]));
        surface.normals.push_back(i < mesh.normals.size()
                                      ? f64::cotan_normalize_or(movedCovector(m, mesh.normals[i]), glm::dvec3(0))
                                      : glm::dvec3(0));
        if (!uv.empty())
            surface.uv.push_back(glm::dvec2(uv[i]));
        if (storedFits)
            surface.stored.push_back(moved(m, mesh.tangents[i]));
    }
    if (surface.uv.empty())
        return surface;
    const MeshView view{mesh.positions, mesh.normals, uv, mesh.indices};
    for (const FrameInfo& f : frames())
        if (readsTangents(f.frame))
            surface.generated[std::size_t(f.frame)] = moved(m, generateTangents(f.frame, view));
    addCotangents(surface, view, m);
    return surface;
}

MappedSurface makeCoatSurface(const Mesh& mesh, const Texture& surfaceMap, const Texture& coatMap,
                              const glm::dmat3& linear)
{
    MappedSurface own = makeSurface(mesh, surfaceMap, linear), coat = makeSurface(mesh, coatMap, linear);
    if (own.uv == coat.uv)
        return own;
    coat.generated = std::move(own.generated);
    coat.ofCoat = true;
    return coat;
}

f64::cotan_frame frameAt(const MappedSurface& s, Frame frame, TangentOrigin tangents, std::size_t triangle,
                         glm::dvec3 barycentric)
{
    const TriangleEdges e = edgesOf(s, triangle);
    const glm::dvec3 raw = atPoint(s.normals, triangle, barycentric);
    const f64::cotan_differences d = f64::cotan_scale_differences(e.p1, e.p2, glm::dvec2(0), glm::dvec2(0));
    const glm::dvec3 n = f64::cotan_safe_normal(raw, d.dpdx, d.dpdy);
    if (s.uv.empty())
        return {glm::dvec3(0), glm::dvec3(0), n};
    // `mikktspace` wants its normal as interpolated.
    if (readsCotangents(frame) && s.ofCoat)
        return evaluate(Frame::cotangent, n, e.p1, e.p2, e.uv1, e.uv2);
    if (readsVertices(frame))
        return frameOfVertices(s, frame, tangents, triangle, barycentric, frame == Frame::mikktspace ? raw : n);
    return evaluate(frame, n, e.p1, e.p2, e.uv1, e.uv2);
}

TriangleEdges edgesOf(const MappedSurface& s, std::size_t triangle)
{
    return edgesOf(s.positions, s.uv, MappedSurface::cornersOf(triangle));
}

UvRaster repeatedRaster(const MappedSurface& s, int width, int height, glm::ivec2 copies)
{
    std::vector<glm::vec2> uv;
    for (const glm::dvec2& c : s.uv)
        uv.push_back(glm::vec2(c / glm::dvec2(copies)));
    std::vector<std::uint32_t> indices(uv.size());
    std::iota(indices.begin(), indices.end(), 0u);
    return UvRaster({uv, indices}, width * copies.x, height * copies.y, {0, 0}, true);
}

double areaOf(const MappedSurface& s, std::size_t triangle)
{
    const TriangleEdges e = edgesOf(s, triangle);
    const double area = glm::length(glm::cross(e.p1, e.p2)) / 2;
    return std::isfinite(area) ? area : 0;
}

int orientationOf(const MappedSurface& s, std::size_t triangle)
{
    if (s.uv.empty())
        return 0;
    const TriangleEdges e = edgesOf(s, triangle);
    const auto [a, b, c] = MappedSurface::cornersOf(triangle);
    // The corners' order is judged from the side that the normals point to.
    const double outside = glm::dot(glm::cross(e.p1, e.p2), s.normals[a] + s.normals[b] + s.normals[c]) < 0 ? -1 : 1;
    const double signedArea = -e.uvArea2() * outside; // v runs down
    return signedArea > 0 ? 1 : signedArea < 0 ? -1 : 0;
}

} // namespace cotan
