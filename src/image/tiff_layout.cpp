// Checks that a TIFF file holds the strips and tiles that its directory lists.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "oiio.hpp"

namespace cotan::oiio {

namespace {

// Values of one tag of the directory: `count` values of `size` bytes from `offset` on. count 0: absent.
struct Tag {
    std::uint64_t count = 0, offset = 0;
    std::size_t size = 0;
};

// Bytes of an integer type, signed or unsigned, of TIFF 6.0, section 2, and of BigTIFF; 0: another type.
std::size_t wholeNumberBytes(std::uint64_t type)
{
    constexpr std::array<std::size_t, 18> kBytes = {0, 1, 0, 2, 4, 0, 1, 0, 2, 4, 0, 0, 0, 0, 0, 0, 8, 8}; // by type
    return type < kBytes.size() ? kBytes[type] : 0;
}

class TiffDirectory {
public:
    explicit TiffDirectory(File& file) : numbers_(numbersOf(file, startsWithM(file)))
    {
        const bool large = numbers_.at(2, 2) == 43; // BigTIFF
        const std::size_t word = large ? 8 : 4;
        const std::uint64_t start = numbers_.at(large ? 8 : 4, word);
        const std::uint64_t entries = numbers_.at(start, large ? 8 : 2);
        for (std::uint64_t i = 0; i < entries && !numbers_.past; ++i) {
            const std::uint64_t entry = start + (large ? 8 : 2) + i * (large ? 20 : 12);
            Tag tag{numbers_.at(entry + 4, word), entry + 4 + word, wholeNumberBytes(numbers_.at(entry + 2, 2))};
            if (tag.size == 0)
                tag = {}; // kept, since libtiff ignores a second tag of the same number
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

// Bytes of an uncompressed row of a strip or tile; 0: unknown.
std::uint64_t plainRowBytes(TiffDirectory& tiff, bool tiled, bool planes)
{
    const std::uint64_t width = tiled ? tiff.valueOr(322, 0) : tiff.valueOr(256, 0);
    const bool subsampled = tiff.valueOr(262, 0) == 6; // YCbCr
    if (tiff.valueOr(259, 1) != 1 || subsampled || width > 0xffffffff)
        return 0;
    const std::uint64_t bits = tiff.valueOr(258, 1) * (planes ? 1 : tiff.valueOr(277, 1));
    return (width * std::min<std::uint64_t>(bits, 0xffffff) + 7) / 8;
}

// The number of parts of size `each` that cover `whole`, at least 1.
std::uint64_t partsOf(std::uint64_t whole, std::uint64_t each)
{
    constexpr std::uint64_t kMax = 0xffffffff;
    each = std::clamp<std::uint64_t>(each, 1, kMax);
    return std::max<std::uint64_t>(1, (std::min(whole, kMax) + each - 1) / each);
}

} // namespace

// TIFF 6.0, sections 3, 7 and 15. Checks the first image only, since no other is read.
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
        return inputError("its directory extends past the end of the file");
    if (tiff.find(258).count == 0) // 1 by the format; OpenImageIO assumes 8
        return inputError("its directory does not state the bits per sample");
    // The methods that libtiff decodes. For others OpenImageIO returns uninitialised memory.
    constexpr std::array<std::uint64_t, 12> kKnown = {1, 2, 3, 4, 5, 7, 8, 32773, 32946, 34925, 50000, 50001};
    if (const std::uint64_t method = tiff.valueOr(259, 1); std::ranges::find(kKnown, method) == kKnown.end())
        return inputError(fmt::format("its compression {} is not supported", method));
    // OpenImageIO allocates all rows of a strip, 4 channels each. 0xffffffff means a single strip.
    const std::uint64_t sampleBytes = 4 * std::clamp<std::uint64_t>(tiff.valueOr(258, 1) / 8, 1, 16);
    const std::uint64_t width = std::clamp<std::uint64_t>(tiff.valueOr(256, 0), 1, 0xffffffff);
    if (!tiled && rows > height && rows != 0xffffffff && rows > limits.imageBytes / sampleBytes / width)
        return inputError(fmt::format("its strips have {} rows, the image {}", rows, height));
    if (offsets.count < expected)
        return inputError(fmt::format("its directory lists {} {}s, expected {}", offsets.count, part, expected));
    for (std::uint64_t i = 0; i < offsets.count; ++i) {
        const std::uint64_t offset = tiff.value(offsets, i), stored = i < counts.count ? tiff.value(counts, i) : 0;
        const std::uint64_t rowsHere = tiled ? rows : std::min(rows, height - std::min(height, i % strips * rows));
        const std::uint64_t plain = std::min(rowBytes * rowsHere, std::uint64_t(1) << 62);
        if (tiff.past())
            return inputError("the list of its strips or tiles extends past the end of the file");
        if (counts.count > 0 && stored == 0) // without this list the sizes follow from the image size
            return inputError(fmt::format("{} {} has no bytes", part, i));
        if (stored > 0 && stored < plain)
            return inputError(fmt::format("{} {} has {} bytes, expected {}", part, i, stored, plain));
        const std::uint64_t needed = std::max<std::uint64_t>({stored, plain, 1});
        if (offset > tiff.fileSize() || needed > tiff.fileSize() - offset)
            return inputError(
                fmt::format("{} {} takes {} bytes from {}, the file has {}", part, i, needed, offset, tiff.fileSize()));
    }
    return std::nullopt;
}

} // namespace cotan::oiio
