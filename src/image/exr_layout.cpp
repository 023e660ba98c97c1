// Checks that an OpenEXR file holds the attributes and blocks that its header describes.
#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "oiio.hpp"

namespace cotan::oiio {

namespace {

// A null-terminated string; `at` moves past its terminator. Stops at 256 bytes: such a name is unterminated.
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

// The number of bytes from `at` that OpenEXR reads for a value of this type. It honours `size` for unknown types and
// text only. If the two differ, OpenEXR looks for the next attribute at another offset than `size` gives.
std::uint64_t exrValueBytes(Numbers& numbers, std::uint64_t at, std::string_view type, std::uint64_t size)
{
    constexpr Named<std::uint64_t> kFixed[] = {
        {"compression", 1}, {"deepImageState", 1}, {"envmap", 1},   {"lineOrder", 1}, {"float", 4},
        {"int", 4},         {"double", 8},         {"rational", 8}, {"timecode", 8},  {"v2f", 8},
        {"v2i", 8},         {"tiledesc", 9},       {"v3f", 12},     {"v3i", 12},      {"box2f", 16},
        {"box2i", 16},      {"v2d", 16},           {"v3d", 24},     {"keycode", 28},  {"chromaticities", 32},
        {"m33f", 36},       {"m44f", 64},          {"m33d", 72},    {"m44d", 128}};
    if (type == "chlist") {
        std::uint64_t end = at;
        while (!nameAt(numbers, end).empty() && !numbers.past)
            end += 16; // pixel type, linearity, two sampling rates
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
    return valueOf(kFixed, type).value_or(size);
}

// Checks the attribute whose name ends at `at`, and moves `at` past it.
Problem checkExrAttribute(Numbers& numbers, std::uint64_t& at)
{
    const std::string type = nameAt(numbers, at);
    const std::uint64_t size = numbers.at(at, 4);
    at += 4;
    if (numbers.past || type.size() >= kNoEnd || size > numbers.size() - at)
        return inputError(fmt::format("an attribute of its header takes {} bytes, the file has {} left", size,
                                      numbers.size() - std::min(at, numbers.size())));
    const std::uint64_t taken = exrValueBytes(numbers, at, type, size);
    if (numbers.past || taken != size)
        return inputError(fmt::format("an attribute of its header has {} bytes, which do not fit its type", size));
    at += size;
    return std::nullopt;
}

// What a header states about its blocks of rows or tiles. OpenEXR allocates a block as soon as it opens a file.
struct ExrBlocks {
    std::int64_t width = 0, height = 0; // 0: not stated
    std::uint64_t rows = 0;             // per block; 0: not stated
    std::uint64_t channels = 0;
    std::uint64_t pixelBytes = 0; // 0: unknown, since a channel is subsampled
    std::uint64_t tileWidth = 0, tileHeight = 0;
    bool compressed = true;
    bool deep = false; // lists of samples per pixel, which OpenImageIO refuses
};

// Records the attribute `name`, whose value is [start,end), in `blocks`.
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
        blocks.compressed = method != 0;
    } else if (name == "tiles") {
        blocks.tileWidth = numbers.at(end - 9, 4);
        blocks.tileHeight = numbers.at(end - 5, 4);
    } else if (name == "channels") {
        bool all = true;
        while (start < end && !nameAt(numbers, start).empty()) {
            constexpr std::uint64_t kHalf = 1;
            blocks.pixelBytes += numbers.at(start, 4) == kHalf ? 2 : 4;
            all = all && numbers.at(start + 8, 4) == 1 && numbers.at(start + 12, 4) == 1;
            start += 16;
            ++blocks.channels;
        }
        if (!all)
            blocks.pixelBytes = 0;
    } else if (name == "type") {
        blocks.deep = nameAt(numbers, start).starts_with("deep");
    }
}

Problem checkExrBlocks(const ExrBlocks& blocks, const LoadLimits& limits)
{
    if (blocks.width > limits.imageSide || blocks.height > limits.imageSide)
        return memoryError(
            fmt::format("{} x {} pixels, the limit is {} per side", blocks.width, blocks.height, limits.imageSide));
    const std::uint64_t row =
        std::uint64_t(std::max<std::int64_t>(blocks.width, 1)) * std::max<std::uint64_t>(blocks.rows, 1);
    const std::uint64_t tile = blocks.tileWidth * blocks.tileHeight;                  // of two 32-bit factors
    const std::uint64_t bytes = 4 * std::min<std::uint64_t>(blocks.channels, 0xffff); // per pixel
    if (std::max(row, tile) > limits.imageBytes / std::max<std::uint64_t>(bytes, 1))
        return memoryError(fmt::format("its blocks have {} pixels of {} bytes, the limit is {} bytes",
                                       std::max(row, tile), bytes, limits.imageBytes));
    return std::nullopt;
}

// Checks the blocks of the first part, of level 0 if it is tiled: `table` is the offset of its offset table, and each
// block must hold its pixels. OpenEXR returns uninitialised memory for shorter blocks.
Problem checkExrTable(Numbers& numbers, std::uint64_t table, bool several, const ExrBlocks& blocks)
{
    if (blocks.deep)
        return std::nullopt;
    if (blocks.width <= 0 || blocks.height <= 0 || blocks.rows == 0 || blocks.channels == 0)
        return inputError("its header lacks a data window, a compression or channels");
    const bool tiled = blocks.tileWidth > 0 && blocks.tileHeight > 0;
    const auto width = std::uint64_t(blocks.width), height = std::uint64_t(blocks.height);
    const std::uint64_t wide = tiled ? blocks.tileWidth : width, high = tiled ? blocks.tileHeight : blocks.rows;
    const std::uint64_t across = (width + wide - 1) / wide, count = across * ((height + high - 1) / high);
    const std::uint64_t before = (several ? 4 : 0) + (tiled ? 16 : 4); // part number, and block coordinates
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t at = numbers.at(table + 8 * i, 8);
        if (at == 0 || at > numbers.size() || numbers.past)
            return inputError(fmt::format("block {} of {} is not in the file", i, count));
        const std::uint64_t stored = numbers.at(at + before, 4), begin = at + before + 4;
        const std::uint64_t pixels =
            std::min(wide, width - i % across * wide) * std::min(high, height - i / across * high);
        const std::uint64_t needed = std::max<std::uint64_t>(blocks.compressed ? 1 : pixels * blocks.pixelBytes, 1);
        if (stored < needed)
            return inputError(fmt::format("block {} has {} bytes, expected {}", i, stored, needed));
        if (begin > numbers.size() || stored > numbers.size() - begin)
            return inputError(
                fmt::format("block {} takes {} bytes from {}, the file has {}", i, stored, begin, numbers.size()));
    }
    return std::nullopt;
}

} // namespace

