#include <algorithm>
#include <array>
#include <cstdint>

#include "block.hpp"
#include "block_texels.hpp"

namespace cotan::maps {

namespace {

// The four values of green between two ends of 6 bits: (2 a + b) / 3 and (a + 2 b) / 3 lie between.
std::array<float, 4> greensOf(int a, int b)
{
    const float first = float(a << 2 | a >> 4), second = float(b << 2 | b >> 4);
    return {first, second, (2 * first + second) / 3, (first + 2 * second) / 3};
}

struct GreenBlock {
    int a = 0, b = 0;
    std::uint32_t indices = 0; // 2 bits a texel
    float error = 1e30f;       // weighted squares of codes
};

GreenBlock indexed(int a, int b, Values& values, Values& weights)
{
    const std::array<float, 4> greens = greensOf(a, b);
    GreenBlock found{a, b, 0, 0};
    for (std::size_t i = 0; i < 16; ++i) {
        std::uint32_t nearest = 0;
        float least = 1e30f;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const float off = greens[k] - at(values, i), square = off * off;
            if (square < least) {
                least = square;
                nearest = k;
            }
        }
        found.indices |= nearest << 2 * i;
        found.error += at(weights, i) * least;
    }
    return found;
}

// The ends within two steps of the extremes with the least error.
GreenBlock fitGreen(Values& values, Values& weights)
{
    constexpr int kReach = 2;
    const int low = int(minOf(values) * 63 / 255 + 0.5f), high = int(maxOf(values) * 63 / 255 + 0.5f);
    GreenBlock best;
    for (int a = std::max(high - kReach, 0); a <= std::min(high + kReach, 63); ++a)
        for (int b = std::max(low - kReach, 0); b <= std::min(low + kReach, a); ++b)
            if (const GreenBlock here = indexed(a, b, values, weights); here.error < best.error)
                best = here;
    return best;
}

} // namespace

std::vector<std::byte> encodeBc3(const Image& map, const CodeScale& scale)
{
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        NormalTexels t = normalTexels(map, left, top, scale);
        encodeAlpha(t.x, t.weightX, to);
        const GreenBlock green = fitGreen(t.y, t.weightY);
        // Red and blue are 31 in both ends. With a >= b the first end is the larger number, as in every block of four
        // colours.
        const auto colour = [](int g) { return std::uint16_t(31 << 11 | g << 5 | 31); };
        const std::array<std::uint16_t, 2> ends{colour(green.a), colour(green.b)};
        for (std::size_t i = 0; i < 2; ++i) {
            to[8 + 2 * i] = std::byte(ends[i] & 0xff);
            to[9 + 2 * i] = std::byte(ends[i] >> 8);
        }
        for (std::size_t i = 0; i < 4; ++i)
            to[12 + i] = std::byte(green.indices >> 8 * i & 0xff);
    });
}

} // namespace cotan::maps
