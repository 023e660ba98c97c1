// Files of normal maps: how they are read, and how results are stored.
//
// The calls of this part take files of any size: what works row by row holds a few strips of a picture at a time. A
// file appears whole or not at all. Errors of an option begin with its name, "options.bits: ".
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "cotan/convention.hpp"
#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "cotan/result.hpp"
#include "maps/texels.hpp"

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

// A map in memory, and how it is to be read.
struct LoadedMap {
    Image image;
    Convention convention;
};

// Bytes that work on a picture may take: as decoding it, 192 MiB and 128 times the size of its file, at most
// limits.imageBytes. So a small file cannot ask for minutes. A file whose size is unknown counts as empty.
std::size_t workBudget(const std::filesystem::path& file, const LoadLimits& limits);

// Reads a map whole: two channels are brought to red and green. option: as for conventionOf. Errors: as readImage and
// conventionOf.
Result<LoadedMap> readMap(const std::filesystem::path& file, const StatedConvention& stated, const std::string& option,
                          const LoadLimits& limits = {});

// Writes a whole picture. Errors: as writeImage.
Status writeMap(const std::filesystem::path& file, const Image& image, const Bits& bits);

// A map to be read by rows, and how: the strips are to be brought to red and green by unswizzle.
struct OpenMap {
    std::unique_ptr<RowReader> rows;
    Convention convention;
    Swizzle swizzle = Swizzle::rg;
    Damage damage{};

    // Rows as they were read, with x in red and y in green, and what was wrong with them undone.
    void put(Image& strip) const
    {
        unswizzle(strip, swizzle);
        undo(damage, strip);
    }
};

// Opens a map. A map of two channels in a file of four is read once through, to find where they are. Errors: as
// openRows and conventionOf.
Result<OpenMap> openMap(const std::filesystem::path& file, const StatedConvention& stated, const std::string& option,
                        const LoadLimits& limits = {});

} // namespace cotan::maps
