// Checks of the formats whose readers believe the headers of their files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <OpenImageIO/filesystem.h>

#include "cotan/files.hpp"
#include "numbers.hpp"

namespace cotan::oiio {

using Problem = std::optional<std::string>;
using File = OIIO::Filesystem::IOProxy;

inline Numbers numbersOf(File& file, bool bigEndian = false)
{
    const auto read = [&file](std::uint64_t offset, void* to, std::size_t bytes) {
        return file.pread(to, bytes, std::int64_t(offset)) == bytes;
    };
    return {read, file.size(), bigEndian};
}

// What is wrong, without the file's name. Limits: on what a reader takes for one row, strip or tile.
Problem checkTiff(File& file, const LoadLimits& limits);
Problem checkExr(File& file, const LoadLimits& limits);
Problem checkDds(File& file);
Problem checkBmp(File& file, const LoadLimits& limits);

} // namespace cotan::oiio
