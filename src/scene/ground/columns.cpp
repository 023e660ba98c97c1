#include "columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::ground {

namespace {

constexpr float kOpaque = 0.996f; // 254 of 255

// A vertex: its place in the grid, in columns, and its height above the plane.
struct Standing {
    glm::vec2 place{0};
    float height = 0;
};

class Filling {
public:
    Filling(const Scene& scene, double plane, Columns& columns) : scene_(scene), plane_(plane), columns_(columns) {}

    // odd: its veils are told from those of other things.
    void add(const Instance& instance, const Mesh& mesh, bool odd);

private:
    void fillTriangle(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, bool odd);
    float alphaAt(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, glm::vec3 weights) const;

    const Scene& scene_;
    double plane_;
    Columns& columns_;
    std::vector<Standing> vertices_;
};

// Where a point stands along the lean, in x and z, and its height above the plane.
glm::dvec3 standing(const glm::mat4& toWorld, const glm::vec3& p, double plane, glm::vec2 lean)
{
    const glm::dvec3 world(glm::dmat4(toWorld) * glm::dvec4(glm::dvec3(p), 1));
    const double height = world.y - plane;
    return {glm::dvec2(world.x, world.z) - height * glm::dvec2(lean), height};
}

float Filling::alphaAt(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, glm::vec3 weights) const
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

void Filling::fillTriangle(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners, bool odd)
{
    const Material& material = scene_.materials[std::size_t(mesh.material)];
    const Standing a = vertices_[corners[0]], b = vertices_[corners[1]], c = vertices_[corners[2]];
    const glm::vec2 low = glm::min(glm::min(a.place, b.place), c.place) - 0.5f;
    const glm::vec2 high = glm::max(glm::max(a.place, b.place), c.place) + 0.5f;
    const float most = float(columns_.side);
    const float lowest = std::min({a.height, b.height, c.height}), highest = std::max({a.height, b.height, c.height});
    if (!(low.x < most && low.y < most && high.x > 0 && high.y > 0 && highest <= columns_.top))
        return;
    const glm::vec2 ab = b.place - a.place, ac = c.place - a.place, bc = c.place - b.place;
    const float area = ab.x * ac.y - ab.y * ac.x;
    // What a column's square touches counts, so that nothing is too thin: weights may be negative by so much.
    const float per = std::abs(area) > 1e-9f ? -0.5f / std::abs(area) : -1e9f;
    const float minU = per * (std::abs(bc.x) + std::abs(bc.y)), minV = per * (std::abs(ac.x) + std::abs(ac.y));
    const float minW = per * (std::abs(ab.x) + std::abs(ab.y));
    const float inverse = std::abs(area) > 1e-9f ? 1 / area : 0;
    const int x0 = std::max(int(std::ceil(low.x - 0.5f)), 0),
              x1 = std::min(int(std::floor(high.x - 0.5f)), columns_.side - 1);
    const int z0 = std::max(int(std::ceil(low.y - 0.5f)), 0),
              z1 = std::min(int(std::floor(high.y - 0.5f)), columns_.side - 1);
    for (int z = z0; z <= z1; ++z)
        for (int x = x0; x <= x1; ++x) {
            const glm::vec2 p = glm::vec2(float(x) + 0.5f, float(z) + 0.5f) - a.place;
            const float v = (p.x * ac.y - p.y * ac.x) * inverse, w = (ab.x * p.y - ab.y * p.x) * inverse, u = 1 - v - w;
            if (u < minU || v < minV || w < minW)
                continue;
            const auto inside = [](glm::vec3 weights) {
                weights = glm::max(weights, 0.0f);
                return weights / (weights.x + weights.y + weights.z);
            };
            const glm::vec3 middle = inside(glm::vec3(u, v, w));
            const float height = std::clamp(glm::dot(middle, glm::vec3(a.height, b.height, c.height)), lowest, highest);
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

void Filling::add(const Instance& instance, const Mesh& mesh, bool odd)
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

} // namespace

float Columns::stopped(glm::vec2 place, glm::vec2 speed) const
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

} // namespace cotan::ground
