// The header of DDS files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace cotan {

// How a DDS stores its pixels.
struct DdsCode {
    std::string_view letters = {}; // FourCC: "DXT1" etc., or "DX10" if `dxgi` applies. Empty: 8-bit RGBA
    std::uint32_t dxgi = 0;        // DXGI_FORMAT, with "DX10"
    std::uint32_t block = 0;       // bytes per block of 4 x 4 pixels
};

// "DDS ", DDS_HEADER and, for "DX10", DDS_HEADER_DXT10 of a 2D texture with `levels` levels (at least 1). The levels
// follow the header, largest first.
inline std::vector<std::byte> ddsHeader(const DdsCode& code, int width, int height, std::size_t levels)
{
    const bool blocks = !code.letters.empty();
    std::array<std::uint32_t, 37> header{};
    header[0] = 0x20534444; // "DDS "
    header[1] = 124;
    header[2] = 0x1 | 0x2 | 0x4 | (blocks ? 0x80000 : 0x8) | 0x1000; // caps, height, width, size or pitch, format
    header[3] = std::uint32_t(height);
    header[4] = std::uint32_t(width);
    header[5] = blocks ? std::uint32_t((width + 3) / 4) * std::uint32_t((height + 3) / 4) * code.block
                       : std::uint32_t(width) * 4;
    header[19] = 32;     // size of DDS_PIXELFORMAT
    header[27] = 0x1000; // DDSCAPS_TEXTURE
    if (levels > 1) {
        header[2] |= 0x20000;
        header[7] = std::uint32_t(levels);
        header[27] |= 0x8 | 0x400000; // DDSCAPS_COMPLEX, DDSCAPS_MIPMAP
    }
    if (blocks) {
        header[20] = 0x4; // DDPF_FOURCC
        std::memcpy(&header[21], code.letters.data(), 4);
        header[32] = code.dxgi;
        header[33] = 3; // D3D10_RESOURCE_DIMENSION_TEXTURE2D
        header[35] = 1; // array size
    } else {
        header[20] = 0x1 | 0x40; // DDPF_ALPHAPIXELS, DDPF_RGB
        header[22] = 32;
        header[23] = 0x000000ff, header[24] = 0x0000ff00, header[25] = 0x00ff0000, header[26] = 0xff000000;
    }
    std::vector<std::byte> bytes(code.letters == "DX10" ? sizeof header : 128);
    std::memcpy(bytes.data(), header.data(), bytes.size());
    return bytes;
}

} // namespace cotan
