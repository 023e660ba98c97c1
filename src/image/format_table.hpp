// The image formats: one table for readers, writers, commands, the viewer, batch and the help.
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

// One format. Formats whose library a build lacks are in the table, too.
struct ImageFormat {
    std::string_view name; // in messages
    // File extensions in lower case, the usual one first; the second may be empty.
    std::array<std::string_view, 2> endings;
    std::string_view mime;        // MIME type in glTF or its extensions; empty: not allowed in glTF
    std::string_view openImageIo; // name of OpenImageIO's reader and writer; empty: not used

    bool reads = false;     // by readImage
    bool readsRows = false; // by openRows without decoding the whole image, at least for most files
    bool writes = false;    // by writeImage and createRows
    bool texture = false;   // written as a texture with mip levels and blocks by `map convert` and `map mips`
    bool animation = false; // written by createAnimation

    // What a written file can hold. A format without alpha drops it.
    bool bits8 = false, bits16 = false, halfs = false, floats = false;
    bool negative = false; // floats may be negative
    bool alpha = false;
    bool lossy = false; // values change
    bool frame = false; // stores Image::frame

    // has: the members to set.
    constexpr ImageFormat(std::string_view name_, std::array<std::string_view, 2> endings_, std::string_view mime_,
                          std::string_view openImageIo_, std::initializer_list<bool ImageFormat::*> has)
        : name(name_), endings(endings_), mime(mime_), openImageIo(openImageIo_)
    {
        for (bool ImageFormat::*what : has)
            this->*what = true;
    }
};

// The magic number of a format, `at` bytes from the start. A format may have several, or none (TGA).
struct ImageStart {
    std::string_view format; // ImageFormat::name
    std::string_view bytes;
    std::size_t at = 0;
    std::string_view before = {}; // the file must start with these bytes, too
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
                                       {"AVIF", "ftypavif"sv, 4, "\0\0"sv}, // the size of the first box is below 64 KiB
                                       {"AVIF", "ftypavis"sv, 4, "\0\0"sv}}};
}();

// The format by a file's extension, case-insensitive. Null: not in the table.
const ImageFormat* imageFormatOf(const std::filesystem::path& file);

// The format by a file's first bytes; 16 suffice. Null: not in the table, or TGA, which has no magic number.
const ImageFormat* imageFormatOf(std::span<const std::byte> bytes);

// Whether the file's extension is that of a format with this property: imageFormatHas(file, &ImageFormat::writes).
// False for extensions that are not in the table.
inline bool imageFormatHas(const std::filesystem::path& file, bool ImageFormat::*what)
{
    const ImageFormat* const format = imageFormatOf(file);
    return format && format->*what;
}

// Errors (ErrorKind::usage): an extension that writeImage and createRows cannot write.
Status checkImageName(const std::filesystem::path& file);

// Whether a render written to this file stays linear and unclamped: the format can store floats.
inline bool keepsFloats(const std::filesystem::path& file)
{
    return imageFormatHas(file, &ImageFormat::writes) && imageFormatHas(file, &ImageFormat::floats);
}

// The usual extensions of the formats for which `wanted` holds, in table order, joined by `between`, the last two by
// `last` unless it is empty: ".png, .exr or .tif".
std::string imageEndings(const std::function<bool(const ImageFormat&)>& wanted, std::string_view between = " ",
                         std::string_view last = {});

// The names of all readable formats: "PNG, EXR, ...".
std::string readableFormatNames();

} // namespace cotan
