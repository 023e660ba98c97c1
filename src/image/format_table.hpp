// The formats of image files: one table that readers, writers, commands, the viewer, batch and the help ask.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "cotan/result.hpp"

namespace cotan {

// One format. What a build lacks the library for is in the table all the same.
struct ImageFormat {
    std::string_view name; // in messages
    // Of file names, in lower case, the usual one first; the second may be empty.
    std::array<std::string_view, 2> endings;
    std::string_view mime;        // in glTF, of its own or of an extension; empty: glTF has no such images
    std::string_view openImageIo; // name of OpenImageIO's reader and writer; empty: it is not asked

    bool reads = false;     // readImage
    bool readsRows = false; // by openRows without the whole image in memory, most files at least
    bool writes = false;    // writeImage and createRows
    bool texture = false;   // written as a texture with its levels and blocks: `map convert` and `map mips`
    bool animation = false; // createAnimation

    // What a written file holds. A format without alpha drops it.
    bool bits8 = false, bits16 = false, halfs = false, floats = false;
    bool negative = false; // floats below zero
    bool alpha = false;
    bool lossy = false; // changes the values
    bool frame = false; // Image::frame

    // has: what of these holds.
    constexpr ImageFormat(std::string_view name_, std::array<std::string_view, 2> endings_, std::string_view mime_,
                          std::string_view openImageIo_, std::initializer_list<bool ImageFormat::*> has)
        : name(name_), endings(endings_), mime(mime_), openImageIo(openImageIo_)
    {
        for (bool ImageFormat::*what : has)
            this->*what = true;
    }
};

// How files begin, `at` bytes from the start. A format may have several, or none (TGA).
struct ImageStart {
    std::string_view format; // ImageFormat::name
    std::string_view bytes;
    std::size_t at = 0;
    std::string_view before = {}; // from the start on
};

inline constexpr std::array<ImageFormat, 12> kImageFormats = [] {
    using Format = ImageFormat;
    return std::array<ImageFormat, 12>{
        Format("PNG", {".png"}, "image/png", "",
               {&Format::reads, &Format::readsRows, &Format::writes, &Format::bits8, &Format::bits16, &Format::alpha,
                &Format::frame}),
        Format("EXR", {".exr"}, "", "openexr",
               {&Format::reads, &Format::readsRows, &Format::writes, &Format::halfs, &Format::floats, &Format::negative,
                &Format::alpha, &Format::frame}),
        Format("TIFF", {".tif", ".tiff"}, "", "tiff",
               {&Format::reads, &Format::readsRows, &Format::writes, &Format::bits8, &Format::bits16, &Format::floats,
                &Format::negative, &Format::alpha}),
        Format("TGA", {".tga"}, "", "targa", {&Format::reads, &Format::writes, &Format::bits8, &Format::alpha}),
        Format("JPEG", {".jpg", ".jpeg"}, "image/jpeg", "jpeg",
               {&Format::reads, &Format::writes, &Format::bits8, &Format::lossy}),
        Format("HDR", {".hdr"}, "", "hdr", {&Format::reads, &Format::readsRows, &Format::writes, &Format::floats}),
        Format("DDS", {".dds"}, "image/vnd-ms.dds", "dds",
               {&Format::reads, &Format::texture, &Format::bits8, &Format::alpha}),
        Format("KTX2", {".ktx2"}, "image/ktx2", "",
               {&Format::reads, &Format::texture, &Format::bits8, &Format::alpha, &Format::frame}),
        Format("WebP", {".webp"}, "image/webp", "",
               {&Format::reads, &Format::animation, &Format::bits8, &Format::alpha, &Format::lossy}),
        Format("GIF", {".gif"}, "", "", {&Format::animation, &Format::bits8, &Format::lossy}),
        Format("BMP", {".bmp"}, "", "bmp", {&Format::reads}),
        Format("AVIF", {".avif"}, "image/avif", "", {})};
}();

inline constexpr std::array<ImageStart, 16> kImageStarts = [] {
    using namespace std::string_view_literals;
    return std::array<ImageStart, 16>{{{"PNG", "\x89PNG\r\n\x1a\n"sv},
                                       {"JPEG", "\xff\xd8\xff"sv},
                                       {"TIFF", "II*\0"sv},
                                       {"TIFF", "MM\0*"sv},
                                       {"TIFF", "II+\0"sv}, // BigTIFF
                                       {"TIFF", "MM\0+"sv},
                                       {"EXR", "\x76\x2f\x31\x01"sv},
                                       {"HDR", "#?"sv},
                                       {"DDS", "DDS "sv},
                                       {"KTX2", "\xabKTX 20\xbb"sv},
                                       {"WebP", "WEBP"sv, 8, "RIFF"sv},
                                       {"GIF", "GIF87a"sv},
                                       {"GIF", "GIF89a"sv},
                                       {"BMP", "BM"sv},
                                       {"AVIF", "ftypavif"sv, 4, "\0\0"sv}, // its first box is shorter than 64 KiB
                                       {"AVIF", "ftypavis"sv, 4, "\0\0"sv}}};
}();

// The format that a file's name ends in, compared without regard to case. Null: none of the table.
const ImageFormat* imageFormatOf(const std::filesystem::path& file);

// The format that a file's first bytes say; 16 do. Null: none of the table, or TGA, which begins in no way of its own.
const ImageFormat* imageFormatOf(std::span<const std::byte> bytes);

// Whether a file of that name can be written by writeImage, keeps floats, and so on: imageFormatHas(file,
// &ImageFormat::writes). False for names that the table does not know.
inline bool imageFormatHas(const std::filesystem::path& file, bool ImageFormat::*what)
{
    const ImageFormat* const format = imageFormatOf(file);
    return format && format->*what;
}

// Errors (ErrorKind::usage): a name that writeImage and createRows do not write.
Status checkImageName(const std::filesystem::path& file);

// Whether a rendered image in a file of that name keeps light linear and unlimited: floats can be written.
inline bool keepsFloats(const std::filesystem::path& file)
{
    return imageFormatHas(file, &ImageFormat::writes) && imageFormatHas(file, &ImageFormat::floats);
}

// The usual endings of the formats for which `wanted` holds, in the order of the table: ".png, .exr or .tif" with
// `last` " or ". Empty `last`: `between`.
std::string imageEndings(const std::function<bool(const ImageFormat&)>& wanted, std::string_view between = " ",
                         std::string_view last = {});

// The names of the formats that can be read: "PNG, EXR, ...".
std::string readableFormatNames();

} // namespace cotan
