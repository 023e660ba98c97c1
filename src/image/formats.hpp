// Every image format beyond reading and writing PNG and reading JPEG. OpenImageIO does them; it
// lives in a module of its own that is loaded on first use, because its libraries (250 of them on
// Debian) take half a second and 130 MB to load, and most runs meet nothing but PNG and JPEG.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// What the module offers.
struct ImageFormats {
    const char* version; // of the build; must be ours, as C++ types are passed

    // As decodeImage, for JPEG, TIFF, OpenEXR, Radiance HDR, BMP, DDS (by their first bytes) and
    // TGA (which has none, by the extension of `name`).
    Result<Image> (*read)(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

    // As writeImage, for formats with a name of OpenImageIO. `name` is for messages.
    Status (*write)(const std::filesystem::path& file, const Image& image, const std::string& name);

    // As openRows, for files of a format that readsRows; `head` is how this one starts.
    Result<std::unique_ptr<RowReader>> (*openRows)(const std::filesystem::path& file, std::span<const std::byte> head,
                                                   const LoadLimits& limits);

    // As createRows, for the extension of `name`; `file` is where to write and appears at once.
    Result<std::unique_ptr<RowWriter>> (*createRows)(const std::filesystem::path& file, const RowFormat& format,
                                                     int threads, const std::string& name);

    // As createAnimation, for GIF and pictures of unorm8; `file` is where to write and appears at once.
    Result<std::unique_ptr<AnimationWriter>> (*createGif)(const std::filesystem::path& file,
                                                          const AnimationFormat& format, const std::string& name);
};

// Whether this build has the module.
bool readsOtherFormats();

// The module, for a file of that name. Errors: ErrorKind::unavailable where it is missing or does not load.
Result<const ImageFormats*> imageFormats(const std::string& name);

// ImageFormats::read of the module.
Result<Image> readOther(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// OpenImageIO's name of the format whose files begin in no way of their own: the name of the file says it.
inline constexpr std::string_view kNoStart = "targa";

// Whether writeImage and createRows write files of that name without the module: PNG.
bool writesItself(const std::filesystem::path& file);

} // namespace cotan

// The module's only symbol: its ImageFormats, of the type that loadModule calls.
extern "C" const void* cotanImageFormats();
