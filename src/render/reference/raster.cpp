#include "raster.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"

namespace cotan::reference {

namespace {

// The point where an edge crosses the plane. It is always computed from the inside to the outside, so that triangles
// that share the edge get the same point.
glm::dvec4 crossing(glm::dvec4 inside, double insideDistance, glm::dvec4 outside, double outsideDistance)
{
    double k = insideDistance / (insideDistance - outsideDistance);
    return inside + (outside - inside) * k;
}

Polygon cut(const Polygon& polygon, glm::dvec4 plane)
{
    Polygon result;
    const auto add = [&](glm::dvec4 corner) {
        if (result.count < int(result.corner.size())) // full only if rounding made it concave, by less than a sub-pixel
            result.corner[std::size_t(result.count++)] = corner;
    };
    for (int i = 0; i < polygon.count; ++i) {
        glm::dvec4 a = polygon.corner[std::size_t(i)];
        glm::dvec4 b = polygon.corner[std::size_t((i + 1) % polygon.count)];
        double da = glm::dot(plane, a), db = glm::dot(plane, b);
        if (da >= 0)
            add(a);
        if (da >= 0 && db < 0)
            add(crossing(a, da, b, db));
        if (da < 0 && db >= 0)
            add(crossing(b, db, a, da));
    }
    return result;
}

} // namespace

Polygon clip(const std::array<glm::dvec4, 3>& triangle, int width, int height)
{
    Polygon polygon;
    for (const glm::dvec4& v : triangle) {
        if (!isFinite(v))
            return {};
        polygon.corner[std::size_t(polygon.count++)] = v;
    }
    const std::array<glm::dvec4, 5> planes = {{
        {0, 0, -1, 1},
        {1, 0, 0, kGuardBand},
        {-1, 0, 0, width + kGuardBand},
        {0, 1, 0, kGuardBand},
        {0, -1, 0, height + kGuardBand},
    }};
    for (const glm::dvec4& plane : planes) {
        const auto inside = [&](const glm::dvec4& corner) { return glm::dot(plane, corner) >= 0; };
        if (!std::all_of(polygon.corner.begin(), polygon.corner.begin() + polygon.count, inside))
            polygon = cut(polygon, plane);
    }
    return polygon;
}

std::array<Edge, 3> edgesOf(const RasterTriangle& triangle)
{
    std::array<Edge, 3> edges;
    for (std::size_t i = 0; i < 3; ++i) {
        glm::ivec2 a = triangle.corner[i], b = triangle.corner[(i + 1) % 3];
        std::int64_t dx = b.x - a.x, dy = b.y - a.y;
        bool top = dy == 0 && dx > 0, left = dy < 0;
        edges[i] = {-dy, dx, dy * a.x - dx * a.y - (top || left ? 0 : 1)};
    }
    return edges;
}

Rectangle boundsOf(const RasterTriangle& triangle, Rectangle area)
{
    const auto& c = triangle.corner;
    auto [lowX, highX] = std::minmax({c[0].x, c[1].x, c[2].x});
    auto [lowY, highY] = std::minmax({c[0].y, c[1].y, c[2].y});
    // An arithmetic shift rounds down, for negative coordinates too.
    return {std::max(area.x0, lowX >> 8), std::max(area.y0, lowY >> 8), std::min(area.x1, (highX >> 8) + 1),
            std::min(area.y1, (highY >> 8) + 1)};
}

bool mayCover(const std::array<Edge, 3>& edges, Rectangle area)
{
    return std::all_of(edges.begin(), edges.end(), [&](const Edge& e) {
        // The corner of the area farthest inside the edge.
        const std::int64_t x = e.x > 0 ? area.x1 : area.x0, y = e.y > 0 ? area.y1 : area.y0;
        return e.at(x * kSubPixels, y * kSubPixels) >= 0;
    });
}

Rectangle narrowed(const std::array<Edge, 3>& edges, Rectangle bounds, int y)
{
    const std::int64_t top = std::int64_t(y) * kSubPixels, bottom = top + 2 * kSubPixels;
    for (const Edge& e : edges) {
        // At most, in these rows, the edge function is e.x * px + best.
        const std::int64_t best = std::max(e.y * top, e.y * bottom) + e.constant;
        if (e.x == 0) {
            if (best < 0)
                bounds.x1 = bounds.x0;
            continue;
        }
        const std::int64_t crossing = -best / e.x / kSubPixels; // pixels, to within one
        if (e.x > 0)
            bounds.x0 = int(std::clamp<std::int64_t>(crossing - 1, bounds.x0, bounds.x1));
        else
            bounds.x1 = int(std::clamp<std::int64_t>(crossing + 2, bounds.x0, bounds.x1));
    }
    return bounds;
}

unsigned coverage(const std::array<Edge, 3>& edges, int x, int y, const SamplePattern& pattern)
{
    unsigned mask = 0;
    for (int s = 0; s < pattern.count; ++s) {
        std::int64_t px = std::int64_t(x) * kSubPixels + pattern.offset[std::size_t(s)].x;
        std::int64_t py = std::int64_t(y) * kSubPixels + pattern.offset[std::size_t(s)].y;
        bool inside = edges[0].at(px, py) >= 0 && edges[1].at(px, py) >= 0 && edges[2].at(px, py) >= 0;
        mask |= unsigned(inside) << s;
    }
    return mask;
}

Tile::Tile(Rectangle area, const SamplePattern& pattern)
    : area_(area), pattern_(pattern), samples_(std::size_t(pattern.count))
{
    std::size_t count = std::size_t(area.x1 - area.x0) * std::size_t(area.y1 - area.y0) * samples_;
    value_.assign(count, glm::vec4(0));
    reversedDepth_.assign(count, -1.0f);
}

std::size_t Tile::at(int x, int y) const
{
    std::size_t pixel = std::size_t(y - area_.y0) * std::size_t(area_.x1 - area_.x0) + std::size_t(x - area_.x0);
    return pixel * samples_;
}

// Reversed depth at a sample, rounded to float as in a depth buffer, so that coincident surfaces tie and the first one
// drawn stays.
float Tile::reversedDepthAt(const Plane& z, int x, int y, std::size_t sample) const
{
    const glm::ivec2 offset = pattern_.offset[sample];
    return float(z.at(x + offset.x / double(kSubPixels), y + offset.y / double(kSubPixels)));
}

void Tile::announce(int x, int y, unsigned covered, const Plane& z)
{
    if (announced_.empty())
        announced_.assign(reversedDepth_.size(), -1.0f);
    for (std::size_t s = 0; s < samples_; ++s)
        if (covered >> s & 1) {
            float& nearest = announced_[at(x, y) + s];
            nearest = std::max(nearest, reversedDepthAt(z, x, y, s));
        }
}

unsigned Tile::nearer(int x, int y, unsigned covered, const Plane& z) const
{
    const std::size_t first = at(x, y);
    unsigned passed = 0;
    for (std::size_t s = 0; s < samples_; ++s) {
        if (!(covered >> s & 1))
            continue;
        const float depth = reversedDepthAt(z, x, y, s);
        if (depth > reversedDepth_[first + s] && (announced_.empty() || depth >= announced_[first + s]))
            passed |= 1u << s;
    }
    return passed;
}

void Tile::write(int x, int y, unsigned samples, glm::vec4 value, const Plane& z)
{
    ++written_;
    for (std::size_t s = 0; s < samples_; ++s) {
        if (!(samples >> s & 1))
            continue;
        value_[at(x, y) + s] = value;
        reversedDepth_[at(x, y) + s] = reversedDepthAt(z, x, y, s);
    }
}

void Tile::blend(int x, int y, unsigned samples, glm::vec4 value, glm::vec3 transmittance, const Plane& z)
{
    if (layers_.size() == kMaxLayers)
        throw TooManyLayers{};
    if (newest_.empty())
        newest_.assign(value_.size() / samples_, kNone);
    std::uint32_t& newest = newest_[at(x, y) / samples_];
    Layer layer{glm::vec3(value) * value.w, transmittance, {}, samples, newest};
    for (std::size_t s = 0; s < samples_; ++s)
        layer.reversedDepth[s] = reversedDepthAt(z, x, y, s);
    newest = std::uint32_t(layers_.size());
    layers_.push_back(layer);
}

void Tile::clear(int x, int y, glm::vec4 value)
{
    for (std::size_t s = 0; s < samples_; ++s)
        value_[at(x, y) + s] = value;
}

glm::vec4 Tile::resolve(int x, int y) const
{
    glm::vec4 sum(0);
    std::vector<const Layer*> layers;
    for (auto i = newest_.empty() ? kNone : newest_[at(x, y) / samples_]; i != kNone; i = layers_[i].previous)
        layers.push_back(&layers_[i]);
    for (std::size_t s = 0; s < samples_; ++s) {
        // Layers are stored in the order in which they were added, so pointers compare by it.
        std::sort(layers.begin(), layers.end(), [&](const Layer* a, const Layer* b) {
            return a->reversedDepth[s] != b->reversedDepth[s] ? a->reversedDepth[s] < b->reversedDepth[s] : a < b;
        });
        glm::vec3 light(value_[at(x, y) + s]), transmittance(1);
        for (const Layer* layer : layers) // far to near
            if (layer->samples >> s & 1) {
                light = layer->light + light * layer->transmittance;
                transmittance *= layer->transmittance;
            }
        // Alpha has a single channel: the transmittance is averaged over the colours.
        const float meanTransmittance = (transmittance.x + transmittance.y + transmittance.z) / 3;
        sum += glm::vec4(light, 1 - meanTransmittance * (1 - value_[at(x, y) + s].w));
    }
    return sum / float(samples_);
}

} // namespace cotan::reference
