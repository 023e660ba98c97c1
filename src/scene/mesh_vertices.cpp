// Vertex attributes of meshes: generating normals, welding vertices, deriving frames.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/groups.hpp"
#include "core/tangents_mesh.hpp"
#include "cotan/covector.hpp"
#include "cotan/tangents.hpp"
#include "cotan/vector.hpp"
#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

using Index = std::uint32_t;
constexpr Index kNone = ~Index(0);

// Calls work with each non-empty per-vertex array of the mesh.
template<class M, class Work> void eachAttribute(M& mesh, const Work& work)
{
    const auto call = [&](auto& attribute) {
        if (!attribute.empty())
            work(attribute);
    };
    std::apply([&](auto&... attributes) { (call(attributes), ...); }, attributesOf(mesh));
}

// Replaces vertex i by the old vertex split.sources[i].
void takeVertices(Mesh& mesh, const VertexSplit& split)
{
    eachAttribute(mesh, [&](auto& attribute) { attribute = gathered(std::span(std::as_const(attribute)), split); });
}

// ---- normals --------------------------------------------------------------------------------

// Numbers the distinct positions: vertices at equal positions get equal numbers. Sorting keeps it fast for any input.
std::vector<Index> positionNumbers(const std::vector<glm::vec3>& positions)
{
    // Bit patterns order all floats, even NaN; adding zero turns -0 into 0.
    const auto key = [&](Index i) { return std::bit_cast<std::array<std::uint32_t, 3>>(positions[i] + 0.0f); };
    std::vector<Index> order(positions.size());
    std::iota(order.begin(), order.end(), Index(0));
    std::ranges::sort(order, [&](Index a, Index b) { return key(a) < key(b); });
    std::vector<Index> number(positions.size());
    Index current = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i]) != key(order[i - 1]))
            ++current;
        number[order[i]] = current;
    }
    return number;
}

struct Face {
    glm::dvec3 normal{0};          // unit; zero for a degenerate triangle
    std::array<double, 3> angle{}; // at each corner, radians
    bool usable() const { return normal != glm::dvec3(0); }
};

std::vector<Face> measureFaces(const Mesh& mesh)
{
    std::vector<Face> faces(mesh.triangleCount());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const std::array<glm::dvec3, 3> p = {glm::dvec3(mesh.positions[mesh.indices[3 * f]]),
                                             glm::dvec3(mesh.positions[mesh.indices[3 * f + 1]]),
                                             glm::dvec3(mesh.positions[mesh.indices[3 * f + 2]])};
        const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(cross);
        if (!(length > 0) || !std::isfinite(length))
            continue;
        faces[f].normal = cross / length;
        for (std::size_t c = 0; c < 3; ++c)
            faces[f].angle[c] = angleBetween(p[(c + 1) % 3] - p[c], p[(c + 2) % 3] - p[c]);
    }
    return faces;
}

// A triangle's edge between two points (by number), and the triangle's corners at the lower and the higher one.
struct Edge {
    Index low, high;
    Index cornerAtLow, cornerAtHigh;
};

std::vector<Edge> sortedEdges(const std::vector<Index>& pointOfCorner)
{
    std::vector<Edge> edges;
    edges.reserve(pointOfCorner.size());
    for (Index corner = 0; corner < pointOfCorner.size(); ++corner) {
        const Index next = corner % 3 == 2 ? corner - 2 : corner + 1;
        Edge edge{pointOfCorner[corner], pointOfCorner[next], corner, next};
        if (edge.low > edge.high) {
            std::swap(edge.low, edge.high);
            std::swap(edge.cornerAtLow, edge.cornerAtHigh);
        }
        edges.push_back(edge);
    }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.low, e.high, e.cornerAtLow); });
    return edges;
}

