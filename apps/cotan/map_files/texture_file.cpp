#include "texture_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "block.hpp"
#include "core/try.hpp"
#include "cotan/image.hpp"
#include "files/output.hpp"
#include "image/astc.hpp"
#include "image/checks.hpp"
#include "image/codecs.hpp"
#include "image/dds.hpp"
#include "image/format_table.hpp"
#include "maps/texels.hpp"

namespace cotan::app {

using maps::Swizzle;

namespace {

// Codes of a format in the two containers.
struct CodeFacts {
    std::uint32_t dxgi, vulkan; // DXGI_FORMAT, VkFormat
    std::uint32_t bytes;        // per pixel or block
    std::uint32_t model;        // of the Khronos Data Format: KHR_DF_MODEL_...
    std::vector<std::uint32_t> channels;
};

// Of ASTC, in the order of their VkFormats from 157 on, which alternate with those of sRGB.
constexpr std::array<TexelCode, 8> kAstc{{{4, 4}, {5, 4}, {5, 5}, {6, 5}, {6, 6}, {8, 5}, {8, 6}, {8, 8}}};

CodeFacts factsOf(const TexelCode& code)
{
    switch (code.kind) {
    case TexelCode::bc5: return {83, 141, 16, 132, {0, 1}};
    case TexelCode::bc7: return {98, 145, 16, 134, {0}};
    case TexelCode::bc3: return {77, 137, 16, 130, {15, 0}};
    case TexelCode::uastc: return {0, 0, 16, 166, {0}};
    case TexelCode::bc4: return {80, 139, 8, 131, {0}};
    case TexelCode::eacRg11: return {0, 155, 16, 161, {0, 1}};
    case TexelCode::eacR11: return {0, 153, 8, 161, {0}};
    case TexelCode::astc:
        for (std::uint32_t i = 0; i < kAstc.size(); ++i)
            if (kAstc[i].width == code.width && kAstc[i].height == code.height)
                return {0, 157 + 2 * i, 16, 162, {0}};
        break;
    case TexelCode::rgba8: break;
    }
    return {0, 37, 4, 1, {0, 1, 2, 15}};
}

std::string astcWord(const TexelCode& code) { return fmt::format("astc-{}x{}", code.width, code.height); }

constexpr std::pair<const char*, TexelCode::Kind> kCodes[] = {
    {"none", TexelCode::rgba8}, {"bc3", TexelCode::bc3},     {"bc5", TexelCode::bc5},
    {"bc7", TexelCode::bc7},    {"uastc", TexelCode::uastc}, {"eac-rg11", TexelCode::eacRg11}};

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

std::optional<TexelCode> codeNamed(const std::string& word)
{
    for (const auto& [name, kind] : kCodes)
        if (word == name)
            return kind;
    for (const TexelCode& code : kAstc)
        if (word == astcWord(code))
            return code;
    return std::nullopt;
}

void append(std::string& bytes, const std::vector<std::byte>& more)
{
    bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
}

void appendNumber(std::string& bytes, std::uint64_t number, int size)
{
    for (int i = 0; i < size; ++i)
        bytes += char(number >> 8 * i & 0xff);
}

std::string ddsBytes(const TexelCode& code, const std::vector<TextureLevel>& levels)
{
    const CodeFacts facts = factsOf(code);
    DdsCode stored;
    if (code == TexelCode::bc3) // every reader knows its old name
        stored = {"DXT5", 0, facts.bytes};
    else if (code != TexelCode::rgba8)
        stored = {"DX10", facts.dxgi, facts.bytes};
    std::string bytes;
    append(bytes, ddsHeader(stored, levels[0].width, levels[0].height, levels.size()));
    for (const TextureLevel& level : levels)
        append(bytes, level.texels);
    return bytes;
}

// The basic data format descriptor of the Khronos Data Format 1.3: linear values, one sample per channel.
std::string descriptor(const TexelCode& code, const CodeFacts& facts)
{
    const bool blocks = code != TexelCode::rgba8;
    const std::size_t size = 24 + 16 * facts.channels.size();
    std::string d;
    appendNumber(d, size + 4, 4);
    appendNumber(d, 0, 4); // vendor Khronos, type basic
    appendNumber(d, 2, 2); // version 1.3
    appendNumber(d, size, 2);
    appendNumber(d, facts.model, 1);
    appendNumber(d, 1, 1); // BT.709 primaries
    appendNumber(d, 1, 1); // linear transfer function
    appendNumber(d, 0, 1);
    const auto block = std::uint64_t(code.width - 1) | std::uint64_t(code.height - 1) << 8;
    appendNumber(d, blocks ? block : 0, 4); // size of a block minus one
    appendNumber(d, facts.bytes, 8);        // bytes of the first plane
    const std::size_t bits = facts.bytes * 8 / facts.channels.size();
    for (std::size_t i = 0; i < facts.channels.size(); ++i) {
        appendNumber(d, i * bits, 2);
        appendNumber(d, bits - 1, 1);
        appendNumber(d, facts.channels[i], 1);
        appendNumber(d, 0, 8); // sample position, lowest value
        appendNumber(d, blocks ? 0xffffffff : 255, 4);
    }
    return d;
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

bool isTextureFile(const std::filesystem::path& file) { return imageFormatHas(file, &ImageFormat::texture); }

std::vector<std::string> compressionWords()
{
    std::vector<std::string> words;
    for (const auto& [name, kind] : kCodes)
        words.emplace_back(name);
    for (const TexelCode& code : kAstc)
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
    return 8.0 * factsOf(code).bytes / (code == TexelCode::rgba8 ? 1 : code.width * code.height);
}

// Header, level index, descriptor, keys, and the levels, smallest first.
std::string ktx2Bytes(const TexelCode& code, const std::vector<TextureLevel>& levels, const std::string& frame)
{
    const CodeFacts facts = factsOf(code);
    std::string dataFormat = descriptor(code, facts), keys;
    std::vector<std::string> entries = {std::string("KTXorientation\0rd", 18), std::string("KTXwriter\0cotan", 16)};
    if (code.swizzle != Swizzle::rg) // where a reader finds x and y
        entries.insert(entries.begin() + 1,
                       std::string(code.swizzle == Swizzle::greyAlpha ? "KTXswizzle\0ra01" : "KTXswizzle\0ag01", 16));
    if (!frame.empty()) // last, since keys are sorted; null-terminated like the others
        entries.push_back(std::string(kFrameKey) + '\0' + frame + '\0');
    for (const std::string& entry : entries) {
        appendNumber(keys, entry.size(), 4);
        keys += entry + std::string((4 - entry.size() % 4) % 4, '\0');
    }
    const std::size_t descriptorAt = 80 + 24 * levels.size(), keysAt = descriptorAt + dataFormat.size();
    std::string data(keysAt + keys.size(), '\0'); // precedes the levels; filled at the end
    // UASTC is packed as its own encoder does; other blocks are for engines that may not unpack them.
    std::vector<std::vector<std::byte>> packed;
    for (std::size_t i = 0; code == TexelCode::uastc && i < levels.size(); ++i)
        packed.push_back(packZstd(levels[i].texels));
    const bool packs = !packed.empty() && std::ranges::none_of(packed, &std::vector<std::byte>::empty);
    const auto stored = [&](std::size_t i) -> const std::vector<std::byte>& {
        return packs ? packed[i] : levels[i].texels;
    };
    std::vector<std::size_t> offsets(levels.size());
    for (std::size_t i = levels.size(); i-- > 0;) {
        if (!packs)
            data.resize((data.size() + facts.bytes - 1) / facts.bytes * facts.bytes, '\0');
        offsets[i] = data.size();
        append(data, stored(i));
    }
    std::string head = "\xabKTX 20\xbb\r\n\x1a\n";
    for (const std::uint64_t number :
         {std::uint64_t(facts.vulkan), std::uint64_t(1), std::uint64_t(levels[0].width),
          std::uint64_t(levels[0].height), std::uint64_t(0), std::uint64_t(0), std::uint64_t(1),
          std::uint64_t(levels.size()), std::uint64_t(packs ? 2 : 0), std::uint64_t(descriptorAt),
          std::uint64_t(dataFormat.size()), std::uint64_t(keysAt), std::uint64_t(keys.size())})
        appendNumber(head, number, 4);
    appendNumber(head, 0, 8);
    appendNumber(head, 0, 8);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        appendNumber(head, offsets[i], 8);
        appendNumber(head, stored(i).size(), 8);
        appendNumber(head, levels[i].texels.size(), 8);
    }
    head += dataFormat + keys;
    std::ranges::copy(head, data.begin());
    return data;
}

Status writeTextureFile(const std::filesystem::path& file, const TexelCode& code,
                        const std::vector<TextureLevel>& levels, const std::string& frame)
{
    const bool dds = imageFormatOf(file)->name == "DDS";
    return writeFileWhole(file, dds ? ddsBytes(code, levels) : ktx2Bytes(code, levels, frame));
}

Result<TextureLevel> levelOf(const Image& image, const TexelCode& code, const Convention& to, bool lengths)
{
    TextureLevel level{image.width, image.height, {}};
    if (code == TexelCode::bc5)
        level.texels = encodeBc5(image, scaleOf(to.expansion));
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

Result<AngleStatistics> costOf(const Image& map, const Convention& convention, std::span<const std::byte> texture,
                               const Convention& stored)
{
    COTAN_TRY(read, decodeImage(texture, "the texture"));
    AngleCounter angles;
    for (const float degrees : maps::anglesBetween(map, convention, *read, stored))
        angles.add(degrees);
    return angles.statistics();
}

TextureLevel greyLevel(const Image& image, const TexelCode& code)
{
    return {image.width, image.height,
            code == TexelCode::rgba8       ? image.data
                : code == TexelCode::uastc ? encodeUastc(image, scaleOf(Expansion::biased), true)
                : code == TexelCode::bc4   ? encodeBc4(image)
                                           : encodeEacR11(image)};
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
    if (isTextureFile(file) && to.expansion == Expansion::signedValues)
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
    return stored;
}

} // namespace cotan::app
