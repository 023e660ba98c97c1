// What a scene is at one point of a surface: texture coordinates, texel, and the frame there.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "bake/surface/mapped_surface.hpp"
#include "cotan/inspect.hpp"

namespace cotan::viewer {

struct Probed {
    glm::vec3 normal{0};        // world, as interpolated, unit
    glm::vec3 t{0}, b{0};       // of the frame, world; zero where there is none
    glm::vec3 storedTangent{0}; // world, unit, along +u; zero where the mesh has none
    int w = 0; // as glTF stores it: +1 where -b, up the picture, is along cross(n, t); -1; 0 without a frame
    bool hasUv = false;
    glm::vec2 uv{0};      // of the normal map
    glm::ivec2 texel{-1}; // of the normal map, from its top left corner; -1: there is none
};

// Keeps the surface of the mesh that was asked for last.
class Prober {
public:
    // The scene as it was loaded; `number`: another for another scene. What a frame reads at the vertices is derived
    // for the whole mesh where it is asked for first.
    Probed at(const Scene& scene, std::uint64_t number, const PickedPoint& hit, Frame frame, TangentOrigin tangents);

private:
    std::uint64_t number_ = 0;
    int instance_ = -1;
    MappedSurface surface_;
};

} // namespace cotan::viewer
