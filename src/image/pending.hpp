// Images that are written beside their places, to appear together.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "cotan/scene.hpp"
#include "files/output.hpp"

namespace cotan {

// As writeImage, but the file appears when the caller commits it (commitTogether). Errors: as writeImage.
Result<OutputFile> writePending(const std::filesystem::path& file, const Image& image);

struct PlacedImage {
    std::filesystem::path file;
    const Image* image = nullptr;
};

// The same of several. Errors: those of the first that cannot be written, and then there is none.
Result<std::vector<OutputFile>> writePending(std::span<const PlacedImage> images);

// Writes all of them or none. Errors: as writeImage; one of commitTogether.
Status writeTogether(std::span<const PlacedImage> images);

} // namespace cotan
