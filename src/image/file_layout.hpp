// Numbers in files whose readers believe their headers, and the checks of three formats by them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <OpenImageIO/filesystem.h>

#include "cotan/files/limits.hpp"

namespace cotan::oiio {

using Problem = std::optional<std::string>;
using File = OIIO::Filesystem::IOProxy;

// Numbers at places in a file; what lies behind its end is 0, and `past` is set.
class Numbers {
public:
    Numbers(File& file, bool bigEndian) : file_(file), bigEndian_(bigEndian) {}

    std::uint64_t at(std::uint64_t offset, std::size_t bytes)
    {
        std::array<unsigned char, 8> raw{};
        if (offset > file_.size() || bytes > file_.size() - offset
            || file_.pread(raw.data(), bytes, std::int64_t(offset)) != bytes) {
            past = true;
            return 0;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i)
            value = value << 8 | raw[bigEndian_ ? i : bytes - 1 - i];
        return value;
    }

    std::uint64_t size() const { return file_.size(); }

    bool past = false;

private:
    File& file_;
    bool bigEndian_;
};

// What is wrong, without the file's name. Limits: on what a reader takes for one row, strip or tile.
Problem checkTiff(File& file, const LoadLimits& limits);
Problem checkExr(File& file, const LoadLimits& limits);
Problem checkDds(File& file);

} // namespace cotan::oiio
