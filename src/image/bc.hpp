// Blocks of BC1 to BC5 and BC7: 4 x 4 texels in 8 or 16 bytes.
#pragma once

#include <cstddef>
#include <span>

#include "cotan/scene.hpp"

namespace cotan {

enum class BcCode { bc1, bc2, bc3, bc4, bc4Signed, bc5, bc5Signed, bc7 };

std::size_t bcBytes(BcCode code); // per block

// Decodes blocks in rows from the top: ceil(width / 4) * ceil(height / 4) of them, which the caller checks. Every block
// is valid; one of BC7 without a mode is transparent black. Signed blocks need an image of unorm16, as unormOfSigned
// carries them, the others unorm8; grey and blue are as in other files of one and two channels. All bytes are those
// that OpenImageIO makes of them in DDS. Source: Khronos Data Format Specification 1.3, chapters 18 to 20.
void decodeBc(BcCode code, std::span<const std::byte> blocks, Image& image);

} // namespace cotan
