// Skins a primitive; checks and repairs its normals and tangents.
#include "gltf_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <glm/geometric.hpp>

#include "cotan/covector.hpp"
#include "cotan/tangents.hpp"
#include "cotan/vector.hpp"

namespace cotan {

namespace {

// Lengths within this distance of 1 count as unit: on a signed 8-bit grid, rounding changes a vector by up to
// sqrt(3)/2/127 = 0.0069.
constexpr float kUnitTolerance = 0.01f;

// ---- normals --------------------------------------------------------------------------------

void normalizeNormals(Mesh& mesh, const std::string& field, GltfWarnings& warnings)
{
    std::size_t zero = 0, odd = 0;
    for (glm::vec3& n : mesh.normals) {
        const double length = glm::length(glm::dvec3(n));
        zero += length == 0;
        odd += length > 0 && std::abs(length - 1) > kUnitTolerance;
        n = unitNormal(n);
    }
    warnings.add(field + ".NORMAL", "zero length, so the direction is unknown", zero, "vertices");
    warnings.add(field + ".NORMAL", "not of unit length; normalised", odd, "vertices");
}

// ---- tangents -------------------------------------------------------------------------------

void normalizeTangents(Mesh& mesh, const std::string& field, GltfWarnings& warnings)
{
    std::size_t zero = 0, odd = 0, signs = 0;
    for (glm::vec4& t : mesh.tangents) {
        const glm::dvec3 direction(t);
        const double length = glm::length(direction);
        zero += length == 0;
        const bool offUnit = length > 0 && std::abs(length - 1) > kUnitTolerance;
        odd += offUnit;
        if (offUnit)
            t = glm::vec4(unitOrZero(direction), t.w);
        signs += std::abs(std::abs(t.w) - 1) > kUnitTolerance;
        t.w = t.w < 0 ? -1.0f : 1.0f;
    }
    warnings.add(field + ".TANGENT", "zero length", zero, "vertices");
    warnings.add(field + ".TANGENT", "not of unit length; normalised", odd, "vertices");
    warnings.add(field + ".TANGENT", "w is not +-1; only its sign is used", signs, "vertices");
}

// Twice the signed area of a triangle in uv space.
float uvArea(const Mesh& mesh, const std::vector<glm::vec2>& uv, std::size_t first)
{
    const glm::vec2 a = uv[mesh.indices[first]];
    const glm::vec2 p = uv[mesh.indices[first + 1]] - a;
    const glm::vec2 q = uv[mesh.indices[first + 2]] - a;
    return p.x * q.y - p.y * q.x;
}

// The handedness implied by a triangle's uv, seen from the side that its normals point to. glTF's bitangent points
// against +v (v points down), so a triangle that is not mirrored, whose area in (u, v) is negative, has w = +1. 0:
// unknown, because the triangle has no area in uv or in space.
int handednessFromUv(const Mesh& mesh, const std::vector<glm::vec2>& uv, std::size_t first)
{
    const auto corner = [&](std::size_t k) { return mesh.indices[first + k]; };
    const glm::dvec3 a = mesh.positions[corner(0)];
    const glm::dvec3 face =
        glm::cross(glm::dvec3(mesh.positions[corner(1)]) - a, glm::dvec3(mesh.positions[corner(2)]) - a);
    const glm::vec3 n = mesh.normals[corner(0)] + mesh.normals[corner(1)] + mesh.normals[corner(2)];
    const double side = glm::dot(face, glm::dvec3(n));
    const float area = uvArea(mesh, uv, first);
    if (area == 0 || side == 0)
        return 0;
    return (area < 0) == (side > 0) ? 1 : -1;
}

void checkHandedness(const Mesh& mesh, const std::string& field, GltfWarnings& warnings)
{
    const std::vector<glm::vec2>& uv = mesh.texcoords[0];
    if (mesh.tangents.empty() || uv.empty())
        return;
    std::size_t known = 0, against = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const int expected = handednessFromUv(mesh, uv, i);
        float sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
            sum += mesh.tangents[mesh.indices[i + k]].w;
        known += expected != 0;
        against += expected != 0 && (sum > 0) != (expected > 0);
    }
    if (against * 2 > known)
        warnings.add(field, "TANGENT.w inverted: its sign contradicts the texture coordinates", against, "triangles");
}

void checkUvArea(const Mesh& mesh, int set, const std::string& field, GltfWarnings& warnings)
{
    const std::vector<glm::vec2>& uv = mesh.texcoords[std::size_t(set)];
    if (uv.empty())
        return;
    std::size_t flat = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        flat += uvArea(mesh, uv, i) == 0;
    warnings.add(field, "no area in the texture coordinates of the normal map: undefined frame", flat, "triangles");
}

// ---- skins ----------------------------------------------------------------------------------

struct Blend {
    glm::dmat4 matrix{0};
    double weight = 0;
};

Blend blend(const GltfPrimitive& primitive, std::size_t vertex, const std::vector<glm::dmat4>& joints)
{
    Blend sum;
    for (std::size_t set = 0; set < primitive.joints.size(); ++set)
        for (int k = 0; k < 4; ++k) {
            const double weight = primitive.weights[set][vertex][k];
            if (weight == 0)
                continue;
            const std::size_t joint = primitive.joints[set][vertex][k];
            if (joint >= joints.size())
                failGltf("{}.JOINTS_{}: vertex {} refers to joint {}, but the skin has {}", primitive.field, set,
                         vertex, joint, joints.size());
            sum.matrix += joints[joint] * weight;
            sum.weight += weight;
        }
    return sum;
}

} // namespace

