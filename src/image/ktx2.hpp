// KTX 2.0: the container of textures as graphics processors take them (Khronos' specification, version 2.0.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "cotan/files.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// How pixels are stored, of the numbers of VkFormat that are read here.
struct Ktx2Format {
    std::uint32_t linear = 0;      // VkFormat
    std::uint32_t srgb = 0;        // the same in sRGB; linear where there is none
    int channels = 0;              // of what comes out
    int bytes = 0;                 // of one component; 0: blocks of 4 x 4 pixels
    bool floats = false;           // components are floats of 2 or 4 bytes
    bool blueFirst = false;        // blue, green, red
    std::string_view letters = {}; // blocks: how DDS calls them
    std::uint32_t dxgi = 0;        // likewise, of "DX10" the number of DXGI_FORMAT
    std::uint32_t block = 0;       // bytes of a block
};

// What is read of a file: its largest level.
struct Ktx2Picture {
    Ktx2Format format;
    int width = 0, height = 0;
    std::uint32_t packing = 0;         // 0 none, 2 Zstandard, 3 zlib
    std::span<const std::byte> stored; // of the file
    std::size_t bytes = 0;             // once unpacked
    std::string swizzle;               // four of "rgba01"; empty: none is stated
    bool bottomUp = false;             // the first row is the lowest
    std::string frame;                 // Image::frame
};

// Whether this is a KTX2 whose pixels are stored in a way that nothing here decodes, for messages: "BasisU (ETC1S)",
// "BasisU (UASTC)", "ASTC", "ETC2"; empty otherwise.
std::string foreignKtx2(std::span<const std::byte> bytes);

// Every size, offset and count of the header checked against each other and the file.
// Errors: ErrorKind::input, without the file's name.
Result<Ktx2Picture> checkKtx2(std::span<const std::byte> bytes);

// As decodeImage: the largest level. Blocks (BC1 to BC5, BC7) are decoded by `readDds`, which gets them as a DDS.
Result<Image> readKtx2(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits,
                       Result<Image> (*readDds)(std::span<const std::byte>, const std::string&, const LoadLimits&));

// Fills all of `out`. Errors: ErrorKind::input where the data are damaged or have another length,
// ErrorKind::unavailable where this build lacks the library.
Status unpackZstd(std::span<const std::byte> packed, std::span<std::byte> out);
Status unpackZlib(std::span<const std::byte> packed, std::span<std::byte> out);

} // namespace cotan
