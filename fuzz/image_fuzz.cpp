// Decodes images in memory: the first bytes determine the format, anything else is taken for TGA. The result is encoded
// as PNG and decoded again.
#include <algorithm>

#include "cotan/image.hpp"
#include "fuzz.hpp"
#include "image/codecs.hpp"
#include "limits.hpp"

using namespace cotan;
using namespace cotan::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto bytes = std::as_bytes(std::span(data, size));
    if (const auto blocks = readJpegBlocks(bytes, smallLimits(), 64)) // also of files whose pixels are refused
        for (const JpegBlocks::Component& c : blocks->components)
            COTAN_HOLDS(c.coefficients.size() == blocks->units.size() * std::size_t(c.across * c.down) * 64);
    const auto image = decodeImage(bytes, "picture.tga", smallLimits());
    if (!image) {
        checkError(image.error());
        return 0;
    }
    const int side = smallLimits().imageSide;
    COTAN_HOLDS(image->width > 0 && image->width <= side && image->height > 0 && image->height <= side, "{} x {}",
                image->width, image->height);
    COTAN_HOLDS(image->data.size() == image->pixelCount() * image->bytesPerPixel(), "{}", image->data.size());
    const auto again = decodeImage(bytes, "picture.tga", smallLimits());
    COTAN_HOLDS(again && again->data == image->data, "the second reading differs");
    if (image->type == PixelType::float32 || image->pixelCount() > 65536)
        return 0;
    const auto png = encodePng(*image);
    COTAN_HOLDS(bool(png));
    const auto read = decodeImage(*png, "again.png", smallLimits());
    COTAN_HOLDS(read && read->type == image->type && read->width == image->width && read->data == image->data);
    return 0;
}
