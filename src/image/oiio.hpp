// What the module's two ways of reading and writing share.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <OpenImageIO/imageio.h>

#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "file_layout.hpp"
#include "image/format_table.hpp"

namespace cotan::oiio {

// Without trailing spaces and line breaks.
std::string oneLine(std::string text);

// OpenImageIO's name of the format of something that knownImage() accepted. The contents decide,
// as extensions are often wrong.
std::string formatOf(std::span<const std::byte> bytes);

PixelType pixelType(OIIO::TypeDesc format);
OIIO::TypeDesc typeDesc(PixelType type);

// Spreads the first `channels` components of every pixel over red, green, blue and alpha.
void completeChannels(Image& image, int channels);

// Compares what the headers of TIFF, OpenEXR, DDS and BMP files promise with the size of the file: every
// strip, tile, attribute and level that will be read, and blocks of OpenEXR with the limits. Their readers take memory
// by those numbers, or hand out what it held. format: of formatOf().
std::optional<Error> checkFileLayout(File& file, const std::string& name, const std::string& format,
                                     const LoadLimits& limits);

// Rows of a file without tiles, from `first` on: those of `to`, the first `channels` components of each pixel. False:
// input says why.
bool readScanlines(OIIO::ImageInput& input, int first, int channels, Image& to);

// What a header may claim beside its size.
std::optional<Error> checkLayers(const OIIO::ImageSpec& spec, const std::string& name);

// How values are to be read: as they are stored.
OIIO::ImageSpec readConfig();

// How components of `type` are stored.
OIIO::TypeDesc typeToWrite(const ImageFormat& format, PixelType type);

// channels: no more than the format has. frame: Image::frame, for the formats that hold it.
OIIO::ImageSpec outputSpec(int width, int height, int channels, OIIO::TypeDesc type, const ImageFormat& format,
                           const std::string& frame);

// The library's words within a sentence of ours: of a file that was read, and of one to be written.
Error brokenToOiio(const std::string& name, const std::string& format, const std::string& words);
inline Error notWritten(const std::string& name, const std::string& words)
{
    return outputError(name + ": expected to write the picture, OpenImageIO found: " + oneLine(words));
}

// Image::frame of a file.
std::string frameOf(const OIIO::ImageSpec& spec, const std::string& format);

// ImageFormats::openRows and createRows.
Result<std::unique_ptr<RowReader>> openRows(const std::filesystem::path& file, std::span<const std::byte> head,
                                            const LoadLimits& limits);
Result<std::unique_ptr<RowWriter>> createRows(const std::filesystem::path& file, const RowFormat& format, int threads,
                                              const std::string& name);

// ImageFormats::createGif.
Result<std::unique_ptr<AnimationWriter>> createGif(const std::filesystem::path& file, const AnimationFormat& format,
                                                   const std::string& name);

} // namespace cotan::oiio
