#include "cotan/environment/environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "albedo.hpp"
#include "cotan/parallel/loops.hpp"
#include "octahedral.hpp"

namespace cotan {

namespace {

using namespace environment;

constexpr float kBrightest = 65504; // what a half holds
constexpr float kPi = std::numbers::pi_v<float>;

glm::vec3 sound(glm::vec3 c)
{
    for (int i = 0; i < 3; ++i)
        c[i] = c[i] > 0 ? std::min(c[i], kBrightest) : 0; // NaN becomes 0
    return c;
}

int sizeOfTile(int tile) { return int(f32::cotan_environment_tile(float(tile)).z); }

// Finest first, each level half of the one before, down to 4 texels a side.
using Pyramid = std::vector<Octahedral>;

Pyramid pyramidOf(Octahedral finest)
{
    Pyramid levels{std::move(finest)};
    while (levels.back().size > 4)
        levels.push_back(halved(levels.back()));
    return levels;
}

glm::vec3 readLevel(const Pyramid& pyramid, glm::vec3 direction, float level)
{
    level = std::clamp(level, 0.0f, float(pyramid.size() - 1));
    const auto lower = std::size_t(level);
    const glm::vec3 a = pyramid[lower].read(direction);
    if (lower + 1 == pyramid.size())
        return a;
    return a + (pyramid[lower + 1].read(direction) - a) * (level - float(lower));
}

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
                sum += sound(radiance({c * d.x - s * d.z, d.y, s * d.x + c * d.z})); // turned back
            }
            map.at(x, y) = sound(sum * (options.intensity / float(samples * samples)));
        }
    });
    return map;
}

// A direction around z of what a mirror of that roughness reflects, seen straight on.
struct LobeSample {
    glm::vec3 direction;
    float weight = 0;
    float solidAngle = 0; // that it stands for
};

// In order of the microfacets' distribution; each weighs as its cosine.
std::vector<LobeSample> lobe(float roughness, unsigned count)
{
    const double alpha = std::pow(std::max(roughness, 0.045f), 2), alpha2 = alpha * alpha;
    std::vector<LobeSample> samples;
    double weights = 0;
    for (unsigned i = 0; i < count; ++i) {
        const glm::dvec2 u = hammersley(i, count);
        const double nh2 = (1 - u.x) / (1 + (alpha2 - 1) * u.x);
        const double nl = 2 * nh2 - 1;
        if (nl <= 0)
            continue;
        const double side = std::sqrt(std::max(1 - nl * nl, 0.0)), phi = 2 * std::numbers::pi * u.y;
        const double d = 1 + (alpha2 - 1) * nh2;
        const double density = alpha2 / (std::numbers::pi * d * d) / 4;
        samples.push_back(
            {glm::vec3(side * std::cos(phi), side * std::sin(phi), nl), float(nl), float(1 / (count * density))});
        weights += nl;
    }
    for (LobeSample& s : samples)
        s.weight /= float(weights);
    return samples;
}

// Every sample reads the level whose texels cover what it stands for: no dots, however bright a small light is.
Octahedral filtered(const Pyramid& pyramid, int size, float roughness, unsigned count)
{
    const std::vector<LobeSample> samples = lobe(roughness, count);
    const float texelsOfAll = float(pyramid[0].size) * float(pyramid[0].size);
    Octahedral map(size);
    parallelFor(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec3 n = map.direction(x, y);
            const f32::cotan_basis basis = f32::cotan_basis_of_normal(n);
            glm::vec3 sum(0);
            for (const LobeSample& s : samples) {
                const glm::vec3 l = basis.x * s.direction.x + basis.y * s.direction.y + n * s.direction.z;
                const float texel = solidAngleOfPlace(l) / texelsOfAll;
                sum += readLevel(pyramid, l, 0.5f * std::log2(s.solidAngle / texel) + 0.25f) * s.weight;
            }
            map.at(x, y) = sum;
        }
    });
    return map;
}

// Over all directions of a level of the pyramid, by solid angle and cosine.
Octahedral irradiance(const Octahedral& source, int size)
{
    struct Light {
        glm::vec3 direction, radiance;
        float solidAngle;
    };
    std::vector<Light> lights;
    for (int y = 0; y < source.size; ++y)
        for (int x = 0; x < source.size; ++x) {
            const glm::vec3 d = source.direction(x, y);
            lights.push_back({d, source.at(x, y), solidAngleOfPlace(d)});
        }
    Octahedral map(size);
    parallelFor(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec3 n = map.direction(x, y);
            glm::vec3 sum(0);
            float weights = 0;
            for (const Light& light : lights) {
                const float weight = std::max(glm::dot(n, light.direction), 0.0f) * light.solidAngle;
                sum += light.radiance * weight;
                weights += weight;
            }
            map.at(x, y) = sum / weights;
        }
    });
    return map;
}

