#include "cotan/image/convert.hpp"

namespace cotan {

namespace {

std::uint8_t quantise(float value)
{
    if (!(value > 0))
        return 0;
    return value >= 1 ? 255 : static_cast<std::uint8_t>(value * 255.0f + 0.5f);
}

} // namespace

Image toUnorm8(const Image& image)
{
    if (image.type == PixelType::unorm8)
        return image;
    Image out = makeImage(image.width, image.height, PixelType::unorm8, image.name);
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
