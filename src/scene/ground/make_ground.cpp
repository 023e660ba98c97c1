// The shadow on the ground. Columns, each filled over one range of heights, approximate the scene above the plane.
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

constexpr float kOpaque = 0.996f; // 254/255; blocked fractions above count as opaque

// A grid of columns over the plane. A point at height h above the plane belongs to the column at (x, z) - h * lean.
// With the light's direction as lean, a column holds everything that shadows one point of the plane. A column counts as
// filled between its lowest and its highest point.
struct Columns {
    // Range of heights above the plane; from > to if empty.
    struct Span {
        float from = std::numeric_limits<float>::infinity(), to = -from;

        void expandTo(float height)
        {
            from = std::min(from, height);
            to = std::max(to, height);
        }
        bool meets(float lowest, float highest) const { return from <= highest && to > lowest; }
    };

    // The translucent content of a column, which also counts as filled over its range.
    struct Veil {
        Span span;
        std::array<float, 4> opacity{}; // fraction of light blocked, per layer of cotan_shadow_threshold
    };

    int side = 0; // columns along x and along z
    glm::vec2 lean{0};
    glm::vec2 low{0}, extent{0}; // of the grid, in x and z
    float top = 0;               // height of the highest column above the plane
    std::vector<Span> spans;     // rows along x first
    std::vector<Veil> veils;     // likewise; empty if nothing is translucent

    // The fraction of a ray's light that is blocked. The ray leaves the plane at `point` and moves sideways by `speed`
    // per unit of height, not counting the columns' lean. Of the veils in one layer along the ray, only the densest
    // counts: they are mostly the same surface.
    float blocked(glm::vec2 point, glm::vec2 speed) const
    {
        const glm::vec2 start = (point - low) / extent * float(side), pace = speed / extent * float(side);
        // Range of heights in which the ray is above the grid.
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
        const float column = fastest > 0 ? 1 / fastest : top; // height gained across one column
        glm::vec4 densest(0);                                 // the densest veil of each layer
        // Each step is at least 1/16 of the height, so the loop ends.
        for (float height = first, next; height < last; height = next) {
            // Steps grow with the distance from the start, where neighbouring rays are further apart.
            next = std::min(height + std::max(column, 0.0625f * height), last);
            const glm::vec2 at = start + pace * (0.5f * (height + next));
            const int x = std::clamp(int(at.x), 0, side - 1), z = std::clamp(int(at.y), 0, side - 1);
            const std::size_t i = std::size_t(z) * std::size_t(side) + std::size_t(x);
            if (spans[i].meets(height, next))
                return 1;
            if (!veils.empty() && veils[i].span.meets(height, next))
                densest = glm::max(densest, glm::make_vec4(veils[i].opacity.data()));
        }
        densest = 1.0f - densest;
        return 1 - densest.x * densest.y * densest.z * densest.w;
    }
};

// A vertex: its grid coordinates, in columns, and its height above the plane.
struct GridVertex {
    glm::vec2 point{0};
    float height = 0;
};

// Projects a world point along the lean onto the plane; returns its x and z there, and its height above the plane.
glm::dvec3 projectedToPlane(const glm::mat4& toWorld, const glm::vec3& p, double plane, glm::vec2 lean)
{
    const glm::dvec3 world(glm::dmat4(toWorld) * glm::dvec4(glm::dvec3(p), 1));
    const double height = world.y - plane;
    return {glm::dvec2(world.x, world.z) - height * glm::dvec2(lean), height};
}

class ColumnFill {
public:
    ColumnFill(const Scene& scene, double plane, Columns& columns) : scene_(scene), plane_(plane), columns_(columns) {}

