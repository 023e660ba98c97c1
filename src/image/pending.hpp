// Images that are written beside their places, to appear together.
#pragma once

#include <filesystem>
#include <span>

#include "cotan/scene.hpp"
#include "files/output.hpp"

namespace cotan {

// As writeImage, but the file appears when the caller commits it (commitTogether). Errors: as writeImage.
Result<OutputFile> writePending(const std::filesystem::path& file, const Image& image);

struct PlacedImage {
    std::filesystem::path file;
    const Image* image = nullptr;
};

// Writes all of them or none. Errors: as writeImage; one of commitTogether.
Status writeTogether(std::span<const PlacedImage> images);

} // namespace cotan
