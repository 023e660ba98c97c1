// Between component types.
#pragma once

#include <cstdint>

#include "cotan/scene.hpp"

namespace cotan {

// f(components, middle, one): the image's components as they are stored, and the middle and the end of their range.
template<class F> void withComponents(Image& image, const F& f)
{
    switch (image.type) {
    case PixelType::unorm8: return f(image.bytes8(), std::uint8_t(128), std::uint8_t(255));
    case PixelType::unorm16: return f(image.words(), std::uint16_t(0x8000), std::uint16_t(0xffff));
    case PixelType::float32: return f(image.floats(), 0.5f, 1.0f);
    }
}

// The same picture at 8 bits: floats are clamped to [0,1] (NaN is 0), 16 bits rounded.
Image toUnorm8(const Image& image);

// Gives normals of two channels their third. Where blue is the middle and alpha 1 everywhere, as readers of BC5 and
// other two-channel pictures leave them, blue becomes what the length 1 leaves; other pictures stay.
void completeNormals(Image& image);

} // namespace cotan
