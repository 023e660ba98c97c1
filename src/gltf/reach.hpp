// Where a model gets to in an animation.
#pragma once

#include "cotan/gltf.hpp"

namespace cotan {

// As AnimatedGltf::reach, each time anew.
Result<std::vector<glm::vec3>> pointsReached(AnimatedGltf& model, const std::string& animation);

} // namespace cotan
