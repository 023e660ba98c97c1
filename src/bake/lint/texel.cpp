#include "bake/lint/texel.hpp"

#include <cmath>

#include "scene/texture_sample.hpp"

namespace cotan {

glm::dvec3 storedTexel(const Image& image, int x, int y)
{
    return atTexel(image, x, y, [](const auto* c, int most) { return glm::dvec3(c[0], c[1], c[2]) / double(most); });
}

f64::cotan_normal_format formatOf(const Material& material, PixelType type)
{
    return toFormat<f64::cotan_normal_format>(material.normalFormat, type, double(material.normalScale));
}

int wrappedTexel(double coordinate, int size, Wrap wrap)
{
    if (!(std::abs(coordinate) <= kFarthestUv))
        return 0;
    return wrapTexel(std::int64_t(std::floor(coordinate * size)), size, wrap);
}

glm::dvec3 decodedAt(const Image& image, const Texture& texture, const f64::cotan_normal_format& format, glm::dvec2 uv)
{
    return f64::cotan_decode(storedTexel(image, wrappedTexel(uv.x, image.width, texture.sampler.wrapU),
                                         wrappedTexel(uv.y, image.height, texture.sampler.wrapV)),
                             format);
}

} // namespace cotan
