#include "bake/surface/mapped_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <glm/geometric.hpp>

#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

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

// A glTF tangent after the linear map, as frames take it. Mirroring flips cross products.
glm::dvec4 moved(const LinearMap<double>& m, glm::vec4 gltf)
{
    const glm::vec4 t = tangentAlongV(gltf);
    const glm::dvec3 direction = f64::cotan_normalize_or(m(Vector3d(glm::dvec3(t))).raw(), glm::dvec3(0));
    return {direction, double(t.w) * (m.determinant() < 0 ? -1 : 1)};
}

// Stores the values of corners once for the corners of a vertex with equal bits, as far as these are among the first
// kMaxCompared of the vertex. Further values of a vertex follow the first values of all vertices.
CornerTangents gathered(std::size_t vertices, const std::vector<std::uint32_t>& indices,
                        const std::vector<glm::vec4>& corners)
{
    constexpr std::uint32_t kNone = 0xffffffffu;
    constexpr int kMaxCompared = 64; // a vertex of thousands of corners may have a value for each
    CornerTangents result;
    if (corners.size() != indices.size() || corners.empty())
        return result;
    const auto same = [](const glm::vec4& a, const glm::vec4& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
    std::vector<glm::vec4>& values = result.values;
    values.resize(vertices);
    std::vector<bool> has(vertices);
    std::vector<std::uint32_t> next; // of the same vertex, by index
    for (std::size_t c = 0; c < indices.size(); ++c) {
        std::uint32_t slot = indices[c];
        if (!has[slot]) {
            has[slot] = true;
            values[slot] = corners[c];
            continue;
        }
        for (int compared = 1; !same(values[slot], corners[c]); ++compared) {
            if (next.empty())
                next.assign(vertices, kNone);
            if (compared > kMaxCompared) {
                slot = std::uint32_t(values.size());
                values.push_back(corners[c]);
                next.push_back(kNone);
                break;
            }
            if (next[slot] == kNone) {
                next[slot] = std::uint32_t(values.size());
                values.push_back(corners[c]);
                next.push_back(kNone);
            }
            slot = next[slot];
        }
        if (slot != indices[c])
            result.slots.add(c, indices[c], slot, vertices);
    }
    values.shrink_to_fit();
    return result;
}

// Cotangents, separate for mirrored and unmirrored triangles.
CornerCotangents cotangentsOf(const Mesh& skin, const MeshView& mesh)
{
    SplitCotangents made = splitSmoothCotangents(mesh);
    for (std::size_t i = 0; i < made.split.sources.size(); ++i)
        for (auto* const vectors : {&made.cotangents.u, &made.cotangents.v})
            (*vectors)[i] = skinnedCotangent(skin, made.split.sources[i], (*vectors)[i]);
    CornerCotangents result{std::move(made.cotangents), {}};
    for (std::size_t c = 0; c < made.split.indices.size(); ++c)
        if (made.split.indices[c] != mesh.indices[c])
            result.slots.add(c, mesh.indices[c], made.split.indices[c], mesh.positions.size());
    return result;
}

// The weighted sum over the corners of a triangle.
template<class ValueOf> auto blended(std::size_t triangle, glm::dvec3 weights, const ValueOf& valueOf)
{
    return valueOf(3 * triangle) * weights.x + valueOf(3 * triangle + 1) * weights.y
        + valueOf(3 * triangle + 2) * weights.z;
}

f64::cotan_frame frameOfVertices(const MappedSurface& s, Frame frame, TangentOrigin source, std::size_t triangle,
                                 glm::dvec3 barycentric, glm::dvec3 n)
{
    if (!readsCotangents(frame)) {
        const glm::dvec4 t = tangentAt(s, frame, source, triangle, barycentric);
        return evaluateTangents(frame, n, glm::dvec3(t), t.w);
    }
    const CornerCotangents& made = s.shared->cotangents;
    if (made.values.u.empty())
        return evaluateCotangents(frame, n, glm::dvec3(0), glm::dvec3(0));
    const auto gradient = [&](const std::vector<glm::vec3>& values) {
        return blended(triangle, barycentric, [&](std::size_t corner) {
            const glm::dvec3 own(values[made.slots.of(corner, s.vertexOf(corner))]);
            return s.linear.planeImage(Covector3d(own)).raw();
        });
    };
    return evaluateCotangents(frame, n, gradient(made.values.u), gradient(made.values.v));
}

std::shared_ptr<SurfaceMesh> shareMesh(std::shared_ptr<const Mesh> mesh, const Texture& map, const FrameSet& wanted)
{
    auto shared = std::make_shared<SurfaceMesh>();
    shared->uv = uvOfMap(*mesh, map);
    shared->mesh = std::move(mesh);
    const Mesh& m = *shared->mesh;
    if (shared->uv.empty() || m.indices.empty())
        return shared;
    const MeshView view = bindView(m, shared->uv);
    for (const FrameInfo& f : frames()) // first those that take most memory while they are made
        if (wanted[std::size_t(f.frame)] && readsTangents(f.frame)) {
            auto corners = generateTangents(f.frame, view);
            for (std::size_t c = 0; c < corners.size(); ++c)
                corners[c] = skinned(m, m.indices[c], corners[c]);
            shared->generated[std::size_t(f.frame)] = gathered(m.vertexCount(), m.indices, corners);
        }
    if (wanted[std::size_t(Frame::smooth)])
        shared->cotangents = cotangentsOf(m, view);
    return shared;
}

// Copies the attributes that a surface reads.
std::shared_ptr<const Mesh> copied(const Mesh& mesh)
{
    auto copy = std::make_shared<Mesh>();
    copy->positions = mesh.positions;
    copy->normals = mesh.normals;
    copy->tangents = mesh.tangents;
    copy->texcoords = mesh.texcoords;
    copy->bindPositions = mesh.bindPositions;
    copy->bindNormals = mesh.bindNormals;
    copy->skin = mesh.skin;
    copy->indices = mesh.indices;
    return copy;
}

} // namespace

