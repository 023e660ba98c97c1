// A tile of the picture while it is drawn.
#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "cotan/scene/image.hpp"
#include "raster.hpp"

namespace cotan::reference {

// Colour and nearness of every sample of an area. Values are linear; alpha is coverage, and
// colours are premultiplied by it, as they are in a render target after blending.
class Tile {
public:
    Tile(Rectangle area, int samples);

    // The samples of `covered` for which z passes: nearer than what is there.
    unsigned nearer(int x, int y, unsigned covered, const Plane& z,
                    const SamplePattern& pattern) const;

    // Replaces the samples and their nearness.
    void write(int x, int y, unsigned samples, glm::vec4 value, const Plane& z,
               const SamplePattern& pattern);

    // Mixes a colour over the samples by its alpha; nearness stays.
    void blend(int x, int y, unsigned samples, glm::vec4 value);

    // Fills all samples of a pixel, behind everything.
    void clear(int x, int y, glm::vec4 value);

    // The mean of a pixel's samples.
    glm::vec4 resolve(int x, int y) const;

private:
    std::size_t at(int x, int y) const;

    Rectangle area_;
    int samples_;
    std::vector<glm::vec4> value_;
    std::vector<float> nearness_;
};

// Writes a pixel as the image's type: float32 as it is; unorm8 with colours sRGB-encoded and, as
// image files want them, not multiplied by alpha.
void storePixel(Image& image, int x, int y, glm::vec4 value);

} // namespace cotan::reference
