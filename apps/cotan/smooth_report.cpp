#include "smooth_report.hpp"

#include <fmt/format.h>

namespace cotan::app {

std::string reportSmooth(const SmoothStatistics& s, nlohmann::ordered_json& row)
{
    row["vertices"] = s.vertices;
    row["vertices_added"] = s.added;
    row["without_frame"] = s.without;
    row["shear"] = toJson(s.shear);
    row["shear"].erase("pixels");
    row["stretch"] = {{"median", s.stretchMedian}, {"max", s.stretchMaximum}};
    const std::string figures = s.shear.count == 0
        ? "no shear or stretch to measure"
        : fmt::format("shear {}; stretch median {:.3g}, max {:.3g}", toText(s.shear), s.stretchMedian, s.stretchMaximum);
    return fmt::format("{} vertices ({} added where mirrored charts meet), {} without a frame; {}", s.vertices, s.added, s.without, figures);
}

} // namespace cotan::app
