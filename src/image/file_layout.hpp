// Checks of the formats whose readers believe the headers of their files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <OpenImageIO/filesystem.h>

#include "cotan/files.hpp"
#include "numbers.hpp"

namespace cotan::oiio {

// What is wrong, without the file's name.
struct Problem : std::optional<std::string> {
    using std::optional<std::string>::optional;
    bool memory = false; // as Error has it
};

inline Problem tooMuchMemory(std::string text)
{
    Problem problem(std::move(text));
    problem.memory = true;
    return problem;
}

using File = OIIO::Filesystem::IOProxy;

inline Numbers numbersOf(File& file, bool bigEndian = false)
{
    const auto read = [&file](std::uint64_t offset, void* to, std::size_t bytes) {
        return file.pread(to, bytes, std::int64_t(offset)) == bytes;
    };
    return {read, file.size(), bigEndian};
}

// limits: on what a reader takes for one row, strip or tile.
Problem checkTiff(File& file, const LoadLimits& limits);
Problem checkExr(File& file, const LoadLimits& limits);
Problem checkDds(File& file, const LoadLimits& limits);
Problem checkBmp(File& file, const LoadLimits& limits);

} // namespace cotan::oiio
