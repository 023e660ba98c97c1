// PNG through libpng. Direct, because here every checksum counts, nothing may be printed, and the
// rows can be decoded straight into place.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// As decodeImage. Palettes are expanded, 1-, 2- and 4-bit samples scaled to the full range, a
// transparent colour becomes alpha. Chunks about colour spaces are ignored.
Result<Image> readPng(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// Writes unorm8 or unorm16. An image whose alpha is 1 everywhere is stored without alpha, which
// reads back the same. `name` is for messages.
Status writePng(const std::filesystem::path& file, const Image& image, const std::string& name);

} // namespace cotan
