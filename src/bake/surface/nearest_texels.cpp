#include "bake/surface/nearest_texels.hpp"

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

namespace cotan {

namespace {

using Neighbours = std::array<glm::ivec2, 4>; // those that the sweep down has been at

constexpr Neighbours kAboveFirst{{{0, -1}, {-1, -1}, {1, -1}, {-1, 0}}};
constexpr Neighbours kBesideFirst{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

} // namespace

std::int64_t distance2(std::uint32_t a, std::uint32_t b, int width)
{
    const auto w = std::uint32_t(width);
    const std::int64_t dx = std::int64_t(a % w) - std::int64_t(b % w), dy = std::int64_t(a / w) - std::int64_t(b / w);
    return dx * dx + dy * dy;
}

void spreadNearest(std::span<std::uint32_t> owner, int width, int height, AskFirst first)
{
    const Neighbours& neighbours = first == AskFirst::above ? kAboveFirst : kBesideFirst;
    const auto index = [&](int x, int y) { return std::size_t(y) * std::size_t(width) + std::size_t(x); };
    const auto ask = [&](int x, int y, int fromX, int fromY) {
        if (fromX < 0 || fromX >= width || fromY < 0 || fromY >= height)
            return;
        const std::uint32_t offered = owner[index(fromX, fromY)], self = std::uint32_t(index(x, y));
        std::uint32_t& mine = owner[self];
        if (offered == kNoTexel || offered == mine || mine == self)
            return;
        if (mine == kNoTexel || distance2(offered, self, width) < distance2(mine, self, width))
            mine = offered;
    };
    // What the row y learns from its neighbours, and from itself the other way. step: 1 down and right, -1 up and left.
    const auto row = [&](int y, int step) {
        const int from = step > 0 ? 0 : width - 1, to = step > 0 ? width : -1;
        for (int x = from; x != to; x += step)
            for (const glm::ivec2 d : neighbours)
                ask(x, y, x + step * d.x, y + step * d.y);
        for (int x = to - step; x != from - step; x -= step)
            ask(x, y, x + step, y);
    };
    for (int y = 0; y < height; ++y)
        row(y, 1);
    for (int y = height - 1; y >= 0; --y)
        row(y, -1);
}

} // namespace cotan
