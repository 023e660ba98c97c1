// The shadow on the ground, by what stands above a level plane as columns: from where to where each is filled.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "core/loops.hpp"
#include "cotan/view.hpp"
#include "scene/environment_map.hpp"
#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

// ---- columns ---------------------------------------------------------------------------------

constexpr float kOpaque = 0.996f; // 254 of 255

// A grid of columns over the plane. A point at height h above the plane stands in the column at (x, z) - h * lean: with
// the direction of a light as lean, a column holds what shades one place. Between its lowest and its highest point a
// column counts as full.
struct Columns {
    // Heights above the plane; from > to where nothing stands.
    struct Span {
        float from = std::numeric_limits<float>::infinity(), to = -from;

        void hold(float height)
        {
            from = std::min(from, height);
            to = std::max(to, height);
        }
        bool meets(float lowest, float highest) const { return from <= highest && to > lowest; }
    };

    // What is translucent in a column, which counts as full in the same way.
    struct Veil {
        Span span;
        std::array<float, 4> stops{}; // the share of light, of each layer of cotan_shadow_threshold
    };

    int side = 0; // columns along x and along z
    glm::vec2 lean{0};
    glm::vec2 low{0}, extent{0}; // of the grid, in x and z
    float top = 0;               // of the highest column, above the plane
    std::vector<Span> spans;     // rows along x first
    std::vector<Veil> veils;     // likewise; empty where nothing is translucent

    // The share of a ray's light that does not arrive. The ray leaves the plane at `place` and moves sideways by
    // `speed` as it rises by 1, the columns' lean not counted. Of the veils of one layer that it meets the densest
    // counts: they are mostly one surface.
    float stopped(glm::vec2 place, glm::vec2 speed) const
    {
        const glm::vec2 start = (place - low) / extent * float(side), pace = speed / extent * float(side);
        // Heights between which the ray is above the grid.
        float first = 0, last = top;
        for (int i = 0; i < 2; ++i) {
            if (std::abs(pace[i]) < 1e-20f) {
                if (start[i] < 0 || start[i] >= float(side))
                    return 0;
                continue;
            }
            const float in = -start[i] / pace[i], out = (float(side) - start[i]) / pace[i];
            first = std::max(first, std::min(in, out));
            last = std::min(last, std::max(in, out));
        }
        const float fastest = std::max(std::abs(pace.x), std::abs(pace.y));
        const float column = fastest > 0 ? 1 / fastest : top; // height gained within one column
        glm::vec4 met(0);                                     // the densest veil of each layer
        // Each step is at least a sixteenth of the height: they end.
        for (float height = first, next; height < last; height = next) {
            // Steps grow with the way from the start, as what is met there spreads over a wider part of the sky.
            next = std::min(height + std::max(column, 0.0625f * height), last);
            const glm::vec2 at = start + pace * (0.5f * (height + next));
            const int x = std::clamp(int(at.x), 0, side - 1), z = std::clamp(int(at.y), 0, side - 1);
            const std::size_t i = std::size_t(z) * std::size_t(side) + std::size_t(x);
            if (spans[i].meets(height, next))
                return 1;
            if (!veils.empty() && veils[i].span.meets(height, next))
                met = glm::max(met, glm::make_vec4(veils[i].stops.data()));
        }
        met = 1.0f - met;
        return 1 - met.x * met.y * met.z * met.w;
    }
};

// A vertex: its place in the grid, in columns, and its height above the plane.
struct Standing {
    glm::vec2 place{0};
    float height = 0;
};

// Where a point stands along the lean, in x and z, and its height above the plane.
glm::dvec3 standing(const glm::mat4& toWorld, const glm::vec3& p, double plane, glm::vec2 lean)
{
    const glm::dvec3 world(glm::dmat4(toWorld) * glm::dvec4(glm::dvec3(p), 1));
    const double height = world.y - plane;
    return {glm::dvec2(world.x, world.z) - height * glm::dvec2(lean), height};
}

class Filling {
public:
    Filling(const Scene& scene, double plane, Columns& columns) : scene_(scene), plane_(plane), columns_(columns) {}

