// Shared by the files of the OpenImageIO module: checks for formats whose readers trust the file headers, and writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "files/bytes.hpp"
#include "numbers.hpp"

namespace cotan::oiio {

// ---- checks --------------------------------------------------------------------------------

// What is wrong; the message lacks the file's name.
using Problem = std::optional<Error>;

using File = OIIO::Filesystem::IOProxy;

inline Numbers numbersOf(File& file, bool bigEndian = false)
{
    const auto read = [&file](std::uint64_t offset, void* to, std::size_t bytes) {
        return file.pread(to, bytes, std::int64_t(offset)) == bytes;
    };
    return {read, file.size(), bigEndian};
}

// limits: on the memory that a reader allocates for a row, strip or tile.
Problem checkTiff(File& file, const LoadLimits& limits);
Problem checkExr(File& file, const LoadLimits& limits);
Problem checkDds(File& file, const LoadLimits& limits);
Problem checkBmp(File& file, const LoadLimits& limits);

// ---- signed DDS ----------------------------------------------------------------------------

// The number of channels of a DDS with signed blocks; 0: any other file.
int signedDdsChannels(File& file);

// Reads the first level, which checkDds has checked, as unormOfSigned carries it.
Result<Image> readSignedDds(File& file, int channels, const std::string& name, const LoadLimits& limits);

// ---- shared --------------------------------------------------------------------------------

OIIO::TypeDesc typeDesc(PixelType type);

// ---- writing: functions of ImageFormats ----------------------------------------------------

Status write(OpenFile file, const Image& image, const std::string& name);
Result<std::unique_ptr<RowWriter>> createRows(OpenFile file, const RowFormat& format, int threads,
                                              const std::string& name);
Result<std::unique_ptr<AnimationWriter>> createGif(OpenFile file, const AnimationFormat& format,
                                                   const std::string& name);

} // namespace cotan::oiio
