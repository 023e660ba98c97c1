// Builds environment atlases: octahedral maps of radiance, and their GGX-filtered levels.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/integer.hpp>
#include <glm/packing.hpp>

#include "core/loops.hpp"
#include "cotan/view.hpp"
#include "prefilter.hpp"
#include "scene/environment_map.hpp"

// How these vectors are passed depends on the target's instruction set, but only functions of this file pass them.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace cotan {

namespace {

using namespace environment;

// ---- all directions --------------------------------------------------------------------------

// A function of direction: an octahedral map with a border, so that it can be filtered without seams. Texels have four
// floats, the last one 0, so that SIMD adds a texel at once.
class Octahedral {
public:
    // side: in texels, even.
    explicit Octahedral(int side) : size_(side), texels_(std::size_t(side + 2) * std::size_t(side + 2), glm::vec4(0)) {}

    int size() const { return size_; }

    // x, y: -1 to size(), including a border of one texel.
    glm::vec4& at(int x, int y) { return texels_[index(x, y)]; }
    const glm::vec4& at(int x, int y) const { return texels_[index(x, y)]; }

    // Fills the border with the adjacent texels on the sphere: across an edge the map continues with the same edge
    // reversed. Call after writing and before filtering.
    void fillBorder()
    {
        const int last = size_ - 1;
        for (int i = 0; i < size_; ++i) {
            at(i, -1) = at(last - i, 0);
            at(i, size_) = at(last - i, last);
            at(-1, i) = at(0, last - i);
            at(size_, i) = at(last, last - i);
        }
        for (const int x : {-1, size_})
            for (const int y : {-1, size_})
                at(x, y) = at(x < 0 ? last : 0, y < 0 ? last : 0);
    }

    // The unit direction of a point inside a texel, from (0,0) to (1,1).
    glm::vec3 direction(int x, int y, glm::vec2 inside = glm::vec2(0.5f)) const
    {
        const glm::vec2 place((float(x) + inside.x) / float(size_), (float(y) + inside.y) / float(size_));
        return glm::normalize(f32::cotan_octahedral_direction(place));
    }

private:
    std::size_t index(int x, int y) const { return std::size_t(y + 1) * std::size_t(size_ + 2) + std::size_t(x + 1); }

    int size_;
    std::vector<glm::vec4> texels_;
};

// ---- lamps -----------------------------------------------------------------------------------

constexpr int kCoarsest = 4;     // blocks per side
constexpr float kWidest = 0.15f; // maximum texel width in radians: near the horizon, where lobes end
constexpr float kNarrow = 0.35f; // maximum texel width relative to the lobe's width or the distance from the lobe

// Four floats for SIMD; compilers split glm's vectors.
using Four = float __attribute__((vector_size(16)));

Four four(const glm::vec4& v) { return Four{v.x, v.y, v.z, v.w}; }
float sumOf(Four v) { return (v[0] + v[1]) + (v[2] + v[3]); }

// Light of a texel, or of several texels.
struct LightSum {
    glm::vec3 light{0};  // radiance times solid angle
    glm::vec3 axis{0};   // sum of directions, weighted by light
    glm::vec3 middle{0}; // sum of directions, weighted by solid angle
    float solidAngle = 0;
};

// Solid angle per unit of the map's area, around a unit direction. The map is the octahedron seen from above, unfolded
// to a square of side 2. On the octahedron, direction d ends at d / (|x|+|y|+|z|); its distance r gives the solid
// angle, 1/r^3 times the area seen from above.
float solidAngleDensity(glm::vec3 d)
{
    const float size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    return 4 * size * size * size;
}

// All incident light as a hierarchy of lamps: fine near a lobe's centre, coarse far from it.
class LampTree {
public:
    // finest: radiance; its side is a power of two, at least 8.
    explicit LampTree(const Octahedral& finest)
    {
        int texels = finest.size();
        std::vector<LightSum> texelSums(std::size_t(texels) * std::size_t(texels));
        for (int y = 0; y < texels; ++y)
            for (int x = 0; x < texels; ++x) {
                const glm::vec3 d = finest.direction(x, y);
                LightSum& h = texelSums[std::size_t(y) * std::size_t(texels) + std::size_t(x)];
                h.solidAngle = solidAngleDensity(d) / (float(texels) * float(texels));
                h.light = glm::vec3(finest.at(x, y)) * h.solidAngle;
                h.middle = d * h.solidAngle;
                h.axis = d * (h.light.x + h.light.y + h.light.z);
            }
        while (texels >= 2 * kCoarsest) {
            const int size = texels / 2;
            Level level{size, std::vector<Block>(std::size_t(size) * std::size_t(size))};
            std::vector<LightSum> sums(level.blocks.size());
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const std::size_t place = std::size_t(y) * std::size_t(size) + std::size_t(x);
                    Block& b = level.blocks[place];
                    LightSum& sum = sums[place];
                    for (int i = 0; i < 4; ++i) {
                        const LightSum& h =
                            texelSums[std::size_t(2 * y + i / 2) * std::size_t(texels) + std::size_t(2 * x + i % 2)];
                        const glm::vec3 d = glm::normalize(glm::dot(h.axis, h.axis) > 0 ? h.axis : h.middle);
                        b.x[i] = d.x, b.y[i] = d.y, b.z[i] = d.z;
                        b.solidAngle[i] = h.solidAngle;
                        for (int c = 0; c < 3; ++c)
                            b.light[std::size_t(c)][i] = h.light[c];
                        sum.light += h.light, sum.axis += h.axis, sum.middle += h.middle;
                        sum.solidAngle += h.solidAngle;
                    }
                    b.middle = glm::normalize(sum.middle);
                    b.width = 0.5f * std::sqrt(sum.solidAngle);
                    b.radius = 2 * b.width; // texels are up to 1.7 times as long as wide
                }
            levels_.push_back(std::move(level));
            texelSums = std::move(sums);
            texels = size;
        }
        std::reverse(levels_.begin(), levels_.end());
    }

