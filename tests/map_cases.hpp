// Small float maps for the tests of src/maps.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/convention.hpp"
#include "cotan/scene.hpp"
#include "maps/texels.hpp"

namespace cotan::maps::cases {

inline constexpr Convention kFloats{.expansion = Expansion::signedValues};

// A float map from a function of (column, row) that returns vectors in image space, y up; they are stored unchanged.
template<class Normal> Image floatMap(int width, int height, Normal normal)
{
    Image image = makeImage(width, height, PixelType::float32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 n(normal(x, y));
            std::copy_n(&n.x, 3, image.floats() + 4 * (y * width + x));
            image.floats()[4 * (y * width + x) + 3] = 1;
        }
    return image;
}

inline glm::vec3 texelAt(const Image& floats, int x, int y)
{
    const float* p = floats.floats() + 4 * (y * floats.width + x);
    return {p[0], p[1], p[2]};
}

inline glm::vec3 ofSlopes(double right, double up) { return glm::vec3(glm::normalize(glm::dvec3(-right, -up, 1))); }

// Slopes of the surface, rightwards and up, for the normal n.
inline glm::dvec2 slopesOf(const glm::vec3& n) { return {-double(n.x) / double(n.z), -double(n.y) / double(n.z)}; }

// Rows [first, last) of an image.
inline Image rowsBetween(const Image& image, int first, int last)
{
    Image strip = makeImage(image.width, last - first, image.type);
    const std::size_t row = std::size_t(image.width) * image.bytesPerPixel();
    std::copy_n(image.data.begin() + std::ptrdiff_t(std::size_t(first) * row), strip.data.size(), strip.data.begin());
    return strip;
}

inline Image joined(const Image& above, const Image& below)
{
    Image all = makeImage(above.width, above.height + below.height, above.type);
    std::copy(above.data.begin(), above.data.end(), all.data.begin());
    std::copy(below.data.begin(), below.data.end(), all.data.begin() + std::ptrdiff_t(above.data.size()));
    return all;
}

// Pseudorandom numbers in [0,1).
class Noise {
public:
    explicit Noise(unsigned seed) : state_(seed) {}
    double next()
    {
        state_ = state_ * 1664525u + 1013904223u;
        return double(state_ >> 8) / 16777216.0;
    }

private:
    unsigned state_;
};

} // namespace cotan::maps::cases