// "OpenEXR File Layout": an attribute is name, type, size, bytes; an empty name ends a header, and an empty header ends
// the headers of a multi-part file.
Problem checkExr(File& file, const LoadLimits& limits)
{
    constexpr std::uint64_t kSeveralParts = 0x1000;
    Numbers numbers = numbersOf(file);
    std::uint64_t at = 8;
    const bool several = (numbers.at(4, 4) & kSeveralParts) != 0;
    ExrBlocks first;
    for (bool begins = true, more = true; more; begins = false) {
        bool empty = true;
        ExrBlocks blocks;
        for (std::string name = nameAt(numbers, at); !name.empty(); name = nameAt(numbers, at), empty = false) {
            if (name.size() >= kNoEnd)
                return inputError("an attribute of its header has a name without an end");
            const std::uint64_t start = at;
            std::uint64_t value = start;
            if (const Problem problem = checkExrAttribute(numbers, at))
                return problem;
            nameAt(numbers, value); // skips its type
            readExrBlocks(numbers, name, value + 4, at, blocks);
        }
        if (const Problem problem = checkExrBlocks(blocks, limits))
            return problem;
        if (numbers.past)
            return inputError("its header extends past the end of the file");
        if (begins)
            first = blocks;
        more = several && !empty;
    }
    return checkExrTable(numbers, at, several, first);
}

} // namespace cotan::oiio
