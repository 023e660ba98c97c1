// The shadow that a scene throws on a level plane, as both renderers read it.
#pragma once

#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/packed_only.hpp"
#include "cotan/scene/environment.hpp"

namespace cotan {

struct GroundMap {
    float height = 0;    // of the plane, world y
    glm::vec2 low{0};    // x and z of the rectangle that the picture covers; beyond it there is no shadow
    glm::vec2 extent{1}; // of it, world units
    Image shares;        // float32, values that a half holds: x, the share of its light that a place gets; z runs down
};

// The share at a place, x and z in the world; 1 beyond the map.
inline float groundShareAt(const GroundMap& map, glm::vec2 place)
{
    const glm::vec2 uv = (place - map.low) / map.extent;
    if (!(uv.x > 0 && uv.y > 0 && uv.x < 1 && uv.y < 1))
        return 1;
    return readBilinear(map.shares, uv * glm::vec2(float(map.shares.width), float(map.shares.height))).x;
}

} // namespace cotan