    // For each normal: the mean radiance that GGX microfacets reflect, viewed along the normal, weighted by the
    // distribution at the half vector times n.l. alpha2: squared alpha, above 0; 1 gives the cosine-weighted mean.
    // Normals that are close together are faster: they share one traversal of the tree. Every texel contributes to
    // exactly one lamp; so even small bright lights give no dots, and a white environment gives 1.
    void lobes(std::span<const glm::vec3> normals, float alpha2, std::span<glm::vec3> means) const
    {
        const float lobeWidth = 1.3f * std::sqrt(alpha2); // half width at half maximum
        glm::vec3 sum(0);
        for (const glm::vec3& n : normals)
            sum += n;
        const glm::vec3 middle = glm::normalize(sum);
        float apart = 0;
        for (const glm::vec3& n : normals)
            apart = std::max(apart, glm::distance(n, middle));

        std::vector<const Block*> lamps; // lamps for all of the normals
        const auto visit = [&](const auto& self, std::size_t level, int x, int y) -> void {
            const Level& l = levels_[level];
            const Block& b = l.blocks[std::size_t(y) * std::size_t(l.size) + std::size_t(x)];
            const float cosine = glm::dot(middle, b.middle);
            if (cosine < -b.radius - apart)
                return; // behind
            const float away = std::sqrt(std::max(2 - 2 * cosine, 0.0f)) - b.radius - apart;
            if (level + 1 == levels_.size() || b.width <= std::min(kNarrow * std::max(lobeWidth, away), kWidest)) {
                lamps.push_back(&b);
                return;
            }
            for (int i = 0; i < 4; ++i)
                self(self, level + 1, 2 * x + i % 2, 2 * y + i / 2);
        };
        for (int y = 0; y < levels_[0].size; ++y)
            for (int x = 0; x < levels_[0].size; ++x)
                visit(visit, 0, x, y);

        for (std::size_t i = 0; i < normals.size(); ++i) {
            const glm::vec3 n = normals[i];
            Four red{}, green{}, blue{}, weights{};
            for (const Block* b : lamps) {
                Four nl = four(b->x) * n.x + four(b->y) * n.y + four(b->z) * n.z;
                nl = nl > 0 ? nl : Four{};
                const Four d = 1 + (nl + 1) * (0.5f * (alpha2 - 1)); // the half vector's n.h^2 is (1 + nl) / 2
                const Four w = nl / (d * d);
                weights += four(b->solidAngle) * w;
                red += four(b->light[0]) * w, green += four(b->light[1]) * w, blue += four(b->light[2]) * w;
            }
            means[i] = glm::vec3(sumOf(red), sumOf(green), sumOf(blue)) / sumOf(weights);
        }
    }

private:
    // Four texels that meet at a corner, as a structure of arrays for SIMD.
    struct Block {
        glm::vec4 x, y, z; // unit directions to the centres of their light
        glm::vec4 solidAngle;
        std::array<glm::vec4, 3> light; // radiance times solid angle
        glm::vec3 middle;
        float radius; // of all four around `middle`, as a chord length
        float width;  // of one texel
    };
    struct Level {
        int size; // blocks per side
        std::vector<Block> blocks;
    };

