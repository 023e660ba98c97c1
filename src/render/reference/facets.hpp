// What a turned normal does to light on rays: classic normal mapping, and two facets that make a surface of it.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/portable.hpp"
#include "cotan/view.hpp"

namespace cotan::reference {

// Light from one direction, of that irradiance perpendicular to it.
struct ArrivingLight {
    glm::vec3 toLight{0};
    glm::vec3 irradiance{0};
};

// A point seen by rays. All in the world.
struct FacetPoint {
    f32::cotan_surface surface; // its n is the turned normal
    f32::cotan_gloss gloss;     // even highlights: anisotropy counts as 0
    glm::vec3 normal{0};        // not turned, unit, on the eye's side
    std::uint32_t seed = 0;     // of the random numbers
};

// Linear radiance towards the eye of what lights and, where the view has one, the environment give, by one of
// View::normalMapping's ways but `shading`: the mean of 64 walks. Emission is not in it.
// A direction to the eye below the surface counts as one along it.
glm::vec3 radianceByRays(const FacetPoint& point, const View& view, const std::vector<ArrivingLight>& lights);

} // namespace cotan::reference
