// Images, frames and conventions of cotan.h, converted for the library.
#pragma once

#include <cstdint>

#include "call.hpp"
#include "cotan/convention.hpp"
#include "cotan/frame.hpp"
#include "cotan/scene.hpp"

struct cotan_image {
    cotan::Image image;
};

namespace cotan::c {

inline constexpr int kMaxSide = 65536;
// Processing a pixel takes up to 64 bytes, and the total must fit into 32-bit addresses.
inline constexpr std::uint64_t kMaxPixels = SIZE_MAX / 64;

inline PixelType typeOf(const cotan_image_view& p, const char* name)
{
    if (p.bits == 8)
        return PixelType::unorm8;
    if (p.bits != 16 && p.bits != 32)
        fail(ErrorKind::usage, name, ".bits: expected 8, 16 or 32, found ", p.bits);
    return p.bits == 16 ? PixelType::unorm16 : PixelType::float32;
}

inline const cotan_image_view& checkedView(const cotan_image_view* given, const char* name)
{
    const cotan_image_view& p = checked(given, name);
    typeOf(p, name);
    if (p.width < 1 || p.height < 1 || p.width > kMaxSide || p.height > kMaxSide)
        fail(ErrorKind::usage, name, ": expected 1 to 65536 pixels per side, found ", p.width, " x ", p.height);
    if (std::uint64_t(p.width) * std::uint64_t(p.height) > kMaxPixels)
        fail(ErrorKind::unavailable, name, ": expected at most ", kMaxPixels, " pixels in all, found ", p.width, " x ",
             p.height);
    if (!p.pixels)
        fail(ErrorKind::usage, name, ".pixels: expected an array, found null");
    return p;
}

inline Image imageOf(const cotan_image_view* given, const char* name)
{
    const cotan_image_view& p = checkedView(given, name);
    Image image = makeImage(p.width, p.height, typeOf(p, name));
    std::memcpy(image.data.data(), p.pixels, image.pixelCount() * image.bytesPerPixel());
    return image;
}

// Checks an output image for a result of that size.
inline const cotan_image_view& output(const cotan_image_view* given, const char* name, const Image& like)
{
    const cotan_image_view& p = checkedView(given, name);
    if (p.width != like.width || p.height != like.height)
        fail(ErrorKind::usage, name, ": expected ", like.width, " x ", like.height, " pixels, found ", p.width, " x ",
             p.height);
    return p;
}

inline void put(const Image& image, const cotan_image_view& p)
{
    std::memcpy(p.pixels, image.data.data(), image.pixelCount() * image.bytesPerPixel());
}

// Returns the frame with the given name; `otherwise` if no name is given.
inline Frame frameOr(const char* given, Frame otherwise, const char* name)
{
    if (const auto frame = given ? frameFromName(given) : otherwise)
        return *frame;
    std::string known;
    for (const FrameInfo& frame : frames())
        known += (known.empty() ? "" : ", ") + std::string(frame.name);
    fail(ErrorKind::usage, name, ": expected one of ", known, "; found '", given, "'");
}

inline Convention conventionOf(const char* words, const char* name)
{
    return valueOf(parseConvention(word(words, name)), name);
}

inline void requireStorable(const Convention& convention, const char* name, PixelType type)
{
    if (convention.expansion == Expansion::signedValues && type != PixelType::float32)
        fail(ErrorKind::usage, name, ": signed values need an image of 32 bits");
}

// Returns a convention that components of `type` can store.
inline Convention storableAs(const char* words, const char* name, PixelType type)
{
    const Convention convention = conventionOf(words, name);
    requireStorable(convention, name, type);
    return convention;
}

inline cotan_image_view imageViewOf(const Image& image)
{
    return {sizeof(cotan_image_view), image.width, image.height, bitsPerComponent(image.type),
            const_cast<std::byte*>(image.data.data())};
}

} // namespace cotan::c
