#include "texture_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

#include "block.hpp"
#include "files/output.hpp"
#include "image/checks.hpp"
#include "image/dds.hpp"
#include "image/format_table.hpp"

namespace cotan::app {

namespace {

// Codes of a format in the two containers.
struct CodeFacts {
    std::uint32_t dxgi, vulkan; // DXGI_FORMAT, VkFormat
    std::uint32_t bytes;        // per pixel or block
    std::uint32_t model;        // of the Khronos Data Format: KHR_DF_MODEL_...
    std::vector<std::uint32_t> channels;
};

CodeFacts factsOf(TexelCode code)
{
    switch (code) {
    case TexelCode::bc5: return {83, 141, 16, 132, {0, 1}};
    case TexelCode::bc7: return {98, 145, 16, 134, {0}};
    case TexelCode::bc4: return {80, 139, 8, 131, {0}};
    case TexelCode::rgba8: break;
    }
    return {0, 37, 4, 1, {0, 1, 2, 15}};
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

std::string ddsBytes(TexelCode code, const std::vector<TextureLevel>& levels)
{
    const CodeFacts facts = factsOf(code);
    const DdsCode stored = code == TexelCode::rgba8 ? DdsCode{} : DdsCode{"DX10", facts.dxgi, facts.bytes};
    std::string bytes;
    append(bytes, ddsHeader(stored, levels[0].width, levels[0].height, levels.size()));
    for (const TextureLevel& level : levels)
        append(bytes, level.texels);
    return bytes;
}

// The basic data format descriptor of the Khronos Data Format 1.3: linear values, one sample per channel.
std::string descriptor(TexelCode code, const CodeFacts& facts)
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
    appendNumber(d, blocks ? 0x0303 : 0, 4); // block size minus one: 4 x 4 or 1 x 1
    appendNumber(d, facts.bytes, 8);         // bytes of the first plane
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

// Header, level index, descriptor, keys, and the levels, smallest first.
std::string ktx2Bytes(TexelCode code, const std::vector<TextureLevel>& levels, const std::string& frame)
{
    const CodeFacts facts = factsOf(code);
    std::string dataFormat = descriptor(code, facts), keys;
    std::vector<std::string> entries = {std::string("KTXorientation\0rd", 18), std::string("KTXwriter\0cotan", 16)};
    if (!frame.empty()) // last, since keys are sorted; null-terminated like the others
        entries.push_back(std::string(kFrameKey) + '\0' + frame + '\0');
    for (const std::string& entry : entries) {
        appendNumber(keys, entry.size(), 4);
        keys += entry + std::string((4 - entry.size() % 4) % 4, '\0');
    }
    const std::size_t descriptorAt = 80 + 24 * levels.size(), keysAt = descriptorAt + dataFormat.size();
    std::string data(keysAt + keys.size(), '\0'); // precedes the levels; filled at the end
    std::vector<std::size_t> offsets(levels.size());
    for (std::size_t i = levels.size(); i-- > 0;) {
        data.resize((data.size() + facts.bytes - 1) / facts.bytes * facts.bytes, '\0');
        offsets[i] = data.size();
        append(data, levels[i].texels);
    }
    std::string head = "\xabKTX 20\xbb\r\n\x1a\n";
    for (const std::uint64_t number :
         {std::uint64_t(facts.vulkan), std::uint64_t(1), std::uint64_t(levels[0].width),
          std::uint64_t(levels[0].height), std::uint64_t(0), std::uint64_t(0), std::uint64_t(1),
          std::uint64_t(levels.size()), std::uint64_t(0), std::uint64_t(descriptorAt), std::uint64_t(dataFormat.size()),
          std::uint64_t(keysAt), std::uint64_t(keys.size())})
        appendNumber(head, number, 4);
    appendNumber(head, 0, 8);
    appendNumber(head, 0, 8);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        appendNumber(head, offsets[i], 8);
        appendNumber(head, levels[i].texels.size(), 8);
        appendNumber(head, levels[i].texels.size(), 8);
    }
    head += dataFormat + keys;
    std::ranges::copy(head, data.begin());
    return data;
}

// The scale by which a shader decodes codes: see Expansion.
CodeScale scaleOf(Expansion expansion)
{
    if (expansion == Expansion::biased)
        return {127.5f, 127.5f};
    return expansion == Expansion::exact16 ? CodeScale{255 * 32768 / 65535.0f, 255 * 32767 / 65535.0f} : CodeScale{};
}

} // namespace

bool isTextureFile(const std::filesystem::path& file) { return imageFormatHas(file, &ImageFormat::texture); }

Status writeTextureFile(const std::filesystem::path& file, TexelCode code, const std::vector<TextureLevel>& levels,
                        const std::string& frame)
{
    const bool dds = imageFormatOf(file)->name == "DDS";
    return writeFileWhole(file, dds ? ddsBytes(code, levels) : ktx2Bytes(code, levels, frame));
}

TextureLevel levelOf(const Image& image, TexelCode code, const Convention& to, bool lengths)
{
    TextureLevel level{image.width, image.height, {}};
    if (code == TexelCode::bc5)
        level.texels = encodeBc5(image, scaleOf(to.expansion));
    else if (code == TexelCode::bc7)
        level.texels = encodeBc7(image, scaleOf(to.expansion), lengths);
    else
        level.texels = image.data;
    return level;
}

TextureLevel bc4Level(const Image& image) { return {image.width, image.height, encodeBc4(image)}; }

Result<TexelCode> codeFor(const std::string& compress, const std::string& bits, const Convention& to,
                          const std::filesystem::path& file)
{
    if (compress != "none" && compress != "bc5" && compress != "bc7")
        return about("options.compress", usageError(fmt::format("expected none, bc5 or bc7; found '{}'", compress)));
    if (!isTextureFile(file) && compress != "none")
        return about(
            "options.compress",
            usageError(fmt::format("blocks are for {} files; found '{}'",
                                   imageEndings(&ImageFormat::texture, ", ", " and "), file.extension().string())));
    if (isTextureFile(file) && bits != "auto" && bits != "8")
        return about("options.bits",
                     usageError(fmt::format("expected 8 or auto, as {} files have 8 bits; found '{}'",
                                            imageFormatOf(file)->endings[0], bits)));
    if (compress == "bc5" && (to.channels == Channels::stereographic || to.channels == Channels::slope))
        return about("options.to", usageError("bc5 holds x and y of unit vectors; found another form of two channels"));
    if (compress == "bc7" && to.channels != Channels::xyz)
        return about("options.to", usageError("bc7 holds x, y and z; found two channels, which bc5 is for"));
    if (isTextureFile(file) && to.expansion == Expansion::signedValues)
        return about("options.to",
                     usageError(fmt::format("signed values need a {} of floats",
                                            imageEndings(&ImageFormat::negative, ", ", " or "))));
    return compress == "bc5" ? TexelCode::bc5 : compress == "bc7" ? TexelCode::bc7 : TexelCode::rgba8;
}

Convention codeConvention(TexelCode code, const Convention& to)
{
    Convention taken = to;
    if (code == TexelCode::bc5)
        taken.channels = Channels::orthographic;
    if (code != TexelCode::rgba8)
        taken.expansion = Expansion::biased;
    return taken;
}

} // namespace cotan::app