    // odd: its veils are told from those of other things.
    void add(const Instance& instance, const Mesh& mesh, bool odd)
    {
        vertices_.clear();
        for (const glm::vec3& p : mesh.positions) {
            const glm::dvec3 at = standing(instance.toWorld, p, plane_, columns_.lean);
            const glm::dvec2 place =
                (glm::dvec2(at) - glm::dvec2(columns_.low)) / glm::dvec2(columns_.extent) * double(columns_.side);
            vertices_.push_back({glm::vec2(place), float(at.z)});
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const std::array<std::uint32_t, 3> corners{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
            if (std::max({corners[0], corners[1], corners[2]}) < vertices_.size())
                fillTriangle(mesh, corners, odd);
        }
    }

private:
    float alphaAt(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, glm::vec3 weights) const
    {
        const Material& material = scene_.materials[std::size_t(mesh.material)];
        float alpha = material.baseColor.w;
        const auto mixed = [&](const auto& values) {
            return values[corners[0]] * weights.x + values[corners[1]] * weights.y + values[corners[2]] * weights.z;
        };
        if (!mesh.colors.empty())
            alpha *= mixed(mesh.colors).w;
        const Texture& map = material.baseColorMap;
        const auto& texcoords = mesh.texcoords[uvSetOf(map)];
        if (map.present() && std::size_t(map.image) < scene_.images.size() && !texcoords.empty()) {
            const Image& image = scene_.images[std::size_t(map.image)];
            const glm::vec2 uv = textureUv(map, mixed(texcoords));
            if (hasPixels(image) && std::abs(uv.x) + std::abs(uv.y) < kFarthestUv)
                alpha *= nearestTexel(image.width, image.height, map.sampler, glm::dvec2(uv), [&](int x, int y) {
                             return storedComponents(image, x, y);
                         }).w;
        }
        return alpha;
    }

    void fillTriangle(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, bool odd)
    {
        const Material& material = scene_.materials[std::size_t(mesh.material)];
        const Standing a = vertices_[corners[0]], b = vertices_[corners[1]], c = vertices_[corners[2]];
        const glm::vec2 low = glm::min(glm::min(a.place, b.place), c.place) - 0.5f;
        const glm::vec2 high = glm::max(glm::max(a.place, b.place), c.place) + 0.5f;
        const float most = float(columns_.side);
        const float lowest = std::min({a.height, b.height, c.height}),
                    highest = std::max({a.height, b.height, c.height});
        if (!(low.x < most && low.y < most && high.x > 0 && high.y > 0 && highest <= columns_.top))
            return;
        const glm::vec2 ab = b.place - a.place, ac = c.place - a.place, bc = c.place - b.place;
        const float area = ab.x * ac.y - ab.y * ac.x;
        // What a column's square touches counts, so that nothing is too thin: weights may be negative by so much.
        const float per = std::abs(area) > 1e-9f ? -0.5f / std::abs(area) : -1e9f;
        const float minU = per * (std::abs(bc.x) + std::abs(bc.y)), minV = per * (std::abs(ac.x) + std::abs(ac.y));
        const float minW = per * (std::abs(ab.x) + std::abs(ab.y));
        const float inverse = std::abs(area) > 1e-9f ? 1 / area : 0;
        const glm::ivec2 first = glm::max(glm::ivec2(glm::ceil(low - 0.5f)), 0);
        const glm::ivec2 last = glm::min(glm::ivec2(glm::floor(high - 0.5f)), columns_.side - 1);
        for (int z = first.y; z <= last.y; ++z)
            for (int x = first.x; x <= last.x; ++x) {
                const glm::vec2 p = glm::vec2(float(x) + 0.5f, float(z) + 0.5f) - a.place;
                const float v = (p.x * ac.y - p.y * ac.x) * inverse, w = (ab.x * p.y - ab.y * p.x) * inverse,
                            u = 1 - v - w;
                if (u < minU || v < minV || w < minW)
                    continue;
                const auto inside = [](glm::vec3 weights) {
                    weights = glm::max(weights, 0.0f);
                    return weights / (weights.x + weights.y + weights.z);
                };
                const glm::vec3 middle = inside(glm::vec3(u, v, w));
                const float height =
                    std::clamp(glm::dot(middle, glm::vec3(a.height, b.height, c.height)), lowest, highest);
                if (material.alphaMode == AlphaMode::mask && !(alphaAt(mesh, corners, middle) >= material.alphaCutoff))
                    continue;
                float stops = material.alphaMode == AlphaMode::blend ? 0 : 1;
                for (int k = 0; k < 4 && material.alphaMode == AlphaMode::blend; ++k) {
                    const glm::vec2 q = p + glm::vec2(k & 1 ? 0.25f : -0.25f, k & 2 ? 0.25f : -0.25f);
                    const float qv = (q.x * ac.y - q.y * ac.x) * inverse, qw = (ab.x * q.y - ab.y * q.x) * inverse;
                    stops += 0.25f * std::clamp(alphaAt(mesh, corners, inside({1 - qv - qw, qv, qw})), 0.0f, 1.0f);
                }
                const std::size_t at = std::size_t(z) * std::size_t(columns_.side) + std::size_t(x);
                if (stops > kOpaque) {
                    columns_.spans[at].hold(height);
                } else if (stops > 0) {
                    columns_.veils.resize(columns_.spans.size());
                    columns_.veils[at].span.hold(height);
                    float& layer = columns_.veils[at].stops[(area > 0 ? 0 : 1) + (odd ? 2 : 0)];
                    layer = std::max(layer, stops);
                }
            }
    }

    const Scene& scene_;
    double plane_;
    Columns& columns_;
    std::vector<Standing> vertices_;
};

// The rectangle of the grid: what all points need, and never empty.
void setExtent(const Scene& scene, double plane, Columns& columns)
{
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
        const glm::dvec3 at = standing(toWorld, point, plane, columns.lean);
        if (!std::isfinite(at.x + at.y + at.z))
            return;
        low = glm::min(low, glm::dvec2(at));
        high = glm::max(high, glm::dvec2(at));
        columns.top = std::max(columns.top, float(at.z));
    });
    if (!(low.x <= high.x))
        low = high = glm::dvec2(0);
    const double margin = std::max({high.x - low.x, high.y - low.y, 1e-6 * glm::length(low), 1e-30}) / columns.side;
    columns.low = glm::vec2(low - margin);
    columns.extent = glm::vec2(high - low + 2 * margin);
}

// The columns of all that throws shadows. Masked materials count where their mask leaves them, blended ones as veils by
// their alpha, read at four places of a column. plane: y.
Columns makeColumns(const Scene& scene, double plane, glm::vec2 lean, int side)
{
    Columns columns;
    columns.side = side;
    columns.lean = lean;
    setExtent(scene, plane, columns);
    columns.spans.resize(std::size_t(side) * std::size_t(side));
    Filling filling(scene, plane, columns);
    bool odd = false; // of what is translucent
    for (const Instance& instance : scene.instances) {
        const Mesh* mesh = meshPlacedBy(scene, instance);
        if (!mesh)
            continue;
        const Material& material = scene.materials[std::size_t(mesh->material)];
        if (material.throwsShadow())
            filling.add(instance, *mesh, odd);
        odd = odd != material.translucent();
    }
    return columns;
}

// ---- the map ---------------------------------------------------------------------------------

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
    const Light* key = view.shadows ? shadowLight(view) : nullptr;
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
