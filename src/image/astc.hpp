// Blocks of ASTC, by libastcenc of Arm.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// Whether this build has libastcenc; without it the two functions below return ErrorKind::unavailable.
bool readsAstc();

// Decodes blocks of width x height texels, 16 bytes each, in rows from the top, whose number the caller checks. Blocks
// that break the format become magenta, as on a GPU. image: unorm8.
Status decodeAstc(int width, int height, std::span<const std::byte> blocks, Image& image);

// What the blocks hold: the image's own components; or only its red and green, x and y of unit vectors, as luminance
// and alpha (red, red, red, green), the form that libastcenc has for normals, or as (1, green, 1, red).
enum class AstcChannels { all, greyAlpha, alphaGreen };

// Encodes an image of float32, 0 to 1. The bytes do not depend on the number of threads.
Result<std::vector<std::byte>> encodeAstc(int width, int height, const Image& image, AstcChannels channels);

} // namespace cotan
