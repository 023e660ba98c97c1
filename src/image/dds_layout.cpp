// Whether a DDS file holds the levels that its header promises.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "file_layout.hpp"

namespace cotan::oiio {

namespace {

// Bytes of a block of 4 x 4 pixels, or of one pixel, of the formats of DXGI_FORMAT.
struct DdsFormat {
    std::size_t block = 0, pixel = 0; // both 0: not known
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
    constexpr std::uint64_t kFourLetters = 0x4;
    const std::uint64_t flags = numbers.at(80, 4);
    if (!(flags & kFourLetters)) {
        // Colours or one brightness, with alpha or without. OpenImageIO takes anything else for colours, and does not
        // come back from a channel without bits in its mask.
        constexpr std::uint64_t kAlpha = 0x1, kColours = 0x40, kBrightness = 0x20000;
        const std::uint64_t kind = flags & ~kAlpha;
        if (kind != kColours && kind != kBrightness)
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
    // One channel as a normal map: OpenImageIO makes three channels of two that are not there.
    constexpr std::uint64_t kNormalMap = 0x80000000;
    if (name == "ATI1" || name == "BC4U" || name == "BC4S")
        return {flags & kNormalMap ? std::size_t(0) : std::size_t(8), 0};
    if (name == "DXT1")
        return {8, 0};
    // Not DXT2 and DXT4, whose colours are multiplied by alpha: OpenImageIO divides by an alpha of 0, which ends the
    // process.
    constexpr std::array<std::string_view, 5> kSixteen = {"DXT3", "DXT5", "ATI2", "BC5U", "BC5S"};
    return {std::ranges::find(kSixteen, name) != kSixteen.end() ? std::size_t(16) : 0, 0};
}

} // namespace

// Microsoft's DDS_HEADER and DDS_HEADER_DXT10; the first level only.
Problem checkDds(File& file, const LoadLimits&)
{
    Numbers numbers = numbersOf(file);
    const std::uint64_t height = numbers.at(12, 4), width = numbers.at(16, 4);
    const bool dx10 = (numbers.at(80, 4) & 0x4) && numbers.at(84, 4) == 0x30315844;
    const DdsFormat format = ddsFormat(numbers);
    const std::uint64_t header = dx10 ? 148 : 128;
    if (numbers.past || numbers.size() < header)
        return "its header goes on behind the end of the file";
    if (format.block == 0 && format.pixel == 0)
        return "its pixel format is not read here";
    // OpenImageIO counts up to the number of levels, for each tile of a cube.
    constexpr std::uint64_t kMaxLevels = 32;
    if (const std::uint64_t levels = numbers.at(28, 4); levels > kMaxLevels)
        return fmt::format("it has {} levels, the most is {}", levels, kMaxLevels);
    const std::uint64_t blocks = ((width + 3) / 4) * ((height + 3) / 4);
    const std::uint64_t bytes = format.block > 0 ? blocks : width * height;
    const std::uint64_t each = format.block > 0 ? format.block : format.pixel;
    if (bytes > (numbers.size() - header) / each)
        return fmt::format("{} x {} pixels take {} times {} bytes, the file has {} behind its header", width, height,
                           bytes, each, numbers.size() - header);
    return std::nullopt;
}

} // namespace cotan::oiio
