// The geometry of a glTF file as it stands in the world.
#pragma once

#include <vector>

#include <glm/mat3x3.hpp>

#include "cotan/gltf/edit.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan::app {

// The length of a collection of the root; 0 where it is missing.
inline std::size_t countOf(const nlohmann::ordered_json& root, const char* collection)
{
    return root.contains(collection) ? root[collection].size() : 0;
}

// For each mesh the linear maps under which nodes show it; of those that differ by rotations, mirroring
// and uniform scale only one, since all frames go along with these. The identity for a mesh that no node
// shows. root: as openGltfDocument has checked it.
std::vector<std::vector<glm::dmat3>> placings(const nlohmann::ordered_json& root);

// Makes normals unit. Those that are unit up to rounding keep their bits, which MikkTSpace's welding compares.
void makeUnit(std::vector<glm::vec3>& normals);

// The geometry as a mesh whose uv set 0 is what the normal map reads. Without NORMAL glTF asks for flat ones.
Mesh meshOf(GltfGeometry geometry);

} // namespace cotan::app
