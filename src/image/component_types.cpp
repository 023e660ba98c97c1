#include "image/component_types.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace cotan {

namespace {

std::uint8_t quantise(float value)
{
    if (!(value > 0))
        return 0;
    return value >= 1 ? 255 : static_cast<std::uint8_t>(value * 255.0f + 0.5f);
}

} // namespace

void completeNormals(Image& image)
{
    withComponents(image, [count = image.pixelCount()]<class T>(T* texels, T middle, T one) {
        for (std::size_t i = 0; i < count; ++i)
            if (texels[4 * i + 2] != middle || texels[4 * i + 3] != one)
                return;
        const double scale = T(one - middle);
        for (T* t = texels; t < texels + 4 * count; t += 4) {
            const double x = (double(t[0]) - double(middle)) / scale, y = (double(t[1]) - double(middle)) / scale;
            const double z = std::sqrt(std::max(0.0, 1 - x * x - y * y)) * scale;
            t[2] = T(double(middle) + (std::is_integral_v<T> ? std::round(z) : z));
        }
    });
}

Image toUnorm8(const Image& image)
{
    if (image.type == PixelType::unorm8)
        return image;
    Image out = makeImage(image.width, image.height, PixelType::unorm8, image.name);
    out.frame = image.frame;
    out.channels = image.channels;
    out.blocks = image.blocks;
    const std::size_t count = image.pixelCount() * 4;
    if (image.type == PixelType::float32) {
        for (std::size_t i = 0; i < count; ++i)
            out.bytes8()[i] = quantise(image.floats()[i]);
    } else {
        for (std::size_t i = 0; i < count; ++i)
            out.bytes8()[i] = static_cast<std::uint8_t>((image.words()[i] + 128u) / 257u);
    }
    return out;
}

} // namespace cotan