    std::vector<Level> levels_; // coarsest first; each texel of a block is a block of the next level
};

// ---- what GGX reflects -----------------------------------------------------------------------

constexpr unsigned kSamples = 64;

// Samples a microfacet normal from the distribution visible along v; n = z.
glm::dvec3 visibleNormal(glm::dvec3 v, double alpha, glm::dvec2 u)
{
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
    const double flat = stretched.x * stretched.x + stretched.y * stretched.y;
    const glm::dvec3 t =
        flat > 1e-12 ? glm::dvec3(-stretched.y, stretched.x, 0) / std::sqrt(flat) : glm::dvec3(1, 0, 0);
    const glm::dvec3 b = glm::cross(stretched, t);
    const double r = std::sqrt(u.x), phi = 2 * std::numbers::pi * u.y;
    const double x = r * std::cos(phi);
    const double s = (1 + stretched.z) / 2;
    const double y = (1 - s) * std::sqrt(std::max(1 - x * x, 0.0)) + s * r * std::sin(phi);
    const glm::dvec3 h = x * t + y * b + std::sqrt(std::max(1 - x * x - y * y, 0.0)) * stretched;
    return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-9)));
}

// A point of the Hammersley set.
glm::dvec2 hammersley(unsigned index, unsigned count)
{
    return {(index + 0.5) / count, glm::bitfieldReverse(index) * 0x1p-32 + 0x1p-33};
}

// ---- the atlas -------------------------------------------------------------------------------

constexpr float kBrightest = 65504; // maximum of a half
constexpr float kPi = std::numbers::pi_v<float>;

glm::vec3 clampedRadiance(glm::vec3 c)
{
    for (int i = 0; i < 3; ++i)
        c[i] = c[i] > 0 ? std::min(c[i], kBrightest) : 0; // NaN becomes 0
    return c;
}

int sizeOfTile(int tile) { return int(f32::cotan_environment_tile(float(tile)).z); }

Octahedral sampled(const Radiance& radiance, int size, int samples, const EnvironmentOptions& options)
{
    Octahedral map(size);
    const float c = std::cos(options.rotation), s = std::sin(options.rotation);
    parallelFor(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            glm::vec3 sum(0);
            for (int i = 0; i < samples * samples; ++i) {
                const glm::vec2 inside((float(i % samples) + 0.5f) / float(samples),
                                       (float(i / samples) + 0.5f) / float(samples));
                const glm::vec3 d = map.direction(x, y, inside);
                sum += clampedRadiance(radiance({c * d.x - s * d.z, d.y, s * d.x + c * d.z})); // inverse rotation
            }
            map.at(x, y) = glm::vec4(clampedRadiance(sum * (options.intensity / float(samples * samples))), 0);
        }
    });
    map.fillBorder();
    return map;
}

// Filters the lamps with the given alpha^2 for every direction of a map, in patches. size: a multiple of 8.
Octahedral filtered(const LampTree& lamps, int size, float alpha2)
{
    constexpr int kPatch = 4;
    Octahedral map(size);
    parallelFor(0, size / kPatch, [&](int row) {
        std::array<glm::vec3, kPatch * kPatch> normals, means;
        for (int column = 0; column < size / kPatch; ++column) {
            for (int i = 0; i < kPatch * kPatch; ++i)
                normals[std::size_t(i)] = map.direction(kPatch * column + i % kPatch, kPatch * row + i / kPatch);
            lamps.lobes(normals, alpha2, means);
            for (int i = 0; i < kPatch * kPatch; ++i)
                map.at(kPatch * column + i % kPatch, kPatch * row + i / kPatch) = glm::vec4(means[std::size_t(i)], 0);
        }
    });
    map.fillBorder();
    return map;
}

void put(Image& atlas, int x, int y, glm::vec3 value)
{
    float* p = atlas.floats() + 4 * (std::size_t(y) * std::size_t(atlas.width) + std::size_t(x));
    for (int c = 0; c < 3; ++c)
        p[c] = glm::unpackHalf2x16(glm::packHalf2x16(glm::vec2(std::min(value[c], kBrightest), 0))).x;
}

