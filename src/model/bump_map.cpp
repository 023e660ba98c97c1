#include "bump_map.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

#include "cotan/convention.hpp"
#include "cotan/portable.hpp"

namespace cotan {

namespace {

constexpr float kDepth = 0.01f; // of white over black, in widths of the picture

float component(const Image& image, std::size_t index)
{
    switch (image.type) {
    case PixelType::unorm8: return float(image.bytes8()[index]) / 255.0f;
    case PixelType::unorm16: return float(image.words()[index]) / 65535.0f;
    case PixelType::float32: break;
    }
    const float value = image.floats()[index];
    return std::isfinite(value) ? value : 0.0f;
}

void store(Image& image, std::size_t index, float value)
{
    if (image.type == PixelType::unorm8)
        image.bytes8()[index] = static_cast<std::uint8_t>(value * 255.0f + 0.5f);
    else
        image.words()[index] = static_cast<std::uint16_t>(value * 65535.0f + 0.5f);
}

} // namespace

bool looksLikeHeight(const Image& image)
{
    double difference = 0;
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        difference += std::abs(component(image, 4 * i) - component(image, 4 * i + 2));
    return difference < 0.03 * double(image.pixelCount());
}

Image normalMapFromHeight(const Image& height, float strength)
{
    const int w = height.width, h = height.height;
    Image out = makeImage(w, h, height.type == PixelType::unorm8 ? PixelType::unorm8 : PixelType::unorm16,
                          height.name + " (bump)");
    const int expansion = expansionFor(Expansion::exact, bitsPerComponent(out.type));
    const auto at = [&](int x, int y) {
        return component(height, 4 * (std::size_t((y + h) % h) * std::size_t(w) + std::size_t((x + w) % w)));
    };
    const float depth = kDepth * float(w) * strength; // in texels
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const float slopeU = (at(x + 1, y) - at(x - 1, y)) * 0.5f * depth;
            const float slopeV = (at(x, y + 1) - at(x, y - 1)) * 0.5f * depth;
            // The normal leans down the slope; green is stored against +v.
            const glm::vec3 n = glm::normalize(glm::vec3(-slopeU, slopeV, 1.0f));
            const std::size_t pixel = 4 * (std::size_t(y) * std::size_t(w) + std::size_t(x));
            for (int c = 0; c < 3; ++c)
                store(out, pixel + std::size_t(c), f32::cotan_compress(n[c], expansion));
            store(out, pixel + 3, 1.0f);
        }
    }
    return out;
}

} // namespace cotan
