#include "cotan/lint/texel.hpp"

#include <algorithm>
#include <cmath>

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

f64::cotan_normal_format formatOf(const Material& material)
{
    return {material.normalFormat.expansion, material.normalFormat.channels,
            material.normalFormat.greenAlongV ? 1.0 : -1.0, double(material.normalScale)};
}

int wrappedTexel(double coordinate, int size, Wrap wrap)
{
    if (!(std::abs(coordinate) <= 1e8))
        return 0;
    const auto i = std::int64_t(std::floor(coordinate * size));
    if (wrap == Wrap::clamp)
        return int(std::clamp<std::int64_t>(i, 0, size - 1));
    const std::int64_t period = wrap == Wrap::mirror ? 2 * std::int64_t(size) : size;
    const std::int64_t k = (i % period + period) % period;
    return int(k < size ? k : 2 * std::int64_t(size) - 1 - k);
}

glm::dvec3 decodedAt(const Image& image, const Texture& texture, const f64::cotan_normal_format& format, glm::dvec2 uv)
{
    return f64::cotan_decode(storedTexel(image, wrappedTexel(uv.x, image.width, texture.sampler.wrapU),
                                         wrappedTexel(uv.y, image.height, texture.sampler.wrapV)),
                             format);
}

} // namespace cotan
