// Small scenes for the tests of the baker.
#pragma once

#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene.hpp"

namespace cotan {

// From `corner` along two edges; uv fill the unit square, v down.
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

// One material, one instance of each mesh.
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
