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
    while (levels.back().size() > 4)
        levels.push_back(halved(levels.back()));
    return levels;
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
            map.at(x, y) = glm::vec4(sound(sum * (options.intensity / float(samples * samples))), 0);
        }
    });
    map.fold();
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

// log2 of a number from 1 to sqrt(3), to 0.02.
float smallLog2(float x) { return (x - 1) * (1.386f - 0.415f * (x - 1)); }

// Every sample reads the level whose texels cover what it stands for: no dots, however bright a small light is.
Octahedral filtered(const Pyramid& pyramid, int size, float roughness, unsigned count)
{
    const std::vector<LobeSample> samples = lobe(roughness, count);
    const float texelsOfAll = float(pyramid[0].size()) * float(pyramid[0].size());
    std::vector<float> levels; // where a texel's solid angle is least
    for (const LobeSample& s : samples)
        levels.push_back(0.5f * std::log2(s.solidAngle * texelsOfAll / solidAngleOfPlace({0, 1, 0})));
    const float last = float(pyramid.size()) - 1.01f;
    Octahedral map(size);
    parallelFor(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec3 n = map.direction(x, y);
            const f32::cotan_basis basis = f32::cotan_basis_of_normal(n);
            glm::vec4 sum(0);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const LobeSample& s = samples[i];
                const glm::vec3 l = basis.x * s.direction.x + basis.y * s.direction.y + n * s.direction.z;
                const float extent = std::abs(l.x) + std::abs(l.y) + std::abs(l.z);
                const float level = std::clamp(levels[i] - 1.5f * smallLog2(extent), 0.0f, last);
                const auto finer = std::size_t(level);
                const glm::vec2 place = f32::cotan_octahedral_place(l);
                const glm::vec4 a = pyramid[finer].read(place), b = pyramid[finer + 1].read(place);
                sum += (a + (b - a) * (level - float(finer))) * s.weight;
            }
            map.at(x, y) = sum;
        }
    });
    map.fold();
    return map;
}

// Over all directions of a level of the pyramid, by solid angle and cosine.
Octahedral irradiance(const Octahedral& source, int size)
{
    struct Light {
        glm::vec4 direction, radiance; // times its solid angle; 1 in the last place, times that too
    };
    std::vector<Light> lights;
    for (int y = 0; y < source.size(); ++y)
        for (int x = 0; x < source.size(); ++x) {
            const glm::vec3 d = source.direction(x, y);
            lights.push_back({glm::vec4(d, 0), (source.at(x, y) + glm::vec4(0, 0, 0, 1)) * solidAngleOfPlace(d)});
        }
    Octahedral map(size);
    parallelFor(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec4 n(map.direction(x, y), 0);
            glm::vec4 sum(0);
            for (const Light& light : lights)
                sum += light.radiance * std::max(glm::dot(n, light.direction), 0.0f);
            map.at(x, y) = glm::vec4(glm::vec3(sum) / sum.w, 0);
        }
    });
    map.fold();
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

EnvironmentMap makeEnvironment(const Radiance& radiance, int samples, const EnvironmentOptions& options)
{
    EnvironmentMap map;
    map.atlas = makeImage(COTAN_ENVIRONMENT_WIDTH, COTAN_ENVIRONMENT_HEIGHT, PixelType::float32, "environment");
    const Pyramid pyramid = pyramidOf(sampled(radiance, sizeOfTile(0), samples, options));
    putTile(map.atlas, 0, pyramid[0]);
    for (int tile = 1; tile <= COTAN_ENVIRONMENT_STEPS; ++tile) {
        const int size = sizeOfTile(tile);
        // All but the sharpest are smoother than half as many texels can show.
        const unsigned count = tile == 1 ? 16 : size == 256 ? 40 : size == 128 ? 80 : 192;
        const float roughness = float(tile) / COTAN_ENVIRONMENT_STEPS;
        putTile(map.atlas, tile,
                tile == 1 ? filtered(pyramid, size, roughness, count)
                          : doubled(filtered(pyramid, size / 2, roughness, count)));
    }
    const auto coarse =
        std::find_if(pyramid.begin(), pyramid.end(), [](const Octahedral& level) { return level.size() == 16; });
    putTile(map.atlas, COTAN_ENVIRONMENT_IRRADIANCE, irradiance(*coarse, sizeOfTile(COTAN_ENVIRONMENT_IRRADIANCE)));
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
