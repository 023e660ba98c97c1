// Whether a file holds what its header promises, before OpenImageIO's readers believe it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <fmt/format.h>

#include "oiio.hpp"

namespace cotan::oiio {

namespace {

using Problem = std::optional<std::string>;
using File = OIIO::Filesystem::IOProxy;

// Numbers at places in a file; what lies behind its end is 0, and `past` is set.
class Numbers {
public:
    Numbers(File& file, bool bigEndian) : file_(file), bigEndian_(bigEndian) {}

    std::uint64_t at(std::uint64_t offset, std::size_t bytes)
    {
        std::array<unsigned char, 8> raw{};
        if (offset > file_.size() || bytes > file_.size() - offset
            || file_.pread(raw.data(), bytes, std::int64_t(offset)) != bytes) {
            past = true;
            return 0;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i)
            value = value << 8 | raw[bigEndian_ ? i : bytes - 1 - i];
        return value;
    }

    std::uint64_t size() const { return file_.size(); }

    bool past = false;

private:
    File& file_;
    bool bigEndian_;
};

// ---- TIFF -----------------------------------------------------------------------------------

// Values of one tag of the directory: `count` of `size` bytes from `offset`. count 0: not there.
struct Tag {
    std::uint64_t count = 0, offset = 0;
    std::size_t size = 0;
};

// Bytes of the whole numbers of TIFF 6.0, section 2, and of BigTIFF, with and without sign; 0: another type.
std::size_t wholeNumberBytes(std::uint64_t type)
{
    switch (type) {
    case 1:
    case 6: return 1;
    case 3:
    case 8: return 2;
    case 4:
    case 9: return 4;
    case 16:
    case 17: return 8;
    default: return 0;
    }
}

class TiffDirectory {
public:
    explicit TiffDirectory(File& file) : numbers_(file, startsWithM(file))
    {
        const bool large = numbers_.at(2, 2) == 43; // BigTIFF
        const std::size_t word = large ? 8 : 4;
        const std::uint64_t start = numbers_.at(large ? 8 : 4, word);
        const std::uint64_t entries = numbers_.at(start, large ? 8 : 2);
        for (std::uint64_t i = 0; i < entries && !numbers_.past; ++i) {
            const std::uint64_t entry = start + (large ? 8 : 2) + i * (large ? 20 : 12);
            Tag tag{numbers_.at(entry + 4, word), entry + 4 + word, wholeNumberBytes(numbers_.at(entry + 2, 2))};
            if (tag.size == 0)
                tag = {}; // still the one that counts: the library passes over a second tag of the same number
            else if (tag.count > word / tag.size)
                tag.offset = numbers_.at(tag.offset, word);
            tags_.emplace_back(numbers_.at(entry, 2), tag);
        }
    }

    Tag find(std::uint64_t id) const
    {
        const auto found = std::ranges::find(tags_, id, &std::pair<std::uint64_t, Tag>::first);
        return found == tags_.end() ? Tag{} : found->second;
    }

    std::uint64_t value(const Tag& tag, std::uint64_t i) { return numbers_.at(tag.offset + i * tag.size, tag.size); }

    std::uint64_t valueOr(std::uint64_t id, std::uint64_t fallback)
    {
        const Tag tag = find(id);
        return tag.count > 0 ? value(tag, 0) : fallback;
    }

    bool past() const { return numbers_.past; }
    std::uint64_t fileSize() const { return numbers_.size(); }

private:
    static bool startsWithM(File& file)
    {
        char first = 0;
        return file.pread(&first, 1, 0) == 1 && first == 'M';
    }

