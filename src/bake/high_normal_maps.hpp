// The normal maps that a detailed surface has itself.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "bake/surface/low_surface.hpp"

namespace cotan {

// The maps of all instances of some scenes, read in the frame that they were made for.
class HighNormalMaps {
public:
    // scenes: those that the HighSurface was made of, in the same order; the images that are read are moved out of
    // them. frame: that the maps were made for; tangents for `vertex` and `mikktspace` are the stored ones, generated
    // where a mesh has none. An instance without a normal map, or without its uv, keeps its smooth normals.
    // Errors: ErrorKind::input where no instance has a map and uv for it; ErrorKind::usage for a frame that depends
    // on the view.
    static Result<HighNormalMaps> make(std::vector<Scene>& scenes, Frame frame);

    // The unit normal, world, at a place of a triangle, numbered as by Hit: the finest level of the map there, filtered
    // as its sampler says, in the frame there. `smooth`, the interpolated normal, where the instance has no map, the
    // triangle no area in uv, or the texel no direction (zero or not finite).
    glm::vec3 normalAt(std::uint32_t instance, std::uint32_t triangle, double b1, double b2, glm::vec3 smooth) const;

    std::size_t instanceCount() const { return parts_.size(); }
    std::size_t mappedCount() const { return mapped_; }

private:
    struct Part {           // one instance, numbered as Hit::instance
        LowSurface surface; // empty where there is no map
        const Image* image = nullptr;
        Sampler sampler;
        f64::cotan_normal_format format{};
    };
    std::deque<Image> images_; // a deque, since the parts point into it
    std::vector<Part> parts_;
    std::size_t mapped_ = 0;
};

} // namespace cotan
