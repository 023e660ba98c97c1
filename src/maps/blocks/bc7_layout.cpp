#include "bc7_layout.hpp"

#include <algorithm>
#include <utility>

#include "block_texels.hpp"

namespace cotan::maps::bc7 {

void write(Block block, std::byte* to)
{
    const Mode& mode = kModes[std::size_t(block.mode)];
    const auto reverse = [&](std::array<int, 16>& indices, int bits, int subset) {
        for (int i = 0; i < 16; ++i)
            if (subsetOf(mode.subsets, block.partition, i) == subset)
                indices[std::size_t(i)] = (1 << bits) - 1 - indices[std::size_t(i)];
    };
    std::array<int, 3> anchors{};
    for (int s = 0; s < mode.subsets; ++s) {
        auto& [first, last] = block.ends[std::size_t(s)];
        const auto anchor = std::size_t(anchors[std::size_t(s)] = anchorOf(mode.subsets, block.partition, s));
        // Exchanges the ends where an anchor's highest bit is set: of all channels, or, with second indices, of those
        // that the indices belong to.
        const bool firstIsColor = block.selection == 0;
        if (block.indices[anchor] >> (mode.indexBits - 1)) {
            reverse(block.indices, mode.indexBits, s);
            if (mode.secondBits == 0)
                std::swap(first, last);
            else if (firstIsColor)
                std::swap_ranges(first.begin(), first.begin() + 3, last.begin());
            else
                std::swap(first[3], last[3]);
        }
        if (mode.secondBits > 0 && block.second[anchor] >> (mode.secondBits - 1)) {
            reverse(block.second, mode.secondBits, s);
            if (firstIsColor)
                std::swap(first[3], last[3]);
            else
                std::swap_ranges(first.begin(), first.begin() + 3, last.begin());
        }
    }
    BlockBits bits(to);
    bits.put(1 << block.mode, block.mode + 1);
    bits.put(block.partition, mode.partitionBits);
    bits.put(block.rotation, mode.rotationBits);
    bits.put(block.selection, mode.selectionBits);
    for (std::size_t c = 0; c < 4; ++c)
        for (int s = 0; s < mode.subsets; ++s)
            for (const auto& end : block.ends[std::size_t(s)])
                bits.put(end[c] >> mode.lowBits(), c < 3 ? mode.colorBits : mode.alphaBits);
    for (int s = 0; s < mode.subsets; ++s) {
        const auto& [first, last] = block.ends[std::size_t(s)];
        bits.put(first[0] & 1, mode.lowBits());
        bits.put(last[0] & 1, mode.endBits);
    }
    for (std::size_t i = 0; i < 16; ++i)
        bits.put(block.indices[i],
                 mode.indexBits - (int(i) == anchors[std::size_t(subsetOf(mode.subsets, block.partition, int(i)))]));
    for (std::size_t i = 0; i < 16; ++i)
        bits.put(block.second[i], mode.secondBits - (mode.secondBits > 0 && i == 0));
}

} // namespace cotan::maps::bc7
