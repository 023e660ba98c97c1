// Basis Universal (BasisU) in KTX2: what the file says about it, and its texels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "image/etc1s.hpp"
#include "numbers.hpp"

namespace cotan {

enum class BasisChannels { rgb, rgba, red, redGreen, redAlpha }; // redAlpha: x in red, green and blue, y in alpha

// The data format descriptor of a file without VkFormat.
struct BasisLayout {
    bool etc1s = false; // else UASTC
    BasisChannels channels = BasisChannels::rgb;

    int channelCount() const;
    int slices() const { return channelCount() % 2 == 0 ? 2 : 1; } // of ETC1S
};

// Errors of all: ErrorKind::input, without the file's name.

// Reads the colour model and the channels, and compares the supercompression with them.
Result<BasisLayout> readBasisLayout(Numbers& file);

// Reads the global data of BasisLZ and the slices of level 0. levelSizes: bytes of each level as stored; the caller has
// checked that they are inside the file. level: those of level 0.
Result<Etc1sParts> readEtc1sParts(Numbers& file, std::span<const std::byte> bytes, const BasisLayout& layout,
                                  std::span<const std::uint64_t> levelSizes, std::span<const std::byte> level);

// KTXswizzle of a file of two channels: it may name them where the texels or where the shader has them, and "" is not
// stated. Errors for others, which contradict the descriptor.
Status checkBasisSwizzle(const BasisLayout& layout, const std::string& swizzle);

// Decodes an image of unorm8. One channel becomes grey; of two, x is red and y green, blue is the middle value; alpha
// is 1 if the file has none. blocks: of UASTC. Errors also for texels with an alpha that the descriptor denies.
Status decodeBasis(const BasisLayout& layout, std::span<const std::byte> blocks, const Etc1sParts& parts, Image& image);

} // namespace cotan
