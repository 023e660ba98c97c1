#include "maps/textures/make_texture.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

Result<MadeTexture> makeTexture(Image map, const TextureSettings& s)
{
    COTAN_TRY(code, codeFor(s.compress, "auto", s.to, s.file, s.swizzle));
    if ((s.from.kind == MapKind::objectSpace) != (s.to.kind == MapKind::objectSpace))
        return about("options.to", usageError("expected a map of the same space; object space needs the mesh"));
    if (s.from.channels != Channels::xyz)
        unswizzle(map, swizzleOf(map));
    const Convention taken = codeConvention(*code, s.to);
    const PixelType type = *code == TexelCode::rgba8 ? PixelType::unorm8 : PixelType::float32;
    RecodeCounts counts;
    Image stored = recode(map, {.from = s.from, .to = taken, .type = type}, counts);
    stored.frame = map.frame;
    COTAN_TRY(first, levelOf(stored, *code, s.to));
    return finishTexture(stored, taken, *code, *std::move(first), &map, s);
}

Result<MadeTexture> finishTexture(const Image& image, const Convention& taken, const TexelCode& code,
                                  TextureLevel first, const Image* map, const TextureSettings& s)
{
    std::vector<TextureLevel> levels{std::move(first)};
    if (s.mips)
        COTAN_CHECK(addMips(image, taken, code, s.to, levels));
    const std::string bytes = textureBytes(s.file, code, levels, image.frame);
    const auto view = std::as_bytes(std::span(bytes));
    MadeTexture made{{view.begin(), view.end()}, int(levels.size()), storedConvention(code, s.to)};
    if (!map)
        return made;
    const auto cost = costOf(*map, s.from, view, made.stored);
    if (cost)
        made.cost = *cost;
    else if (cost.error().kind != ErrorKind::unavailable)
        return cost.error();
    return made;
}

std::vector<std::string> modelCompressionWords()
{
    std::vector<std::string> words = compressionWords();
    std::erase_if(
        words, [](const std::string& word) { return word != "none" && word != "uastc" && !word.starts_with("astc"); });
    return words;
}

std::string extensionOf(const std::string& compress)
{
    return compress == "uastc" ? "KHR_texture_basisu" : "EXT_texture_astc";
}

Status checkModelCompression(const std::string& compress)
{
    const std::vector<std::string> words = modelCompressionWords();
    if (std::ranges::find(words, compress) == words.end())
        return about("options.compress",
                     usageError(fmt::format("expected one of {}, which extensions of glTF name; found '{}'",
                                            fmt::join(words, ", "), compress)));
    return Done{};
}

} // namespace cotan::maps
