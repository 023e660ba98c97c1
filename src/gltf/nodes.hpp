// The node hierarchy, and what hangs on it besides meshes.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "cotan/scene.hpp"
#include "gltf_model.hpp"

namespace cotan {

struct GltfNodes {
    std::vector<glm::dmat4> world; // of every node, in the order of the file
    std::vector<int> visible;      // nodes of the scene that is shown, parents first
};

// Resolves the hierarchy. Cycles, nodes with two parents and transforms that are not affine or
// not finite are refused. The scene shown is the default one, else the first, else all roots.
GltfNodes readGltfNodes(GltfModel& model);

// Where the node's mesh stands: one matrix, or one for each instance of EXT_mesh_gpu_instancing.
std::vector<glm::mat4> gltfPlacements(GltfModel& model, const GltfNodes& nodes, int node);

// Lights and cameras of the visible nodes.
std::vector<Light> readGltfLights(const GltfModel& model, const GltfNodes& nodes);
std::vector<Camera> readGltfCameras(const GltfModel& model, const GltfNodes& nodes);

} // namespace cotan
