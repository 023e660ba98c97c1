// Processes images in strips: reads, works and writes at the same time, in bounded memory.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "cotan/result.hpp"

namespace cotan::app {

struct StreamPlan {
    bool bordered = false; // strips include a row above and a row below, also at the ends; for one reader only
    maps::Wrap wrap = maps::Wrap::clamp; // how rows beyond the ends are made
    const Image* lastRow = nullptr;      // the image's last row, for Wrap::repeat
};

// Works on the same rows of every reader, on several threads at a time, and returns a function that takes the result.
// These functions are called in order, one at a time.
using StripWork = std::function<std::function<Status()>(std::span<Image> strips, int firstRow)>;

// Reads images of the same size to the end, to the first error, or until `progress` stops it. The strips depend on the
// size only.
Status streamStrips(std::span<RowReader* const> readers, const StreamPlan& plan, const Progress& progress,
                    const StripWork& work);

// Reads one image strip by strip, in order.
Status inOrder(RowReader& reader, const Progress& progress,
               const std::function<void(const Image& strip, int firstRow)>& take);

// Converts an image to a file: `work` returns the new rows of each strip.
Status streamToFile(RowReader& reader, const StreamPlan& plan, const std::filesystem::path& file,
                    const RowFormat& format, int threads, const Progress& progress,
                    const std::function<Image(Image& strip, int firstRow)>& work);

// The last row of an image, for StreamPlan. Reads the whole file.
Result<Image> lastRowOf(const std::filesystem::path& file, const LoadLimits& limits);

} // namespace cotan::app
