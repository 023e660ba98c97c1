#include <algorithm>
#include <cmath>
#include <vector>

#include "batch/record.hpp"
#include "cotan/image.hpp"
#include "html.hpp"
#include "image/codecs.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::app {

namespace {

constexpr int kSide = 64, kQuality = 80; // pixels; JPEG quality in percent
constexpr double kBackgroundGrey = 0.5;  // grey behind transparent pixels

// The colour of a pixel over grey, in [0,1].
glm::dvec3 colorAt(const Image& strip, int x, bool hasAlpha)
{
    glm::dvec4 c =
        atTexel(strip, x, 0, [](const auto* v, int one) { return glm::dvec4(v[0], v[1], v[2], v[3]) / double(one); });
    for (int i = 0; i < 4; ++i)
        c[i] = std::isfinite(c[i]) ? std::clamp(c[i], 0.0, 1.0) : 0.0;
    return glm::mix(glm::dvec3(kBackgroundGrey), glm::dvec3(c), hasAlpha ? c.w : 1.0);
}

} // namespace

std::optional<Thumbnail> thumbnailOf(const std::filesystem::path& image)
{
    auto rows = openRows(image);
    if (!rows || (*rows)->width < 1 || (*rows)->height < 1)
        return std::nullopt;
    RowReader& reader = **rows;
    const double factor = std::min({1.0, double(kSide) / reader.width, double(kSide) / reader.height});
    Image small = makeImage(std::max(1, int(std::lround(factor * reader.width))),
                            std::max(1, int(std::lround(factor * reader.height))), PixelType::unorm8);
    // The sum of the colours of the pixels that fall on each pixel, and their number.
    std::vector<glm::dvec4> sums(small.pixelCount(), glm::dvec4(0));
    Image strip = makeImage(reader.width, 1, reader.type, reader.name);
    for (std::int64_t row = 0; row < reader.height; ++row) {
        if (!reader.read(strip))
            return std::nullopt;
        const std::size_t y = std::size_t(row * small.height / reader.height) * std::size_t(small.width);
        for (std::int64_t x = 0; x < reader.width; ++x)
            sums[y + std::size_t(x * small.width / reader.width)] +=
                glm::dvec4(colorAt(strip, int(x), reader.alpha), 1);
    }
    for (std::size_t i = 0; i < 4 * sums.size(); ++i)
        small.bytes8()[i] =
            static_cast<std::uint8_t>(255 * sums[i / 4][int(i % 4)] / std::max(sums[i / 4].w, 1.0) + 0.5);
    const std::string jpeg = writeJpeg(small, kQuality);
    return jpeg.empty() ? std::nullopt : std::optional(Thumbnail{small.width, small.height, toBase64(jpeg)});
}

} // namespace cotan::app
