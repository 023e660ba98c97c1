// Normal maps of models as textures.
#pragma once

#include <string>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/result.hpp"
#include "inspect/angles.hpp"
#include "texture_file.hpp"

namespace cotan::app {

// How a model can hold blocks: the words of --compress that an extension of glTF names, and that extension.
std::vector<std::string> modelCompressionWords();
std::string extensionOf(const TexelCode& code);

// A word of modelCompressionWords besides none. Errors (ErrorKind::usage): "options.compress: ".
Result<TexelCode> modelCodeFor(const std::string& compress);

struct ModelTexture {
    std::vector<std::byte> bytes; // KTX2 with all levels
    AngleStatistics cost;         // degrees between the map and its largest level
};

// A normal map of a model with its levels. convention: of the map and of the texture, with three channels. Errors: as
// levelOf.
Result<ModelTexture> modelTexture(const Image& map, const TexelCode& code, const Convention& convention);

} // namespace cotan::app
