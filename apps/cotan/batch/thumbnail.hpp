// Thumbnails of images.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "batch/record.hpp"

namespace cotan {

// A JPEG of at most 64 x 64 pixels and about two kilobytes, with transparent pixels over grey. Only a few rows of the
// image are in memory at a time. Returns nullopt for files that are not images.
std::optional<Thumbnail> thumbnailOf(const std::filesystem::path& image);

} // namespace cotan
