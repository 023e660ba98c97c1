// The node hierarchy, at rest or at a moment of an animation, and what hangs on it besides meshes.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "cotan/gltf.hpp"
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

// ---- animations -----------------------------------------------------------------------------

// Sets translation, rotation, scale and weights of the nodes that limits.pose moves; everything that is read from the
// structure afterwards follows. Nothing where no animation is asked for. The accessors must have been found. Times
// before the first and behind the last key of a channel give that key.
// Throws GltfProblem: ErrorKind::usage where the model has no such animation; damaged channels. Source: glTF 2.0,
// section 3.11 and appendix C.
void poseGltf(GltfModel& model);

// The animations of the file and how long they are. Never fails: what is damaged in one is said where it is asked for.
std::vector<GltfAnimation> gltfAnimations(GltfModel& model);

// As AnimatedGltf::reach, each time anew.
Result<std::vector<glm::vec3>> pointsReached(AnimatedGltf& model, const std::string& animation);

} // namespace cotan
