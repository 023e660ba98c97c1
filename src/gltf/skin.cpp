// Skins in their rest state.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "mesh.hpp"

namespace cotan {

namespace {

struct Blend {
    glm::dmat4 matrix{0};
    double weight = 0;
};

Blend blend(const GltfPrimitive& primitive, std::size_t vertex, const std::vector<glm::dmat4>& joints)
{
    Blend sum;
    for (std::size_t set = 0; set < primitive.joints.size(); ++set) {
        for (int k = 0; k < 4; ++k) {
            const double weight = primitive.weights[set][vertex][k];
            if (weight == 0)
                continue;
            const std::size_t joint = primitive.joints[set][vertex][k];
            if (joint >= joints.size())
                failGltf("{}.JOINTS_{}: vertex {} names joint {}, but the skin has {}", primitive.field, set, vertex,
                         joint, joints.size());
            sum.matrix += joints[joint] * weight;
            sum.weight += weight;
        }
    }
    return sum;
}

// The cofactor matrix is the inverse transpose times the determinant, so it gives the direction
// of a transformed normal even where the matrix has no inverse; the sign is put back.
glm::dvec3 turnNormal(const glm::dmat3& m, double determinant, const glm::vec3& n)
{
    const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const glm::dvec3 turned = cofactor * glm::dvec3(n) * (determinant < 0 ? -1.0 : 1.0);
    const double length = glm::length(turned);
    return length > 0 ? turned / length : glm::dvec3(0);
}

glm::vec4 turnTangent(const glm::dmat3& m, double determinant, const glm::vec4& t)
{
    const glm::dvec3 turned = m * glm::dvec3(t);
    const double length = glm::length(turned);
    return glm::vec4(length > 0 ? glm::vec3(turned / length) : glm::vec3(0), determinant < 0 ? -t.w : t.w);
}

} // namespace

void skinGltfPrimitive(GltfPrimitive& primitive, const std::vector<glm::dmat4>& joints, GltfWarnings& warnings)
{
    std::size_t mirrored = 0;
    std::size_t loose = 0;
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const Blend sum = blend(primitive, i, joints);
        if (!(std::abs(sum.weight) > 1e-6)) { // weights are parts of one: less is nothing
            ++loose;
            continue;
        }
        const glm::dmat4 matrix = sum.matrix / sum.weight;
        const glm::dmat3 linear(matrix);
        const double determinant = glm::determinant(linear);
        mirrored += determinant < 0;
        primitive.positions[i] = glm::vec3(matrix * glm::dvec4(primitive.positions[i], 1));
        if (!primitive.normals.empty())
            primitive.normals[i] = turnNormal(linear, determinant, primitive.normals[i]);
        if (!primitive.tangents.empty())
            primitive.tangents[i] = turnTangent(linear, determinant, primitive.tangents[i]);
    }
    if (mirrored == primitive.positions.size())
        for (std::size_t i = 0; i < primitive.triangles.size(); i += 3)
            std::swap(primitive.triangles[i + 1], primitive.triangles[i + 2]);
    if (loose > 0)
        warnings.add(primitive.field, "skinned without weights, left in place", loose, "vertices");
}

} // namespace cotan
