// Values of a scene at one surface point: texture coordinates, texel and frame.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "bake/surface/mapped_surface.hpp"
#include "cotan/inspect.hpp"

namespace cotan::viewer {

struct Probed {
    glm::vec3 normal{0};        // world space, interpolated, unit
    glm::vec3 t{0}, b{0};       // of the frame, world space; zero if there is none
    glm::vec3 storedTangent{0}; // world space, unit, along +u; zero if the mesh has none
    int w = 0; // sign as in glTF: +1 if -b, up in the image, is along cross(n, t); else -1; 0 without a frame
    bool hasUv = false;
    glm::vec2 uv{0};      // of the normal map
    glm::ivec2 texel{-1}; // of the normal map, from its top left corner; -1: none
};

// Caches the surface of the last mesh requested.
class Prober {
public:
    // scene: as loaded; number: identifies the scene. Vertex attributes of a frame are derived for the whole mesh when
    // first needed.
    Probed at(const Scene& scene, std::uint64_t number, const PickedPoint& hit, Frame frame, TangentOrigin tangents);

private:
    std::uint64_t number_ = 0;
    int instance_ = -1;
    MappedSurface surface_;
};

} // namespace cotan::viewer
