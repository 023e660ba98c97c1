// A model at a moment of one of its animations, and where it gets to.
#pragma once

#include <vector>

#include "cotan/gltf.hpp"
#include "gltf_model.hpp"

namespace cotan {

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
