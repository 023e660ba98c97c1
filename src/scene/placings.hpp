// In how many different ways a mesh stands in the world, as far as frames can tell.
#pragma once

#include <vector>

#include <glm/mat3x3.hpp>

#include "cotan/packed_only.hpp"

namespace cotan {

// Whether two linear maps differ by a rotation, a mirroring and a uniform scale only: all frames go along
// with these, so that one surface stands for both.
bool alikeForFrames(const glm::dmat3& a, const glm::dmat3& b);

// Adds a linear map to those that are known, unless one of them is alike.
void addPlacing(std::vector<glm::dmat3>& known, const glm::dmat3& linear);

// Gives each mesh that nothing shows the identity: it is looked at as it stands.
void placeUnshown(std::vector<std::vector<glm::dmat3>>& placings);

} // namespace cotan
