// The containers of textures: DDS, and KTX 2.0 (Khronos specification, version 2.0.4).
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "image/checks.hpp"
#include "image/codecs.hpp"
#include "image/dds.hpp"
#include "image/format_table.hpp"
#include "maps/textures/texel_code.hpp"

namespace cotan::maps {

namespace {

// Codes of a format in the two containers.
struct CodeFacts {
    std::uint32_t dxgi, vulkan; // DXGI_FORMAT, VkFormat
    std::uint32_t bytes;        // per pixel or block
    std::uint32_t model;        // of the Khronos Data Format: KHR_DF_MODEL_...
    std::vector<std::uint32_t> channels;
};

CodeFacts factsOf(const TexelCode& code)
{
    switch (code.kind) {
    case TexelCode::bc5: return {83, 141, 16, 132, {0, 1}};
    case TexelCode::bc5Signed: return {84, 142, 16, 132, {0, 1}};
    case TexelCode::bc7: return {98, 145, 16, 134, {0}};
    case TexelCode::bc3: return {77, 137, 16, 130, {15, 0}};
    case TexelCode::uastc: return {0, 0, 16, 166, {0}};
    case TexelCode::bc4: return {80, 139, 8, 131, {0}};
    case TexelCode::eacRg11: return {0, 155, 16, 161, {0, 1}};
    case TexelCode::eacR11: return {0, 153, 8, 161, {0}};
    case TexelCode::astc:
        for (std::uint32_t i = 0; i < kAstcSizes.size(); ++i)
            if (kAstcSizes[i].width == code.width && kAstcSizes[i].height == code.height)
                return {0, 157 + 2 * i, 16, 162, {0}};
        break;
    case TexelCode::rgba8: break;
    }
    return {0, 37, 4, 1, {0, 1, 2, 15}};
}

std::size_t bytesOf(const std::vector<TextureLevel>& levels)
{
    std::size_t bytes = 0;
    for (const TextureLevel& level : levels)
        bytes += level.texels.size();
    return bytes;
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
    bytes.reserve(256 + bytesOf(levels)); // growing it would take twice the memory
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
        constexpr std::uint32_t kSigned = 0x40; // KHR_DF_SAMPLE_DATATYPE_SIGNED
        const bool isSigned = code == TexelCode::bc5Signed;
        appendNumber(d, facts.channels[i] | (isSigned ? kSigned : 0), 1);
        appendNumber(d, 0, 4); // sample position
        appendNumber(d, isSigned ? 0x80000000 : 0, 4);
        appendNumber(d, isSigned ? 0x7fffffff : blocks ? 0xffffffff : 255, 4);
    }
    return d;
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
    std::string data;
    data.reserve(keysAt + keys.size() + bytesOf(levels) + levels.size() * facts.bytes);
    data.resize(keysAt + keys.size(), '\0'); // precedes the levels; filled at the end
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

} // namespace

std::string textureBytes(const std::filesystem::path& file, const TexelCode& code,
                         const std::vector<TextureLevel>& levels, const std::string& frame)
{
    return imageFormatOf(file)->name == "DDS" ? ddsBytes(code, levels) : ktx2Bytes(code, levels, frame);
}

} // namespace cotan::maps
