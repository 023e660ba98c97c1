// Files of normal maps: how they are read, and how results are stored.
//
// The functions of this part take files of any size; those that work row by row hold a few strips of an image at a
// time. A file appears complete or not at all. Messages about an option begin with its name, "options.bits: ".
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "cotan/result.hpp"
#include "maps/patches.hpp"
#include "maps/texels.hpp"

namespace cotan::app {

struct FileOptions {
    LoadLimits limits{}; // for reading; imageBytes also limits images held in memory and work on them
    int threads = 0;     // for compression; 0: all cores. The bytes do not depend on it
    Progress progress{}; // called by one thread at a time
};

// How the components of a file are stored.
struct Bits {
    PixelType type = PixelType::unorm8;
    bool half = false; // float32 in memory, half floats in the file
};

// The type to write: "auto", "8", "16", "half" or "float", checked against the types that the file's format holds.
// auto: that of the input if the format holds it, else a similar one. Errors (ErrorKind::usage): "options.bits: ...".
Result<Bits> bitsFor(const std::string& wanted, PixelType input, const std::filesystem::path& file);
// The same for a map in convention `to`, with checkSigned.
Result<Bits> bitsFor(const std::string& wanted, PixelType input, const Convention& to,
                     const std::filesystem::path& file);

// "8 bit", "16 bit", "half" or "float".
std::string bitsName(PixelType type);
std::string bitsName(const Bits& bits);

// Checks that signed values are floats in a format that holds negative ones. Errors (ErrorKind::usage): "options.to: ".
Status checkSigned(const Convention& to, const Bits& bits, const std::filesystem::path& file);

// A map in memory with its convention.
struct LoadedMap {
    Image image;
    Convention convention;
    std::string note; // what contradicts the stated convention; empty if nothing does
};

// Limit in bytes for work on an image, as for decoding it (imageBudget): it grows with the size of the file, up to
// limits.imageBytes. Thus a small file cannot cause minutes of work. A file of unknown size counts as empty.
std::size_t workBudget(const std::filesystem::path& file, const LoadLimits& limits);

// Reads a whole map; two channels are moved to red and green. option: as for conventionOf. Errors: as readImage and
// conventionOf.
Result<LoadedMap> readMap(const std::filesystem::path& file, const StatedConvention& stated, const std::string& option,
                          const LoadLimits& limits = {});

// Writes a whole image. Errors: as writeImage.
Status writeMap(const std::filesystem::path& file, const Image& image, const Bits& bits);

// A map to be read by rows. Strips must be passed to put().
struct OpenMap {
    std::unique_ptr<RowReader> rows;
    Convention convention;
    maps::Swizzle swizzle = maps::Swizzle::rg;
    Damage damage{};
    std::string option{}, name{}; // that states the convention; of the file
    std::unique_ptr<maps::PatchSampler> sample{};

    // Moves x to red and y to green in rows as read, and repairs the known damage. Several threads may call it for
    // different rows.
    void put(Image& strip, int firstRow) const
    {
        maps::unswizzle(strip, swizzle);
        maps::undo(damage, strip);
        sample->add(strip, firstRow);
    }
    // After all rows: what contradicts the stated convention, as a line that begins with the option; empty if nothing
    // does.
    std::string note() const;
};

// Appends a note that is not empty.
void addNote(std::string note, std::vector<std::string>& notes);

// Opens a map. A map of two channels in a file of four is read through once to find these channels. Errors: as openRows
// and conventionOf.
Result<OpenMap> openMap(const std::filesystem::path& file, const StatedConvention& stated, const std::string& option,
                        const LoadLimits& limits = {});

} // namespace cotan::app
