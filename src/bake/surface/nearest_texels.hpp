// Finds the nearest texel with a value for each texel without one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec2.hpp>

namespace cotan {

inline constexpr std::uint32_t kNoTexel = 0xffffffffu;

// Which of several equally near texels is taken: that of the neighbour which is asked first.
enum class TieBreak {
    above,  // above, then the corners, then beside
    beside, // beside, then the corner, above, the other corner
};

// The squared distance between two texels of an image, in texels.
inline std::int64_t distance2(std::uint32_t a, std::uint32_t b, int width)
{
    const auto w = std::uint32_t(width);
    const std::int64_t dx = std::int64_t(a % w) - std::int64_t(b % w), dy = std::int64_t(a / w) - std::int64_t(b / w);
    return dx * dx + dy * dy;
}

// owner: width * height entries, row by row, at most 65536 a side and fewer than kNoTexel: the texel's own index if it
// has a value, otherwise kNoTexel. Afterwards every entry is the index of a nearby texel with a value. Two sweeps, down
// and up, propagate the nearest texel to the eight neighbours (P.-E. Danielsson, Euclidean distance mapping, 1980);
// `first` applies to the sweep down, the other asks the opposite neighbours in that order. Sometimes errs by a fraction
// of a texel. The image does not wrap around. If no texel has a value, all entries stay kNoTexel.
inline void propagateNearest(std::span<std::uint32_t> owner, int width, int height, TieBreak first)
{
    using Neighbours = std::array<glm::ivec2, 4>; // that the sweep down has visited
    const Neighbours neighbours = first == TieBreak::above ? Neighbours{{{0, -1}, {-1, -1}, {1, -1}, {-1, 0}}}
                                                           : Neighbours{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    // While they are compared, entries hold row and column in 16 bits each, which needs no division.
    const auto eachOwner = [&](const auto& change) {
        for (std::uint32_t& texel : owner)
            texel = texel == kNoTexel ? texel : change(texel);
    };
    const auto w = std::uint32_t(width);
    eachOwner([w](std::uint32_t texel) { return texel / w << 16 | texel % w; });
    const auto ask = [&](int x, int y, std::uint32_t& mine, int fromX, int fromY) {
        if (fromX < 0 || fromX >= width || fromY < 0 || fromY >= height)
            return;
        const std::uint32_t offered = owner[std::size_t(fromY) * w + std::size_t(fromX)];
        const auto distance = [x, y](std::uint32_t to) {
            const std::int64_t dx = std::int64_t(to & 0xffff) - x, dy = std::int64_t(to >> 16) - y;
            return dx * dx + dy * dy;
        };
        if (offered != kNoTexel && offered != mine && (mine == kNoTexel || distance(offered) < distance(mine)))
            mine = offered;
    };
    // Updates row y from its neighbours, then in the opposite direction. step: 1 down and right, -1 up and left.
    const auto row = [&](int y, int step) {
        std::uint32_t* const own = &owner[std::size_t(y) * w];
        const auto update = [&](int x, std::span<const glm::ivec2> from) {
            if (own[x] == (std::uint32_t(y) << 16 | std::uint32_t(x))) // has a value
                return;
            for (const glm::ivec2 d : from)
                ask(x, y, own[x], x + step * d.x, y + step * d.y);
        };
        const glm::ivec2 ahead[] = {{1, 0}};
        const int from = step > 0 ? 0 : width - 1, to = step > 0 ? width : -1;
        for (int x = from; x != to; x += step)
            update(x, neighbours);
        for (int x = to - step; x != from - step; x -= step)
            update(x, ahead);
    };
    for (int y = 0; y < height; ++y)
        row(y, 1);
    for (int y = height - 1; y >= 0; --y)
        row(y, -1);
    eachOwner([w](std::uint32_t place) { return (place >> 16) * w + (place & 0xffff); });
}

} // namespace cotan
