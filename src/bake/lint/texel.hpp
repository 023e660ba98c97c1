// Texels of a normal map on the CPU: stored and decoded.
#pragma once

#include "cotan/portable.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// The stored components at column x, row y, as a sampler gives them: unorm as [0,1].
glm::dvec3 storedTexel(const Image& image, int x, int y);

// How a material's normal map, with components of that type, is decoded. Its scale is in `strength`.
f64::cotan_normal_format formatOf(const Material& material, PixelType type);

// The texel that a coordinate falls into along one axis: `size` texels, coordinates in [0,1) the image itself.
int wrappedTexel(double coordinate, int size, Wrap wrap);

// The decoded texel, nearest filter, finest level.
glm::dvec3 decodedAt(const Image& image, const Texture& texture, const f64::cotan_normal_format& format, glm::dvec2 uv);

} // namespace cotan
