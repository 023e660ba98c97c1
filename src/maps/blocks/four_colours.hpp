// Blocks of four colours: what they would keep of a map, for estimates.
#pragma once

#include "cotan/scene.hpp"

namespace cotan::maps {

// Where the four colours of a block lie.
enum class FourColours {
    line,  // BC1: on any line, its ends of 5, 6 and 5 bits
    grey,  // ETC1 and ETC1S: on a grey line through a colour of 5 bits, at the distances of one of eight tables
    plane, // ETC2: as grey, or a plane of colours
    one    // the mean of each block only
};

// Returns the texels as blocks of 4 x 4 would hold them, nearly as well as a good encoder does. Alpha stays, and so do
// texels that are in no whole block. image: components from 0 to 1.
Image inFourColours(const Image& image, FourColours colours);

} // namespace cotan::maps
