// DDS with signed blocks, BC4_SNORM and BC5_SNORM, which OpenImageIO reads as if they were unsigned.
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "image/checks.hpp"
#include "image/component_types.hpp"
#include "oiio.hpp"

namespace cotan::oiio {

namespace {

// The 16 texels of one channel. Microsoft, "BC4_SNORM": two ends of -127 to 127, where -128 is -127, and values between
// them: six if the first end is larger, else four, -1 and 1.
std::array<std::uint16_t, 16> signedChannel(const std::byte* block)
{
    const auto end = [&](int i) {
        const int stored = std::to_integer<int>(block[i]);
        return std::max(stored < 128 ? stored : stored - 256, -127);
    };
    const int first = end(0), second = end(1), parts = first > second ? 7 : 5;
    std::array<std::uint16_t, 8> values{unormOfSigned(first, 127), unormOfSigned(second, 127)};
    for (int i = 1; i < parts; ++i)
        values[std::size_t(i) + 1] = unormOfSigned((parts - i) * first + i * second, 127 * parts);
    if (parts == 5) {
        values[6] = unormOfSigned(-1, 1);
        values[7] = unormOfSigned(1, 1);
    }
    std::uint64_t bits = 0;
    for (int i = 7; i >= 2; --i)
        bits = bits << 8 | std::to_integer<std::uint64_t>(block[i]);
    std::array<std::uint16_t, 16> texels{};
    for (std::size_t i = 0; i < 16; ++i)
        texels[i] = values[bits >> 3 * i & 7];
    return texels;
}

// All rows of blocks, as in other files of one channel and two.
void decodeSigned(const std::vector<std::byte>& blocks, int channels, Image& image)
{
    const std::size_t across = std::size_t(image.width + 3) / 4;
    for (int top = 0; top < image.height; top += 4)
        for (int left = 0; left < image.width; left += 4) {
            const std::size_t block = std::size_t(top / 4) * across + std::size_t(left / 4);
            const std::byte* const from = blocks.data() + block * std::size_t(8 * channels);
            const auto x = signedChannel(from), y = channels == 2 ? signedChannel(from + 8) : x;
            for (int i = 0; i < 16; ++i) {
                const int column = left + i % 4, row = top + i / 4;
                if (column >= image.width || row >= image.height)
                    continue;
                const auto at = std::size_t(i);
                const std::array<std::uint16_t, 4> texel{x[at], y[at], channels == 2 ? std::uint16_t(0x8000) : x[at],
                                                         0xffff};
                std::copy_n(texel.begin(), 4,
                            image.words() + 4 * (std::size_t(row) * std::size_t(image.width) + std::size_t(column)));
            }
        }
}

bool isDx10(Numbers& numbers) { return numbers.matches(84, "DX10"); }

} // namespace

int signedDdsChannels(File& file)
{
    Numbers numbers = numbersOf(file);
    constexpr std::uint64_t kFourCc = 0x4;
    if (!(numbers.at(80, 4) & kFourCc))
        return 0;
    const std::uint64_t dxgi = isDx10(numbers) ? numbers.at(128, 4) : 0;
    if (dxgi == 81 || numbers.matches(84, "BC4S"))
        return 1;
    return dxgi == 84 || numbers.matches(84, "BC5S") ? 2 : 0;
}

Result<Image> readSignedDds(File& file, int channels, const std::string& name, const LoadLimits& limits)
{
    Numbers numbers = numbersOf(file);
    const std::uint64_t height = numbers.at(12, 4), width = numbers.at(16, 4);
    if (auto error = checkImageSize(std::int64_t(width), std::int64_t(height), PixelType::unorm16, name, limits))
        return *error;
    constexpr std::uint64_t kCubeOrVolume = 0x200200; // of DDS_HEADER::dwCaps2
    if (numbers.at(112, 4) & kCubeOrVolume)
        return inputError(name + ": expected a flat image, found a cube map or a volume");
    const std::int64_t start = isDx10(numbers) ? 148 : 128;
    std::vector<std::byte> blocks(((width + 3) / 4) * ((height + 3) / 4) * std::uint64_t(8 * channels));
    if (file.pread(blocks.data(), blocks.size(), start) != blocks.size())
        return inputError(name + ": cannot be read");
    Image image = makeImage(int(width), int(height), PixelType::unorm16, name);
    decodeSigned(blocks, channels, image);
    image.channels = channels;
    return image;
}

} // namespace cotan::oiio
