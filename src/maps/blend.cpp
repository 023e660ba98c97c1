#include "cotan/maps.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cotan/vector.hpp"
#include "maps/texels.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::maps {

namespace {

int repeated(std::int64_t i, int size) { return int((i % size + size) % size); }

// A texel of a repeating line, and its weight in a footprint.
struct Tap {
    int texel;
    float weight;
};

// The taps of texel i of `count` over `tiles` repetitions of a line of `size` texels. Magnified: two, linear. Minified:
// all texels in the footprint, weighted by coverage.
std::vector<Tap> tapsOf(int i, int count, int size, int tiles)
{
    const double step = double(size) * tiles / count; // texels of the detail per texel of the base
    if (step <= 1) {
        const double at = (i + 0.5) * step - 0.5;
        const auto first = std::int64_t(std::floor(at));
        const float fraction = float(at - double(first));
        return {{repeated(first, size), 1 - fraction}, {repeated(first + 1, size), fraction}};
    }
    std::vector<Tap> taps;
    const double from = i * step, to = from + step;
    for (auto k = std::int64_t(std::floor(from)); double(k) < to; ++k) {
        const double covered = std::min(to, double(k) + 1.0) - std::max(from, double(k));
        if (covered > 1e-9)
            taps.push_back({repeated(k, size), float(covered / step)});
    }
    return taps;
}

// The unit vector; zero if v is shorter than 1e-3 or its length overflows.
glm::vec3 direction(const glm::vec3& v) { return unitOr(v, glm::vec3(0), 1e-3f); }

// Rows of the detail at the base's resolution, as unit vectors; zero where it has no direction.
class DetailRows {
public:
    DetailRows(const Image& detail, const Convention& convention, int width, int height, int tilesX, int tilesY)
        : detail_(detail), convention_(convention), height_(height), tilesY_(tilesY)
    {
        for (int x = 0; x < width; ++x)
            across_.push_back(tapsOf(x, width, detail.width, tilesX));
    }

    void load(int row, std::vector<glm::vec3>& out) const
    {
        std::vector<glm::vec3> line(std::size_t(detail_.width)), sum(line.size(), glm::vec3(0));
        for (const Tap& tap : tapsOf(row, height_, detail_.height, tilesY_)) {
            decodeRow(detail_, tap.texel, convention_, line);
            for (std::size_t x = 0; x < sum.size(); ++x)
                sum[x] += direction(line[x]) * tap.weight;
        }
        for (std::size_t x = 0; x < out.size(); ++x) {
            glm::vec3 v(0);
            for (const Tap& tap : across_[x])
                v += sum[std::size_t(tap.texel)] * tap.weight;
            out[x] = direction(v);
        }
    }

private:
    const Image& detail_;
    const Convention convention_;
    std::vector<std::vector<Tap>> across_;
    int height_, tilesY_;
};

// The mask's red at the nearest texel, [0,1]; NaN gives 0.
float maskAt(const Image& mask, int x, int y, int width, int height)
{
    const float value = atTexel(mask, int(double(x) * mask.width / width), int(double(y) * mask.height / height),
                                [](const auto* c, int maximum) { return float(c[0]) / float(maximum); });
    return value > 0 ? std::min(value, 1.0f) : 0.0f;
}

glm::vec3 blendTexels(const glm::vec3& base, const glm::vec3& detail, BlendMode mode)
{
    switch (mode) {
    case BlendMode::reoriented: return f32::cotan_blend_reoriented(base, detail);
    case BlendMode::whiteout: return f32::cotan_blend_whiteout(base, detail);
    case BlendMode::udn: return f32::cotan_blend_udn(base, detail);
    case BlendMode::slopes: return f32::cotan_blend_slopes(base, detail, 1.0f, 1.0f);
    case BlendMode::linear: break;
    }
    return f32::cotan_blend_linear(base, detail);
}

} // namespace

Image blend(const Image& base, const Image& detail, const BlendSettings& s, std::size_t& invalid)
{
    Image out = makeImage(base.width, base.height, s.type, base.name);
    const int height = s.imageHeight > 0 ? s.imageHeight : base.height;
    const DetailRows details(detail, s.detail, base.width, height, s.tilesX, s.tilesY);
    const bool alpha = s.base.channels == Channels::xyz && s.to.channels == Channels::xyz;
    std::atomic<std::size_t> bad = 0;
    forRowBands(base.width, base.height, [&](int first, int last) {
        const std::size_t width = std::size_t(base.width);
        std::vector<glm::vec3> baseRow(width), detailRow(width);
        std::vector<glm::vec4> texels(width), stored(width, glm::vec4(1));
        std::size_t badHere = 0;
        for (int y = first; y < last; ++y) {
            decodeRow(base, y, s.base, baseRow);
            details.load(s.firstRow + y, detailRow);
            if (alpha)
                loadRow(base, y, stored);
            for (std::size_t x = 0; x < width; ++x) {
                const float mask = s.mask ? maskAt(*s.mask, int(x), s.firstRow + y, base.width, height) : 1.0f;
                const glm::vec3 b = direction(baseRow[x]);
                glm::vec3 d = detailRow[x];
                badHere += b == glm::vec3(0) || d == glm::vec3(0);
                d = direction({d.x * s.strength * mask, d.y * s.strength * mask, d.z});
                glm::vec3 n = b == glm::vec3(0) ? d : b;
                // Zero strength leaves the base unchanged, even in the modes that flatten it.
                if (b != glm::vec3(0) && d != glm::vec3(0) && mask * s.strength != 0)
                    n = blendTexels(b, d, s.mode);
                texels[x] = glm::vec4(glm::vec3(encodeTexel(n, s.to, s.type)), stored[x].w);
            }
            if (s.dither)
                ditherRow(texels, s.type, s.firstRow + y);
            storeRow(out, y, texels);
        }
        bad += badHere;
    });
    invalid = bad;
    return out;
}

} // namespace cotan::maps
