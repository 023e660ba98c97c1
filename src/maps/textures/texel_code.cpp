#include "maps/textures/texel_code.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "core/value_statistics.hpp"
#include "cotan/image.hpp"
#include "image/astc.hpp"
#include "image/format_table.hpp"
#include "maps/blocks/block.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

namespace {

std::string astcWord(const TexelCode& code) { return fmt::format("astc-{}x{}", code.width, code.height); }

constexpr std::pair<const char*, TexelCode::Kind> kCodes[] = {
    {"none", TexelCode::rgba8},          {"bc3", TexelCode::bc3}, {"bc5", TexelCode::bc5},
    {"bc5-snorm", TexelCode::bc5Signed}, {"bc7", TexelCode::bc7}, {"uastc", TexelCode::uastc},
    {"eac-rg11", TexelCode::eacRg11}};

// The words of --swizzle besides auto; rrrg is another name of ra.
constexpr std::pair<const char*, Swizzle> kSwizzles[] = {
    {"rg", Swizzle::rg}, {"ra", Swizzle::greyAlpha}, {"ag", Swizzle::alphaGreen}, {"rrrg", Swizzle::greyAlpha}};

// Where a format can hold two channels; the first is that of auto.
std::vector<std::string> swizzlesOf(const TexelCode& code, const std::filesystem::path& file)
{
    if (code == TexelCode::astc)
        return {"ra", "ag", "rrrg"};
    if (code == TexelCode::bc3)
        return {"ag"};
    if (code != TexelCode::rgba8 || !imageFormatHas(file, &ImageFormat::alpha))
        return {"rg"};
    return {"rg", "ra", "ag", "rrrg"};
}

Result<Swizzle> swizzleFor(const std::string& word, const TexelCode& code, const std::string& compress,
                           const std::filesystem::path& file)
{
    const std::vector<std::string> words = swizzlesOf(code, file);
    const std::string& chosen = word == "auto" ? words[0] : word;
    if (std::ranges::find(words, chosen) == words.end())
        return about("options.swizzle",
                     usageError(fmt::format("expected one of auto, {}, as {} has; found '{}'", fmt::join(words, ", "),
                                            compress == "none" ? file.extension().string() : compress, word)));
    for (const auto& [name, swizzle] : kSwizzles)
        if (chosen == name)
            return swizzle;
    return Swizzle::rg;
}

// The scale by which a shader decodes codes: see Expansion.
CodeScale scaleOf(Expansion expansion)
{
    if (expansion == Expansion::biased)
        return {127.5f, 127.5f};
    return expansion == Expansion::exact16 ? CodeScale{255 * 32768 / 65535.0f, 255 * 32767 / 65535.0f} : CodeScale{};
}

// The same for codes of 11 bits, which are read as 16 bits: their exact zero is the one of 16.
CodeScale scaleOf11(Expansion expansion)
{
    const CodeScale eight = scaleOf(expansion == Expansion::biased ? expansion : Expansion::exact16);
    return {eight.zero / 255 * 2047, eight.unit / 255 * 2047};
}

// Stored as `scale` decodes it.
Image scaled(Image image, const CodeScale& scale)
{
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
        if (i % 4 != 3)
            image.floats()[i] = (scale.zero + (2 * image.floats()[i] - 1) * scale.unit) / 255;
    return image;
}

} // namespace

std::optional<TexelCode> codeNamed(const std::string& word)
{
    for (const auto& [name, kind] : kCodes)
        if (word == name)
            return kind;
    for (const TexelCode& code : kAstcSizes)
        if (word == astcWord(code))
            return code;
    return std::nullopt;
}

bool isTextureFile(const std::filesystem::path& file) { return imageFormatHas(file, &ImageFormat::texture); }

std::vector<std::string> compressionWords()
{
    std::vector<std::string> words;
    for (const auto& [name, kind] : kCodes)
        words.emplace_back(name);
    for (const TexelCode& code : kAstcSizes)
        words.push_back(astcWord(code));
    return words;
}

std::vector<std::string> swizzleWords()
{
    std::vector<std::string> words = {"auto"};
    for (const auto& [name, swizzle] : kSwizzles)
        words.emplace_back(name);
    return words;
}

double bitsPerTexel(const TexelCode& code)
{
    const bool eight = code == TexelCode::bc4 || code == TexelCode::eacR11;
    return code == TexelCode::rgba8 ? 32 : (eight ? 64.0 : 128.0) / (code.width * code.height);
}

