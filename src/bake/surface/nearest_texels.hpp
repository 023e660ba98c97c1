// Finds the nearest texel with a value for each texel without one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cotan {

inline constexpr std::uint32_t kNoTexel = 0xffffffffu;
inline constexpr int kLargestSide = 65535; // of a map, in texels: propagateNearest packs two of them

// Which of several equally near texels is taken: that of the neighbour which is asked first.
enum class TieBreak {
    above,  // above, then the corners, then beside
    beside, // beside, then the corner, above, the other corner
};

// owner: width * height entries, row by row, at most kLargestSide a side: the texel's own index if it has a value,
// otherwise kNoTexel. Afterwards every entry is the index of a nearby texel with a value, or kNoTexel if that is more
// than `radius` texels away (0: no limit). Two sweeps, down and up, propagate the nearest texel to the eight neighbours
// (P.-E. Danielsson, Euclidean distance mapping, 1980); `first` applies to the sweep down, the other asks the opposite
// neighbours in that order. Sometimes errs by a fraction of a texel. The image does not wrap around. If no texel has a
// value, all entries stay kNoTexel.
inline void propagateNearest(std::span<std::uint32_t> owner, int width, int height, TieBreak first, int radius = 0)
{
    // A texel with a value, as seen from another one.
    struct Seen {
        std::uint32_t texel = kNoTexel;                 // row and column in 16 bits each, which needs no division
        std::int64_t distance2 = std::int64_t(1) << 40; // squared, in texels; that of kNoTexel is larger than all
    };
    const auto seenFrom = [](int x, int y, std::uint32_t texel) {
        const std::int64_t dx = std::int64_t(texel & 0xffff) - x, dy = std::int64_t(texel >> 16) - y;
        return texel == kNoTexel ? Seen{} : Seen{texel, dx * dx + dy * dy};
    };
    const auto take = [](const Seen& offered, Seen& mine) {
        if (offered.distance2 < mine.distance2)
            mine = offered;
    };
    const auto w = std::size_t(width);
    const std::vector<std::uint32_t> none(w, kNoTexel);
    // Updates row y from its neighbours, then in the opposite direction. step: 1 down and right, -1 up and left.
    const auto row = [&](int y, int step) {
        std::uint32_t* const own = &owner[std::size_t(y) * w];
        const bool isFirst = y - step < 0 || y - step >= height;
        const std::uint32_t* const above = isFirst ? none.data() : own - step * std::ptrdiff_t(width);
        const auto inRow = [&](int x) { return x >= 0 && x < width; };
        const int from = step > 0 ? 0 : width - 1, to = step > 0 ? width : -1;
        std::uint32_t beside = kNoTexel;
        for (int x = from; x != to; x += step) {
            const std::uint32_t itself = std::uint32_t(y) << 16 | std::uint32_t(x);
            if (own[x] != itself) {
                const std::uint32_t middle = above[x], before = inRow(x - step) ? above[x - step] : kNoTexel,
                                    after = inRow(x + step) ? above[x + step] : kNoTexel;
                Seen mine = seenFrom(x, y, own[x]);
                if (first == TieBreak::above) {
                    take(seenFrom(x, y, middle), mine);
                    if (before != middle)
                        take(seenFrom(x, y, before), mine);
                    if (after != middle)
                        take(seenFrom(x, y, after), mine);
                    if (beside != mine.texel)
                        take(seenFrom(x, y, beside), mine);
                } else {
                    for (const std::uint32_t texel : {beside, before, middle, after})
                        take(seenFrom(x, y, texel), mine);
                }
                own[x] = mine.texel;
            }
            beside = own[x];
        }
        beside = kNoTexel;
        for (int x = to - step; x != from - step; x -= step) {
            if (own[x] != beside && own[x] != (std::uint32_t(y) << 16 | std::uint32_t(x))) {
                Seen mine = seenFrom(x, y, own[x]);
                take(seenFrom(x, y, beside), mine);
                own[x] = mine.texel;
            }
            beside = own[x];
        }
    };
    for (int y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < w; ++x)
            if (std::uint32_t& texel = owner[std::size_t(y) * w + x]; texel != kNoTexel)
                texel = std::uint32_t(y) << 16 | x;
        row(y, 1);
    }
    for (int y = height - 1; y >= 0; --y)
        row(y, -1);
    const std::int64_t limit = radius > 0 ? std::int64_t(radius) * radius : std::int64_t(1) << 40;
    for (int y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < w; ++x) {
            std::uint32_t& texel = owner[std::size_t(y) * w + x];
            if (texel != kNoTexel)
                texel = seenFrom(int(x), y, texel).distance2 <= limit
                    ? (texel >> 16) * std::uint32_t(width) + (texel & 0xffff)
                    : kNoTexel;
        }
}

} // namespace cotan