    // odd: puts the instance's veils into separate layers from those of even ones.
    void add(const Instance& instance, const Mesh& mesh, bool odd)
    {
        vertices_.clear();
        for (const glm::vec3& p : mesh.positions) {
            const glm::dvec3 at = projectedToPlane(instance.toWorld, p, plane_, columns_.lean);
            const glm::dvec2 point =
                (glm::dvec2(at) - glm::dvec2(columns_.low)) / glm::dvec2(columns_.extent) * double(columns_.side);
            vertices_.push_back({glm::vec2(point), float(at.z)});
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
        const GridVertex a = vertices_[corners[0]], b = vertices_[corners[1]], c = vertices_[corners[2]];
        const glm::vec2 low = glm::min(glm::min(a.point, b.point), c.point) - 0.5f;
        const glm::vec2 high = glm::max(glm::max(a.point, b.point), c.point) + 0.5f;
        const float gridSide = float(columns_.side);
        const float lowest = std::min({a.height, b.height, c.height}),
                    highest = std::max({a.height, b.height, c.height});
        if (!(low.x < gridSide && low.y < gridSide && high.x > 0 && high.y > 0 && highest <= columns_.top))
            return;
        const glm::vec2 ab = b.point - a.point, ac = c.point - a.point, bc = c.point - b.point;
        const float area = ab.x * ac.y - ab.y * ac.x;
        // Every column whose square the triangle touches is filled, so that nothing is too thin: barycentric weights
        // may be negative down to these bounds.
        const float per = std::abs(area) > 1e-9f ? -0.5f / std::abs(area) : -1e9f;
        const float minU = per * (std::abs(bc.x) + std::abs(bc.y)), minV = per * (std::abs(ac.x) + std::abs(ac.y));
        const float minW = per * (std::abs(ab.x) + std::abs(ab.y));
        const float inverse = std::abs(area) > 1e-9f ? 1 / area : 0;
        const glm::ivec2 first = glm::max(glm::ivec2(glm::ceil(low - 0.5f)), 0);
        const glm::ivec2 last = glm::min(glm::ivec2(glm::floor(high - 0.5f)), columns_.side - 1);
        for (int z = first.y; z <= last.y; ++z)
            for (int x = first.x; x <= last.x; ++x) {
                const glm::vec2 p = glm::vec2(float(x) + 0.5f, float(z) + 0.5f) - a.point;
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
                float opacity = material.alphaMode == AlphaMode::blend ? 0 : 1;
                for (int k = 0; k < 4 && material.alphaMode == AlphaMode::blend; ++k) {
                    const glm::vec2 q = p + glm::vec2(k & 1 ? 0.25f : -0.25f, k & 2 ? 0.25f : -0.25f);
                    const float qv = (q.x * ac.y - q.y * ac.x) * inverse, qw = (ab.x * q.y - ab.y * q.x) * inverse;
                    opacity += 0.25f * std::clamp(alphaAt(mesh, corners, inside({1 - qv - qw, qv, qw})), 0.0f, 1.0f);
                }
                const std::size_t at = std::size_t(z) * std::size_t(columns_.side) + std::size_t(x);
                if (opacity > kOpaque) {
                    columns_.spans[at].expandTo(height);
                } else if (opacity > 0) {
                    columns_.veils.resize(columns_.spans.size());
                    columns_.veils[at].span.expandTo(height);
                    float& layer = columns_.veils[at].opacity[(area > 0 ? 0 : 1) + (odd ? 2 : 0)];
                    layer = std::max(layer, opacity);
                }
            }
    }

    const Scene& scene_;
    double plane_;
    Columns& columns_;
    std::vector<GridVertex> vertices_;
};

// Sets the rectangle of the grid to contain all projected points; never empty.
void setExtent(const Scene& scene, double plane, Columns& columns)
{
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
        const glm::dvec3 at = projectedToPlane(toWorld, point, plane, columns.lean);
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

// The columns of everything that casts shadows. Masked materials count where the mask keeps them, blended ones as veils
// by their alpha, sampled at four points per column. plane: world y.
Columns makeColumns(const Scene& scene, double plane, glm::vec2 lean, int side)
{
    Columns columns;
    columns.side = side;
    columns.lean = lean;
    setExtent(scene, plane, columns);
    columns.spans.resize(std::size_t(side) * std::size_t(side));
    ColumnFill filling(scene, plane, columns);
    bool odd = false; // alternates between translucent instances
    for (const Instance& instance : scene.instances) {
        const Mesh* mesh = meshPlacedBy(scene, instance);
        if (!mesh)
            continue;
        const Material& material = scene.materials[std::size_t(mesh->material)];
        if (material.castsShadow())
            filling.add(instance, *mesh, odd);
        odd = odd != material.translucent();
    }
    return columns;
}

// ---- the map ---------------------------------------------------------------------------------

constexpr int kColumns = 192;                   // per side
constexpr int kLightSide = 320, kSkySide = 128; // of the map, per side
constexpr int kLightRays = 16 * 24, kSkyRays = 16 * 32;
constexpr float kMinElevationSine = 0.17f; // sine of the light's minimum elevation; below it the shadow is omitted
constexpr float kSkyReach = 1.2f;          // distance up to which the sky is darkened, in heights of the scene
constexpr float kGolden = 2.399963f;

float luminance(glm::vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// The rectangle of the plane that the map covers.
struct Rectangle {
    glm::vec2 low, high;

    void expandTo(glm::vec2 a, glm::vec2 b)
    {
        low = glm::min(low, a);
        high = glm::max(high, b);
    }
    glm::vec2 point(int x, int z, int side) const
    {
        return low + (high - low) * (glm::vec2(float(x) + 0.5f, float(z) + 0.5f) / float(side));
    }
};

// Sideways movement of rays per unit of height.
using Speeds = std::vector<glm::vec2>;

// Rays to a disc around the light's direction. softness: tangent of half the disc's angle.
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

// Rays to the whole sky, cosine-weighted as they light a horizontal plane.
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

// A 4 x 4 box filter, centred: weights 1, 2, 2, 2, 1 along each axis.
void boxFilter(std::vector<float>& visibility, int side)
{
    const auto filterLines = [&](int step, int stride) {
        std::vector<float> line(static_cast<std::size_t>(side));
        for (int i = 0; i < side; ++i) {
            float* at = visibility.data() + std::ptrdiff_t(i) * stride;
            const auto value = [&](int k) { return at[std::ptrdiff_t(std::clamp(k, 0, side - 1)) * step]; };
            for (int k = 0; k < side; ++k)
                line[std::size_t(k)] = (value(k - 2) + value(k + 2) + 2 * (value(k - 1) + value(k) + value(k + 1))) / 8;
            for (int k = 0; k < side; ++k)
                at[std::ptrdiff_t(k) * step] = line[std::size_t(k)];
        }
    };
    filterLines(1, side);
    filterLines(side, 1);
}

// The fraction of rays that are not blocked, at `side` x `side` points of the rectangle, rows along x first. Each of
// 4 x 4 neighbouring points traces a sixteenth of the rays; the box filter combines all of them.
std::vector<float> transmittances(const Columns& columns, const Speeds& speeds, const Rectangle& rectangle, int side)
{
    std::vector<float> visibility(std::size_t(side) * std::size_t(side));
    parallelFor(0, side, [&](int z) {
        for (int x = 0; x < side; ++x) {
            const glm::vec2 point = rectangle.point(x, z, side);
            const std::size_t kind = std::size_t(4 * (z & 3) + (x & 3));
            float blocked = 0;
            for (std::size_t i = kind; i < speeds.size(); i += 16)
                blocked += columns.blocked(point, speeds[i]);
            visibility[std::size_t(z) * std::size_t(side) + std::size_t(x)] = 1 - 16 * blocked / float(speeds.size());
        }
    });
    boxFilter(visibility, side);
    return visibility;
}

// Interpolates a map of another resolution bilinearly.
float interpolated(const std::vector<float>& visibility, int side, glm::vec2 uv)
{
    const glm::vec2 p = glm::clamp(uv * float(side) - 0.5f, 0.0f, float(side) - 1.001f);
    const glm::ivec2 i(p);
    const glm::vec2 k = p - glm::vec2(i);
    const float* at = visibility.data() + std::size_t(i.y) * std::size_t(side) + std::size_t(i.x);
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

// 0 at the edge of the map, rising to 1 over a twentieth of it, so that no shadow is cut off visibly.
float inside(glm::vec2 uv)
{
    const float edge = std::min(std::min(uv.x, uv.y), std::min(1 - uv.x, 1 - uv.y));
    return f32::cotan_smooth(0, 0.05f, edge);
}

// Weight of the sky's darkening, which has no natural end: 1 below the scene, falling smoothly to 0 at the distance
// `around` on all sides, and 1/2 at half that distance.
float weightOfSky(const Columns& upright, float around, glm::vec2 point)
{
    const glm::vec2 middle = upright.low + upright.extent * 0.5f;
    const glm::vec2 beside = glm::max(glm::abs(point - middle) - upright.extent * 0.5f, 0.0f);
    const float t = std::min(glm::length(beside) / around, 1.0f);
    return 1 - t * t * t * (10 - t * (15 - 6 * t)); // second derivative 0 at both ends (K. Perlin, 2002)
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
    const bool lit = key && toLight.y > kMinElevationSine;
    const float fromLight = lit ? luminance(key->color) * key->intensity * toLight.y / std::numbers::pi_v<float> : 0;
    const float fromSky = skyLight(view);
    if (!(fromLight + fromSky > 0))
        return std::nullopt;

    const Columns upright = makeColumns(scene, plane, glm::vec2(0), kColumns);
    Rectangle rectangle{upright.low, upright.low + upright.extent};
    // A scene that is taller than wide darkens the sky only to about its own width around it.
    const float width = std::max(upright.extent.x, upright.extent.y);
    const float around = std::max(0.1f * width, std::min(upright.top, width)) * kSkyReach;
    rectangle.low -= around;
    rectangle.high += around;
    std::vector<float> light;
    if (lit) {
        const Columns along = makeColumns(scene, plane, glm::vec2(toLight.x, toLight.z) / toLight.y, kColumns);
        const float blur = view.shadowSoftness * along.top / (toLight.y * toLight.y);
        rectangle.expandTo(along.low - blur, along.low + along.extent + blur);
        const glm::vec2 margin = (rectangle.high - rectangle.low) * 0.08f;
        rectangle.expandTo(along.low - blur - margin, along.low + along.extent + blur + margin);
        light = transmittances(along, raysToLight(toLight, view.shadowSoftness), rectangle, kLightSide);
    }
    const std::vector<float> sky = transmittances(upright, raysToSky(), rectangle, kSkySide);

    GroundMap map;
    map.height = float(plane);
    map.low = rectangle.low;
    map.extent = rectangle.high - rectangle.low;
    map.visibility = makeImage(kLightSide, kLightSide, PixelType::float32, "ground");
    for (int z = 0; z < kLightSide; ++z)
        for (int x = 0; x < kLightSide; ++x) {
            const std::size_t at = std::size_t(z) * kLightSide + std::size_t(x);
            const glm::vec2 uv = glm::vec2(float(x) + 0.5f, float(z) + 0.5f) / float(kLightSide);
            const float weight = weightOfSky(upright, around, rectangle.point(x, z, kLightSide));
            const float skyVisibility = glm::mix(1.0f, interpolated(sky, kSkySide, uv), weight);
            const float arriving = fromSky * skyVisibility + (lit ? fromLight * light[at] : 0);
            const float fraction = glm::mix(1.0f, arriving / (fromLight + fromSky), inside(uv));
            float* texel = map.visibility.floats() + 4 * at;
            texel[0] = texel[1] = texel[2] = asHalf(fraction);
            texel[3] = 1;
        }
    return map;
}

} // namespace cotan
