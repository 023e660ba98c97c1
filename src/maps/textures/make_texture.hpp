// A map as the bytes of a texture file: one rule for `map convert`, models, bakes and the C API.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maps/textures/texel_code.hpp"

namespace cotan::maps {

struct TextureSettings {
    Convention from{}, to{}; // of the map and of the texture
    std::string compress = "none", swizzle = "auto";
    std::filesystem::path file = "map.ktx2"; // its extension is the container
    bool mips = true;
};

struct MadeTexture {
    std::vector<std::byte> bytes;
    int levels = 1;
    Convention stored{};               // how the texture is read
    std::optional<TextureCost> cost{}; // of the largest level; none if this build cannot decode the format
};

// Makes the file that `map convert --compress` writes. Two channels of the map are found as swizzleOf finds them.
// Image::frame is stored by KTX2. Errors: as codeFor and levelOf.
Result<MadeTexture> makeTexture(Image map, const TextureSettings& settings);

// The same from the largest level on. image: what that level was made of, in `taken`, a codeConvention. map: what the
// texture is compared with, in settings.from; null: nothing. Errors: as levelOf.
Result<MadeTexture> finishTexture(const Image& image, const Convention& taken, const TexelCode& code,
                                  TextureLevel first, const Image* map, const TextureSettings& settings);

// How a model can hold blocks: the words of --compress that an extension of glTF names, and that extension.
std::vector<std::string> modelCompressionWords();
std::string extensionOf(const std::string& compress);

// Checks a word of modelCompressionWords. Errors (ErrorKind::usage): "options.compress: ".
Status checkModelCompression(const std::string& compress);

} // namespace cotan::maps
