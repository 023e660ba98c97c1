// How the fields of a BC7 block become 128 bits.
#pragma once

#include <array>
#include <cstddef>

#include "image/bc7_modes.hpp"

namespace cotan::maps::bc7 {

using namespace cotan::bc7;

// The fields of a block. A rotation of 1 to 3 exchanges alpha with red, green or blue after decoding.
struct Block {
    int mode = 6, partition = 0, rotation = 0, selection = 0;
    std::array<std::array<std::array<int, 4>, 2>, 3> ends{}; // by subset, end and channel, the shared bit included
    std::array<int, 16> indices{}, second{};                 // as stored; second: of modes 4 and 5
};

void write(Block block, std::byte* to);

} // namespace cotan::maps::bc7
