// A tile of the picture while it is drawn.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "cotan/scene.hpp"
#include "raster.hpp"

namespace cotan::reference {

// Of a tile: 1024 for each pixel, 48 MiB.
inline constexpr std::size_t kMaxLayers = std::size_t(1) << 20;

struct TooManyLayers {};

// Colour and reversed depth of every sample of an area. Values are linear; alpha is coverage, and
// colours are premultiplied by it, as they are in a render target after blending.
class Tile {
public:
    Tile(Rectangle area, const SamplePattern& pattern);

    // Says that an opaque surface will be drawn there: what lies behind it does not pass from now on.
    void expect(int x, int y, unsigned covered, const Plane& z);

    // The samples of `covered` for which z passes: nearer than what is there, and not behind what is expected.
    unsigned nearer(int x, int y, unsigned covered, const Plane& z) const;

    // Replaces the samples and their reversed depth.
    void write(int x, int y, unsigned samples, glm::vec4 value, const Plane& z);

    // Adds a translucent layer to the samples: nothing that is written later may be behind it. Layers are
    // composed in `resolve`, by reversed depth; of equally near ones the later is in front.
    // through: factors of what is behind, by colour.
    // Throws TooManyLayers over kMaxLayers.
    void blend(int x, int y, unsigned samples, glm::vec4 value, glm::vec3 through, const Plane& z);

    // How many pixels were written, each as often as it was.
    std::size_t written() const { return written_; }

    // Fills all samples of a pixel, behind everything.
    void clear(int x, int y, glm::vec4 value);

    // The mean of a pixel's samples, each with its layers over what was written.
    glm::vec4 resolve(int x, int y) const;

private:
    struct Layer {
        glm::vec3 light{0}; // times what it covers
        glm::vec3 through{0};
        std::array<float, 4> reversedDepth{}; // of each sample
        unsigned samples = 0;
        std::uint32_t before = 0; // the pixel's layer that was added before, kNone if none
    };
    static constexpr std::uint32_t kNone = 0xffffffff;

    std::size_t at(int x, int y) const;
    float reversedDepthAt(const Plane& z, int x, int y, std::size_t sample) const;
    std::vector<const Layer*> layersOf(std::size_t pixel) const;

    Rectangle area_;
    SamplePattern pattern_;
    std::size_t samples_; // of a pixel
    std::vector<glm::vec4> value_;
    std::vector<float> reversedDepth_;
    std::vector<float> expected_; // reversed depth of the nearest surface that will be drawn; empty before the first
    std::size_t written_ = 0;
    std::vector<Layer> layers_;
    std::vector<std::uint32_t> newest_; // of each pixel; empty before the first layer
};

} // namespace cotan::reference
