// Images written to a temporary file beside their final path.
#pragma once

#include <filesystem>

#include "cotan/scene.hpp"
#include "files/output.hpp"

namespace cotan {

// As writeImage, but the file appears only when the caller commits it (commitTogether). Errors: as writeImage.
Result<OutputFile> writePending(const std::filesystem::path& file, const Image& image);

} // namespace cotan
