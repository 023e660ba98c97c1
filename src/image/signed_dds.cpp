// DDS with signed blocks, BC4_SNORM and BC5_SNORM, which OpenImageIO reads as if they were unsigned.
#include <vector>

#include "image/bc.hpp"
#include "image/checks.hpp"
#include "oiio.hpp"

namespace cotan::oiio {

namespace {

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
    decodeBc(channels == 1 ? BcCode::bc4Signed : BcCode::bc5Signed, blocks, image);
    image.channels = channels;
    return image;
}

} // namespace cotan::oiio
