// The figures of the papers and more, drawn anew and measured: PNGs and one HTML page.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "files/report/json.hpp"

namespace cotan::figures {

// The names of all figures, in the order of the page.
std::vector<std::string_view> figureNames();

struct FiguresOptions {
    std::vector<std::string> only{}; // names; empty: all. The order is that of the page
    int width = 480, height = 360;   // of a wide panel, in pixels; square ones are height x height
    int threads = 0;                 // of the reference renderer; 0: all cores
    std::string command{};           // what the page adds to the command line that makes a figure
    std::function<void(std::string_view name, const std::string& title)> made{}; // after each figure
    Progress progress{};
};

// Draws figures and writes their pictures, overview.png and index.html into a folder that is there. Returns the
// figures' names, pictures and angles for a report. Errors: those of the renderer and of writing; ErrorKind::usage:
// "options.only: " for a name that is no figure's; ErrorKind::stopped.
Result<Json> drawFigures(Renderer& renderer, const std::filesystem::path& folder, const FiguresOptions& options);

} // namespace cotan::figures