// Joins the corners of triangles that meet at an edge within the crease angle.
void joinAcrossEdges(JoinedGroups& groups, const std::vector<Index>& pointOfCorner, const std::vector<Face>& faces,
                     double minimumCosine)
{
    const std::vector<Edge> edges = sortedEdges(pointOfCorner);
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const Edge& a = edges[i - 1];
        const Edge& b = edges[i];
        if (a.low != b.low || a.high != b.high)
            continue;
        const Face& faceA = faces[a.cornerAtLow / 3];
        const Face& faceB = faces[b.cornerAtLow / 3];
        if (!faceA.usable() || !faceB.usable() || glm::dot(faceA.normal, faceB.normal) < minimumCosine)
            continue;
        groups.join(a.cornerAtLow, b.cornerAtLow);
        groups.join(a.cornerAtHigh, b.cornerAtHigh);
    }
}

void joinAtPoints(JoinedGroups& groups, const std::vector<Index>& pointOfCorner, std::size_t points,
                  const std::vector<Face>& faces)
{
    std::vector<Index> first(points, kNone);
    for (Index corner = 0; corner < pointOfCorner.size(); ++corner) {
        if (!faces[corner / 3].usable())
            continue;
        Index& at = first[pointOfCorner[corner]];
        if (at == kNone)
            at = corner;
        else
            groups.join(at, corner);
    }
}

// Returns one normal per group, stored at the group's first corner. Corners of degenerate triangles, which are groups
// of their own, take the normal of another corner at the same point.
std::vector<glm::vec3> groupNormals(JoinedGroups& groups, const std::vector<Index>& pointOfCorner, std::size_t points,
                                    const std::vector<Face>& faces)
{
    std::vector<glm::dvec3> sums(pointOfCorner.size(), glm::dvec3(0));
    for (Index corner = 0; corner < pointOfCorner.size(); ++corner)
        sums[groups.find(corner)] += faces[corner / 3].normal * faces[corner / 3].angle[corner % 3];

    std::vector<glm::vec3> normals(pointOfCorner.size(), glm::vec3(0));
    std::vector<glm::vec3> any(points, glm::vec3(0, 0, 1));
    for (Index corner = 0; corner < pointOfCorner.size(); ++corner) {
        const Face& face = faces[corner / 3];
        if (groups.find(corner) != corner || !face.usable())
            continue;
        // Back-to-back faces cancel out: use the normal of one of them.
        const double length = glm::length(sums[corner]);
        normals[corner] = glm::vec3(length > 1e-9 ? sums[corner] / length : face.normal);
        any[pointOfCorner[corner]] = normals[corner];
    }
    for (Index corner = 0; corner < pointOfCorner.size(); ++corner)
        if (!faces[corner / 3].usable())
            normals[corner] = any[pointOfCorner[corner]];
    return normals;
}

// Gives every corner a vertex with the corner's normal, splitting vertices as needed.
void assignNormals(Mesh& mesh, JoinedGroups& groups, const std::vector<glm::vec3>& normals)
{
    std::vector<Index> groupOfVertex(mesh.vertexCount(), kNone);
    std::map<std::pair<Index, Index>, Index> splits; // (vertex, group) to the new vertex
    mesh.normals.assign(mesh.vertexCount(), glm::vec3(0, 0, 1));
    for (Index corner = 0; corner < mesh.indices.size(); ++corner) {
        const Index vertex = mesh.indices[corner];
        const Index group = groups.find(corner);
        if (groupOfVertex[vertex] == kNone) {
            groupOfVertex[vertex] = group;
            mesh.normals[vertex] = normals[group];
        } else if (groupOfVertex[vertex] != group && mesh.normals[vertex] != normals[group]) {
            const auto [found, isNew] = splits.try_emplace({vertex, group}, 0);
            if (isNew) {
                found->second = Index(mesh.vertexCount());
                eachAttribute(mesh, [vertex](auto& attribute) { attribute.push_back(attribute[vertex]); });
                mesh.normals[found->second] = normals[group];
            }
            mesh.indices[corner] = found->second;
        }
    }
}

// ---- equal vertices --------------------------------------------------------------------------

// The bits of all attributes of a vertex; zeros at the end if the mesh lacks arrays.
std::array<std::uint32_t, 40> bitsOf(const Mesh& mesh, Index vertex)
{
    std::array<std::uint32_t, 40> bits{};
    std::size_t at = 0;
    eachAttribute(mesh, [&](const auto& attribute) {
        const auto& value = attribute[vertex];
        for (int c = 0; c < value.length(); ++c)
            bits[at++] = std::bit_cast<std::uint32_t>(value[c]);
    });
    return bits;
}

