#include "padding.hpp"

#include <cstddef>

namespace cotan::convert {

namespace {

class Spreader {
public:
    Spreader(std::vector<std::uint32_t>& owner, int width, int height) : owner_(owner), width_(width), height_(height) {}

    void take(int x, int y, int dx, int dy)
    {
        const int fromX = x + dx, fromY = y + dy;
        if (fromX < 0 || fromX >= width_ || fromY < 0 || fromY >= height_)
            return;
        const std::uint32_t offered = owner_[index(fromX, fromY)];
        std::uint32_t& mine = owner_[index(x, y)];
        if (offered != kNoTexel && (mine == kNoTexel || distance2(x, y, offered) < distance2(x, y, mine)))
            mine = offered;
    }

private:
    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }
    std::int64_t distance2(int x, int y, std::uint32_t texel) const
    {
        const std::int64_t dx = std::int64_t(texel % std::uint32_t(width_)) - x;
        const std::int64_t dy = std::int64_t(texel / std::uint32_t(width_)) - y;
        return dx * dx + dy * dy;
    }

    std::vector<std::uint32_t>& owner_;
    int width_, height_;
};

} // namespace

void spread(std::vector<std::uint32_t>& owner, int width, int height)
{
    Spreader s(owner, width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            for (auto [dx, dy] : {std::pair(-1, 0), {-1, -1}, {0, -1}, {1, -1}})
                s.take(x, y, dx, dy);
        for (int x = width - 1; x >= 0; --x)
            s.take(x, y, 1, 0);
    }
    for (int y = height - 1; y >= 0; --y) {
        for (int x = width - 1; x >= 0; --x)
            for (auto [dx, dy] : {std::pair(1, 0), {1, 1}, {0, 1}, {-1, 1}})
                s.take(x, y, dx, dy);
        for (int x = 0; x < width; ++x)
            s.take(x, y, -1, 0);
    }
}

} // namespace cotan::convert
