// Images that are written beside their places, to appear later.
#pragma once

#include <filesystem>

#include "cotan/scene.hpp"
#include "files/output.hpp"

namespace cotan {

// As writeImage, but the file appears when the caller commits it (commitTogether). Errors: as writeImage.
Result<OutputFile> writePending(const std::filesystem::path& file, const Image& image);

} // namespace cotan