void CornerSlots::add(std::size_t corner, std::uint32_t vertex, std::uint32_t slot, std::size_t vertices)
{
    if (split_.empty())
        split_.resize(vertices);
    split_[vertex] = true;
    exceptions_.push_back({std::uint32_t(corner), slot});
}

std::size_t CornerSlots::of(std::size_t corner, std::uint32_t vertex) const
{
    if (split_.empty() || !split_[vertex])
        return vertex;
    const auto found = std::ranges::lower_bound(exceptions_, corner, {}, &Exception::corner);
    return found != exceptions_.end() && found->corner == corner ? found->slot : vertex;
}

bool MappedSurface::hasStored() const
{
    return shared && !shared->mesh->tangents.empty() && shared->mesh->tangents.size() == shared->mesh->vertexCount();
}

glm::dvec4 MappedSurface::stored(std::size_t corner) const
{
    return moved(linear, shared->mesh->tangents[vertexOf(corner)]);
}

glm::dvec4 MappedSurface::generated(Frame frame, std::size_t corner) const
{
    const CornerTangents& made = shared->generated[std::size_t(frame)];
    return moved(linear, made.values[made.slots.of(corner, vertexOf(corner))]);
}

MappedSurface makeSurface(std::shared_ptr<const Mesh> mesh, const Texture& map, const glm::dmat3& linear,
                          const FrameSet& wanted)
{
    return placedBy({shareMesh(std::move(mesh), map, wanted)}, linear);
}

MappedSurface makeSurface(const Mesh& mesh, const Texture& map, const glm::dmat3& linear, const FrameSet& wanted)
{
    return makeSurface(copied(mesh), map, linear, wanted);
}

// The memory of generateTangents and splitSmoothCotangents, as measured in docs/explanation/speed.md.
SurfaceBytes surfaceBytes(std::size_t vertices, std::size_t triangles, const FrameSet& wanted)
{
    SurfaceBytes bytes{sizeof(glm::vec2) * vertices, 0};
    const auto add = [&](std::size_t value, std::size_t perVertex, std::size_t perTriangle) {
        bytes.kept += value * vertices;
        bytes.making = std::max(bytes.making, perVertex * vertices + perTriangle * triangles);
    };
    if (wanted[std::size_t(Frame::smooth)])
        add(2 * sizeof(glm::vec3), 18, 15);
    for (const FrameInfo& f : frames())
        if (wanted[std::size_t(f.frame)] && readsTangents(f.frame))
            add(sizeof(glm::vec4), 0, 80);
    return bytes;
}

MappedSurface makeCoatSurface(std::shared_ptr<const Mesh> mesh, const Texture& surfaceMap, const Texture& coatMap,
                              const FrameSet& wanted)
{
    auto shared = shareMesh(std::move(mesh), surfaceMap, wanted);
    std::vector<glm::vec2> uv = uvOfMap(*shared->mesh, coatMap);
    if (uv != shared->uv) {
        shared->uv = std::move(uv);
        shared->cotangents = {};
        shared->ofCoat = true;
    }
    return placedBy({std::move(shared)}, glm::dmat3(1));
}

MappedSurface placedBy(const MappedSurface& surface, const glm::dmat3& linear)
{
    const LinearMap<double> map(linear);
    return {surface.shared, map, map.planeMatrix()};
}

