#include "model_texture.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"

namespace cotan::app {

std::vector<std::string> modelCompressionWords()
{
    std::vector<std::string> words = compressionWords();
    std::erase_if(
        words, [](const std::string& word) { return word != "none" && word != "uastc" && !word.starts_with("astc"); });
    return words;
}

std::string extensionOf(const TexelCode& code)
{
    return code == TexelCode::uastc ? "KHR_texture_basisu" : "EXT_texture_astc";
}

Result<TexelCode> modelCodeFor(const std::string& compress)
{
    const std::vector<std::string> words = modelCompressionWords();
    if (std::ranges::find(words, compress) == words.end())
        return about("options.compress",
                     usageError(fmt::format("expected one of {}, which extensions of glTF name; found '{}'",
                                            fmt::join(words, ", "), compress)));
    return codeFor(compress, "auto", Convention{}, "map.ktx2");
}

Result<ModelTexture> modelTexture(const Image& map, const TexelCode& code, const Convention& convention)
{
    const auto chain =
        maps::mipChain(map, {.from = convention, .to = codeConvention(code, convention), .type = PixelType::float32});
    std::vector<TextureLevel> levels;
    for (const maps::MipLevel& level : chain) {
        COTAN_TRY(made, levelOf(level.normals, code, convention));
        levels.push_back(*std::move(made));
    }
    const std::string bytes = ktx2Bytes(code, levels, map.frame);
    const auto stored = std::as_bytes(std::span(bytes));
    COTAN_TRY(cost, costOf(map, convention, stored, storedConvention(code, convention)));
    return ModelTexture{{stored.begin(), stored.end()}, *cost};
}

} // namespace cotan::app