// ---- frames ----------------------------------------------------------------------------------

void deriveCotangents(Mesh& mesh, std::span<const glm::vec2> uv)
{
    SplitCotangents made = splitSmoothCotangents(bindView(mesh, uv));
    takeVertices(mesh, made.split);
    mesh.indices = std::move(made.split.indices);
    mesh.cotangentsU = std::move(made.cotangents.u);
    mesh.cotangentsV = std::move(made.cotangents.v);
    for (auto* const vectors : {&mesh.cotangentsU, &mesh.cotangentsV})
        for (std::size_t i = 0; i < vectors->size(); ++i)
            (*vectors)[i] = skinnedCotangent(mesh, i, (*vectors)[i]);
}

void deriveTangents(Mesh& mesh, std::span<const glm::vec2> uv, Frame frame)
{
    const auto corners = generateTangents(frame, bindView(mesh, uv));
    const VertexSplit split = splitVertices(mesh.vertexCount(), mesh.indices, corners);
    mesh.tangents.clear();
    takeVertices(mesh, split);
    mesh.indices = split.indices;
    mesh.tangents.resize(mesh.vertexCount());
    for (std::size_t i = 0; i < corners.size(); ++i)
        mesh.tangents[mesh.indices[i]] = skinned(mesh, mesh.indices[i], corners[i]);
}

LinearMap<double> skinAt(const Mesh& mesh, std::size_t vertex)
{
    const auto& [x, y, z] = mesh.skin;
    return LinearMap<double>(glm::dmat3(x[vertex], y[vertex], z[vertex]));
}

} // namespace

MeshView bindView(const Mesh& mesh, std::span<const glm::vec2> uv)
{
    if (mesh.skin[0].empty())
        return {mesh.positions, mesh.normals, uv, mesh.indices};
    return {mesh.bindPositions, mesh.bindNormals, uv, mesh.indices};
}

glm::vec4 skinned(const Mesh& mesh, std::size_t vertex, glm::vec4 tangent)
{
    if (mesh.skin[0].empty())
        return tangent;
    return {unitOrZero(skinAt(mesh, vertex)(Vector3d(glm::dvec3(tangent))).raw()), tangent.w};
}

glm::vec3 skinnedCotangent(const Mesh& mesh, std::size_t vertex, glm::vec3 cotangent)
{
    return mesh.skin[0].empty() ? cotangent : glm::vec3(skinAt(mesh, vertex)(Covector3d(glm::dvec3(cotangent))).raw());
}

void generateNormals(Mesh& mesh, float creaseDegrees)
{
    const std::vector<Index> point = positionNumbers(mesh.positions);
    std::vector<Index> pointOfCorner(mesh.indices.size());
    std::ranges::transform(mesh.indices, pointOfCorner.begin(), [&](Index i) { return point[i]; });
    const std::vector<Face> faces = measureFaces(mesh);

    JoinedGroups groups(mesh.indices.size());
    if (creaseDegrees >= 180)
        joinAtPoints(groups, pointOfCorner, mesh.vertexCount(), faces);
    else // slightly wider, so that faces at exactly this angle are smoothed
        joinAcrossEdges(groups, pointOfCorner, faces,
                        std::cos(double(creaseDegrees) * 3.14159265358979323846 / 180) - 1e-6);

    const auto normals = groupNormals(groups, pointOfCorner, mesh.vertexCount(), faces);
    assignNormals(mesh, groups, normals);
}

void weldVertices(Mesh& mesh)
{
    const auto first = tangents::firstEqual(Index(mesh.vertexCount()), [&](Index i) { return bitsOf(mesh, i); });
    std::vector<Index> newIndex(mesh.vertexCount(), kNone); // indexed by the first of equal vertices
    VertexSplit kept;
    for (Index& index : mesh.indices) {
        Index& number = newIndex[first[index]];
        if (number == kNone) {
            number = Index(kept.sources.size());
            kept.sources.push_back(index);
        }
        index = number;
    }
    takeVertices(mesh, kept);
}

