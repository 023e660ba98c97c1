// The figures of the papers and others, redrawn and measured: PNGs and an HTML page.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "files/json.hpp"

namespace cotan::figures {

// Names of all figures, in the order of the page.
std::vector<std::string_view> figureNames();

struct FiguresOptions {
    std::vector<std::string> only{}; // names; empty: all. Their order does not matter
    int width = 480, height = 360;   // size of a wide panel in pixels; square panels are height x height
    int threads = 0;                 // threads of the reference renderer; 0: all cores
    std::string command{};           // options that the page shows in the command line of each figure
    std::function<void(std::string_view name, const std::string& title)> made{}; // called after each figure
    Progress progress{};
};

// Draws figures and writes their images, overview.png and index.html into an existing folder. Returns the names, images
// and angles of the figures for a report. Errors: those of the renderer and of writing; ErrorKind::usage:
// "options.only: " for an unknown figure; ErrorKind::stopped.
Result<Json> drawFigures(Renderer& renderer, const std::filesystem::path& folder, const FiguresOptions& options);

} // namespace cotan::figures
