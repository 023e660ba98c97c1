#include "cotan/maps.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "maps/texels.hpp"

namespace cotan::maps {

namespace {

// Means over a footprint. `coverage`: fraction of the footprint that has a direction.
struct Moments {
    glm::vec3 normal{0};
    float coverage = 0;
    float bx = 0, by = 0, bb = 0; // slopes and the sum of their squares

    void add(const Moments& o, float weight)
    {
        normal += o.normal * weight;
        coverage += o.coverage * weight;
        bx += o.bx * weight, by += o.by * weight, bb += o.bb * weight;
    }
};

struct Level {
    int width = 0, height = 0;
    std::vector<Moments> texels;
};

// Copies rows of a level, for smaller() and encoded().
auto rowsOf(const Level& level)
{
    return [&level](int y, std::vector<Moments>& row) {
        std::copy_n(level.texels.begin() + std::ptrdiff_t(y) * level.width, row.size(), row.begin());
    };
}

Moments momentsOf(const glm::vec3& decoded)
{
    const float length = glm::length(decoded);
    if (!(length > 0))
        return {};
    const glm::vec3 n = decoded / length;
    const float z = std::max(n.z, std::max(std::abs(n.x), std::abs(n.y)) / kSteepestSlope);
    const float bx = -n.x / z, by = -n.y / z;
    return {n, 1, bx, by, bx * bx + by * by};
}

// The texels [first, last] of a larger line that one texel of a smaller line covers, the ends partially.
struct Footprint {
    int first = 0, last = 0;
    double from = 0, to = 0;

    float weight(int i) const { return float((std::min(to, i + 1.0) - std::max(from, double(i))) / (to - from)); }
};

Footprint footprint(int i, int size, int larger)
{
    const double step = double(larger) / size;
    Footprint f{.from = i * step, .to = (i + 1) * step};
    f.first = int(std::floor(f.from));
    f.last = std::min(int(std::ceil(f.to)), larger) - 1;
    return f;
}

// rowOf(y, row): fills `row` with the moments of row y of the larger level.
template<class RowOf> Level smaller(int width, int height, RowOf rowOf)
{
    Level level{std::max(1, width / 2), std::max(1, height / 2), {}};
    level.texels.resize(std::size_t(level.width) * std::size_t(level.height));
    forRowBands(level.height, [&](int firstRow, int lastRow) {
        std::vector<Moments> row(std::size_t(width), Moments{});
        for (int y = firstRow; y < lastRow; ++y) {
            const Footprint down = footprint(y, level.height, height);
            for (int fy = down.first; fy <= down.last; ++fy) {
                rowOf(fy, row);
                for (int x = 0; x < level.width; ++x) {
                    const Footprint across = footprint(x, level.width, width);
                    Moments& sum = level.texels[std::size_t(y) * std::size_t(level.width) + std::size_t(x)];
                    for (int fx = across.first; fx <= across.last; ++fx)
                        sum.add(row[std::size_t(fx)], across.weight(fx) * down.weight(fy));
                }
            }
        }
    });
    return level;
}

double roughnessOf(const Moments& m, const MipSettings& s)
{
    if (!(m.coverage > 0))
        return s.roughness;
    if (s.model != VarianceModel::lean)
        return roughnessFromLength(s.roughness, std::min(1.0, double(glm::length(m.normal)) / m.coverage), s.model);
    const double bx = double(m.bx / m.coverage), by = double(m.by / m.coverage), bb = double(m.bb / m.coverage);
    return roughnessFromVariance(s.roughness, std::max(0.0, bb - bx * bx - by * by));
}

// rowOf: as for smaller().
template<class RowOf> MipLevel encoded(int width, int height, const MipSettings& s, RowOf rowOf)
{
    MipLevel out{makeImage(width, height, s.type), makeImage(width, height, s.type)};
    std::vector<double> lengths(std::size_t(height), 0), roughness(lengths), counts(lengths);
    forRowBands(height, [&](int first, int last) {
        std::vector<Moments> row(std::size_t(width), Moments{});
        std::vector<glm::vec4> normals(row.size()), rough(row.size());
        for (int y = first; y < last; ++y) {
            rowOf(y, row);
            for (std::size_t x = 0; x < row.size(); ++x) {
                const Moments& m = row[x];
                const glm::vec3 mean = m.coverage > 0 ? m.normal / m.coverage : glm::vec3(0);
                normals[x] = encodeTexel(mean, s.to, s.type, s.keepLengths);
                const double r = roughnessOf(m, s);
                rough[x] = glm::vec4(float(r), float(r), float(r), 1);
                roughness[std::size_t(y)] += r;
                if (m.coverage > 0)
                    lengths[std::size_t(y)] += double(glm::length(mean)), counts[std::size_t(y)] += 1;
            }
            storeRow(out.normals, y, normals);
            storeRow(out.roughness, y, rough);
        }
    });
    double length = 0, sum = 0, count = 0;
    for (std::size_t y = 0; y < lengths.size(); ++y)
        length += lengths[y], sum += roughness[y], count += counts[y];
    out.meanLength = count > 0 ? length / count : 0;
    out.meanRoughness = sum / (double(width) * height);
    return out;
}

} // namespace

double roughnessFromLength(double roughness, double length, VarianceModel model)
{
    const double alpha2 = std::pow(roughness, 4), r = std::clamp(length, 1e-6, 1.0);
    double result = alpha2;
    if (model == VarianceModel::toksvig) {
        const double exponent = 2 / std::max(alpha2, 1e-9) - 2; // Blinn-Phong exponent of the same width
        const double variance = (1 - r) / r;
        result = 2 / (exponent / (1 + exponent * variance) + 2);
    } else if (r < 1) {
        // A lobe exp(kappa (cos - 1)) has alpha^2 = 2/kappa; the squared widths of convolved lobes add.
        result = alpha2 + 2 * (1 - r * r) / (3 * r - r * r * r);
    }
    return std::pow(std::clamp(result, alpha2, 1.0), 0.25);
}

double roughnessFromVariance(double roughness, double variance)
{
    // Beckmann's alpha^2 is twice the slope variance along one axis, which is the sum over both axes.
    return std::pow(std::min(1.0, std::pow(roughness, 4) + variance), 0.25);
}

std::vector<MipLevel> mipChain(const Image& map, const MipSettings& settings)
{
    std::vector<MipLevel> chain;
    const auto fromMap = [&](int y, std::vector<Moments>& row) {
        std::vector<glm::vec3> normals(row.size());
        decodeRow(map, y, settings.from, normals);
        std::ranges::transform(normals, row.begin(), momentsOf);
    };
    chain.push_back(encoded(map.width, map.height, settings, fromMap));
    Level level;
    for (int width = map.width, height = map.height; width > 1 || height > 1;
         width = level.width, height = level.height) {
        level = chain.size() == 1 ? smaller(width, height, fromMap) : smaller(width, height, rowsOf(level));
        chain.push_back(encoded(level.width, level.height, settings, rowsOf(level)));
    }
    return chain;
}

} // namespace cotan::maps
