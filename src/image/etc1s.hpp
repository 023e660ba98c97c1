// ETC1S, the smaller format of Basis Universal: blocks of ETC1 whose two halves have one colour, packed by BasisLZ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// The parts of a KTX2 file that hold one image; the caller has checked that they are inside the file.
struct Etc1sParts {
    std::uint32_t endpointCount = 0, selectorCount = 0;
    std::span<const std::byte> endpoints, selectors; // codebooks of all levels
    std::span<const std::byte> tables;
    std::span<const std::byte> color, second; // slices; second: empty if there is none
};

// Decodes into an image of unorm8: `color` into red, green and blue, and red of `second` into alpha, which is 255
// without it. Memory grows with what the bytes of a codebook hold, not with the number of entries that they claim.
// Errors: ErrorKind::input without the file's name.
// Source: KTX 2.0 specification, appendix "BasisLZ/ETC1S Bitstream"; Khronos Data Format 1.4, chapter 21.1.
Status decodeEtc1s(const Etc1sParts& parts, Image& image);

} // namespace cotan