void put(Image& atlas, int x, int y, glm::vec3 value)
{
    float* p = atlas.floats() + 4 * (std::size_t(y) * std::size_t(atlas.width) + std::size_t(x));
    for (int c = 0; c < 3; ++c)
        p[c] = glm::unpackHalf2x16(glm::packHalf2x16(glm::vec2(std::min(value[c], kBrightest), 0))).x;
    p[3] = 1;
}

// With its border.
void putTile(Image& atlas, int tile, const Octahedral& map)
{
    const glm::vec3 place = f32::cotan_environment_tile(float(tile));
    for (int y = -1; y <= map.size; ++y)
        for (int x = -1; x <= map.size; ++x)
            put(atlas, int(place.x) + x, int(place.y) + y, map.around(x, y));
}

void putAlbedo(Image& atlas)
{
    const glm::vec3 place = f32::cotan_environment_tile(10);
    const int size = int(place.z);
    parallelFor(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            const glm::dvec2 factors = albedoFactors(x / double(size - 1), y / double(size - 1));
            put(atlas, int(place.x) + x, int(place.y) + y, glm::vec3(glm::vec2(factors), 0));
        }
    });
}

} // namespace

EnvironmentMap makeEnvironment(const Radiance& radiance, int samples, const EnvironmentOptions& options)
{
    EnvironmentMap map;
    map.atlas = makeImage(COTAN_ENVIRONMENT_WIDTH, COTAN_ENVIRONMENT_HEIGHT, PixelType::float32, "environment");
    const Pyramid pyramid = pyramidOf(sampled(radiance, sizeOfTile(0), samples, options));
    putTile(map.atlas, 0, pyramid[0]);
    for (int tile = 1; tile <= 8; ++tile) {
        const int size = sizeOfTile(tile);
        const unsigned count = size == 256 ? 64 : size == 128 ? 128 : 256;
        putTile(map.atlas, tile, filtered(pyramid, size, float(tile) / 8, count));
    }
    const auto coarse =
        std::find_if(pyramid.begin(), pyramid.end(), [](const Octahedral& level) { return level.size == 32; });
    putTile(map.atlas, 9, irradiance(*coarse, sizeOfTile(9)));
    putAlbedo(map.atlas);
    return map;
}

Result<EnvironmentMap> environmentOfPicture(const Image& picture, const EnvironmentOptions& options)
{
    if (picture.type != PixelType::float32)
        return inputError(fmt::format("{}: expected a picture of floats (.hdr, .exr); found {} bits a channel",
                                      picture.name, bitsPerComponent(picture.type)));
    if (!hasPixels(picture) || picture.width != 2 * picture.height)
        return inputError(
            fmt::format("{}: expected surroundings in equirectangular projection, twice as wide as high; found {}x{}",
                        picture.name, picture.width, picture.height));
    const int width = picture.width, height = picture.height;
    const auto at = [&](int x, int y) {
        x = (x % width + width) % width;
        y = std::clamp(y, 0, height - 1);
        const float* p = picture.floats() + 4 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
        return sound({p[0], p[1], p[2]});
    };
    const Radiance radiance = [&](glm::vec3 d) {
        const float u = (std::atan2(d.z, d.x) / (2 * kPi) + 0.5f) * float(width) - 0.5f;
        const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi * float(height) - 0.5f;
        const float fx = std::floor(u), fy = std::floor(v);
        const int x = int(fx), y = int(fy);
        const glm::vec3 top = at(x, y) * (1 - (u - fx)) + at(x + 1, y) * (u - fx);
        const glm::vec3 bottom = at(x, y + 1) * (1 - (u - fx)) + at(x + 1, y + 1) * (u - fx);
        return top * (1 - (v - fy)) + bottom * (v - fy);
    };
    // The widest texels of the finest tile are 0.009 radians wide.
    const int samples = std::clamp(int(std::ceil(0.009f * float(width) / (2 * kPi))), 1, 24);
    EnvironmentMap map = makeEnvironment(radiance, samples, options);
    map.name = picture.name;
    return map;
}

} // namespace cotan
