// KTX 2.0, a container for GPU textures (Khronos specification, version 2.0.4).
#include "codecs.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <glm/detail/type_half.hpp>

#include "core/try.hpp"
#include "formats.hpp"
#include "image/astc.hpp"
#include "image/basis.hpp"
#include "image/bc.hpp"
#include "image/checks.hpp"
#include "image/component_types.hpp"
#include "image/dds.hpp"
#include "image/etc.hpp"
#include "numbers.hpp"

namespace cotan {

namespace {

// Blocks of width x height pixels.
struct BlockFormat {
    std::uint32_t dxgi = 0;     // BC6H, which OpenImageIO decodes in DDS
    std::optional<BcCode> bc;   // decodeBc
    std::optional<EtcCode> etc; // decodeEtc
    int width = 4, height = 4;  // with none of them: ASTC
    std::uint32_t bytes() const { return bc ? std::uint32_t(bcBytes(*bc)) : etc ? std::uint32_t(etcBytes(*etc)) : 16; }
};

constexpr BlockFormat bc6(std::uint32_t dxgi) { return {dxgi, std::nullopt, std::nullopt, 4, 4}; }
constexpr BlockFormat bc(BcCode code) { return {0, code, std::nullopt, 4, 4}; }
constexpr BlockFormat etc(EtcCode code) { return {0, std::nullopt, code, 4, 4}; }
constexpr BlockFormat astc(int width, int height) { return {0, std::nullopt, std::nullopt, width, height}; }

// How the pixels of a supported VkFormat are stored.
struct Ktx2Format {
    std::uint32_t linear = 0; // VkFormat
    std::uint32_t srgb = 0;   // its sRGB variant; `linear` if there is none
    int channels = 0;         // of the decoded image
    int bytes = 0;            // per component; 0: blocks that decode to 8 bits or, with `floats`, to floats
    bool floats = false;      // components are floats of 2 or 4 bytes
    bool blueFirst = false;   // BGR order
    BlockFormat blocks = {};

