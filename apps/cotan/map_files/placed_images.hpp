// Images that appear together, or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "cotan/scene.hpp"
#include "files/output.hpp"

namespace cotan {

struct PlacedImage {
    std::filesystem::path file;
    const Image* image = nullptr;
};

// Writes them beside their places; they appear when the caller commits them (commitTogether). Errors: those of the
// first that cannot be written (writeImage), and then there is none.
Result<std::vector<OutputFile>> writePending(std::span<const PlacedImage> images);

// Writes all of them or none. Errors: as writeImage; one of commitTogether.
Status writeTogether(std::span<const PlacedImage> images);

} // namespace cotan
