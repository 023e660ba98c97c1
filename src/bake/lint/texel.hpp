// Texels of a normal map on the CPU: stored and decoded.
#pragma once

#include <cmath>
#include <cstdint>

#include "cotan/portable.hpp"
#include "cotan/scene.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

// The stored components at column x, row y, as a sampler gives them: unorm as [0,1].
inline glm::dvec3 storedTexel(const Image& image, int x, int y)
{
    return atTexel(image, x, y, [](const auto* c, int most) { return glm::dvec3(c[0], c[1], c[2]) / double(most); });
}

// The texel that a coordinate falls into along one axis: `size` texels, coordinates in [0,1) the image itself.
inline int wrappedTexel(double coordinate, int size, Wrap wrap)
{
    if (!(std::abs(coordinate) <= kFarthestUv))
        return 0;
    return wrapTexel(std::int64_t(std::floor(coordinate * size)), size, wrap);
}

// The decoded texel, nearest filter, finest level.
inline glm::dvec3 decodedAt(const Image& image, Wrap wrapU, Wrap wrapV, const f64::cotan_normal_format& format,
                            glm::dvec2 uv)
{
    return f64::cotan_decode(
        storedTexel(image, wrappedTexel(uv.x, image.width, wrapU), wrappedTexel(uv.y, image.height, wrapV)), format);
}

} // namespace cotan
