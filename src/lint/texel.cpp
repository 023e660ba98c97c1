#include "cotan/lint/texel.hpp"

#include <cmath>

#include "cotan/scene/normal_format.hpp"
#include "cotan/scene/texture_sample.hpp"

namespace cotan {

bool hasPixels(const Image& image)
{
    return image.width > 0 && image.height > 0 && image.data.size() == image.pixelCount() * image.bytesPerPixel();
}

glm::dvec3 storedTexel(const Image& image, int x, int y)
{
    const std::size_t at = (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4;
    if (image.type == PixelType::unorm8) {
        const std::uint8_t* p = image.bytes8() + at;
        return glm::dvec3(p[0], p[1], p[2]) / 255.0;
    }
    if (image.type == PixelType::unorm16) {
        const std::uint16_t* p = image.words() + at;
        return glm::dvec3(p[0], p[1], p[2]) / 65535.0;
    }
    const float* p = image.floats() + at;
    return {p[0], p[1], p[2]};
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
