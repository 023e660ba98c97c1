// A picture written in the format that another file has.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

struct EncodedLike {
    std::vector<std::byte> bytes;
    std::string format;   // ImageFormat::name, "PNG" where the other's cannot be kept
    std::string mime;     // of it
    int quality = 0;      // 1 to 100, as encoders count it, of JPEG and of WebP with losses; else 0
    std::string whyNot{}; // why it is not the other's format, as half a sentence; empty: it is
};

// Writes a picture of unorm8 or unorm16 as `old` is written: JPEG with the quantisation tables, the sampling of colours
// and the scans of the old file; WebP without losses, or with the quality that its quantiser stands for (a few steps
// off, since encoders choose others for parts of a picture); all else as PNG, packed tighter and more slowly than
// writeImage does. So are 16 bits, grey JPEGs, JPEGs with alpha in the new picture, and what this build has no library
// for. Errors (ErrorKind::output): not enough memory.
Result<EncodedLike> encodeLike(const Image& image, std::span<const std::byte> old);

} // namespace cotan
