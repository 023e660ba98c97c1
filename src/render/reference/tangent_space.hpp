// Lighting in tangent space, as tutorials do it: vectors come to the map's normal, not it to them.
#pragma once

#include <array>
#include <optional>

#include "reference_light.hpp"
#include "surface.hpp"

namespace cotan::reference {

// Vectors along t, b, n of a pixel.
struct TangentSpace {
    f32::cotan_surface surface; // n: the texel; v: carried to tangent space
    f32::cotan_frame pixel{};   // in the pixel
    bool perVertex = false;     // carry at the corners, and interpolate
    std::array<f32::cotan_frame, 3> corners{};
    std::array<glm::vec3, 3> positions{}; // of the corners, relative to the eye
    std::array<double, 3> weights{};
};

// Nothing where the view lights in the world, where there is no normal map, and where what is asked
// for is missing: tangents at the vertices, or a frame that can be inverted.
// surface: in the world.
std::optional<TangentSpace> tangentSpaceOf(const SurfaceInputs& in, const SurfaceNormal& normal,
                                           const f32::cotan_surface& surface, const std::array<double, 3>& weights,
                                           bool orthographic);

// The unit vector to the light in tangent space. toLight: in the pixel, unit, in the world.
glm::vec3 carried(const TangentSpace& space, const PreparedLight& light, glm::vec3 toLight);

} // namespace cotan::reference
