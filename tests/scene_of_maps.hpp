// Scenes to lint: several normal maps, each with its own material and mesh.
#pragma once

#include <string>
#include <utility>

#include "cotan/scene.hpp"

namespace cotan::test {

// Adds a plane with this normal map.
inline void addPlaneWith(Image map, std::string name, Scene& scene)
{
    scene.images.push_back(std::move(map));
    scene.images.back().name = std::move(name);
    scene.materials.emplace_back().normalMap.image = int(scene.images.size()) - 1;
    Mesh mesh = makePlane(1, 1, 1);
    mesh.material = int(scene.materials.size()) - 1;
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"", int(scene.meshes.size()) - 1, glm::mat4(1)});
}

} // namespace cotan::test
