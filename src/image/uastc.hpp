// Blocks of UASTC LDR 4x4 (Basis Universal): 4 x 4 texels in 16 bytes, a part of ASTC with a layout of its own.
#pragma once

#include <cstddef>
#include <span>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// Decodes blocks in rows from the top: ceil(width / 4) * ceil(height / 4) of them, which the caller checks. The image
// is unorm8; as in ASTC, endpoints are interpolated with 16 bits, of which the upper 8 remain.
// Errors: ErrorKind::input for a mode or a partition pattern that does not exist, without the file's name.
// Source: R. Geldreich, in Khronos Data Format Specification 1.4, chapter 25. It gives such blocks the colour magenta;
// here, as in Binomial's transcoder, they are damage.
Status decodeUastc(std::span<const std::byte> blocks, Image& image);

} // namespace cotan
