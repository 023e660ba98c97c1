// A picture in memory. Plain data, no files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cotan {

enum class PixelType { unorm8, unorm16, float32 };

constexpr std::size_t bytesPerComponent(PixelType type)
{
    return type == PixelType::unorm8 ? 1 : type == PixelType::unorm16 ? 2 : 4;
}

constexpr int bitsPerComponent(PixelType type) { return int(8 * bytesPerComponent(type)); }

// Always four components a pixel, red green blue alpha, rows from the top, no padding.
// Grey files become r = g = b; a missing alpha becomes 1. The values are those of the file:
// whether they are sRGB or linear is decided by what they are used for.
struct Image {
    std::string name; // for messages: file name, or what it was made from
    int width = 0;    // pixels
    int height = 0;   // pixels
    PixelType type = PixelType::unorm8;
    std::vector<std::byte> data; // width * height * 4 * bytesPerComponent(type)
    // Name of the frame that a normal map was made for, as the file says it (key cotanFrame of PNG, EXR and KTX2): any
    // word of up to 64 characters, not only names that frameFromName knows. Empty: it is not said.
    std::string frame = {};
    // How many channels the file stores: 1 grey, 2 (red and green of KTX2 and DDS, others grey and alpha), 3, 4. 4 also
    // where nothing is known.
    int channels = 4;

    std::size_t pixelCount() const { return std::size_t(width) * std::size_t(height); }
    std::size_t bytesPerPixel() const { return 4 * bytesPerComponent(type); }

    std::uint8_t* bytes8() { return reinterpret_cast<std::uint8_t*>(data.data()); }
    const std::uint8_t* bytes8() const { return reinterpret_cast<const std::uint8_t*>(data.data()); }
    std::uint16_t* words() { return reinterpret_cast<std::uint16_t*>(data.data()); }
    const std::uint16_t* words() const { return reinterpret_cast<const std::uint16_t*>(data.data()); }
    float* floats() { return reinterpret_cast<float*>(data.data()); }
    const float* floats() const { return reinterpret_cast<const float*>(data.data()); }
};

// Whether an image has a size and all of its data.
inline bool hasPixels(const Image& image)
{
    return image.width > 0 && image.height > 0 && image.data.size() >= image.pixelCount() * image.bytesPerPixel();
}

// Whether every texel of an image of whole numbers has the largest alpha; false for floats. The image hasPixels.
inline bool isOpaque(const Image& image)
{
    const auto all = [&](const auto* components, auto largest) {
        for (std::size_t i = 3; i < 4 * image.pixelCount(); i += 4)
            if (components[i] != largest)
                return false;
        return true;
    };
    return image.type == PixelType::unorm8 ? all(image.bytes8(), 0xff)
        : image.type == PixelType::unorm16 ? all(image.words(), 0xffff)
                                           : false;
}

// An image of that size with every byte zero.
inline Image makeImage(int width, int height, PixelType type, std::string name = {})
{
    Image image;
    image.name = std::move(name);
    image.width = width;
    image.height = height;
    image.type = type;
    image.data.resize(image.pixelCount() * image.bytesPerPixel());
    return image;
}

} // namespace cotan