f64::cotan_frame frameAt(const MappedSurface& s, Frame frame, TangentOrigin tangents, std::size_t triangle,
                         glm::dvec3 barycentric)
{
    const SurfaceSpot spot = spotAt(s, triangle, barycentric);
    if (!s.hasUv())
        return {glm::dvec3(0), glm::dvec3(0), spot.normal};
    if (readsVertices(frame) && s.shared->ofCoat)
        return frameOf(spot, readsCotangents(frame) ? Frame::cotangent : Frame::orthonormal);
    if (readsVertices(frame))
        return frameOfVertices(s, frame, tangents, triangle, barycentric,
                               info(frame).normal == FrameNormal::nobody ? spot.interpolated : spot.normal);
    return frameOf(spot, frame);
}

SurfaceSpot spotAt(const MappedSurface& s, std::size_t triangle, glm::dvec3 barycentric)
{
    return spotOf(edgesOf(s, triangle), normalAt(s, triangle, barycentric));
}

SurfaceSpot spotOf(const TriangleEdges& edges, glm::dvec3 interpolated)
{
    const f64::cotan_differences d = f64::cotan_scale_differences(edges.p1, edges.p2, glm::dvec2(0), glm::dvec2(0));
    return {edges, interpolated, f64::cotan_safe_normal(interpolated, d.dpdx, d.dpdy)};
}

f64::cotan_frame frameOf(const SurfaceSpot& spot, Frame frame)
{
    const TriangleEdges& e = spot.edges;
    return evaluate(frame, spot.normal, e.p1, e.p2, e.uv1, e.uv2);
}

glm::dvec3 normalAt(const MappedSurface& s, std::size_t triangle, glm::dvec3 barycentric)
{
    return blended(triangle, barycentric, [&](std::size_t corner) { return s.normal(corner); });
}

glm::dvec2 uvAt(const MappedSurface& s, std::size_t triangle, glm::dvec3 barycentric)
{
    return blended(triangle, barycentric, [&](std::size_t corner) { return s.uv(corner); });
}

glm::dvec4 storedAt(const MappedSurface& s, std::size_t triangle, glm::dvec3 barycentric)
{
    return blended(triangle, barycentric, [&](std::size_t corner) { return s.stored(corner); });
}

glm::dvec4 tangentAt(const MappedSurface& s, Frame frame, TangentOrigin source, std::size_t triangle,
                     glm::dvec3 barycentric)
{
    if (source == TangentOrigin::stored && s.hasStored())
        return storedAt(s, triangle, barycentric);
    if (!s.hasGenerated(frame))
        return {0, 0, 0, 1};
    return blended(triangle, barycentric, [&](std::size_t corner) { return s.generated(frame, corner); });
}

TriangleEdges edgesOf(const MappedSurface& s, std::size_t triangle)
{
    const std::size_t a = 3 * triangle;
    const glm::dvec3 p0 = s.position(a);
    TriangleEdges e;
    e.p1 = s.position(a + 1) - p0;
    e.p2 = s.position(a + 2) - p0;
    if (!s.hasUv())
        return e;
    const glm::dvec2 uv0 = s.uv(a);
    e.uv1 = s.uv(a + 1) - uv0;
    e.uv2 = s.uv(a + 2) - uv0;
    return e;
}

UvRaster repeatedRaster(const MappedSurface& s, int width, int height)
{
    const UvTriangles triangles = s.hasUv() ? UvTriangles{s.shared->uv, s.shared->mesh->indices} : UvTriangles{};
    return UvRaster(triangles, width, height, {0, 0}, /*wrap*/ true);
}

double rowsUnder(const MappedSurface& s, int height)
{
    return s.hasUv() ? rowsUnder(UvTriangles{s.shared->uv, s.shared->mesh->indices}, height) : 0;
}

double areaOf(const TriangleEdges& e)
{
    const double area = glm::length(glm::cross(e.p1, e.p2)) / 2;
    return std::isfinite(area) ? area : 0;
}

double areaOf(const MappedSurface& s, std::size_t triangle) { return areaOf(edgesOf(s, triangle)); }

int orientationOf(const MappedSurface& s, std::size_t triangle)
{
    return s.hasUv() ? orientationOf(s, triangle, edgesOf(s, triangle)) : 0;
}

int orientationOf(const MappedSurface& s, std::size_t triangle, const TriangleEdges& e)
{
    const double area = -e.uvArea2(); // v runs down
    if (!s.hasUv() || !(area != 0))
        return 0;
    // The winding is judged from the side that the normals point to.
    const glm::dvec3 face = glm::cross(e.p1, e.p2);
    const std::size_t a = 3 * triangle;
    const double da = glm::dot(face, s.movedNormal(a)), db = glm::dot(face, s.movedNormal(a + 1)),
                 dc = glm::dot(face, s.movedNormal(a + 2));
    bool inside = da < 0 && db < 0 && dc < 0;
    if (!inside && !(da > 0 && db > 0 && dc > 0)) // they disagree
        inside = glm::dot(face, s.normal(a) + s.normal(a + 1) + s.normal(a + 2)) < 0;
    return (area > 0) != inside ? 1 : -1;
}

} // namespace cotan
