#include <cstdint>
#include <limits>

#include "cotan/bake/bake.hpp"

namespace cotan {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Nearest sources by two passes over the picture (P.-E. Danielsson's sequential Euclidean distance
// mapping): each texel looks at its neighbours' sources. Off by a fraction of a texel at times.
struct NearestSources {
    int width, height;
    std::vector<std::uint32_t> source; // index of a texel, or kNone

    std::int64_t distance2(int x, int y, std::uint32_t s) const
    {
        const std::int64_t dx = x - std::int64_t(s % std::uint32_t(width)), dy = y - std::int64_t(s / std::uint32_t(width));
        return dx * dx + dy * dy;
    }
    void look(int x, int y, int nx, int ny)
    {
        if (nx < 0 || ny < 0 || nx >= width || ny >= height)
            return;
        const std::uint32_t candidate = source[std::size_t(ny) * std::size_t(width) + std::size_t(nx)];
        std::uint32_t& mine = source[std::size_t(y) * std::size_t(width) + std::size_t(x)];
        if (candidate != kNone && (mine == kNone || distance2(x, y, candidate) < distance2(x, y, mine)))
            mine = candidate;
    }
    void run()
    {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                look(x, y, x, y - 1);
                look(x, y, x - 1, y - 1);
                look(x, y, x + 1, y - 1);
                look(x, y, x - 1, y);
            }
            for (int x = width - 1; x >= 0; --x)
                look(x, y, x + 1, y);
        }
        for (int y = height - 1; y >= 0; --y) {
            for (int x = width - 1; x >= 0; --x) {
                look(x, y, x, y + 1);
                look(x, y, x + 1, y + 1);
                look(x, y, x - 1, y + 1);
                look(x, y, x + 1, y);
            }
            for (int x = 0; x < width; ++x)
                look(x, y, x - 1, y);
        }
    }
};

} // namespace

void padCharts(Baked& baked, int radius)
{
    NearestSources nearest{baked.width, baked.height, std::vector<std::uint32_t>(baked.values.size(), kNone)};
    auto hasValue = [&](std::size_t i) {
        return (baked.states[i] & (texelCovered | texelTouched)) != 0 && baked.values[i] != glm::vec3(0);
    };
    for (std::size_t i = 0; i < baked.values.size(); ++i)
        if (hasValue(i))
            nearest.source[i] = std::uint32_t(i);
    nearest.run();
    const std::int64_t limit = radius > 0 ? std::int64_t(radius) * radius : std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < baked.values.size(); ++i) {
        const std::uint32_t s = nearest.source[i];
        const int x = int(i % std::size_t(baked.width)), y = int(i / std::size_t(baked.width));
        if (s == kNone || s == i || nearest.distance2(x, y, s) > limit)
            continue;
        baked.values[i] = baked.values[s];
        baked.states[i] = std::uint8_t(baked.states[i] | texelPadded);
    }
}

} // namespace cotan
