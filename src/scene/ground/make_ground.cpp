#include "cotan/view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "columns.hpp"
#include "core/loops.hpp"
#include "scene/environment_map.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

using namespace ground;

constexpr int kColumns = 192;                       // a side
constexpr int kLightPlaces = 320, kSkyPlaces = 128; // of the map, a side
constexpr int kLightRays = 16 * 24, kSkyRays = 16 * 32;
constexpr float kLowest = 0.17f; // sine of the height of a light over the horizon below which its shadow is left out
constexpr float kAround = 1.2f;  // heights of what stands: how far the sky is darkened beside it
constexpr float kGolden = 2.399963f;

float luminance(glm::vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// Where on the plane something can be seen.
struct Rectangle {
    glm::vec2 low, high;

    void hold(glm::vec2 a, glm::vec2 b)
    {
        low = glm::min(low, a);
        high = glm::max(high, b);
    }
    glm::vec2 place(int x, int z, int side) const
    {
        return low + (high - low) * (glm::vec2(float(x) + 0.5f, float(z) + 0.5f) / float(side));
    }
};

// How a ray moves sideways as it rises by 1.
using Speeds = std::vector<glm::vec2>;

// Rays to a disc around the light's direction, whose tangent of half the angle is `softness`.
Speeds raysToLight(glm::vec3 toLight, float softness)
{
    const glm::vec3 right =
        glm::normalize(glm::cross(toLight, std::abs(toLight.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    const glm::vec3 up = glm::cross(right, toLight);
    Speeds speeds;
    for (int i = 0; i < kLightRays; ++i) {
        const float radius = softness * std::sqrt((float(i) + 0.5f) / kLightRays), angle = kGolden * float(i);
        const glm::vec3 d = toLight + right * (radius * std::cos(angle)) + up * (radius * std::sin(angle));
        speeds.push_back(glm::vec2(d.x, d.z) / std::max(d.y, 0.02f) - glm::vec2(toLight.x, toLight.z) / toLight.y);
    }
    return speeds;
}

// Rays to all of the sky, as often as it lights a level plane.
Speeds raysToSky()
{
    Speeds speeds;
    for (int i = 0; i < kSkyRays; ++i) {
        const float sine2 = (float(i) + 0.5f) / kSkyRays, angle = kGolden * float(i);
        const float slope = std::sqrt(sine2 / (1 - sine2));
        speeds.push_back(glm::vec2(std::cos(angle), std::sin(angle)) * slope);
    }
    return speeds;
}

// The mean over 4 x 4 places, without moving them by half a place: weights 1, 2, 2, 2, 1 each way.
void smoothOut(std::vector<float>& shares, int side)
{
    const auto weigh = [&](int step, int stride) {
        std::vector<float> line(static_cast<std::size_t>(side));
        for (int i = 0; i < side; ++i) {
            float* at = shares.data() + std::ptrdiff_t(i) * stride;
            const auto value = [&](int k) { return at[std::ptrdiff_t(std::clamp(k, 0, side - 1)) * step]; };
            for (int k = 0; k < side; ++k)
                line[std::size_t(k)] = (value(k - 2) + value(k + 2) + 2 * (value(k - 1) + value(k) + value(k + 1))) / 8;
            for (int k = 0; k < side; ++k)
                at[std::ptrdiff_t(k) * step] = line[std::size_t(k)];
        }
    };
    weigh(1, side);
    weigh(side, 1);
}

// The share of the rays that get through, in places of the rectangle, rows along x first. Each of
// 4 x 4 places takes a sixteenth of the rays; their means have all of them.
std::vector<float> passing(const Columns& columns, const Speeds& speeds, const Rectangle& rectangle, int side)
{
    std::vector<float> shares(std::size_t(side) * std::size_t(side));
    parallelFor(0, side, [&](int z) {
        for (int x = 0; x < side; ++x) {
            const glm::vec2 place = rectangle.place(x, z, side);
            const std::size_t kind = std::size_t(4 * (z & 3) + (x & 3));
            float stopped = 0;
            for (std::size_t i = kind; i < speeds.size(); i += 16)
                stopped += columns.stopped(place, speeds[i]);
            shares[std::size_t(z) * std::size_t(side) + std::size_t(x)] = 1 - 16 * stopped / float(speeds.size());
        }
    });
    smoothOut(shares, side);
    return shares;
}

// Between the places of another number of them.
float between(const std::vector<float>& shares, int side, glm::vec2 uv)
{
    const glm::vec2 p = glm::clamp(uv * float(side) - 0.5f, 0.0f, float(side) - 1.001f);
    const glm::ivec2 i(p);
    const glm::vec2 k = p - glm::vec2(i);
    const float* at = shares.data() + std::size_t(i.y) * std::size_t(side) + std::size_t(i.x);
    const float top = at[0] + (at[1] - at[0]) * k.x, bottom = at[side] + (at[side + 1] - at[side]) * k.x;
    return top + (bottom - top) * k.y;
}

// The light that casts the shadow; null where there is none.
const Light* keyLight(const View& view)
{
    const auto found = std::find_if(view.lights.begin(), view.lights.end(),
                                    [](const Light& light) { return light.kind == LightKind::directional; });
    return view.shadows && found != view.lights.end() ? &*found : nullptr;
}

float skyLight(const View& view)
{
    const glm::vec3 up(0, 1, 0);
    return !view.environment  ? 0
        : view.environmentMap ? luminance(irradianceAlong(*view.environmentMap, up))
                              : luminance(f32::cotan_environment(up, 1));
}

// 0 at the edge of the map, 1 from a twentieth of it inwards: nothing ends there that is not over.
float inside(glm::vec2 uv)
{
    const float edge = std::min(std::min(uv.x, uv.y), std::min(1 - uv.x, 1 - uv.y));
    return f32::cotan_smooth(0, 0.05f, edge);
}

// The darkening of the sky has no end of its own. This is its weight: 1 under what stands, and falling from there on,
// equally to all sides and without an edge, to 0 at the distance `around`. Half of it is left at half the distance.
float weightOfSky(const Columns& upright, float around, glm::vec2 place)
{
    const glm::vec2 middle = upright.low + upright.extent * 0.5f;
    const glm::vec2 beside = glm::max(glm::abs(place - middle) - upright.extent * 0.5f, 0.0f);
    const float part = std::min(glm::length(beside) / around, 1.0f);
    return 1 - part * part * part * (10 - part * (15 - 6 * part)); // without a bend at either end (K. Perlin, 2002)
}

float asHalf(float x) { return glm::unpackHalf1x16(glm::packHalf1x16(x)); }

} // namespace

std::optional<GroundMap> makeGround(const Scene& scene, const View& view, const GroundOptions& options)
{
    const Bounds box = bounds(scene);
    if (box.empty())
        return std::nullopt;
    const double plane = options.height ? *options.height : box.low.y;
    const Light* key = keyLight(view);
    const glm::vec3 toLight = key ? f32::cotan_normalize_or(-key->direction, glm::vec3(0, 1, 0)) : glm::vec3(0, 1, 0);
    const bool lit = key && toLight.y > kLowest;
    const float fromLight = lit ? luminance(key->color) * key->intensity * toLight.y / std::numbers::pi_v<float> : 0;
    const float fromSky = skyLight(view);
    if (!(fromLight + fromSky > 0))
        return std::nullopt;

    const Columns upright = makeColumns(scene, plane, glm::vec2(0), kColumns);
    Rectangle rectangle{upright.low, upright.low + upright.extent};
    // What stands higher than wide darkens the sky of hardly more than its width around it.
    const float width = std::max(upright.extent.x, upright.extent.y);
    const float around = std::max(0.1f * width, std::min(upright.top, width)) * kAround;
    rectangle.low -= around;
    rectangle.high += around;
    std::vector<float> light;
    if (lit) {
        const Columns along = makeColumns(scene, plane, glm::vec2(toLight.x, toLight.z) / toLight.y, kColumns);
        const float blur = view.shadowSoftness * along.top / (toLight.y * toLight.y);
        rectangle.hold(along.low - blur, along.low + along.extent + blur);
        const glm::vec2 margin = (rectangle.high - rectangle.low) * 0.08f;
        rectangle.hold(along.low - blur - margin, along.low + along.extent + blur + margin);
        light = passing(along, raysToLight(toLight, view.shadowSoftness), rectangle, kLightPlaces);
    }
    const std::vector<float> sky = passing(upright, raysToSky(), rectangle, kSkyPlaces);

    GroundMap map;
    map.height = float(plane);
    map.low = rectangle.low;
    map.extent = rectangle.high - rectangle.low;
    map.shares = makeImage(kLightPlaces, kLightPlaces, PixelType::float32, "ground");
    for (int z = 0; z < kLightPlaces; ++z)
        for (int x = 0; x < kLightPlaces; ++x) {
            const std::size_t at = std::size_t(z) * kLightPlaces + std::size_t(x);
            const glm::vec2 uv = glm::vec2(float(x) + 0.5f, float(z) + 0.5f) / float(kLightPlaces);
            const float weight = weightOfSky(upright, around, rectangle.place(x, z, kLightPlaces));
            const float seen = glm::mix(1.0f, between(sky, kSkyPlaces, uv), weight);
            const float arriving = fromSky * seen + (lit ? fromLight * light[at] : 0);
            const float share = glm::mix(1.0f, arriving / (fromLight + fromSky), inside(uv));
            float* texel = map.shares.floats() + 4 * at;
            texel[0] = texel[1] = texel[2] = asHalf(share);
            texel[3] = 1;
        }
    return map;
}

} // namespace cotan