// Copies a tile with its border.
void putTile(Image& atlas, int tile, const Octahedral& map)
{
    const glm::vec3 place = f32::cotan_environment_tile(float(tile));
    for (int y = -1; y <= map.size(); ++y)
        for (int x = -1; x <= map.size(); ++x)
            put(atlas, int(place.x) + x, int(place.y) + y, glm::vec3(map.at(x, y)));
}

void putAlbedo(Image& atlas)
{
    const glm::vec3 place = f32::cotan_environment_tile(COTAN_ENVIRONMENT_ALBEDO);
    const int size = int(place.z);
    parallelFor(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            const glm::dvec2 factors = albedoFactors(x / double(size - 1), y / double(size - 1));
            put(atlas, int(place.x) + x, int(place.y) + y, glm::vec3(glm::vec2(factors), 0));
        }
    });
}

} // namespace

glm::dvec2 environment::albedoFactors(double nv, double roughness)
{
    nv = std::max(nv, 1e-4);
    const double alpha = std::max(roughness, 0.045) * std::max(roughness, 0.045), alpha2 = alpha * alpha;
    const glm::dvec3 v(std::sqrt(std::max(1 - nv * nv, 0.0)), 0, nv);
    const double rootV = std::sqrt(alpha2 + (1 - alpha2) * nv * nv);
    glm::dvec2 sum(0);
    for (unsigned i = 0; i < kSamples; ++i) {
        const glm::dvec3 h = visibleNormal(v, alpha, hammersley(i, kSamples));
        const double vh = std::max(glm::dot(v, h), 0.0);
        const double nl = 2 * vh * h.z - v.z;
        if (nl <= 0)
            continue;
        // Smith's term for both directions, divided by the eye's term, which visible-normal sampling already contains.
        const double rootL = std::sqrt(alpha2 + (1 - alpha2) * nl * nl);
        const double share = nl * (nv + rootV) / (nl * rootV + nv * rootL);
        const double fresnel = f64::cotan_grazing(std::min(vh, 1.0));
        sum += share * glm::dvec2(1 - fresnel, fresnel);
    }
    return sum / double(kSamples);
}

EnvironmentMap makeEnvironment(const Radiance& radiance, int samples, const EnvironmentOptions& options)
{
    EnvironmentMap map;
    map.atlas = makeImage(COTAN_ENVIRONMENT_WIDTH, COTAN_ENVIRONMENT_HEIGHT, PixelType::float32, "environment");
    for (std::size_t i = 0; i < map.atlas.pixelCount(); ++i)
        map.atlas.floats()[4 * i + 3] = 1;
    const Octahedral finest = sampled(radiance, sizeOfTile(0), samples, options);
    const LampTree lamps(finest);
    putTile(map.atlas, 0, finest);
    for (int tile = 1; tile <= COTAN_ENVIRONMENT_STEPS; ++tile)
        putTile(map.atlas, tile,
                filtered(lamps, sizeOfTile(tile), std::pow(float(tile) / COTAN_ENVIRONMENT_STEPS, 4.0f)));
    putTile(map.atlas, COTAN_ENVIRONMENT_IRRADIANCE, filtered(lamps, sizeOfTile(COTAN_ENVIRONMENT_IRRADIANCE), 1));
    putAlbedo(map.atlas);
    return map;
}

Result<EnvironmentMap> environmentOfImage(const Image& picture, const EnvironmentOptions& options)
{
    if (picture.type != PixelType::float32)
        return inputError(fmt::format("{}: expected a floating-point image (.hdr, .exr); found {} bits per channel",
                                      picture.name, bitsPerComponent(picture.type)));
    if (!hasPixels(picture) || picture.width != 2 * picture.height)
        return inputError(
            fmt::format("{}: expected an environment in equirectangular projection, twice as wide as high; found {}x{}",
                        picture.name, picture.width, picture.height));
    const int width = picture.width, height = picture.height;
    const auto at = [&](int x, int y) {
        x = (x % width + width) % width;
        y = std::clamp(y, 0, height - 1);
        const float* p = picture.floats() + 4 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
        return clampedRadiance({p[0], p[1], p[2]});
    };
    const Radiance radiance = [&](glm::vec3 d) {
        return bilinear({(std::atan2(d.z, d.x) / (2 * kPi) + 0.5f) * float(width),
                         std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi * float(height)},
                        at);
    };
    // Texels of the finest tile are at most 0.009 radians wide.
    const int samples = std::clamp(int(std::ceil(0.009f * float(width) / (2 * kPi))), 1, 24);
    EnvironmentMap map = makeEnvironment(radiance, samples, options);
    map.name = picture.name;
    return map;
}

} // namespace cotan
