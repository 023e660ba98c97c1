#include <cstdint>
#include <limits>

#include "cotan/bake/bake.hpp"

namespace cotan {

namespace {

struct Source { // a texel
    std::int32_t x = -1, y = -1;
    bool none() const { return x < 0; }
};

// Nearest sources by two passes over the picture (P.-E. Danielsson's sequential Euclidean distance
// mapping): each texel looks at its neighbours' sources. Off by a fraction of a texel at times.
struct NearestSources {
    int width, height;
    std::vector<Source> source;

    Source& at(int x, int y) { return source[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    static std::int64_t distance2(int x, int y, Source s)
    {
        const std::int64_t dx = x - s.x, dy = y - s.y;
        return dx * dx + dy * dy;
    }
    void look(Source& mine, int x, int y, int nx, int ny)
    {
        if (nx < 0 || ny < 0 || nx >= width || ny >= height)
            return;
        const Source candidate = at(nx, ny);
        if (!candidate.none() && (mine.none() || distance2(x, y, candidate) < distance2(x, y, mine)))
            mine = candidate;
    }
    // What the row y learns from the row before it (step 1) or after it (step -1), and from itself.
    void row(int y, int step)
    {
        const int from = step > 0 ? 0 : width - 1, to = step > 0 ? width : -1;
        for (int x = from; x != to; x += step) {
            Source& mine = at(x, y);
            if (mine.x == x && mine.y == y)
                continue; // its own: nothing is nearer
            look(mine, x, y, x, y - step);
            look(mine, x, y, x - step, y - step);
            look(mine, x, y, x + step, y - step);
            look(mine, x, y, x - step, y);
        }
        for (int x = to - step; x != from - step; x -= step) {
            Source& mine = at(x, y);
            if (mine.x != x || mine.y != y)
                look(mine, x, y, x + step, y);
        }
    }
    void run()
    {
        for (int y = 0; y < height; ++y)
            row(y, 1);
        for (int y = height - 1; y >= 0; --y)
            row(y, -1);
    }
};

} // namespace

void padCharts(Baked& baked, int radius)
{
    NearestSources nearest{baked.width, baked.height, std::vector<Source>(baked.values.size())};
    for (int y = 0; y < baked.height; ++y)
        for (int x = 0; x < baked.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(baked.width) + std::size_t(x);
            if ((baked.states[i] & (texelCovered | texelTouched)) != 0 && baked.values[i] != glm::vec3(0))
                nearest.source[i] = {x, y};
        }
    nearest.run();
    const std::int64_t limit = radius > 0 ? std::int64_t(radius) * radius : std::numeric_limits<std::int64_t>::max();
    for (int y = 0; y < baked.height; ++y)
        for (int x = 0; x < baked.width; ++x) {
            const Source s = nearest.at(x, y);
            if (s.none() || (s.x == x && s.y == y) || NearestSources::distance2(x, y, s) > limit)
                continue;
            const std::size_t i = std::size_t(y) * std::size_t(baked.width) + std::size_t(x);
            baked.values[i] = baked.values[std::size_t(s.y) * std::size_t(baked.width) + std::size_t(s.x)];
            baked.states[i] = std::uint8_t(baked.states[i] | texelPadded);
        }
}

} // namespace cotan
