// Conversion between component types, and generic access to components.
#pragma once

#include <cstdint>

#include "cotan/scene.hpp"

namespace cotan {

// Calls f(components, middle, one): the stored components of the image, and the middle and the maximum of their range.
template<class F> void withComponents(Image& image, const F& f)
{
    switch (image.type) {
    case PixelType::unorm8: return f(image.bytes8(), std::uint8_t(128), std::uint8_t(255));
    case PixelType::unorm16: return f(image.words(), std::uint16_t(0x8000), std::uint16_t(0xffff));
    case PixelType::float32: return f(image.floats(), 0.5f, 1.0f);
    }
}

// A signed value, `value` of -most to most, as images of unorm16 carry it: -1 is 1, 0 is 32768 and 1 is 65535. So what
// means 0 is the code that conventions with an exact zero expect, and 2c - 1 is at most 1/65535 off.
constexpr std::uint16_t unormOfSigned(int value, int most)
{
    const std::int64_t twice = std::int64_t(2 * 32767) * value + (value < 0 ? -most : most);
    return std::uint16_t(0x8000 + twice / (2 * std::int64_t(most))); // rounds to the nearest, halves away from 0
}

// Converts to 8 bits: floats are clamped to [0,1] and NaN becomes 0; 16-bit values are rounded.
Image toUnorm8(const Image& image);

// Reconstructs the z of two-channel normal maps. If blue is the middle value and alpha is 1 everywhere, as readers of
// BC5 and other two-channel formats leave them, blue is set so that the normals have length 1; other images are
// unchanged.
void completeNormals(Image& image);

} // namespace cotan
