// Skins in their rest state.
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/covector.hpp"
#include "cotan/vector.hpp"
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
        const LinearMap<double> map(linear);
        const bool mirrors = map.determinant() < 0;
        mirrored += mirrors;
        primitive.positions[i] = glm::vec3(matrix * glm::dvec4(primitive.positions[i], 1));
        if (!primitive.normals.empty())
            primitive.normals[i] = unitOrZero(map.planeMatrix() * glm::dvec3(primitive.normals[i]));
        if (!primitive.tangents.empty()) {
            const glm::vec4 t = primitive.tangents[i];
            primitive.tangents[i] = glm::vec4(unitOrZero(linear * glm::dvec3(t)), mirrors ? -t.w : t.w);
        }
    }
    if (mirrored == primitive.positions.size())
        for (std::size_t i = 0; i < primitive.triangles.size(); i += 3)
            std::swap(primitive.triangles[i + 1], primitive.triangles[i + 2]);
    if (loose > 0)
        warnings.add(primitive.field, "skinned without weights, left in place", loose, "vertices");
}

} // namespace cotan
