// A small picture of a large one.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "batch/record.hpp"

namespace cotan {

// At most 64 pixels wide and high, as a JPEG of some two kilobytes; transparent pixels over grey. Of a picture of any
// size a few rows are in memory. Nothing for what is no picture.
std::optional<Thumbnail> thumbnailOf(const std::filesystem::path& picture);

} // namespace cotan