    bool hasBlocks() const { return bytes == 0 || blocks.etc || blocks.bc; }
};

// The largest level of a file, and the keys that apply to it.
struct Ktx2Image {
    Ktx2Format format;
    int width = 0, height = 0;
    std::uint32_t packing = 0;         // 0 none, 2 Zstandard, 3 zlib
    std::span<const std::byte> stored; // part of the file
    std::size_t bytes = 0;             // after decompression
    std::string swizzle;               // four of "rgba01"; empty: not stated
    bool bottomUp = false;             // the first row is the bottom one
    std::string frame;                 // Image::frame
    std::optional<BasisLayout> basis;  // without a VkFormat
    Etc1sParts etc1s;                  // instead of `stored`
};

// VkFormat of Vulkan 1.3, linear and sRGB: values are not converted.
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
                                         {131, 132, 4, 0, false, false, bc(BcCode::bc1)},
                                         {133, 134, 4, 0, false, false, bc(BcCode::bc1)},
                                         {135, 136, 4, 0, false, false, bc(BcCode::bc2)},
                                         {137, 138, 4, 0, false, false, bc(BcCode::bc3)},
                                         {139, 139, 1, 0, false, false, bc(BcCode::bc4)},
                                         {140, 140, 1, 2, false, false, bc(BcCode::bc4Signed)},
                                         {141, 141, 2, 0, false, false, bc(BcCode::bc5)},
                                         {142, 142, 2, 2, false, false, bc(BcCode::bc5Signed)},
                                         {143, 143, 3, 0, true, false, bc6(95)},
                                         {144, 144, 3, 0, true, false, bc6(96)},
                                         {145, 146, 4, 0, false, false, bc(BcCode::bc7)},
                                         {147, 148, 3, 0, false, false, etc(EtcCode::rgb)},
                                         {149, 150, 4, 0, false, false, etc(EtcCode::rgbPunchedAlpha)},
                                         {151, 152, 4, 0, false, false, etc(EtcCode::rgba)},
                                         {153, 153, 1, 2, false, false, etc(EtcCode::r11)},
                                         {154, 154, 1, 2, false, false, etc(EtcCode::r11Signed)},
                                         {155, 155, 2, 2, false, false, etc(EtcCode::rg11)},
                                         {156, 156, 2, 2, false, false, etc(EtcCode::rg11Signed)},
                                         {157, 158, 4, 0, false, false, astc(4, 4)},
                                         {159, 160, 4, 0, false, false, astc(5, 4)},
                                         {161, 162, 4, 0, false, false, astc(5, 5)},
                                         {163, 164, 4, 0, false, false, astc(6, 5)},
                                         {165, 166, 4, 0, false, false, astc(6, 6)},
                                         {167, 168, 4, 0, false, false, astc(8, 5)},
                                         {169, 170, 4, 0, false, false, astc(8, 6)},
                                         {171, 172, 4, 0, false, false, astc(8, 8)},
                                         {173, 174, 4, 0, false, false, astc(10, 5)},
                                         {175, 176, 4, 0, false, false, astc(10, 6)},
                                         {177, 178, 4, 0, false, false, astc(10, 8)},
                                         {179, 180, 4, 0, false, false, astc(10, 10)},
                                         {181, 182, 4, 0, false, false, astc(12, 10)},
                                         {183, 184, 4, 0, false, false, astc(12, 12)}};

constexpr std::uint64_t kHeader = 80, kLevelEntry = 24;

Result<Ktx2Format> formatOf(std::uint64_t vulkan, const std::optional<BasisLayout>& basis)
{
    if (basis)
        return Ktx2Format{0, 0, basis->channelCount()};
    const auto* const known = std::ranges::find_if(
        kVulkanFormats, [&](const Ktx2Format& f) { return f.linear == vulkan || f.srgb == vulkan; });
    if (known == std::end(kVulkanFormats))
        return inputError(fmt::format("its format {} (VkFormat) is not supported", vulkan));
    return *known;
}

std::uint64_t storedBytes(const Ktx2Format& format, std::uint64_t width, std::uint64_t height)
{
    const std::uint64_t across = std::uint64_t(format.blocks.width), down = std::uint64_t(format.blocks.height);
    if (format.hasBlocks())
        return (width + across - 1) / across * ((height + down - 1) / down) * format.blocks.bytes();
    return width * height * std::uint64_t(format.channels * format.bytes);
}

// Reads key/value entries: each is a length, a null-terminated key, a value, and padding to a multiple of 4 bytes.
Status readKeys(Numbers& file, std::span<const std::byte> bytes, Ktx2Image& picture)
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

// Checks every size, offset and count of the header against each other and the file.
// Errors: ErrorKind::input, without the file's name.
Result<Ktx2Image> checkKtx2(std::span<const std::byte> bytes)
{
    Numbers file(bytes);
    if (!file.matches(0, "\xabKTX 20\xbb\r\n\x1a\n") || bytes.size() < kHeader)
        return inputError(fmt::format("its header takes {} bytes, the file has {}", kHeader, bytes.size()));
    const std::uint64_t format = file.at(12, 4), width = file.at(20, 4), height = file.at(24, 4),
                        depth = file.at(28, 4), layers = file.at(32, 4), faces = file.at(36, 4),
                        levels = file.at(40, 4);
    std::optional<BasisLayout> basis;
    if (format == 0) {
        COTAN_TRY(layout, readBasisLayout(file));
        basis = *layout;
    }
    COTAN_TRY(known, formatOf(format, basis));
    if (width == 0 || height == 0 || depth > 1 || layers > 1 || faces != 1)
        return inputError(fmt::format("expected one flat image, found {} x {} x {}, {} layers, {} faces", width, height,
                                      depth, layers, faces));
    constexpr std::uint64_t kMaxSide = 1 << 24;
    if (width > kMaxSide || height > kMaxSide)
        return inputError(fmt::format("its size is {} x {}", width, height));
    if (levels > std::uint64_t(std::bit_width(std::max(width, height))))
        return inputError(fmt::format("it has {} levels, {} x {} pixels have {}", levels, width, height,
                                      std::bit_width(std::max(width, height))));
    Ktx2Image picture{*known, int(width), int(height), std::uint32_t(file.at(44, 4)), {}, 0, {}, false, {}, basis, {}};
    const bool etc1s = basis && basis->etc1s;
    if ((picture.packing == 1 && !etc1s) || picture.packing > 3)
        return inputError(
            fmt::format("its supercompression {} does not match its format or is unknown", picture.packing));
    std::vector<std::uint64_t> levelSizes;
    for (std::uint64_t level = 0; level < std::max<std::uint64_t>(levels, 1); ++level) {
        const std::uint64_t entry = kHeader + level * kLevelEntry, offset = file.at(entry, 8),
                            stored = file.at(entry + 8, 8), plain = file.at(entry + 16, 8);
        const std::uint64_t expected = storedBytes(*known, std::max<std::uint64_t>(width >> level, 1),
                                                   std::max<std::uint64_t>(height >> level, 1));
        if (file.past)
            return inputError("the list of its levels extends past the end of the file");
        if (offset > file.size() || stored > file.size() - offset)
            return inputError(
                fmt::format("level {} takes {} bytes from {}, the file has {}", level, stored, offset, file.size()));
        if (!etc1s && (plain != expected || (picture.packing == 0 && stored != expected)))
            return inputError(fmt::format("level {} has {} bytes, {} as stored; its size requires {}", level, plain,
                                          stored, expected));
        if (level == 0) {
            picture.stored = bytes.subspan(std::size_t(offset), std::size_t(stored));
            picture.bytes = std::size_t(expected);
        }
        levelSizes.push_back(stored);
    }
    COTAN_CHECK(readKeys(file, bytes, picture));
    if (basis)
        COTAN_CHECK(checkBasisSwizzle(*basis, picture.swizzle));
    if (etc1s) {
        COTAN_TRY(parts, readEtc1sParts(file, bytes, *basis, levelSizes, picture.stored));
        picture.etc1s = *parts;
    }
    return picture;
}

// A DDS file with one level.
std::vector<std::byte> asDds(const Ktx2Image& picture, std::span<const std::byte> blocks)
{
    std::vector<std::byte> dds = ddsHeader({"DX10", picture.format.blocks.dxgi, 16}, picture.width, picture.height, 1);
    dds.insert(dds.end(), blocks.begin(), blocks.end());
    return dds;
}

template<class T, class Stored> T component(Stored stored)
{
    if constexpr (std::is_same_v<T, float> && std::is_same_v<Stored, std::uint16_t>)
        return glm::detail::toFloat32(glm::detail::hdata(stored));
    else
        return T(stored);
}

// Expands to RGBA: one channel becomes grey, of two channels blue is the middle value (0 for normals), and alpha is 1.
template<class T, class Stored>
void expandToRgba(const Ktx2Format& format, std::span<const std::byte> from, std::size_t pixels, T middle, T one, T* to)
{
    const std::size_t channels = std::size_t(format.channels);
    for (std::size_t i = 0; i < pixels; ++i, to += 4) {
        std::array<Stored, 4> stored{};
        std::memcpy(stored.data(), from.data() + i * channels * sizeof(Stored), channels * sizeof(Stored));
        for (std::size_t c = 0; c < channels; ++c)
            to[c] = component<T>(stored[c]);
        if (channels == 1)
            to[1] = to[2] = to[0];
        else if (channels == 2)
            to[2] = middle;
        if (channels < 4)
            to[3] = one;
        if (format.blueFirst)
            std::swap(to[0], to[2]);
    }
}

Image plainPixels(const Ktx2Image& picture, PixelType type, std::span<const std::byte> bytes, const std::string& name)
{
    Image image = makeImage(picture.width, picture.height, type, name);
    withComponents(image, [&, pixels = image.pixelCount()]<class T>(T* to, T middle, T one) {
        if constexpr (std::is_same_v<T, float>)
            if (picture.format.bytes == 2)
                return expandToRgba<T, std::uint16_t>(picture.format, bytes, pixels, middle, one, to);
        expandToRgba<T, T>(picture.format, bytes, pixels, middle, one, to);
    });
    return image;
}

Error broken(const std::string& name, const Error& error)
{
    return reworded(
        error,
        fmt::format("{}: {}{}", name, error.kind == ErrorKind::input ? "broken ktx2 image: " : "", error.message));
}

Result<Image> decodedBlocks(const Ktx2Image& picture, PixelType type, std::span<const std::byte> blocks,
                            const std::string& name, const LoadLimits& limits)
{
    const BlockFormat& format = picture.format.blocks;
    if (format.dxgi != 0)
        return readOther(asDds(picture, blocks), name, limits);
    Image image = makeImage(picture.width, picture.height, type, name);
    if (format.bc) {
        decodeBc(*format.bc, blocks, image);
        return image;
    }
    if (format.etc) {
        decodeEtc(*format.etc, blocks, image);
        return image;
    }
    const Status done = picture.basis ? decodeBasis(*picture.basis, blocks, picture.etc1s, image)
                                      : decodeAstc(format.width, format.height, blocks, image);
    return done ? Result<Image>(std::move(image)) : broken(name, done.error());
}

// Applies swizzle and orientation. A swizzle "rg.." of two channels changes nothing: blue is already set as for
// normals.
void arrange(const Ktx2Image& picture, Image& image)
{
    const bool asRead = picture.swizzle.empty() || picture.swizzle == "rgba"
        || (picture.format.channels == 2 && (picture.basis || picture.swizzle.starts_with("rg")));
    if (!asRead)
        withComponents(image, [&, pixels = image.pixelCount()]<class T>(T* to, T, T one) {
            for (std::size_t i = 0; i < pixels; ++i, to += 4) {
                const std::array<T, 6> from{to[0], to[1], to[2], to[3], T(0), one};
                for (std::size_t c = 0; c < 4; ++c)
                    to[c] = from[std::string_view("rgba01").find(picture.swizzle[c])];
            }
        });
    const auto row = std::ptrdiff_t(std::size_t(image.width) * image.bytesPerPixel());
    for (int y = 0; picture.bottomUp && y < image.height / 2; ++y)
        std::swap_ranges(image.data.begin() + y * row, image.data.begin() + (y + 1) * row,
                         image.data.begin() + (image.height - 1 - y) * row);
}

// Image::channels: at most 2 if the swizzle sets blue and alpha to constants.
int channelsOf(const Ktx2Image& picture)
{
    const std::string& s = picture.swizzle;
    const bool noBlue = s.size() == 4 && (s[2] == '0' || s[2] == '1') && (s[3] == '0' || s[3] == '1');
    return noBlue ? std::min(picture.format.channels, 2) : picture.format.channels;
}

} // namespace

