#include "ktx2.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <glm/detail/type_half.hpp>

#include "image/dds.hpp"
#include "image/size.hpp"

namespace cotan {

namespace {

// A DDS of one level, in memory.
std::vector<std::byte> asDds(const Ktx2Picture& picture, std::span<const std::byte> blocks)
{
    const Ktx2Format& f = picture.format;
    std::vector<std::byte> dds = ddsHeader({f.letters, f.dxgi, f.block}, picture.width, picture.height, 1);
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

// What is not stored: of one channel all colours are it, of two blue is the middle of normals.
template<class T, class Stored>
void spread(const Ktx2Format& format, std::span<const std::byte> from, std::size_t pixels, T middle, T one, T* to)
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

template<class T> void applySwizzle(const std::string& swizzle, std::size_t pixels, T one, T* to)
{
    for (std::size_t i = 0; i < pixels; ++i, to += 4) {
        const std::array<T, 6> from{to[0], to[1], to[2], to[3], T(0), one};
        for (std::size_t c = 0; c < 4; ++c)
            to[c] = from[std::string_view("rgba01").find(swizzle[c])];
    }
}

Image plainPixels(const Ktx2Picture& picture, std::span<const std::byte> bytes, const std::string& name)
{
    const Ktx2Format& f = picture.format;
    const PixelType type = f.floats ? PixelType::float32 : f.bytes == 1 ? PixelType::unorm8 : PixelType::unorm16;
    Image image = makeImage(picture.width, picture.height, type, name);
    const std::size_t pixels = image.pixelCount();
    if (type == PixelType::unorm8)
        spread<std::uint8_t, std::uint8_t>(f, bytes, pixels, 128, 0xff, image.bytes8());
    else if (type == PixelType::unorm16)
        spread<std::uint16_t, std::uint16_t>(f, bytes, pixels, 0x8000, 0xffff, image.words());
    else if (f.bytes == 2)
        spread<float, std::uint16_t>(f, bytes, pixels, 0.5f, 1.0f, image.floats());
    else
        spread<float, float>(f, bytes, pixels, 0.5f, 1.0f, image.floats());
    return image;
}

// Of two channels "rg" and constants is what comes out anyway, with blue as other two-channel files have it.
void arrange(const Ktx2Picture& picture, Image& image)
{
    const bool asRead = picture.swizzle.empty() || picture.swizzle == "rgba"
        || (picture.format.channels == 2 && picture.swizzle.starts_with("rg"));
    const std::size_t pixels = image.pixelCount();
    if (!asRead && image.type == PixelType::unorm8)
        applySwizzle<std::uint8_t>(picture.swizzle, pixels, 0xff, image.bytes8());
    else if (!asRead && image.type == PixelType::unorm16)
        applySwizzle<std::uint16_t>(picture.swizzle, pixels, 0xffff, image.words());
    else if (!asRead)
        applySwizzle(picture.swizzle, pixels, 1.0f, image.floats());
    const auto row = std::ptrdiff_t(std::size_t(image.width) * image.bytesPerPixel());
    for (int y = 0; picture.bottomUp && y < image.height / 2; ++y)
        std::swap_ranges(image.data.begin() + y * row, image.data.begin() + (y + 1) * row,
                         image.data.begin() + (image.height - 1 - y) * row);
}

// Image::channels: of more than two that a swizzle leaves without blue it is two.
int channelsOf(const Ktx2Picture& picture)
{
    const std::string& s = picture.swizzle;
    const bool noBlue = s.size() == 4 && (s[2] == '0' || s[2] == '1') && (s[3] == '0' || s[3] == '1');
    return noBlue ? std::min(picture.format.channels, 2) : picture.format.channels;
}

} // namespace

Result<Image> readKtx2(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits,
                       Result<Image> (*readDds)(std::span<const std::byte>, const std::string&, const LoadLimits&))
{
    const auto broken = [&](const Error& error) {
        return reworded(error,
                        error.kind == ErrorKind::input ? fmt::format("{}: broken ktx2 image: {}", name, error.message)
                                                       : fmt::format("{}: {}", name, error.message));
    };
    const auto picture = checkKtx2(bytes);
    if (!picture)
        return broken(picture.error());
    const Ktx2Format& format = picture->format;
    const PixelType type = format.floats ? PixelType::float32
        : format.bytes == 2              ? PixelType::unorm16
                                         : PixelType::unorm8;
    if (auto error = checkImageSize(picture->width, picture->height, type, name, limits))
        return *error;
    std::vector<std::byte> unpacked;
    std::span<const std::byte> plain = picture->stored;
    if (picture->packing != 0) {
        unpacked.resize(picture->bytes); // no more than the pixels take
        const Status done =
            picture->packing == 2 ? unpackZstd(picture->stored, unpacked) : unpackZlib(picture->stored, unpacked);
        if (!done)
            return broken(done.error());
        plain = unpacked;
    }
    Result<Image> image =
        format.bytes > 0 ? plainPixels(*picture, plain, name) : readDds(asDds(*picture, plain), name, limits);
    if (image) {
        arrange(*picture, *image);
        image->frame = picture->frame;
        image->channels = channelsOf(*picture);
    }
    return image;
}

} // namespace cotan
