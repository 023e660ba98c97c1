#include "bake/surface/nearest_texels.hpp"

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

namespace cotan {

namespace {

using Neighbours = std::array<glm::ivec2, 4>; // those that the sweep down has been at

constexpr Neighbours kAboveFirst{{{0, -1}, {-1, -1}, {1, -1}, {-1, 0}}};
constexpr Neighbours kBesideFirst{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

class Spreader {
public:
    Spreader(std::span<std::uint32_t> owner, int width, int height) : owner_(owner), width_(width), height_(height) {}

    // What the row y learns from its neighbours, and from itself the other way. step: 1 down and right, -1 up and left.
    void row(int y, int step, const Neighbours& neighbours)
    {
        const int from = step > 0 ? 0 : width_ - 1, to = step > 0 ? width_ : -1;
        for (int x = from; x != to; x += step)
            for (const glm::ivec2 d : neighbours)
                ask(x, y, x + step * d.x, y + step * d.y);
        for (int x = to - step; x != from - step; x -= step)
            ask(x, y, x + step, y);
    }

private:
    void ask(int x, int y, int fromX, int fromY)
    {
        if (fromX < 0 || fromX >= width_ || fromY < 0 || fromY >= height_)
            return;
        const std::uint32_t offered = owner_[index(fromX, fromY)], self = std::uint32_t(index(x, y));
        std::uint32_t& mine = owner_[self];
        if (offered == kNoTexel || offered == mine || mine == self)
            return;
        if (mine == kNoTexel || distance2(offered, self, width_) < distance2(mine, self, width_))
            mine = offered;
    }
    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }

    std::span<std::uint32_t> owner_;
    int width_, height_;
};

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
    Spreader spreader(owner, width, height);
    for (int y = 0; y < height; ++y)
        spreader.row(y, 1, neighbours);
    for (int y = height - 1; y >= 0; --y)
        spreader.row(y, -1, neighbours);
}

} // namespace cotan