std::string foreignKtx2(std::span<const std::byte> bytes)
{
    Numbers file(bytes);
    const std::uint64_t format = file.at(12, 4);
    if (!file.matches(0, "\xabKTX 20\xbb\r\n\x1a\n") || bytes.size() < kHeader)
        return "";
    const std::uint64_t model = file.at(file.at(48, 4) + 12, 1); // in the data format descriptor
    if (format == 0 && model >= 167 && model <= 170)             // those of Basis Universal 2
        return "BasisU other than ETC1S and UASTC LDR 4x4";
    if (format >= 1000066000 && format <= 1000066013)
        return "ASTC with high dynamic range";
    return format >= 157 && format <= 184 && !readsAstc() ? "ASTC" : "";
}

std::string lackedByKtx2(std::span<const std::byte> bytes)
{
    Numbers file(bytes);
    const std::uint64_t packing = file.at(44, 4);
    if ((packing == 2 && !unpacksZstd()) || (packing == 3 && !unpacksZlib()))
        return packing == 2 ? "Zstandard" : "zlib";
    const auto format = formatOf(file.at(12, 4), {});
    return format && format->blocks.dxgi != 0 && !readsOtherFormats() ? "BC6H" : "";
}

Result<Image> readKtx2(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const auto picture = checkKtx2(bytes);
    if (!picture)
        return broken(name, picture.error());
    const Ktx2Format& format = picture->format;
    const PixelType type = format.floats ? PixelType::float32
        : format.bytes == 2              ? PixelType::unorm16
                                         : PixelType::unorm8;
    if (auto error = checkImageSize(picture->width, picture->height, type, name, limits))
        return *error;
    std::vector<std::byte> unpacked;
    std::span<const std::byte> plain = picture->stored;
    if (picture->packing > 1) {
        unpacked.resize(picture->bytes); // checkKtx2 and checkImageSize have limited this size
        const Status done =
            picture->packing == 2 ? unpackZstd(picture->stored, unpacked) : unpackZlib(picture->stored, unpacked);
        if (!done)
            return broken(name, done.error());
        plain = unpacked;
    }
    Result<Image> image = format.hasBlocks() ? decodedBlocks(*picture, type, plain, name, limits)
                                             : Result<Image>(plainPixels(*picture, type, plain, name));
    if (image) {
        arrange(*picture, *image);
        image->frame = picture->frame;
        image->channels = channelsOf(*picture);
    }
    return image;
}

} // namespace cotan
