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

} // namespace

Result<MadeTexture> makeTexture(Image map, const TextureSettings& s)
{
    COTAN_TRY(code, codeFor(s.compress, "auto", s.to, s.file, s.swizzle));
    if ((s.from.kind == MapKind::objectSpace) != (s.to.kind == MapKind::objectSpace))
        return about("options.to", usageError("expected a map of the same space; object space needs the mesh"));
    const Convention taken = codeConvention(*code, s.to);
    TextureRows texture(map.width, map.height, *code, taken, s);
    for (int y = 0, atOnce = rowsAtOnce(map.width); y < map.height; y += atOnce) {
        const Image rows = rowsOf(map, y, std::min(atOnce, map.height - y));
        RecodeCounts counts;
        const RecodeSettings settings{.from = s.from, .to = taken, .type = typeOf(*code), .normalise = s.normalise};
        COTAN_CHECK(texture.add(recode(rows, settings, counts), &rows));
    }
    return texture.finish(map.frame);
}

TextureRows::TextureRows(int width, int height, const TexelCode& code, const Convention& taken, TextureSettings s)
    : code_(code), settings_(std::move(s)),
      mips_(width, height, {.from = taken, .to = codeConvention(code, settings_.to), .type = typeOf(code)},
            code.holdsRoughness() ? MipRows::averaged : MipRows::one)
{
    for (std::size_t i = 0; i < (settings_.mips ? mips_.levels() : 1); ++i)
        levels_.emplace_back(mips_.size(i));
}

int rowsAtOnce(int width)
{
    constexpr int kTexels = 1 << 20; // enough for all threads
    return std::max(kTexels / width / kWholeBlocks, 1) * kWholeBlocks;
}

Status LevelRows::add(const Image& rows, const std::function<Result<TextureLevel>(const Image&)>& encode)
{
    arrived_ += rows.height;
    waiting_.insert(waiting_.end(), rows.data.begin(), rows.data.end());
    Image next = makeImage(made.width, 1, rows.type);
    const int waiting = int(waiting_.size() / next.data.size()), whole = waiting / kWholeBlocks * kWholeBlocks;
    next.height = arrived_ == made.height ? waiting : whole;
    if (next.height == 0 || (next.height < waiting && next.pixelCount() < kWholeBlocks * 1024))
        return Done{};
    const auto end = waiting_.begin() + std::ptrdiff_t(next.data.size() * std::size_t(next.height));
    next.data.assign(waiting_.begin(), end);
    waiting_.erase(waiting_.begin(), end);
    COTAN_TRY(blocks, encode(next));
    if (made.texels.empty())
        made.texels.reserve(blocks->texels.size() * std::size_t((made.height - 1) / next.height + 1));
    made.texels.insert(made.texels.end(), blocks->texels.begin(), blocks->texels.end());
    return Done{};
}

Status TextureRows::add(const Image& rows, const Image* map)
{
    const auto encode = [&](const Image& next) { return levelOf(next, code_, settings_.to); };
    COTAN_CHECK(levels_[0].add(rows, [&](const Image& next) -> Result<TextureLevel> {
        COTAN_TRY(made, encode(next));
        if (map) {
            const Status compared =
                addCosts(*map, settings_.from, *made, code_, settings_.to, settings_.file, degrees_);
            compared_ = bool(compared);
            if (!compared && compared.error().kind != ErrorKind::unavailable)
                return compared.error();
        }
        return made;
    }));
    Status state = Done{};
    if (settings_.mips)
        mips_.add(rows, [&](std::size_t i, const Image& made, const Image&) {
            if (const Status encoded = levels_[i].add(made, encode); state && !encoded)
                state = encoded;
        });
    return state;
}

MadeTexture TextureRows::finish(const std::string& frame)
{
    std::vector<TextureLevel> levels;
    for (LevelRows& level : levels_)
        levels.push_back(std::move(level.made));
    const std::string bytes = textureBytes(settings_.file, code_, levels, frame);
    const auto count = int(levels.size());
    levels.clear(); // its memory
    const auto view = std::as_bytes(std::span(bytes));
    MadeTexture made{{view.begin(), view.end()}, count, storedConvention(code_, settings_.to)};
    if (compared_)
        made.cost = {degrees_.mean(), degrees_.percentile(0.99)};
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
