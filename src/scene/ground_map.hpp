// The shadow that a scene throws on a level plane, as both renderers read it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/packed_only.hpp"
#include "cotan/view.hpp"
#include "scene/environment_map.hpp"

namespace cotan {

// The share at a place, x and z in the world; 1 beyond the map.
inline float groundShareAt(const GroundMap& map, glm::vec2 place)
{
    const glm::vec2 uv = (place - map.low) / map.extent;
    if (!(uv.x > 0 && uv.y > 0 && uv.x < 1 && uv.y < 1))
        return 1;
    return readBilinear(map.shares, uv * glm::vec2(float(map.shares.width), float(map.shares.height))).x;
}

} // namespace cotan
