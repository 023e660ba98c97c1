// Whether a KTX2 file holds the levels that its header promises.
#include <algorithm>
#include <array>
#include <bit>

#include <fmt/format.h>

#include "image/frame_key.hpp"
#include "ktx2.hpp"
#include "numbers.hpp"

namespace cotan {

namespace {

// VkFormat of Vulkan 1.3, sRGB beside linear: values stay as they are stored.
constexpr Ktx2Format kVulkanFormats[] = {{9, 15, 1, 1},
                                         {16, 22, 2, 1},
                                         {23, 29, 3, 1},
                                         {30, 36, 3, 1, false, true},
                                         {37, 43, 4, 1},
                                         {44, 50, 4, 1, false, true},
                                         {51, 57, 4, 1},
                                         {70, 70, 1, 2},
                                         {76, 76, 1, 2, true},
                                         {77, 77, 2, 2},
                                         {83, 83, 2, 2, true},
                                         {84, 84, 3, 2},
                                         {90, 90, 3, 2, true},
                                         {91, 91, 4, 2},
                                         {97, 97, 4, 2, true},
                                         {100, 100, 1, 4, true},
                                         {103, 103, 2, 4, true},
                                         {106, 106, 3, 4, true},
                                         {109, 109, 4, 4, true},
                                         {131, 132, 4, 0, false, false, "DXT1", 0, 8},
                                         {133, 134, 4, 0, false, false, "DXT1", 0, 8},
                                         {135, 136, 4, 0, false, false, "DXT3", 0, 16},
                                         {137, 138, 4, 0, false, false, "DXT5", 0, 16},
                                         {139, 139, 1, 0, false, false, "DX10", 80, 8},
                                         {141, 141, 2, 0, false, false, "DX10", 83, 16},
                                         {145, 146, 4, 0, false, false, "DX10", 98, 16}};

constexpr std::uint64_t kHeader = 80, kLevelEntry = 24;

// The model of the colours in the data format descriptor: 163 is ETC1S, 166 UASTC.
std::uint64_t colourModel(Numbers& file) { return file.at(file.at(48, 4) + 12, 1); }

std::uint64_t storedBytes(const Ktx2Format& format, std::uint64_t width, std::uint64_t height)
{
    if (format.bytes == 0)
        return (width + 3) / 4 * ((height + 3) / 4) * format.block;
    return width * height * std::uint64_t(format.channels * format.bytes);
}

// Keys and values, each a length, a text with its zero, a value, and zeros up to a multiple of four.
Status readKeys(Numbers& file, std::span<const std::byte> bytes, Ktx2Picture& picture)
{
    const std::uint64_t start = file.at(56, 4), length = file.at(60, 4);
    if (length > 0 && (start > file.size() || length > file.size() - start))
        return inputError(fmt::format("its keys take {} bytes from {}, the file has {}", length, start, file.size()));
    const std::uint64_t end = start + length;
    for (std::uint64_t at = start; at + 4 <= end;) {
        const std::uint64_t size = file.at(at, 4);
        if (size > end - at - 4)
            return inputError(fmt::format("a key and its value take {} bytes, {} are left", size, end - at - 4));
        const std::string_view entry(reinterpret_cast<const char*>(bytes.data()) + at + 4, std::size_t(size));
        const std::size_t zero = std::min(entry.find('\0'), entry.size());
        std::string_view value = entry.substr(std::min(zero + 1, entry.size()));
        value = value.substr(0, value.find('\0'));
        if (entry.substr(0, zero) == "KTXswizzle") {
            if (value.size() != 4 || value.find_first_not_of("rgba01") != value.npos)
                return inputError("KTXswizzle: expected four of r, g, b, a, 0, 1");
            picture.swizzle = value;
        } else if (entry.substr(0, zero) == "KTXorientation") {
            if (value != "rd" && value != "ru")
                return inputError("KTXorientation: expected \"rd\" or \"ru\"");
            picture.bottomUp = value == "ru";
        } else if (entry.substr(0, zero) == kFrameKey) {
            picture.frame = frameText(value);
        }
        at += 4 + (size + 3) / 4 * 4;
    }
    return Done{};
}

} // namespace

std::string foreignKtx2(std::span<const std::byte> bytes)
{
    Numbers file(bytes);
    const std::uint64_t format = file.at(12, 4);
    if (!file.says(0, "\xabKTX 20\xbb\r\n\x1a\n") || bytes.size() < kHeader)
        return "";
    if (format == 0)
        return colourModel(file) == 166 ? "BasisU (UASTC)" : "BasisU (ETC1S)";
    if (format >= 147 && format <= 156)
        return "ETC2";
    return (format >= 157 && format <= 184) || (format >= 1000066000 && format <= 1000066013) ? "ASTC" : "";
}

Result<Ktx2Picture> checkKtx2(std::span<const std::byte> bytes)
{
    Numbers file(bytes);
    if (!file.says(0, "\xabKTX 20\xbb\r\n\x1a\n") || bytes.size() < kHeader)
        return inputError(fmt::format("its header takes {} bytes, the file has {}", kHeader, bytes.size()));
    const std::uint64_t format = file.at(12, 4), width = file.at(20, 4), height = file.at(24, 4),
                        depth = file.at(28, 4), layers = file.at(32, 4), faces = file.at(36, 4),
                        levels = file.at(40, 4);
    const auto known = std::ranges::find_if(
        kVulkanFormats, [&](const Ktx2Format& f) { return f.linear == format || f.srgb == format; });
    if (known == std::end(kVulkanFormats))
        return inputError(fmt::format("its format {} (VkFormat) is not read here", format));
    if (width == 0 || height == 0 || depth > 1 || layers > 1 || faces != 1)
        return inputError(fmt::format("expected one flat picture, found {} x {} x {}, {} layers, {} faces", width,
                                      height, depth, layers, faces));
    constexpr std::uint64_t kMaxSide = 1 << 24;
    if (width > kMaxSide || height > kMaxSide)
        return inputError(fmt::format("its size is {} x {}", width, height));
    if (levels > std::uint64_t(std::bit_width(std::max(width, height))))
        return inputError(fmt::format("it has {} levels, {} x {} pixels have {}", levels, width, height,
                                      std::bit_width(std::max(width, height))));
    Ktx2Picture picture{*known, int(width), int(height), std::uint32_t(file.at(44, 4)), {}, 0, {}, false, {}};
    if (picture.packing == 1 || picture.packing > 3)
        return inputError(
            fmt::format("its supercompression {} is not that of its format, or not known", picture.packing));
    for (std::uint64_t level = 0; level < std::max<std::uint64_t>(levels, 1); ++level) {
        const std::uint64_t entry = kHeader + level * kLevelEntry, offset = file.at(entry, 8),
                            stored = file.at(entry + 8, 8), plain = file.at(entry + 16, 8);
        const std::uint64_t expected = storedBytes(*known, std::max<std::uint64_t>(width >> level, 1),
                                                   std::max<std::uint64_t>(height >> level, 1));
        if (file.past)
            return inputError("the list of its levels lies behind the end of the file");
        if (offset > file.size() || stored > file.size() - offset)
            return inputError(
                fmt::format("level {} takes {} bytes from {}, the file has {}", level, stored, offset, file.size()));
        if (plain != expected || (picture.packing == 0 && stored != expected))
            return inputError(fmt::format("level {} has {} bytes, {} as stored; its size asks for {}", level, plain,
                                          stored, expected));
        if (level == 0) {
            picture.stored = bytes.subspan(std::size_t(offset), std::size_t(stored));
            picture.bytes = std::size_t(expected);
        }
    }
    if (Status keys = readKeys(file, bytes, picture); !keys)
        return keys.error();
    return picture;
}

} // namespace cotan
