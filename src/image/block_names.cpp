// The names of the blocks in DDS and KTX2 files.
#include <cstdint>
#include <cstring>
#include <string_view>

#include "codecs.hpp"
#include "image/format_table.hpp"

namespace cotan {

namespace {

struct BlockName {
    std::string_view name;
    std::uint32_t dxgi = 0, vulkan = 0, srgb = 0; // DXGI_FORMAT, VkFormat and its sRGB variant; 0: none
};

constexpr BlockName kBlockNames[] = {
    {"bc1", 71, 131, 132},     {"bc1", 72, 133, 134},     {"etc2", 0, 147, 148},     {"bc3", 77, 137, 138},
    {"bc5", 83, 141},          {"bc5-snorm", 84, 142},    {"bc7", 98, 145, 146},     {"eac-rg11", 0, 155},
    {"astc-4x4", 0, 157, 158}, {"astc-5x4", 0, 159, 160}, {"astc-5x5", 0, 161, 162}, {"astc-6x5", 0, 163, 164},
    {"astc-6x6", 0, 165, 166}, {"astc-8x5", 0, 167, 168}, {"astc-8x6", 0, 169, 170}, {"astc-8x8", 0, 171, 172}};

} // namespace

std::string blockName(std::span<const std::byte> file)
{
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        if (at <= file.size() && file.size() - at >= 4)
            std::memcpy(&value, file.data() + at, 4);
        return value;
    };
    const ImageFormat* const format = imageFormatOf(file);
    std::uint32_t dxgi = 0, vulkan = 0;
    if (format && format->name == "KTX2") {
        vulkan = number(12);
        constexpr std::uint32_t kEtc1s = 163, kUastc = 166; // KHR_DF_MODEL_*, in the data format descriptor
        const std::uint32_t model = number(std::size_t(number(48)) + 12) & 0xff;
        if (vulkan == 0 && (model == kEtc1s || model == kUastc))
            return model == kUastc ? "uastc" : "etc1s";
    } else if (format && format->name == "DDS" && file.size() >= 132) {
        const std::string_view letters(reinterpret_cast<const char*>(file.data()) + 84, 4);
        dxgi = letters == "DX10"                     ? number(128)
            : letters == "DXT1"                      ? 71
            : letters == "DXT5"                      ? 77
            : letters == "ATI2" || letters == "BC5U" ? 83
            : letters == "BC5S"                      ? 84
                                                     : 0;
    }
    for (const BlockName& one : kBlockNames)
        if ((dxgi != 0 && dxgi == one.dxgi) || (vulkan != 0 && (vulkan == one.vulkan || vulkan == one.srgb)))
            return std::string(one.name);
    return {};
}

} // namespace cotan
