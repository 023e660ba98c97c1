#include "cotan/maps.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

#include "maps/mip_rows.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

using Moments = MipMoments;

namespace {

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

// Adds a row of the larger level to one of the smaller level.
void addRow(std::span<const Moments> row, float weight, std::span<Moments> to)
{
    for (std::size_t x = 0; x < to.size(); ++x) {
        const Footprint across = footprint(int(x), int(to.size()), int(row.size()));
        for (int fx = across.first; fx <= across.last; ++fx)
            to[x].add(row[std::size_t(fx)], across.weight(fx) * weight);
    }
}

glm::vec3 meanOf(const Moments& m) { return m.coverage > 0 ? m.normal / m.coverage : glm::vec3(0); }

// rowOf(y, row): fills `row` with the moments of row y of the larger level.
template<class RowOf> Level smaller(int width, int height, RowOf rowOf)
{
    Level level{std::max(1, width / 2), std::max(1, height / 2), {}};
    level.texels.resize(std::size_t(level.width) * std::size_t(level.height));
    forRowBands(level.width, level.height, [&](int firstRow, int lastRow) {
        std::vector<Moments> row(std::size_t(width), Moments{});
        for (int y = firstRow; y < lastRow; ++y) {
            const Footprint down = footprint(y, level.height, height);
            for (int fy = down.first; fy <= down.last; ++fy) {
                rowOf(fy, row);
                addRow(row, down.weight(fy),
                       {&level.texels[std::size_t(y) * std::size_t(level.width)], std::size_t(level.width)});
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
    forRowBands(width, height, [&](int first, int last) {
        std::vector<Moments> row(std::size_t(width), Moments{});
        std::vector<glm::vec4> normals(row.size()), rough(row.size());
        for (int y = first; y < last; ++y) {
            rowOf(y, row);
            for (std::size_t x = 0; x < row.size(); ++x) {
                const Moments& m = row[x];
                const glm::vec3 mean = meanOf(m);
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

MipRows::MipRows(int width, int height, const MipSettings& settings, bool averagesAlpha)
    : settings_(settings), averagesAlpha_(averagesAlpha)
{
    levels_.push_back({width, height});
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back({std::max(1, levels_.back().width / 2), std::max(1, levels_.back().height / 2)});
}

void MipRows::add(const Image& rows, const Take& take)
{
    std::vector<Moments>& moments = levels_[0].moments;
    std::vector<float>& alphas = levels_[0].alphas;
    const std::size_t width = std::size_t(rows.width), start = moments.size();
    moments.resize(start + rows.pixelCount());
    alphas.resize(averagesAlpha_ ? moments.size() : 0);
    forRowBands(rows.width, rows.height, [&](int first, int last) {
        std::vector<glm::vec3> normals(width);
        std::vector<glm::vec4> texels(width);
        for (int y = first; y < last; ++y) {
            const std::size_t at = start + std::size_t(y) * width;
            decodeRow(rows, y, settings_.from, normals);
            std::ranges::transform(normals, moments.begin() + std::ptrdiff_t(at), momentsOf);
            if (!averagesAlpha_)
                continue;
            loadRow(rows, y, texels);
            std::ranges::transform(texels, alphas.begin() + std::ptrdiff_t(at), &glm::vec4::w);
        }
    });
    for (std::size_t i = 1; i < levels_.size(); ++i)
        makeRows(i, take);
}

void MipRows::makeRows(std::size_t i, const Take& take)
{
    Level &larger = levels_[i - 1], &level = levels_[i];
    const std::size_t from = std::size_t(larger.width), width = std::size_t(level.width);
    const int end = larger.first + int(larger.moments.size() / from), first = level.next;
    while (level.next < level.height && footprint(level.next, level.height, larger.height).last < end)
        ++level.next;
    if (level.next == first)
        return;
    Image rows = makeImage(level.width, level.next - first, settings_.type);
    const std::size_t start = level.moments.size();
    level.moments.resize(start + rows.pixelCount());
    level.alphas.resize(averagesAlpha_ ? level.moments.size() : 0);
    forRowBands(rows.width, rows.height, [&](int firstRow, int lastRow) {
        std::vector<glm::vec4> texels(width);
        for (int y = firstRow; y < lastRow; ++y) {
            const std::size_t at = start + std::size_t(y) * width;
            const std::span<Moments> sums(&level.moments[at], width);
            const Footprint down = footprint(first + y, level.height, larger.height);
            for (int fy = down.first; fy <= down.last; ++fy)
                addRow({&larger.moments[std::size_t(fy - larger.first) * from], from}, down.weight(fy), sums);
            for (std::size_t x = 0; x < width; ++x) {
                texels[x] = encodeTexel(meanOf(sums[x]), settings_.to, settings_.type, settings_.keepLengths);
                if (averagesAlpha_)
                    texels[x].w = larger.meanAlpha(int(x), first + y);
            }
            storeRow(rows, y, texels);
            if (!averagesAlpha_)
                continue;
            loadRow(rows, y, texels);
            std::ranges::transform(texels, level.alphas.begin() + std::ptrdiff_t(at), &glm::vec4::w);
        }
    });
    larger.keepFrom(level.next < level.height ? footprint(level.next, level.height, larger.height).first : end);
    take(i, std::move(rows));
}

float MipRows::Level::meanAlpha(int x, int y) const
{
    const int across = std::min(width, 2), down = std::min(height, 2);
    float sum = 0;
    for (int k = 0; k < down; ++k)
        for (int i = 0; i < across; ++i)
            sum += alphas[std::size_t(2 * y + k - first) * std::size_t(width) + std::size_t(2 * x + i)]
                / float(across * down);
    return sum;
}

void MipRows::Level::keepFrom(int row)
{
    const std::ptrdiff_t count = std::ptrdiff_t(row - first) * width;
    moments.erase(moments.begin(), moments.begin() + count);
    if (!alphas.empty())
        alphas.erase(alphas.begin(), alphas.begin() + count);
    first = row;
}

} // namespace cotan::maps
