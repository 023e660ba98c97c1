// Texture reads as on a GPU, with mip chains.
#pragma once

#include <deque>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "cotan/view.hpp"

namespace cotan::reference {

enum class Content {
    color,  // sRGB (float images are already linear), linear alpha
    linear, // numbers
    normal, // encoded as the normal format states
};

// Level 0 is the scene's image itself; each further level has half the size, rounded down, to 1x1. Levels have the
// pixel type of the image, so that 8-bit maps stay small.
struct MipChain {
    const Image* image = nullptr;
    Content content = Content::linear;
    std::vector<Image> smaller;
    float footprintScale = 1; // distance between samples in pixels; scales the footprint

    int levels() const { return 1 + int(smaller.size()); }
    const Image& level(int i) const { return i == 0 ? *image : smaller[std::size_t(i - 1)]; }
};

// Texture coordinates in a pixel, and their differences to the next pixel in x and y.
struct UvDifferences {
    glm::vec2 uv{0};
    glm::vec2 dx{0};
    glm::vec2 dy{0};
};

// Samples a texture: wrapped, filtered, from the level that the differences determine (OpenGL 4.6, section 8.14).
// Elongated footprints are read by up to eight probes along their longer axis. Coordinates that are not finite are
// taken as 0. pointSampled: the nearest texel of level 0, regardless of the sampler's filters.
glm::vec4 sample(const MipChain& chain, const Sampler& sampler, const UvDifferences& at, bool pointSampled);

// The mip chains of one material; null if the material has no such map or its image is unusable.
struct MaterialMaps {
    const MipChain* baseColor = nullptr;
    const MipChain* metallicRoughness = nullptr;
    const MipChain* normal = nullptr;
    const MipChain* occlusion = nullptr;
    const MipChain* emissive = nullptr;
    const MipChain* coat = nullptr;
    const MipChain* coatRoughness = nullptr;
    const MipChain* coatNormal = nullptr;
    const MipChain* anisotropy = nullptr;
    const MipChain* specular = nullptr;
    const MipChain* specularColor = nullptr;
    const MipChain* sheenColor = nullptr;
    const MipChain* sheenRoughness = nullptr;
    const MipChain* transmission = nullptr;
    const MipChain* height = nullptr;
};

// The maps of all materials. An image with two kinds of use has two chains.
struct TextureLibrary {
    std::vector<MaterialMaps> materials;
    std::deque<MipChain> chains; // a deque, because the materials point to its elements
};

// Builds the chains that the view reads: all for shaded images, otherwise normal maps and the alpha of materials that
// are not opaque.
TextureLibrary makeTextures(const Scene& scene, const View& view);

} // namespace cotan::reference
