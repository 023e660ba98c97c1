// The geometry of a glTF file as it stands in the world.
#pragma once

#include <vector>

#include <glm/mat3x3.hpp>

#include "cotan/gltf.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// For each mesh the linear maps under which nodes show it; of those that differ by rotations, mirroring
// and uniform scale only one, since all frames go along with these. The identity for a mesh that no node
// shows. root: as openGltfDocument has checked it.
std::vector<std::vector<glm::dmat3>> gltfPlacings(const nlohmann::ordered_json& root);

// Makes normals unit; those of length 0 stay so. Those that are unit up to rounding keep their bits, which MikkTSpace's
// welding compares.
void makeUnit(std::vector<glm::vec3>& normals);

// The geometry as a mesh whose uv set 0 is what the normal map reads, with unit normals. Without NORMAL each triangle
// gets vertices of its own with its flat normal, as glTF asks; zero where it has no area.
Mesh gltfMesh(GltfGeometry geometry);

} // namespace cotan