// dP/du' = (vRow.y dP/du - vRow.x dP/dv) / determinant. Where v' does not depend on u, only its sign can change;
// otherwise its direction depends on the lengths of dP/du and dP/dv.
void transformTangents(std::vector<glm::vec4>& tangents, const MeshView& mesh, glm::dvec2 uRow, glm::dvec2 vRow)
{
    const double determinant = uRow.x * vRow.y - uRow.y * vRow.x;
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant) || tangents.size() != mesh.positions.size()
        || mesh.normals.size() != tangents.size() || mesh.texcoords.size() != tangents.size())
        return;
    // For each vertex: dP/du' in the basis of dP/du and n x dP/du, times area.
    std::vector<glm::dvec2> turned(vRow.x != 0 ? tangents.size() : 0, glm::dvec2(0));
    for (std::size_t i = 0; !turned.empty() && i + 2 < mesh.indices.size(); i += 3) {
        const Index* const at = &mesh.indices[i];
        const glm::dvec3 p0(mesh.positions[at[0]]), p1 = glm::dvec3(mesh.positions[at[1]]) - p0,
                                                    p2 = glm::dvec3(mesh.positions[at[2]]) - p0;
        const glm::dvec2 uv0(mesh.texcoords[at[0]]), uv1 = glm::dvec2(mesh.texcoords[at[1]]) - uv0,
                                                     uv2 = glm::dvec2(mesh.texcoords[at[2]]) - uv0;
        const double uvArea = uv1.x * uv2.y - uv1.y * uv2.x;
        const glm::dvec3 alongU = (p1 * uv2.y - p2 * uv1.y) / uvArea, alongV = (p2 * uv1.x - p1 * uv2.x) / uvArea;
        const double length = glm::length(alongU);
        const glm::dvec3 face = glm::cross(p1, p2);
        if (!(length > 0) || !std::isfinite(length) || !isFinite(alongV))
            continue;
        const double v = glm::dot(alongU, alongV) / length; // of dP/dv along dP/du, and across it
        const double across = glm::length(glm::cross(alongU, alongV)) / length * (uvArea < 0 ? -1 : 1);
        for (std::size_t k = 0; k < 3; ++k) {
            const double side = glm::dot(face, glm::dvec3(mesh.normals[at[k]])) < 0 ? -1 : 1;
            turned[at[k]] +=
                glm::length(face) / determinant * glm::dvec2(vRow.y * length - vRow.x * v, -vRow.x * across * side);
        }
    }
    const double sign = determinant < 0 ? -1 : 1;
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        glm::vec4& t = tangents[i];
        if (turned.empty()) {
            t = glm::vec4(glm::vec3(t) * float(vRow.y * sign < 0 ? -1 : 1), t.w * float(sign));
            continue;
        }
        const double length = glm::length(turned[i]);
        if (!(length > 0) || !std::isfinite(length))
            continue;
        const glm::dvec3 along(t), across = glm::cross(glm::dvec3(unitOrZero(glm::dvec3(mesh.normals[i]))), along);
        t = glm::vec4(glm::vec3((along * turned[i].x + across * turned[i].y) / length), t.w * float(sign));
    }
}

namespace {

void deriveVertexFrames(const Scene& scene, Mesh& mesh, Frame frame, TangentOrigin tangents)
{
    if (!readsVertices(frame))
        return;
    const std::vector<glm::vec2> uv = textureUv(frameTexture(scene.materials[std::size_t(mesh.material)]), mesh);
    if (uv.empty() || mesh.indices.empty())
        return;
    if (readsCotangents(frame))
        deriveCotangents(mesh, uv);
    else if (tangents == TangentOrigin::generated || mesh.tangents.empty())
        deriveTangents(mesh, uv, frame);
}

} // namespace

void deriveVertexFrames(Scene& scene, std::optional<Frame> frame, TangentOrigin tangents)
{
    for (Mesh& mesh : scene.meshes)
        if (frame || mesh.readWith)
            deriveVertexFrames(scene, mesh, frame ? *frame : *mesh.readWith, tangents);
}

} // namespace cotan
