// The header of DDS files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cotan {

// How a DDS stores its pixels.
struct DdsCode {
    std::string_view letters = {}; // of blocks: "DXT1" and so on, or "DX10" where the number below counts. Empty: RGBA
                                   // of 8 bits
    std::uint32_t dxgi = 0;        // DXGI_FORMAT, with "DX10"
    std::uint32_t block = 0;       // bytes of 4 x 4 pixels
};

// "DDS ", DDS_HEADER and, with "DX10", DDS_HEADER_DXT10 of a flat picture of one level and more; the levels come behind
// it, the largest first.
std::vector<std::byte> ddsHeader(const DdsCode& code, int width, int height, std::size_t levels);

} // namespace cotan
