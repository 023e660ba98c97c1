#include "cotan/maps.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include <glm/geometric.hpp>

#include "maps/mip_rows.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

using Moments = MipMoments;

namespace {

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

double roughnessOf(const Moments& m, const MipSettings& s)
{
    if (!(m.coverage > 0))
        return s.roughness;
    if (s.model != VarianceModel::lean)
        return roughnessFromLength(s.roughness, std::min(1.0, double(glm::length(m.normal)) / m.coverage), s.model);
    const double bx = double(m.bx / m.coverage), by = double(m.by / m.coverage), bb = double(m.bb / m.coverage);
    return roughnessFromVariance(s.roughness, std::max(0.0, bb - bx * bx - by * by));
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
    constexpr int kTexels = 1 << 20; // at once, enough for all threads
    MipRows mips(map.width, map.height, settings, MipRows::roughness);
    std::vector<MipLevel> chain;
    for (std::size_t i = 0; i < mips.levels(); ++i) {
        const auto [width, height] = mips.size(i);
        chain.push_back({makeImage(width, height, settings.type), makeImage(width, height, settings.type)});
    }
    std::vector<std::size_t> at(chain.size(), 0); // bytes that were made
    const int atOnce = std::max(1, kTexels / map.width);
    for (int y = 0; y < map.height; y += atOnce)
        mips.add(rowsOf(map, y, std::min(atOnce, map.height - y)), [&](std::size_t i, Image normals, Image rough) {
            std::copy(normals.data.begin(), normals.data.end(), chain[i].normals.data.begin() + std::ptrdiff_t(at[i]));
            std::copy(rough.data.begin(), rough.data.end(), chain[i].roughness.data.begin() + std::ptrdiff_t(at[i]));
            at[i] += normals.data.size();
        });
    for (std::size_t i = 0; i < chain.size(); ++i)
        std::tie(chain[i].meanLength, chain[i].meanRoughness) = mips.means(i);
    return chain;
}

MipRows::MipRows(int width, int height, const MipSettings& settings, Alpha alpha) : settings_(settings), alpha_(alpha)
{
    levels_.push_back({width, height});
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back({std::max(1, levels_.back().width / 2), std::max(1, levels_.back().height / 2)});
}

std::pair<double, double> MipRows::means(std::size_t i) const
{
    const Level& level = levels_[i];
    return {level.count > 0 ? level.length / level.count : 0, level.roughness / (double(level.width) * level.height)};
}

void MipRows::add(const Image& rows, const Take& take)
{
    Level& map = levels_[0];
    const std::size_t width = std::size_t(rows.width), start = map.grow(rows.height);
    forRowBands(rows.width, rows.height, [&](int first, int last) {
        std::vector<glm::vec3> normals(width);
        std::vector<glm::vec4> texels(width);
        for (int y = first; y < last; ++y) {
            Moments* const row = &map.moments[start + std::size_t(y) * width];
            decodeRow(rows, y, settings_.from, normals);
            std::ranges::transform(normals, row, momentsOf);
            if (alpha_ == averaged)
                loadRow(rows, y, texels);
            for (std::size_t x = 0; x < width && alpha_ == averaged; ++x)
                row[x].alpha = texels[x].w;
        }
    });
    if (alpha_ == roughness)
        store(0, rows.height, start, take);
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
    const std::size_t start = level.grow(level.next - first);
    forRowBands(level.width, level.next - first, [&](int firstRow, int lastRow) {
        for (int y = firstRow; y < lastRow; ++y) {
            const std::size_t at = start + std::size_t(y) * width;
            const Footprint down = footprint(first + y, level.height, larger.height);
            for (int fy = down.first; fy <= down.last; ++fy)
                addRow({&larger.moments[std::size_t(fy - larger.first) * from], from}, down.weight(fy),
                       {&level.moments[at], width});
            for (std::size_t x = 0; x < width && alpha_ == averaged; ++x)
                level.moments[at + x].alpha = larger.meanAlpha(int(x), first + y);
        }
    });
    larger.keepFrom(level.next < level.height ? footprint(level.next, level.height, larger.height).first : end);
    store(i, level.next - first, start, take);
}

void MipRows::store(std::size_t i, int count, std::size_t start, const Take& take)
{
    Level& level = levels_[i];
    const std::size_t width = std::size_t(level.width);
    Image normals = makeImage(level.width, count, settings_.type), grey;
    if (alpha_ == roughness)
        grey = normals;
    std::vector<double> lengths(std::size_t(count), 0), rough(lengths), counts(lengths);
    forRowBands(level.width, count, [&](int first, int last) {
        std::vector<glm::vec4> texels(width), greys(width);
        for (int y = first; y < last; ++y) {
            Moments* const row = &level.moments[start + std::size_t(y) * width];
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec3 mean = meanOf(row[x]);
                texels[x] = encodeTexel(mean, settings_.to, settings_.type, settings_.keepLengths);
                texels[x].w = row[x].alpha;
                if (alpha_ != roughness)
                    continue;
                const double r = roughnessOf(row[x], settings_);
                greys[x] = glm::vec4(float(r), float(r), float(r), 1);
                rough[std::size_t(y)] += r;
                if (row[x].coverage > 0)
                    lengths[std::size_t(y)] += double(glm::length(mean)), counts[std::size_t(y)] += 1;
            }
            storeRow(normals, y, texels);
            if (alpha_ == roughness)
                storeRow(grey, y, greys);
            if (alpha_ == averaged)
                loadRow(normals, y, texels); // as stored
            for (std::size_t x = 0; x < width && alpha_ == averaged; ++x)
                row[x].alpha = texels[x].w;
        }
    });
    for (std::size_t y = 0; y < lengths.size(); ++y)
        level.length += lengths[y], level.roughness += rough[y], level.count += counts[y];
    take(i, std::move(normals), std::move(grey));
}

std::size_t MipRows::Level::grow(int rows)
{
    const std::size_t start = moments.size();
    moments.resize(start + std::size_t(rows) * std::size_t(width));
    return start;
}

float MipRows::Level::meanAlpha(int x, int y) const
{
    const int across = std::min(width, 2), down = std::min(height, 2);
    float sum = 0;
    for (int k = 0; k < down; ++k)
        for (int i = 0; i < across; ++i)
            sum += moments[std::size_t(2 * y + k - first) * std::size_t(width) + std::size_t(2 * x + i)].alpha
                / float(across * down);
    return sum;
}

void MipRows::Level::keepFrom(int row)
{
    moments.erase(moments.begin(), moments.begin() + std::ptrdiff_t(row - first) * width);
    first = row;
}

} // namespace cotan::maps
