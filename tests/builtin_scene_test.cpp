// The scene that is drawn if no model is given: what it must contain, whatever it looks like.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include <glm/geometric.hpp>

#include "cotan/scene.hpp"
#include "scene/geometry.hpp"

namespace cotan {
namespace {

using Corners = std::array<std::uint32_t, 3>;

void eachTriangle(const Mesh& mesh, const std::function<void(const Corners&)>& work)
{
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        work({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
}

double signedUvArea(const Mesh& mesh, const Corners& c)
{
    const glm::dvec2 t(mesh.texcoords[0][c[0]]);
    const glm::dvec2 a = glm::dvec2(mesh.texcoords[0][c[1]]) - t, b = glm::dvec2(mesh.texcoords[0][c[2]]) - t;
    return a.x * b.y - a.y * b.x;
}

TEST(BuiltinScene, storesNoTangents)
{
    for (const Mesh& mesh : builtinScene().meshes) {
        EXPECT_TRUE(mesh.tangents.empty());
        EXPECT_TRUE(mesh.cotangentsU.empty());
    }
}

TEST(BuiltinScene, isConsistent)
{
    const Scene scene = builtinScene();
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    EXPECT_NEAR(glm::length(scene.lights[0].direction), 1, 1e-6);
    ASSERT_EQ(scene.cameras.size(), 1u);
    ASSERT_FALSE(scene.instances.empty());
    for (const Instance& instance : scene.instances)
        ASSERT_LT(std::size_t(instance.mesh), scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(std::size_t(mesh.material), scene.materials.size());
        const Material& material = scene.materials[std::size_t(mesh.material)];
        ASSERT_LT(std::size_t(material.normalMap.image), scene.images.size()) << material.name;
        EXPECT_TRUE(material.normalFormat.greenUp) << material.name;
    }
}

TEST(BuiltinScene, itsLowestPointIsOnTheGround)
{
    const Scene scene = builtinScene();
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& p : scene.meshes[std::size_t(instance.mesh)].positions)
            ASSERT_GE((instance.toWorld * glm::vec4(p, 1)).y, -1e-6f) << instance.name;
    EXPECT_NEAR(bounds(scene).low.y, 0, 1e-6);
}

// The changes of position per unit of u and of v on a triangle.
std::pair<glm::vec3, glm::vec3> texelAxes(const Mesh& mesh, const Corners& c)
{
    const glm::vec3 p = mesh.positions[c[1]] - mesh.positions[c[0]], q = mesh.positions[c[2]] - mesh.positions[c[0]];
    const glm::vec2 a = mesh.texcoords[0][c[1]] - mesh.texcoords[0][c[0]],
                    b = mesh.texcoords[0][c[2]] - mesh.texcoords[0][c[0]];
    const float area = a.x * b.y - a.y * b.x;
    return {(p * b.y - q * a.y) / area, (q * a.x - p * b.x) / area};
}

TEST(BuiltinScene, hasStretchedShearedAndCompressedTexcoords)
{
    const Scene scene = builtinScene();
    float body = 0, tip = 1e9f; // square roots of the area of a unit square of uv
    int panels = 0;
    for (const Mesh& mesh : scene.meshes)
        eachTriangle(mesh, [&](const Corners& c) {
            if (std::abs(signedUvArea(mesh, c)) < 1e-9)
                return;
            const auto [u, v] = texelAxes(mesh, c);
            if (mesh.name == "patch") {
                EXPECT_GT(glm::length(u) / glm::length(v), 1.5f);
                EXPECT_GT(std::abs(glm::dot(u, v)) / (glm::length(u) * glm::length(v)), 0.4f);
                ++panels;
            }
            if (mesh.name != "teapot")
                return;
            const float size = std::sqrt(glm::length(glm::cross(u, v)));
            const bool spout = mesh.positions[c[0]].x > 1.05f;
            (spout ? tip : body) = spout ? std::min(tip, size) : std::max(body, size);
        });
    EXPECT_GT(panels, 0);
    EXPECT_LT(tip, body / 4);
}

TEST(BuiltinScene, hasMirroredAndUnmirroredTexcoords)
{
    const Scene scene = builtinScene();
    int mirrored = 0, plain = 0;
    for (const Mesh& mesh : scene.meshes)
        if (mesh.name == "sphere")
            eachTriangle(mesh, [&](const Corners& c) { ++(signedUvArea(mesh, c) > 0 ? mirrored : plain); });
    EXPECT_GT(mirrored, 0);
    EXPECT_EQ(mirrored, plain);
}

} // namespace
} // namespace cotan
