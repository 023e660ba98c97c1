#include "image/basis.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/try.hpp"
#include "image/uastc.hpp"

namespace cotan {

namespace {

constexpr std::uint64_t kEtc1sModel = 163, kUastcModel = 166; // KHR_DF_MODEL

// Channel types of the samples of a descriptor (KTX 2.0, "Providing additional information"); `second` of ETC1S only.
struct ChannelTypes {
    bool etc1s;
    int first, second;
    BasisChannels channels;
    const char* name;
};
constexpr int kNone = -1;
constexpr std::array<ChannelTypes, 9> kChannelTypes{{{false, 0, kNone, BasisChannels::rgb, "RGB"},
                                                     {false, 3, kNone, BasisChannels::rgba, "RGBA"},
                                                     {false, 4, kNone, BasisChannels::red, "RRR"},
                                                     {false, 5, kNone, BasisChannels::redAlpha, "RRRG"},
                                                     {false, 6, kNone, BasisChannels::redGreen, "RG"},
                                                     {true, 0, kNone, BasisChannels::rgb, "RGB"},
                                                     {true, 0, 15, BasisChannels::rgba, "RGB and AAA"},
                                                     {true, 3, kNone, BasisChannels::red, "RRR"},
                                                     {true, 3, 4, BasisChannels::redAlpha, "RRR and GGG"}}};

const char* nameOf(const BasisLayout& layout)
{
    return std::ranges::find_if(
               kChannelTypes,
               [&](const ChannelTypes& t) { return t.etc1s == layout.etc1s && t.channels == layout.channels; })
        ->name;
}

// Global data of BasisLZ: five numbers, a description of each image, and four parts.
constexpr std::uint64_t kGlobalHeader = 20, kImageEntry = 20;

// The slices of the image of one level, of `bytes` bytes.
Status checkSlices(Numbers& file, std::uint64_t entry, std::size_t level, std::uint64_t bytes, int slices)
{
    constexpr std::uint64_t kPredictedFrame = 2;
    if ((file.at(entry, 4) & kPredictedFrame) != 0)
        return inputError(
            fmt::format("ETC1S: image {} is a predicted frame of a video; expected a still image", level));
    for (int slice = 0; slice < 2; ++slice) {
        const std::uint64_t offset = file.at(entry + 4 + 8 * std::uint64_t(slice), 4),
                            length = file.at(entry + 8 + 8 * std::uint64_t(slice), 4);
        if ((length > 0) != (slice < slices))
            return inputError(fmt::format("ETC1S: slice {} of level {} has {} bytes; its descriptor has {} slices",
                                          slice, level, length, slices));
        if (offset > bytes || length > bytes - offset)
            return inputError(fmt::format("ETC1S: slice {} of level {} takes {} bytes from {}, the level has {}", slice,
                                          level, length, offset, bytes));
    }
    return Done{};
}

} // namespace

int BasisLayout::channelCount() const
{
    switch (channels) {
    case BasisChannels::red: return 1;
    case BasisChannels::redGreen:
    case BasisChannels::redAlpha: return 2;
    case BasisChannels::rgb: return 3;
    case BasisChannels::rgba: return 4;
    }
    return 4;
}

Result<BasisLayout> readBasisLayout(Numbers& file)
{
    const std::uint64_t start = file.at(48, 4), length = file.at(52, 4);
    if (start > file.size() || length > file.size() - start)
        return inputError(
            fmt::format("its descriptor takes {} bytes from {}, the file has {}", length, start, file.size()));
    const std::uint64_t model = file.at(start + 12, 1), block = file.at(start + 10, 2);
    if (model != kEtc1sModel && model != kUastcModel)
        return inputError(
            fmt::format("its format is in its descriptor, with the colour model {}; expected {} (ETC1S) or {} "
                        "(UASTC)",
                        model, kEtc1sModel, kUastcModel));
    const bool etc1s = model == kEtc1sModel;
    const std::uint64_t samples = block < 24 ? 0 : (block - 24) / 16;
    if (length < 4 + block || (samples != 1 && (!etc1s || samples != 2)))
        return inputError(fmt::format("its descriptor has {} channels in {} bytes; expected {}", samples, length,
                                      etc1s ? "1 or 2 (ETC1S)" : "1 (UASTC)"));
    const auto typeOf = [&](std::uint64_t sample) { return int(file.at(start + 31 + 16 * sample, 1) & 15); };
    const int first = typeOf(0), second = samples == 2 ? typeOf(1) : kNone;
    const auto* const known = std::ranges::find_if(kChannelTypes, [&](const ChannelTypes& t) {
        return t.etc1s == etc1s && t.first == first && t.second == second;
    });
    if (known == kChannelTypes.end())
        return inputError(fmt::format("its descriptor has the channel type {}{}; expected {}", first,
                                      second == kNone ? "" : fmt::format(" and {}", second),
                                      etc1s ? "0, 0 and 15, 3, or 3 and 4 (ETC1S)" : "0, 3, 4, 5 or 6 (UASTC)"));
    const std::uint64_t packing = file.at(44, 4);
    if ((packing == 1) != etc1s)
        return inputError(fmt::format("its supercompression is {}; expected {}", packing,
                                      etc1s ? "1 (BasisLZ) for ETC1S" : "0, 2 or 3 for UASTC"));
    return BasisLayout{etc1s, known->channels};
}

Result<Etc1sParts> readEtc1sParts(Numbers& file, std::span<const std::byte> bytes, const BasisLayout& layout,
                                  std::span<const std::uint64_t> levelSizes, std::span<const std::byte> level)
{
    const std::uint64_t start = file.at(64, 8), length = file.at(72, 8);
    if (start > file.size() || length > file.size() - start)
        return inputError(
            fmt::format("its global data take {} bytes from {}, the file has {}", length, start, file.size()));
    std::array<std::uint64_t, 4> sizes{}; // endpoints, selectors, tables, and an extension that ETC1S has not
    std::uint64_t total = kGlobalHeader + kImageEntry * levelSizes.size();
    for (std::size_t i = 0; i < sizes.size(); ++i)
        total += sizes[i] = file.at(start + 4 + 4 * i, 4);
    if (length != total || sizes[3] != 0)
        return inputError(fmt::format("its global data have {} bytes; its parts of {}, {}, {} and {} bytes require {}",
                                      length, sizes[0], sizes[1], sizes[2], sizes[3], total - sizes[3]));
    for (std::size_t i = 0; i < levelSizes.size(); ++i)
        COTAN_CHECK(checkSlices(file, start + kGlobalHeader + kImageEntry * i, i, levelSizes[i], layout.slices()));
    Etc1sParts parts{std::uint32_t(file.at(start, 2)), std::uint32_t(file.at(start + 2, 2)), {}, {}, {}, {}, {}};
    std::uint64_t at = start + kGlobalHeader + kImageEntry * levelSizes.size();
    std::size_t size = 0;
    for (auto* part : {&parts.endpoints, &parts.selectors, &parts.tables}) {
        *part = bytes.subspan(std::size_t(at), std::size_t(sizes[size]));
        at += sizes[size++];
    }
    std::uint64_t entry = start + kGlobalHeader + 4;
    for (auto* slice : {&parts.color, &parts.second}) {
        *slice = level.subspan(std::size_t(file.at(entry, 4)), std::size_t(file.at(entry + 4, 4)));
        entry += 8;
    }
    return parts;
}

Status checkBasisSwizzle(const BasisLayout& layout, const std::string& swizzle)
{
    const bool atAlpha = layout.channels == BasisChannels::redAlpha && (swizzle.starts_with("ra") || swizzle == "rrrg");
    if (layout.channelCount() != 2 || swizzle.empty() || swizzle.starts_with("rg") || atAlpha)
        return Done{};
    return inputError(
        fmt::format("KTXswizzle {} contradicts its descriptor, whose channels are {}", swizzle, nameOf(layout)));
}

Status decodeBasis(const BasisLayout& layout, std::span<const std::byte> blocks, const Etc1sParts& parts, Image& image)
{
    COTAN_CHECK(layout.etc1s ? decodeEtc1s(parts, image) : decodeUastc(blocks, image));
    const int channels = layout.channelCount();
    std::uint8_t* to = image.bytes8();
    for (std::size_t i = 0; channels < 4 && i < image.pixelCount(); ++i, to += 4) {
        if (channels != 2 && to[3] != 255)
            return inputError(fmt::format("texel {}, {} has the alpha {} of 255, its descriptor has the channels {}",
                                          i % std::size_t(image.width), i / std::size_t(image.width), to[3],
                                          nameOf(layout)));
        if (channels == 1)
            to[1] = to[2] = to[0];
        else if (channels == 2) {
            to[1] = layout.channels == BasisChannels::redAlpha ? to[3] : to[1];
            to[2] = 128;
            to[3] = 255;
        }
    }
    return Done{};
}

} // namespace cotan
