// Files of normal maps: how they are read, and how results are stored.
//
// The calls of this part take files of any size: what works row by row holds a few strips of a picture at a time. A
// file appears whole or not at all. Errors of an option begin with its name, "options.bits: ".
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "cotan/convention.hpp"
#include "cotan/files/limits.hpp"
#include "cotan/image/rows.hpp"
#include "cotan/maps/texels.hpp"
#include "cotan/progress.hpp"
#include "cotan/result.hpp"

namespace cotan::maps {

struct FileOptions {
    LoadLimits limits{}; // of reading; imageBytes of pictures that have to be held whole, and of work on them
    int threads = 0;     // that compression may use; 0: all cores. The bytes do not depend on it
    Progress progress{}; // on one thread at a time
};

// How the components of a file are stored.
struct Bits {
    PixelType type = PixelType::unorm8;
    bool half = false; // float32 here, half floats in the file
};

// The type to write: "auto", "8", "16", "half" or "float", checked against what the file's format holds. auto: the
// input's, as far as the format holds it. Errors (ErrorKind::usage): "options.bits: ...".
Result<Bits> bitsFor(const std::string& wanted, PixelType input, const std::filesystem::path& file);
// The same for a map in convention `to`, with checkSigned.
Result<Bits> bitsFor(const std::string& wanted, PixelType input, const Convention& to,
                     const std::filesystem::path& file);

// "8 bit", "16 bit", "half" or "float".
std::string bitsName(PixelType type);
std::string bitsName(const Bits& bits);

// Signed values need floats, in a file that holds negative ones. Errors (ErrorKind::usage): "options.to: ...".
Status checkSigned(const Convention& to, const Bits& bits, const std::filesystem::path& file);

// Reads a map of that convention whole: pictures of two channels are brought to red and green. Errors: as readImage.
Result<Image> readMap(const std::filesystem::path& file, const Convention& convention, const LoadLimits& limits = {});

// Writes a whole picture. Errors: as writeImage.
Status writeMap(const std::filesystem::path& file, const Image& image, const Bits& bits);

// Which components of a file hold a two-channel map; rg where the convention has three channels. Reads files that have
// alpha once through. Errors: as openRows.
Result<Swizzle> swizzleOfFile(const std::filesystem::path& file, const Convention& convention,
                              const LoadLimits& limits = {});

} // namespace cotan::maps