glm::vec3 unitNormal(const glm::vec3& normal)
{
    constexpr double kRounding = 2e-6; // above float and six-decimal rounding; quantised normals differ by up to 0.007
    return std::abs(glm::length(glm::dvec3(normal)) - 1) > kRounding ? unitOrZero(normal) : normal;
}

void makeFlat(Mesh& mesh)
{
    const VertexSplit corners{std::move(mesh.indices), {}};
    const auto separate = [&](auto& values) { values = gathered(std::span(std::as_const(values)), corners); };
    separate(mesh.positions);
    separate(mesh.texcoords[0]);
    separate(mesh.texcoords[1]);
    separate(mesh.colors);
    mesh.indices.resize(corners.sources.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[i], b = mesh.positions[i + 1], c = mesh.positions[i + 2];
        const glm::vec3 n = unitOrZero(glm::cross(b - a, c - a));
        std::fill_n(mesh.normals.begin() + std::ptrdiff_t(i), 3, n);
    }
}

Mesh finishGltfMesh(GltfPrimitive&& source, int normalMapSet, GltfWarnings& warnings)
{
    Mesh mesh = std::move(source.mesh);
    for (const glm::vec3& p : mesh.positions)
        if (!isFinite(p))
            failGltf("{}: a position is beyond the range of float after morphing and skinning", source.field);
    if (mesh.normals.empty()) {
        warnings.add(source.field, "no NORMAL; flat normals are generated");
        makeFlat(mesh);
    } else {
        normalizeNormals(mesh, source.field, warnings);
    }
    normalizeTangents(mesh, source.field, warnings);
    if (normalMapSet == 0 || normalMapSet == 1)
        checkUvArea(mesh, normalMapSet, source.field, warnings);
    else // with a normal map, reconcileGreenWithTangents judges all its meshes together
        checkHandedness(mesh, source.field, warnings);
    return mesh;
}

void skinGltfPrimitive(GltfPrimitive& primitive, const std::vector<glm::dmat4>& joints, GltfWarnings& warnings)
{
    Mesh& mesh = primitive.mesh;
    std::size_t mirrored = 0, loose = 0;
    Mesh bind;
    bind.bindPositions = mesh.positions;
    for (const glm::vec3& n : mesh.normals)
        bind.bindNormals.push_back(unitOrZero(glm::dvec3(n)));
    for (int k = 0; k < 3; ++k)
        bind.skin[std::size_t(k)].assign(mesh.positions.size(), glm::mat3(1)[k]);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Blend sum = blend(primitive, i, joints);
        if (!(std::abs(sum.weight) > 1e-6)) { // weights are fractions of one; smaller sums are zero
            ++loose;
            continue;
        }
        const glm::dmat4 matrix = sum.matrix / sum.weight;
        const glm::dmat3 linear(matrix);
        const LinearMap<double> map(linear);
        const bool mirrors = map.determinant() < 0;
        mirrored += mirrors;
        for (int k = 0; k < 3; ++k)
            bind.skin[std::size_t(k)][i] = glm::vec3(linear[k]);
        mesh.positions[i] = glm::vec3(matrix * glm::dvec4(mesh.positions[i], 1));
        if (!mesh.normals.empty())
            mesh.normals[i] = unitOrZero(map.planeMatrix() * glm::dvec3(mesh.normals[i]));
        if (!mesh.tangents.empty()) {
            const glm::vec4 t = mesh.tangents[i];
            mesh.tangents[i] = glm::vec4(unitOrZero(linear * glm::dvec3(t)), mirrors ? -t.w : t.w);
        }
    }
    if (mirrored == 0 && !mesh.normals.empty()) { // mirrored parts: vectors are made from the moved mesh
        mesh.bindPositions = std::move(bind.bindPositions);
        mesh.bindNormals = std::move(bind.bindNormals);
        mesh.skin = std::move(bind.skin);
    }
    if (mirrored == mesh.positions.size())
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    warnings.add(primitive.field, "skinned without weights; not moved", loose, "vertices");
}

} // namespace cotan
