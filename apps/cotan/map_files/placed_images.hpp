// Images that appear together, or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "cotan/scene.hpp"
#include "files/output.hpp"

namespace cotan::app {

struct PlacedImage {
    std::filesystem::path file;
    const Image* image = nullptr;
};

// Writes the images to temporary files beside their final paths; they appear when the caller commits them
// (commitTogether). Errors: those of writeImage for the first image that fails; then no file is left.
Result<std::vector<OutputFile>> writePending(std::span<const PlacedImage> images);

// Writes all images or none. Errors: as writeImage; those of commitTogether.
Status writeTogether(std::span<const PlacedImage> images);

} // namespace cotan::app
