#include "cotan/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/packing.hpp>

#include "core/loops.hpp"
#include "prefilter.hpp"
#include "scene/environment_map.hpp"

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

// The lobe of that alpha along every direction of a map, in patches. size: a multiple of 8.
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
    map.fold();
    return map;
}

void put(Image& atlas, int x, int y, glm::vec3 value)
{
    float* p = atlas.floats() + 4 * (std::size_t(y) * std::size_t(atlas.width) + std::size_t(x));
    for (int c = 0; c < 3; ++c)
        p[c] = glm::unpackHalf2x16(glm::packHalf2x16(glm::vec2(std::min(value[c], kBrightest), 0))).x;
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

Result<EnvironmentMap> environmentOfPicture(const Image& picture, const EnvironmentOptions& options)
{
    if (picture.type != PixelType::float32)
        return inputError(fmt::format("{}: expected a picture of floats (.hdr, .exr); found {} bits a channel",
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
        return sound({p[0], p[1], p[2]});
    };
    const Radiance radiance = [&](glm::vec3 d) {
        return bilinear({(std::atan2(d.z, d.x) / (2 * kPi) + 0.5f) * float(width),
                         std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi * float(height)},
                        at);
    };
    // The widest texels of the finest tile are 0.009 radians wide.
    const int samples = std::clamp(int(std::ceil(0.009f * float(width) / (2 * kPi))), 1, 24);
    EnvironmentMap map = makeEnvironment(radiance, samples, options);
    map.name = picture.name;
    return map;
}

} // namespace cotan