    Numbers numbers_;
    std::vector<std::pair<std::uint64_t, Tag>> tags_;
};

// Bytes that the rows of a strip, or a tile, take where they are not compressed; 0: unknown.
std::uint64_t plainRowBytes(TiffDirectory& tiff, bool tiled, bool planes)
{
    const std::uint64_t width = tiled ? tiff.valueOr(322, 0) : tiff.valueOr(256, 0);
    const bool subsampled = tiff.valueOr(262, 0) == 6; // YCbCr
    if (tiff.valueOr(259, 1) != 1 || subsampled || width > 0xffffffff)
        return 0;
    const std::uint64_t bits = tiff.valueOr(258, 1) * (planes ? 1 : tiff.valueOr(277, 1));
    return (width * std::min<std::uint64_t>(bits, 0xffffff) + 7) / 8;
}

// Parts of `each` that cover `whole`, at least 1.
std::uint64_t partsOf(std::uint64_t whole, std::uint64_t each)
{
    constexpr std::uint64_t kMost = 0xffffffff;
    each = std::clamp<std::uint64_t>(each, 1, kMost);
    return std::max<std::uint64_t>(1, (std::min(whole, kMost) + each - 1) / each);
}

// What libtiff decodes. Of a picture compressed otherwise OpenImageIO hands out what the memory held.
bool knownTiffCompression(std::uint64_t method)
{
    constexpr std::array<std::uint64_t, 12> kKnown = {1, 2, 3, 4, 5, 7, 8, 32773, 32946, 34925, 50000, 50001};
    return std::ranges::find(kKnown, method) != kKnown.end();
}

// TIFF 6.0, sections 3, 7 and 15. The first picture only: it is the only one that is read.
Problem checkTiff(File& file, const LoadLimits& limits)
{
    TiffDirectory tiff(file);
    const bool tiled = tiff.find(324).count > 0, planes = tiff.valueOr(284, 1) == 2;
    const Tag offsets = tiff.find(tiled ? 324 : 273), counts = tiff.find(tiled ? 325 : 279);
    const std::uint64_t height = tiff.valueOr(257, 0);
    const std::uint64_t rows = std::max<std::uint64_t>(
        1, std::min(tiled ? tiff.valueOr(323, 0) : tiff.valueOr(278, height), std::uint64_t(0xffffffff)));
    const std::uint64_t strips = partsOf(height, rows);
    const std::uint64_t plane = strips * (tiled ? partsOf(tiff.valueOr(256, 0), tiff.valueOr(322, 0)) : 1);
    const std::uint64_t samples = planes ? std::clamp<std::uint64_t>(tiff.valueOr(277, 1), 1, 0xffff) : 1;
    const std::uint64_t expected = std::min(plane, std::uint64_t(1) << 40) * samples;
    const std::uint64_t rowBytes = plainRowBytes(tiff, tiled, planes);
    const char* const part = tiled ? "tile" : "strip";
    if (tiff.past())
        return "its directory lies behind the end of the file";
    if (tiff.find(258).count == 0) // 1 by the format; OpenImageIO takes it for 8
        return "its directory does not state the bits per sample";
    if (!knownTiffCompression(tiff.valueOr(259, 1)))
        return fmt::format("its compression {} is not read here", tiff.valueOr(259, 1));
    // OpenImageIO takes memory for all rows of a strip, 4 channels each. The largest number means: all in one strip.
    const std::uint64_t sampleBytes = 4 * std::clamp<std::uint64_t>(tiff.valueOr(258, 1) / 8, 1, 16);
    const std::uint64_t width = std::clamp<std::uint64_t>(tiff.valueOr(256, 0), 1, 0xffffffff);
    if (!tiled && rows > height && rows != 0xffffffff && rows > limits.imageBytes / sampleBytes / width)
        return fmt::format("its strips have {} rows, the picture {}", rows, height);
    if (offsets.count < expected)
        return fmt::format("its directory lists {} {}s, expected {}", offsets.count, part, expected);
    for (std::uint64_t i = 0; i < offsets.count; ++i) {
        const std::uint64_t offset = tiff.value(offsets, i), stored = i < counts.count ? tiff.value(counts, i) : 0;
        const std::uint64_t rowsHere = tiled ? rows : std::min(rows, height - std::min(height, i % strips * rows));
        const std::uint64_t plain = std::min(rowBytes * rowsHere, std::uint64_t(1) << 62);
        if (tiff.past())
            return "the list of its strips or tiles lies behind the end of the file";
        if (counts.count > 0 && stored == 0) // without any list the sizes follow from the picture's
            return fmt::format("{} {} has no bytes", part, i);
        if (stored > 0 && stored < plain)
            return fmt::format("{} {} has {} bytes, expected {}", part, i, stored, plain);
        const std::uint64_t needed = std::max<std::uint64_t>({stored, plain, 1});
        if (offset > tiff.fileSize() || needed > tiff.fileSize() - offset)
            return fmt::format("{} {} takes {} bytes from {}, the file has {}", part, i, needed, offset,
                               tiff.fileSize());
    }
    return std::nullopt;
}

// ---- OpenEXR --------------------------------------------------------------------------------

// Text up to its zero, at most 256 bytes: a name of that length has no end. `at` moves behind it.
constexpr std::size_t kNoEnd = 256;

std::string nameAt(Numbers& numbers, std::uint64_t& at)
{
    std::string name;
    while (name.size() < kNoEnd && !numbers.past)
        if (const auto c = char(numbers.at(at++, 1)))
            name += c;
        else
            break;
    return name;
}

// Bytes from `at` that OpenEXR takes for a value of this type. It keeps to `size` for unknown types and text only;
// where the two differ, the next attribute is not where the size says.
std::uint64_t exrValueBytes(Numbers& numbers, std::uint64_t at, std::string_view type, std::uint64_t size)
{
    constexpr std::array<std::pair<std::string_view, std::uint64_t>, 24> kFixed = {{{"box2f", 16},
                                                                                    {"box2i", 16},
                                                                                    {"chromaticities", 32},
                                                                                    {"compression", 1},
                                                                                    {"deepImageState", 1},
                                                                                    {"double", 8},
                                                                                    {"envmap", 1},
                                                                                    {"float", 4},
                                                                                    {"int", 4},
                                                                                    {"keycode", 28},
                                                                                    {"lineOrder", 1},
                                                                                    {"m33d", 72},
                                                                                    {"m33f", 36},
                                                                                    {"m44d", 128},
                                                                                    {"m44f", 64},
                                                                                    {"rational", 8},
                                                                                    {"tiledesc", 9},
                                                                                    {"timecode", 8},
                                                                                    {"v2d", 16},
                                                                                    {"v2f", 8},
                                                                                    {"v2i", 8},
                                                                                    {"v3d", 24},
                                                                                    {"v3f", 12},
                                                                                    {"v3i", 12}}};
    if (type == "chlist") {
        std::uint64_t end = at;
        while (!nameAt(numbers, end).empty() && !numbers.past)
            end += 16; // pixel type, linearity, two samplings
        return end - at;
    }
    if (type == "stringvector") {
        std::uint64_t taken = 0;
        while (taken < size && !numbers.past)
            taken += 4 + numbers.at(at + taken, 4);
        return taken;
    }
    if (type == "floatvector")
        return size / 4 * 4;
    if (type == "preview") {
        const std::uint64_t pixels = numbers.at(at, 4) * numbers.at(at + 4, 4);
        return pixels > size ? size + 1 : 8 + 4 * pixels;
    }
    const auto fixed = std::ranges::find(kFixed, type, &std::pair<std::string_view, std::uint64_t>::first);
    return fixed == kFixed.end() ? size : fixed->second;
}

// One attribute behind its name; `at` moves behind it.
Problem checkExrAttribute(Numbers& numbers, std::uint64_t& at)
{
    const std::string type = nameAt(numbers, at);
    const std::uint64_t size = numbers.at(at, 4);
    at += 4;
    if (numbers.past || type.size() >= kNoEnd || size > numbers.size() - at)
        return fmt::format("an attribute of its header takes {} bytes, the file has {} left", size,
                           numbers.size() - std::min(at, numbers.size()));
    const std::uint64_t taken = exrValueBytes(numbers, at, type, size);
    if (numbers.past || taken != size)
        return fmt::format("an attribute of its header has {} bytes, which its type does not take", size);
    at += size;
    return std::nullopt;
}

// What a header says about its blocks of rows or tiles. OpenEXR takes memory for one as soon as it opens a file.
struct ExrBlocks {
    std::int64_t width = 0, height = 0;
    std::uint64_t rows = 1; // in a block
    std::uint64_t channels = 0;
    std::uint64_t tileWidth = 0, tileHeight = 0;
};

// An attribute whose value ends at `end`.
void readExrBlocks(Numbers& numbers, std::string_view name, std::uint64_t start, std::uint64_t end, ExrBlocks& blocks)
{
    const auto number = [&](std::uint64_t at) { return std::int64_t(std::int32_t(numbers.at(at, 4))); };
    if (name == "dataWindow") {
        blocks.width = number(end - 8) - number(end - 16) + 1;
        blocks.height = number(end - 4) - number(end - 12) + 1;
    } else if (name == "compression") {
        constexpr std::array<std::uint64_t, 10> kRows = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
        const std::uint64_t method = numbers.at(end - 1, 1);
        blocks.rows = method < kRows.size() ? kRows[method] : 1;
    } else if (name == "tiles") {
        blocks.tileWidth = numbers.at(end - 9, 4);
        blocks.tileHeight = numbers.at(end - 5, 4);
    } else if (name == "channels") {
        while (start < end && !nameAt(numbers, start).empty()) {
            start += 16;
            ++blocks.channels;
        }
    }
}

Problem checkExrBlocks(const ExrBlocks& blocks, const LoadLimits& limits)
{
    if (blocks.width > limits.imageSide || blocks.height > limits.imageSide)
        return fmt::format("{} x {} pixels, the limit is {} a side", blocks.width, blocks.height, limits.imageSide);
    const std::uint64_t row = std::uint64_t(std::max<std::int64_t>(blocks.width, 1)) * blocks.rows;
    const std::uint64_t tile = blocks.tileWidth * blocks.tileHeight;                  // of 32 bits each
    const std::uint64_t bytes = 4 * std::min<std::uint64_t>(blocks.channels, 0xffff); // of a pixel
    if (std::max(row, tile) > limits.imageBytes / std::max<std::uint64_t>(bytes, 1))
        return fmt::format("its blocks have {} pixels of {} bytes, the limit is {} bytes", std::max(row, tile), bytes,
                           limits.imageBytes);
    return std::nullopt;
}

// "OpenEXR File Layout": attributes are name, type, size, bytes; an empty name ends a header, an
// empty header the headers of several parts.
Problem checkExr(File& file, const LoadLimits& limits)
{
    constexpr std::uint64_t kSeveralParts = 0x1000;
    Numbers numbers(file, /*bigEndian*/ false);
    std::uint64_t at = 8;
    const bool several = (numbers.at(4, 4) & kSeveralParts) != 0;
    for (bool first = true, more = true; more; first = false) {
        bool empty = true;
        ExrBlocks blocks;
        for (std::string name = nameAt(numbers, at); !name.empty(); name = nameAt(numbers, at), empty = false) {
            if (name.size() >= kNoEnd)
                return "an attribute of its header has a name without an end";
            const std::uint64_t start = at;
            std::uint64_t value = start;
            if (const Problem problem = checkExrAttribute(numbers, at))
                return problem;
            nameAt(numbers, value); // its type
            readExrBlocks(numbers, name, value + 4, at, blocks);
        }
        if (const Problem problem = checkExrBlocks(blocks, limits))
            return problem;
        if (numbers.past)
            return "its header goes on behind the end of the file";
        more = several && !(empty && !first);
    }
    return std::nullopt;
}

// ---- DDS ------------------------------------------------------------------------------------

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
    constexpr std::array<Range, 16> kRanges = {{{1, 4, {0, 16}},
                                                {5, 8, {0, 12}},
                                                {9, 18, {0, 8}},
                                                {23, 43, {0, 4}},
                                                {48, 59, {0, 2}},
                                                {60, 65, {0, 1}},
                                                {70, 72, {8, 0}},
                                                {73, 78, {16, 0}},
                                                {79, 81, {8, 0}},
                                                {82, 84, {16, 0}},
                                                {85, 86, {0, 2}},
                                                {87, 88, {0, 4}},
                                                {90, 91, {0, 4}},
                                                {92, 93, {0, 4}},
                                                {94, 96, {16, 0}},
                                                {97, 99, {16, 0}}}};
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
        // OpenImageIO does not come back from a channel that is there but has no bits in its mask.
        const bool alpha = (flags & 0x3) != 0;
        const std::uint64_t colours = flags & 0x40 ? 3 : flags & 0x20000 ? 1 : 0;
        bool masks = colours > 0 || alpha;
        for (std::uint64_t i = 0; i < 4; ++i)
            masks = masks && ((i < 3 ? i >= colours : !alpha) || numbers.at(92 + 4 * i, 4) != 0);
        return {0, masks ? std::size_t(numbers.at(88, 4) / 8) : 0};
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

// Microsoft's DDS_HEADER and DDS_HEADER_DXT10; the first level only.
Problem checkDds(File& file)
{
    Numbers numbers(file, /*bigEndian*/ false);
    const std::uint64_t height = numbers.at(12, 4), width = numbers.at(16, 4);
    const bool dx10 = (numbers.at(80, 4) & 0x4) && numbers.at(84, 4) == 0x30315844;
    const DdsFormat format = ddsFormat(numbers);
    const std::uint64_t header = dx10 ? 148 : 128;
    if (numbers.past || numbers.size() < header)
        return "its header goes on behind the end of the file";
    if (format.block == 0 && format.pixel == 0)
        return "its pixel format is not read here";
    // OpenImageIO counts up to the number of levels, for each tile of a cube.
    constexpr std::uint64_t kMostLevels = 32;
    if (const std::uint64_t levels = numbers.at(28, 4); levels > kMostLevels)
        return fmt::format("it has {} levels, the most is {}", levels, kMostLevels);
    const std::uint64_t blocks = ((width + 3) / 4) * ((height + 3) / 4);
    const std::uint64_t bytes = format.block > 0 ? blocks : width * height;
    const std::uint64_t each = format.block > 0 ? format.block : format.pixel;
    if (bytes > (numbers.size() - header) / each)
        return fmt::format("{} x {} pixels take {} times {} bytes, the file has {} behind its header", width, height,
                           bytes, each, numbers.size() - header);
    return std::nullopt;
}

} // namespace

Problem checkFileLayout(File& file, const std::string& format, const LoadLimits& limits)
{
    if (format == "tiff")
        return checkTiff(file, limits);
    if (format == "openexr")
        return checkExr(file, limits);
    if (format == "dds")
        return checkDds(file);
    return std::nullopt;
}

} // namespace cotan::oiio
