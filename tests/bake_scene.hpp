// Small scenes for the tests of the baker.
#pragma once

#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene.hpp"

namespace cotan {

// A parallelogram from `corner` along two edges; uv fill the unit square.
inline Mesh rectangle(glm::vec3 corner, glm::vec3 along, glm::vec3 across)
{
    Mesh mesh;
    const glm::vec3 n = glm::normalize(glm::cross(along, across));
    for (const glm::vec2 c : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        mesh.positions.push_back(corner + along * c.x + across * c.y);
        mesh.normals.push_back(n);
        mesh.texcoords[0].emplace_back(c.x, 1 - c.y); // v down
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// `count` slightly different triangles in one plane, all of which contain (0.2, 0.2).
inline Mesh crowd(int count)
{
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const auto base = std::uint32_t(mesh.positions.size());
        const float more = 1e-4f * float(i);
        for (const glm::vec3 p : {glm::vec3(0, 0, 0), glm::vec3(1 + more, 0, 0), glm::vec3(0, 1 + more, 0)}) {
            mesh.positions.push_back(p);
            mesh.normals.push_back({0, 0, 1});
            mesh.texcoords[0].push_back({p.x / 2, p.y / 2});
        }
        mesh.indices.insert(mesh.indices.end(), {base, base + 1, base + 2});
    }
    return mesh;
}

// A scene with one material and one instance of each mesh.
inline Scene sceneOfMeshes(std::vector<Mesh> meshes)
{
    Scene scene;
    scene.name = "scene";
    scene.materials.emplace_back();
    for (std::size_t i = 0; i < meshes.size(); ++i)
        scene.instances.push_back({"", int(i), glm::mat4(1)});
    scene.meshes = std::move(meshes);
    return scene;
}

} // namespace cotan
