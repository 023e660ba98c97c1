#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "cotan/maps.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

namespace {

int wrapped(int i, int size, Wrap wrap)
{
    if (i >= 0 && i < size)
        return i;
    if (wrap == Wrap::clamp || size == 1)
        return std::clamp(i, 0, size - 1);
    if (wrap == Wrap::repeat)
        return (i % size + size) % size;
    return i < 0 ? std::min(-i - 1, size - 1) : std::max(2 * size - 1 - i, 0); // the edge row is repeated
}

// A row of heights with one more texel at either end.
void loadHeights(const Image& image, int row, Wrap wrap, std::vector<float>& heights)
{
    const std::size_t width = std::size_t(image.width);
    const std::size_t start = std::size_t(wrapped(row, image.height, wrap)) * width * 4;
    heights.resize(width + 2);
    for (std::size_t x = 0; x < width; ++x) {
        const std::size_t i = start + 4 * x;
        heights[x + 1] = image.type == PixelType::unorm8 ? float(image.bytes8()[i]) * (1.0f / 255)
            : image.type == PixelType::unorm16           ? float(image.words()[i]) * (1.0f / 65535)
                                                         : image.floats()[i];
    }
    heights[0] = heights[std::size_t(wrapped(-1, image.width, wrap)) + 1];
    heights[width + 1] = heights[std::size_t(wrapped(image.width, image.width, wrap)) + 1];
}

// Differences of height per texel: rightwards and up the picture. x counts within the padded rows.
glm::vec2 difference(const std::vector<float>& above, const std::vector<float>& here, const std::vector<float>& below,
                     std::size_t x, Kernel kernel)
{
    if (kernel == Kernel::forward)
        return {here[x + 1] - here[x], above[x] - here[x]};
    if (kernel == Kernel::central) // not with weights of 0: a corner that is not a number would count
        return 0.5f * glm::vec2(here[x + 1] - here[x - 1], above[x] - below[x]);
    const std::array<float, 3> shares = sharesAcross(kernel == Kernel::sobel ? kernel : Kernel::scharr);
    const float side = shares[0], middle = shares[1];
    const float right = side * (above[x + 1] + below[x + 1]) + middle * here[x + 1];
    const float left = side * (above[x - 1] + below[x - 1]) + middle * here[x - 1];
    const float up = side * (above[x - 1] + above[x + 1]) + middle * above[x];
    const float down = side * (below[x - 1] + below[x + 1]) + middle * below[x];
    return 0.5f * glm::vec2(right - left, up - down);
}

} // namespace

Image normalsFromHeight(const Image& height, const FromHeightSettings& s, std::size_t& invalid)
{
    const int border = s.bordered ? 1 : 0;
    Image out = makeImage(height.width, height.height - 2 * border, s.type, height.name);
    const std::size_t width = std::size_t(height.width);
    const glm::vec2 scale(float(s.scaleX), float(s.scaleY));
    std::atomic<std::size_t> bad = 0;
    forRowBands(out.height, [&](int first, int last) {
        std::vector<float> above, here, below;
        std::vector<glm::vec4> texels(width);
        std::size_t badHere = 0;
        loadHeights(height, first - 1 + border, s.wrap, above);
        loadHeights(height, first + border, s.wrap, here);
        for (int y = first; y < last; ++y) {
            loadHeights(height, y + 1 + border, s.wrap, below);
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec2 slope = difference(above, here, below, x + 1, s.kernel) * scale;
                const bool finite = std::isfinite(slope.x) && std::isfinite(slope.y);
                badHere += !finite;
                const glm::vec3 normal = finite ? glm::normalize(glm::vec3(-slope, 1)) : glm::vec3(0, 0, 1);
                texels[x] = encodeTexel(normal, s.to, s.type);
            }
            if (s.dither)
                ditherRow(texels, s.type, s.firstRow + y);
            storeRow(out, y, texels);
            above.swap(here);
            here.swap(below);
        }
        bad += badHere;
    });
    invalid = bad;
    return out;
}

} // namespace cotan::maps
