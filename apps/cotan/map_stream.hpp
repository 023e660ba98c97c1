// Pictures through a work in strips: reading, working and writing at the same time, in bounded memory.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cotan/image/rows.hpp"
#include "cotan/maps/height.hpp"
#include "map_options.hpp"

namespace cotan::app {

// What a strip's neighbours are.
enum class Border {
    none,
    below, // the row below is there too, except at the bottom
    both   // a row above and one below are there, also at the ends
};

struct StreamPlan {
    Border border = Border::none;   // other than none: for one reader only
    maps::Wrap wrap = maps::Wrap::clamp; // Border::both: what lies beyond the ends
    const Image* lastRow = nullptr; // Border::both and Wrap::repeat: the picture's last row
};

// Works on the same rows of every reader, on several threads at a time, and returns what is to be done with the
// result: that is called in order, on one thread at a time.
using StripWork = std::function<std::function<Status()>(std::span<Image> strips, int firstRow)>;

// Reads pictures of one size to the end, or to the first error. The cuts depend on the size only.
Status streamStrips(const CommonOptions& options, std::span<RowReader* const> readers, const StreamPlan& plan,
                    const StripWork& work);

// One picture, strip by strip in order.
Status inOrder(const CommonOptions& options, RowReader& reader, Border border,
               const std::function<void(const Image& strip, int firstRow)>& take);

// The last row of a picture, for StreamPlan. Reads the file through.
Result<Image> lastRowOf(const std::filesystem::path& file, const MapOptions& options);

} // namespace cotan::app
