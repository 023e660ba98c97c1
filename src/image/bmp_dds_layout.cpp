// BMP and DDS: checks that the compression of a BMP file fits its bit depth and the limits, and that a DDS file holds
// the first level that its header describes.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "oiio.hpp"

namespace cotan::oiio {

// Microsoft's BITMAPINFOHEADER. Run lengths need 8 or 4 bits per pixel; with others OpenImageIO reads before its rows.
Problem checkBmp(File& file, const LoadLimits& limits)
{
    Numbers numbers = numbersOf(file);
    // For other header sizes OpenImageIO takes width and height from uninitialised memory.
    constexpr std::array<std::uint64_t, 6> kHeaders = {12, 40, 52, 56, 108, 124};
    const std::uint64_t header = numbers.at(14, 4);
    if (std::ranges::find(kHeaders, header) == kHeaders.end())
        return inputError(fmt::format("headers of {} bytes are not supported", header));
    if (14 + header > numbers.size())
        return inputError("its header extends past the end of the file");
    if (header == kHeaders[0]) // of OS/2, without compression
        return std::nullopt;
    const std::uint64_t bits = numbers.at(28, 2), compression = numbers.at(30, 4);
    const std::uint64_t width = numbers.at(18, 4), below = numbers.at(22, 4);
    const std::uint64_t height = below < 0x80000000 ? below : 0x100000000 - below; // negative: rows from the top
    const std::uint64_t runBits = compression == 1 ? 8 : compression == 2 ? 4 : 0;
    if (runBits != 0 && bits != runBits)
        return inputError(fmt::format("it has {} bits per pixel, compression {} has {}", bits, compression, runBits));
    // OpenImageIO allocates all pixels before the caller sees the size.
    if (runBits != 0 && height != 0 && width > limits.imageBytes / height)
        return memoryError(
            fmt::format("{} x {} pixels of one byte, the limit is {} bytes", width, height, limits.imageBytes));
    return std::nullopt;
}

namespace {

// Bytes of a block of 4 x 4 pixels, or of one pixel, of a DXGI_FORMAT.
struct DdsFormat {
    std::size_t block = 0, pixel = 0; // both 0: unknown
};

DdsFormat dxgiFormat(std::uint64_t format)
{
    struct Range {
        std::uint64_t first, last;
        DdsFormat bytes;
    };
    constexpr Range kRanges[] = {{1, 4, {0, 16}},  {5, 8, {0, 12}},   {9, 18, {0, 8}},   {23, 43, {0, 4}},
                                 {48, 59, {0, 2}}, {60, 65, {0, 1}},  {70, 72, {8, 0}},  {73, 78, {16, 0}},
                                 {79, 81, {8, 0}}, {82, 84, {16, 0}}, {85, 86, {0, 2}},  {87, 88, {0, 4}},
                                 {90, 91, {0, 4}}, {92, 93, {0, 4}},  {94, 96, {16, 0}}, {97, 99, {16, 0}}};
    for (const Range& range : kRanges)
        if (format >= range.first && format <= range.last)
            return range.bytes;
    return {};
}

DdsFormat ddsFormat(Numbers& numbers)
{
    constexpr std::uint64_t kFourCc = 0x4;
    const std::uint64_t flags = numbers.at(80, 4);
    if (!(flags & kFourCc)) {
        // RGB or luminance, with or without alpha. OpenImageIO treats anything else as RGB, and never returns if the
        // mask of a channel has no bits.
        constexpr std::uint64_t kAlpha = 0x1, kColours = 0x40, kLuminance = 0x20000;
        const std::uint64_t kind = flags & ~kAlpha;
        if (kind != kColours && kind != kLuminance)
            return {};
        for (std::uint64_t i = 0; i < 4; ++i)
            if ((i == 3 ? (flags & kAlpha) != 0 : i == 0 || kind == kColours) && numbers.at(92 + 4 * i, 4) == 0)
                return {};
        return {0, std::size_t(numbers.at(88, 4) / 8)};
    }
    std::string name;
    for (std::uint64_t i = 0; i < 4; ++i)
        name += char(numbers.at(84 + i, 1));
    if (name == "DX10")
        return dxgiFormat(numbers.at(128, 4));
    // One channel flagged as a normal map is refused: OpenImageIO makes three channels from two that do not exist.
    constexpr std::uint64_t kNormalMap = 0x80000000;
    if (name == "ATI1" || name == "BC4U" || name == "BC4S")
        return {flags & kNormalMap ? std::size_t(0) : std::size_t(8), 0};
    if (name == "DXT1")
        return {8, 0};
    // Not DXT2 and DXT4, whose colours are premultiplied: OpenImageIO divides by an alpha of 0, which ends the process.
    constexpr std::array<std::string_view, 5> kSixteen = {"DXT3", "DXT5", "ATI2", "BC5U", "BC5S"};
    return {std::ranges::find(kSixteen, name) != kSixteen.end() ? std::size_t(16) : 0, 0};
}

} // namespace

// Microsoft's DDS_HEADER and DDS_HEADER_DXT10; only the first level is checked.
Problem checkDds(File& file, const LoadLimits&)
{
    Numbers numbers = numbersOf(file);
    const std::uint64_t height = numbers.at(12, 4), width = numbers.at(16, 4);
    const bool dx10 = (numbers.at(80, 4) & 0x4) && numbers.at(84, 4) == 0x30315844;
    const DdsFormat format = ddsFormat(numbers);
    const std::uint64_t header = dx10 ? 148 : 128;
    if (numbers.past || numbers.size() < header)
        return inputError("its header extends past the end of the file");
    if (format.block == 0 && format.pixel == 0)
        return inputError("its pixel format is not supported");
    // OpenImageIO loops over the number of levels for each face of a cube map.
    constexpr std::uint64_t kMaxLevels = 32;
    if (const std::uint64_t levels = numbers.at(28, 4); levels > kMaxLevels)
        return inputError(fmt::format("it has {} levels, the limit is {}", levels, kMaxLevels));
    const std::uint64_t blocks = ((width + 3) / 4) * ((height + 3) / 4);
    const std::uint64_t bytes = format.block > 0 ? blocks : width * height;
    const std::uint64_t each = format.block > 0 ? format.block : format.pixel;
    if (bytes > (numbers.size() - header) / each)
        return inputError(fmt::format("{} x {} pixels take {} times {} bytes, the file has {} after its header", width,
                                      height, bytes, each, numbers.size() - header));
    return std::nullopt;
}

} // namespace cotan::oiio
