#include "maps/textures/make_texture.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

namespace {

// Rows that fill blocks of 4, 5, 6 and 8 rows.
constexpr int kWholeBlocks = 120;

PixelType typeOf(const TexelCode& code) { return code == TexelCode::rgba8 ? PixelType::unorm8 : PixelType::float32; }

Image rowsOf(const Image& image, int first, int count)
{
    Image rows = makeImage(image.width, count, image.type, image.name);
    const std::size_t bytes = std::size_t(image.width) * image.bytesPerPixel();
    std::copy_n(image.data.data() + std::size_t(first) * bytes, std::size_t(count) * bytes, rows.data.data());
    return rows;
}

// Calls add(rows) for all rows of an image, as many as the texture takes at once.
template<class Add> Status addWhole(const TextureRows& texture, const Image& image, const Add& add)
{
    for (int y = 0; y < image.height; y += texture.rowsAtOnce())
        COTAN_CHECK(add(rowsOf(image, y, std::min(texture.rowsAtOnce(), image.height - y))));
    return Done{};
}

} // namespace

Result<MadeTexture> makeTexture(Image map, const TextureSettings& s)
{
    COTAN_TRY(code, codeFor(s.compress, "auto", s.to, s.file, s.swizzle));
    if ((s.from.kind == MapKind::objectSpace) != (s.to.kind == MapKind::objectSpace))
        return about("options.to", usageError("expected a map of the same space; object space needs the mesh"));
    if (s.from.channels != Channels::xyz)
        unswizzle(map, swizzleOf(map));
    const Convention taken = codeConvention(*code, s.to);
    TextureRows texture(map.width, map.height, *code, taken, s);
    COTAN_CHECK(addWhole(texture, map, [&](const Image& rows) {
        RecodeCounts counts;
        return texture.add(recode(rows, {.from = s.from, .to = taken, .type = typeOf(*code)}, counts), &rows);
    }));
    return texture.finish(map.frame);
}

TextureRows::TextureRows(int width, int height, const TexelCode& code, const Convention& taken, TextureSettings s)
    : code_(code), settings_(std::move(s)),
      mips_(width, height, {.from = taken, .to = codeConvention(code, settings_.to), .type = typeOf(code)},
            code.holdsRoughness())
{
    levels_.push_back({{width, height, {}}});
    while (settings_.mips && (width > 1 || height > 1)) {
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
        levels_.push_back({{width, height, {}}});
    }
}

int TextureRows::rowsAtOnce() const
{
    constexpr int kTexels = 1 << 20; // enough for all threads
    return std::max(kTexels / levels_[0].made.width / kWholeBlocks, 1) * kWholeBlocks;
}

Status TextureRows::encode(Level& level, const Image& rows, const Image* map)
{
    COTAN_TRY(made, levelOf(rows, code_, settings_.to));
    std::vector<std::byte>& texels = level.made.texels;
    if (texels.empty())
        texels.reserve(made->texels.size() * std::size_t((level.made.height - 1) / rows.height + 1));
    texels.insert(texels.end(), made->texels.begin(), made->texels.end());
    if (!map)
        return Done{};
    const Status compared = addCosts(*map, settings_.from, *made, code_, settings_.to, settings_.file, degrees_);
    compared_ = bool(compared);
    return compared || compared.error().kind == ErrorKind::unavailable ? Status(Done{}) : compared;
}

Status TextureRows::encodeWaiting(Level& level, PixelType type)
{
    Image rows = makeImage(level.made.width, 1, type);
    const int waiting = int(level.waiting.size() / rows.data.size()), whole = waiting / kWholeBlocks * kWholeBlocks;
    rows.height = level.rows == level.made.height ? waiting : whole;
    if (rows.height == 0 || (rows.height < waiting && rows.pixelCount() < kWholeBlocks * 1024))
        return Done{};
    const auto end = level.waiting.begin() + std::ptrdiff_t(rows.data.size() * std::size_t(rows.height));
    rows.data.assign(level.waiting.begin(), end);
    level.waiting.erase(level.waiting.begin(), end);
    return encode(level, rows, nullptr);
}

Status TextureRows::add(const Image& rows, const Image* map)
{
    COTAN_CHECK(encode(levels_[0], rows, map));
    Status state = Done{};
    if (settings_.mips)
        mips_.add(rows, [&](std::size_t i, Image made) {
            levels_[i].rows += made.height;
            levels_[i].waiting.insert(levels_[i].waiting.end(), made.data.begin(), made.data.end());
            if (const Status encoded = encodeWaiting(levels_[i], made.type); state && !encoded)
                state = encoded;
        });
    return state;
}

MadeTexture TextureRows::finish(const std::string& frame)
{
    std::vector<TextureLevel> levels;
    for (Level& level : levels_)
        levels.push_back(std::move(level.made));
    const std::string bytes = textureBytes(settings_.file, code_, levels, frame);
    const auto count = int(levels.size());
    levels.clear(); // its memory
    const auto view = std::as_bytes(std::span(bytes));
    MadeTexture made{{view.begin(), view.end()}, count, storedConvention(code_, settings_.to)};
    if (compared_)
        made.cost = costOf(degrees_);
    return made;
}

Result<MadeTexture> wholeTexture(const Image& image, const TexelCode& code, bool compared, const TextureSettings& s)
{
    TextureRows texture(image.width, image.height, code, s.from, s);
    COTAN_CHECK(
        addWhole(texture, image, [&](const Image& rows) { return texture.add(rows, compared ? &rows : nullptr); }));
    return texture.finish(image.frame);
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
