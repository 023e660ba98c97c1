#include "bump_map.hpp"

#include <cmath>
#include <vector>

#include "cotan/maps.hpp"
#include "maps/texels.hpp"

namespace cotan {

bool looksLikeHeight(const Image& image)
{
    double difference = 0;
    std::vector<glm::vec4> row(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
        maps::loadRow(image, y, row);
        for (const glm::vec4& texel : row)
            if (const float apart = std::abs(texel.x - texel.z); std::isfinite(apart))
                difference += double(apart);
    }
    return difference < 0.03 * double(image.pixelCount());
}

Image normalMapFromHeight(const Image& height, float strength)
{
    constexpr double kDepth = 0.01; // of white over black, in widths of the picture
    maps::FromHeightSettings settings;
    settings.scaleX = settings.scaleY = kDepth * height.width * double(strength);
    settings.type = height.type == PixelType::unorm8 ? PixelType::unorm8 : PixelType::unorm16;
    std::size_t invalid = 0;
    Image map = maps::normalsFromHeight(height, settings, invalid);
    map.name += " (bump)";
    return map;
}

} // namespace cotan
