// The normal maps of a detailed surface itself.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "bake/surface/low_surface.hpp"

namespace cotan {

// The normal maps of all instances of some scenes, read in the frame that they were made for.
class HighNormalMaps {
public:
    // scenes: those that the HighSurface was made from, in the same order; the images that are read are moved out of
    // them. frame: that the maps were made for; for `vertex` and `mikktspace` with the stored tangents, or generated
    // ones for a mesh without. An instance without a normal map or its uv keeps its smooth normals. Errors:
    // ErrorKind::input if no instance has a map and uv for it; ErrorKind::usage for a frame that depends on the view.
    static Result<HighNormalMaps> make(std::vector<Scene>& scenes, Frame frame);

    // The unit world-space normal at a point of a triangle, numbered as in Hit: the finest level of the map, filtered
    // as its sampler says, in the frame there. Returns `smooth`, the interpolated normal, if the instance has no map,
    // the triangle no area in uv, or the texel no direction (zero or not finite).
    glm::vec3 normalAt(std::uint32_t instance, std::uint32_t triangle, double b1, double b2, glm::vec3 smooth) const;

    std::size_t instanceCount() const { return parts_.size(); }
    std::size_t mappedCount() const { return mapped_; }

private:
    struct Part {           // one instance, with the index of Hit::instance
        LowSurface surface; // empty without a map
        const Image* image = nullptr;
        Sampler sampler;
        f64::cotan_normal_format format{};
    };
    std::deque<Image> images_; // a deque, because parts_ points into it
    std::vector<Part> parts_;
    std::size_t mapped_ = 0;
};

} // namespace cotan
