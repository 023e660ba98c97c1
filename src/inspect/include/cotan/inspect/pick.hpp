// What of a scene is at a pixel.
#pragma once

#include <cstddef>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene/scene.hpp"

namespace cotan {

struct Picked {
    int instance = 0, mesh = 0; // indices into the scene
    std::size_t triangle = 0;   // of the mesh
    glm::dvec3 barycentric{1, 0, 0};
    glm::vec3 position{0}; // world
    float depth = 0;       // along the view, world units
};

// The nearest triangle that the camera sees at a place of a picture of that size, in pixels from its top left corner;
// the middle of the first pixel is (0.5, 0.5). Back faces of single-sided materials are not seen; what a mask cuts out
// is. Looks at every triangle: 100,000 take a millisecond.
std::optional<Picked> pick(const Scene& scene, const Camera& camera, glm::ivec2 size, glm::vec2 place);

} // namespace cotan
