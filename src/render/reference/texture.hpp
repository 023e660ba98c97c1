// Texture reads as a GPU does them, of images with their smaller versions.
#pragma once

#include <deque>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "cotan/view.hpp"

namespace cotan::reference {

enum class Content {
    color,  // sRGB (float images: linear already), alpha linear
    linear, // numbers
    normal, // as the format says
};

// Level 0 is the scene's image itself, every further level is half the size, rounded down, to 1x1.
// The levels are stored as the image is, so 8-bit maps stay small.
struct MipChain {
    const Image* image = nullptr;
    Content content = Content::linear;
    std::vector<Image> smaller;
    float apart = 1; // pixels from one sample to the next: what is read for one is as large

    int levels() const { return 1 + int(smaller.size()); }
    const Image& level(int i) const { return i == 0 ? *image : smaller[std::size_t(i - 1)]; }
};

// Texture coordinates at a pixel and their differences along its row and column.
struct UvDifferences {
    glm::vec2 uv{0};
    glm::vec2 dx{0};
    glm::vec2 dy{0};
};

// The texel value there: wrapped, filtered, from the level that the differences ask for (OpenGL 4.6, section 8.14);
// stretched footprints are read with up to eight probes along their longer axis. Coordinates that are not finite are
// taken as 0. pointSampled: the nearest texel of level 0 instead, whatever the sampler says.
glm::vec4 sample(const MipChain& chain, const Sampler& sampler, const UvDifferences& at, bool pointSampled);

// The chains of one material; null where the material has no such map or its image is unusable.
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
};

// The maps of all materials. An image that is used in two ways has two chains.
struct TextureLibrary {
    std::vector<MaterialMaps> materials;
    std::deque<MipChain> chains; // a deque, since the materials point into it
};

// Makes the chains that the view reads: all for shaded pictures, otherwise normal maps and the
// alpha of materials that are not opaque.
TextureLibrary makeTextures(const Scene& scene, const View& view);

} // namespace cotan::reference
