// The layout of BC7 blocks: modes, partitions, and how a block's fields become 128 bits. Source: Khronos Data Format
// Specification 1.3, chapter 20 (BPTC); Microsoft, BC7 Format Mode Reference.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace cotan::maps::bc7 {

// What the fields of a mode hold. All counts of bits.
struct Mode {
    int subsets, partitionBits, rotationBits, selectionBits;
    int colorBits, alphaBits;  // of a channel of an end, without its shared bit
    int endBits, subsetBits;   // the lowest bit, shared by the channels of an end, or of both ends of a subset
    int indexBits, secondBits; // of a texel; the second indices are those of alpha

    int lowBits() const { return endBits + subsetBits; }
};

inline constexpr std::array<Mode, 8> kModes{{{3, 4, 0, 0, 4, 0, 1, 0, 3, 0},
                                             {2, 6, 0, 0, 6, 0, 0, 1, 3, 0},
                                             {3, 6, 0, 0, 5, 0, 0, 0, 2, 0},
                                             {2, 6, 0, 0, 7, 0, 1, 0, 2, 0},
                                             {1, 0, 2, 1, 5, 6, 0, 0, 2, 3},
                                             {1, 0, 2, 0, 7, 8, 0, 0, 2, 2},
                                             {1, 0, 0, 0, 7, 7, 1, 0, 4, 0},
                                             {2, 6, 0, 0, 5, 5, 1, 0, 2, 0}}};

// Of two subsets: bit i is set if texel i is in the second one. Of three: bits 2i and 2i + 1 are the subset of texel i.
extern const std::array<std::uint16_t, 64> kTwoSubsets;
extern const std::array<std::uint32_t, 64> kThreeSubsets;

// The subset of a texel.
inline int subsetOf(int subsets, int partition, int texel)
{
    if (subsets == 2)
        return kTwoSubsets[std::size_t(partition)] >> texel & 1;
    return subsets == 3 ? int(kThreeSubsets[std::size_t(partition)] >> 2 * texel & 3) : 0;
}

// The fields of a block. A rotation of 1 to 3 exchanges alpha with red, green or blue after decoding.
struct Block {
    int mode = 6, partition = 0, rotation = 0, selection = 0;
    std::array<std::array<std::array<int, 4>, 2>, 3> ends{}; // by subset, end and channel, the shared bit included
    std::array<int, 16> indices{}, second{};                 // as stored; second: of modes 4 and 5
};

void write(Block block, std::byte* to);

} // namespace cotan::maps::bc7
