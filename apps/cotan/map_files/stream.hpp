// Pictures through a work in strips: reading, working and writing at the same time, in bounded memory.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "cotan/result.hpp"

namespace cotan::maps {

struct StreamPlan {
    bool bordered = false;   // a row above each strip and one below are there, also at the ends; for one reader only
    Wrap wrap = Wrap::clamp; // what lies beyond the ends
    const Image* lastRow = nullptr; // Wrap::repeat: the picture's last row
};

// Works on the same rows of every reader, on several threads at a time, and returns what is to be done with the
// result: that is called in order, on one thread at a time.
using StripWork = std::function<std::function<Status()>(std::span<Image> strips, int firstRow)>;

// Reads pictures of one size to the end, or to the first error, or until `progress` says to stop. The cuts depend on
// the size only.
Status streamStrips(std::span<RowReader* const> readers, const StreamPlan& plan, const Progress& progress,
                    const StripWork& work);

// One picture, strip by strip in order.
Status inOrder(RowReader& reader, const Progress& progress,
               const std::function<void(const Image& strip, int firstRow)>& take);

// One picture to a file: `work` makes of each strip rows of the new one.
Status streamToFile(RowReader& reader, const StreamPlan& plan, const std::filesystem::path& file,
                    const RowFormat& format, int threads, const Progress& progress,
                    const std::function<Image(Image& strip, int firstRow)>& work);

// The last row of a picture, for StreamPlan. Reads the file through.
Result<Image> lastRowOf(const std::filesystem::path& file, const LoadLimits& limits);

} // namespace cotan::maps