Result<TextureLevel> levelOf(const Image& image, const TexelCode& code, const Convention& to, bool lengths)
{
    TextureLevel level{image.width, image.height, {}};
    if (code == TexelCode::bc5)
        level.texels = encodeBc5(image, scaleOf(to.expansion));
    else if (code == TexelCode::bc5Signed)
        level.texels = encodeBc5Signed(image);
    else if (code == TexelCode::bc7)
        level.texels = encodeBc7(image, scaleOf(to.expansion), lengths);
    else if (code == TexelCode::uastc)
        level.texels = encodeUastc(image, scaleOf(to.expansion), lengths);
    else if (code == TexelCode::bc3)
        level.texels = encodeBc3(image, scaleOf(to.expansion));
    else if (code == TexelCode::eacRg11)
        level.texels = encodeEacRg11(image, scaleOf11(to.expansion));
    else if (code == TexelCode::astc) {
        const AstcChannels channels = code.swizzle == Swizzle::rg ? AstcChannels::all
            : code.swizzle == Swizzle::greyAlpha                  ? AstcChannels::greyAlpha
                                                                  : AstcChannels::alphaGreen;
        COTAN_TRY(blocks, encodeAstc(code.width, code.height, scaled(image, scaleOf(to.expansion)), channels));
        level.texels = *std::move(blocks);
    } else if (code.swizzle != Swizzle::rg) {
        Image placed = image;
        swizzle(placed, code.swizzle);
        level.texels = std::move(placed.data);
    } else {
        level.texels = image.data;
    }
    return level;
}

Status addCosts(const Image& map, const Convention& convention, const TextureLevel& level, const TexelCode& code,
                const Convention& to, const std::filesystem::path& file, ValueStatistics& degrees)
{
    const std::string bytes = textureBytes(file, code, {level});
    COTAN_TRY(read, decodeImage(std::as_bytes(std::span(bytes)), "the texture"));
    if (imageFormatOf(file)->name == "DDS") // which does not say where x and y are
        unswizzle(*read, code.swizzle);
    for (const float angle : anglesBetween(map, convention, *read, storedConvention(code, to)))
        if (angle >= 0)
            degrees.add(double(angle));
    return Done{};
}

Result<TexelCode> codeFor(const std::string& compress, const std::string& bits, const Convention& to,
                          const std::filesystem::path& file, const std::string& swizzle)
{
    std::optional<TexelCode> code = codeNamed(compress);
    if (!code)
        return about(
            "options.compress",
            usageError(fmt::format("expected one of {}; found '{}'", fmt::join(compressionWords(), ", "), compress)));
    if (!isTextureFile(file) && compress != "none")
        return about(
            "options.compress",
            usageError(fmt::format("blocks are for {} files; found '{}'",
                                   imageEndings(&ImageFormat::texture, ", ", " and "), file.extension().string())));
    if (isTextureFile(file) && bits != "auto" && bits != "8")
        return about("options.bits",
                     usageError(fmt::format("expected 8 or auto, as {} files have 8 bits; found '{}'",
                                            imageFormatOf(file)->endings[0], bits)));
    const bool mobile = *code == TexelCode::eacRg11 || *code == TexelCode::astc || *code == TexelCode::uastc;
    if (mobile && imageFormatOf(file)->name != "KTX2")
        return about("options.compress",
                     usageError(fmt::format("{} is for .ktx2 files; found '{}'", compress, file.extension().string())));
    const bool other = to.channels == Channels::stereographic || to.channels == Channels::slope;
    if (compress != "none" && compress != "bc7" && compress != "uastc" && other)
        return about("options.to",
                     usageError(fmt::format("{} holds x and y of unit vectors; found another form of two "
                                            "channels",
                                            compress)));
    if ((compress == "bc7" || compress == "uastc") && to.channels != Channels::xyz)
        return about("options.to",
                     usageError(fmt::format("{} holds x, y and z; found two channels, which bc5 is for", compress)));
    code->two = to.channels != Channels::xyz || (*code != TexelCode::astc && *code != TexelCode::rgba8);
    if (compress == "bc7" || compress == "uastc")
        code->two = false;
    if (code->two) {
        COTAN_TRY(placed, swizzleFor(swizzle, *code, compress, file));
        code->swizzle = *placed;
    } else if (swizzle != "auto") {
        return about("options.swizzle",
                     usageError(fmt::format("expected auto, as the map has three channels (--to with "
                                            "xy has two); found '{}'",
                                            swizzle)));
    }
    if (isTextureFile(file) && to.expansion == Expansion::signedValues && *code != TexelCode::bc5Signed)
        return about("options.to",
                     usageError(fmt::format("signed values need a {} of floats",
                                            imageEndings(&ImageFormat::negative, ", ", " or "))));
    return *code;
}

Convention codeConvention(const TexelCode& code, const Convention& to)
{
    Convention taken = storedConvention(code, to);
    if (code != TexelCode::rgba8)
        taken.expansion = Expansion::biased;
    return taken;
}

Convention storedConvention(const TexelCode& code, const Convention& to)
{
    Convention stored = to;
    if (code.twoChannels() && to.channels == Channels::xyz)
        stored.channels = Channels::orthographic;
    if (code == TexelCode::bc5Signed) // a reader that carries it in unsigned components has this zero
        stored.expansion = Expansion::exact;
    return stored;
}

} // namespace cotan::maps
