// Images with their smaller versions, filtered for what they hold.
#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "cotan/scene.hpp"

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

// Builds the chain of a usable image. Colours are averaged as linear light; normal maps as decoded
// vectors, which are normalised before they are stored again, with their length in the fourth
// channel: 1 where all agree; everything else as numbers. Every
// texel of a level is the average of the area that it covers in the one before, also where a size
// is odd.
// withLevels: false keeps level 0 only.
MipChain makeMipChain(const Image& image, Content content, Convention format, bool withLevels);

// A texel, with colours made linear. Normal maps come as stored, with 1 in the fourth channel of level 0. x, y: inside
// the level.
glm::vec4 texel(const MipChain& chain, int level, int x, int y);

} // namespace cotan::reference
