// All image formats that need OpenImageIO. It is in a module of its own that is loaded on first use, because its
// libraries (250 on Debian) take half a second and 130 MB to load, and most runs use PNG and JPEG only.
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
#include "files/bytes.hpp"

namespace cotan {

// The functions of the module.
struct ImageFormats {
    const char* version; // of the build; must equal ours, since C++ types cross the boundary

    // As decodeImage, for JPEG, TIFF, OpenEXR, Radiance HDR, BMP and DDS (by their first bytes) and TGA (all other
    // data; it has no magic number).
    Result<Image> (*read)(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

    // As writeImage, for formats with ImageFormat::openImageIo. file: open for reading and writing, here and below.
    // `name` is for messages and gives the format.
    Status (*write)(OpenFile file, const Image& image, const std::string& name);

    // As openRows, for formats with ImageFormat::readsRows; `head` is the start of the file.
    Result<std::unique_ptr<RowReader>> (*openRows)(const std::filesystem::path& file, std::span<const std::byte> head,
                                                   const LoadLimits& limits);

    // As createRows, for the extension of `name`.
    Result<std::unique_ptr<RowWriter>> (*createRows)(OpenFile file, const RowFormat& format, int threads,
                                                     const std::string& name);

    // As createAnimation, for GIF and images of unorm8.
    Result<std::unique_ptr<AnimationWriter>> (*createGif)(OpenFile file, const AnimationFormat& format,
                                                          const std::string& name);
};

// Whether this build has the module.
bool readsOtherFormats();

// The module. name: of the file, for messages. Errors: ErrorKind::unavailable if it is missing or cannot be loaded.
Result<const ImageFormats*> imageFormats(const std::string& name);

// Calls ImageFormats::read of the module.
Result<Image> readOther(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// OpenImageIO's name of the format without a magic number, which is recognised by the file extension.
inline constexpr std::string_view kFormatWithoutMagic = "targa";

// Whether writeImage and createRows write this file type without the module: PNG only.
bool writesItself(const std::filesystem::path& file);

} // namespace cotan

// The module's only exported symbol: its ImageFormats, with the signature that loadModule expects.
extern "C" const void* cotanImageFormats();
