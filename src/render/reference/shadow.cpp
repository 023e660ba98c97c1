#include "pixel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "scene/environment_map.hpp"

namespace cotan::reference {

namespace {

constexpr int kShadowTexels = 2048;
constexpr std::size_t kBlockedTileTriangles = 64; // triangles above which a tile is drawn in blocks
constexpr int kBlock = 8;                         // texels: side of a block
constexpr int kTrianglesPerSearch = 8;            // triangles drawn between searches for a block's farthest texel

// Maximum reversed depth of the triangle's plane in the area.
double nearestIn(const Plane& z, Rectangle area)
{
    return z.at(z.x > 0 ? area.x1 : area.x0, z.y > 0 ? area.y1 : area.y0);
}

struct ShadowPass {
    const View& view;
    const std::vector<Draw>& draws;
    ShadowMap& map;
    std::size_t firstTranslucent; // index in draws
    const TiledTriangles& tiled;

    // The pattern of cotan_shadow_threshold for a translucent surface: it differs between front and back of an object,
    // and between consecutive objects.
    std::uint32_t layerOf(const RasterTriangle& triangle) const
    {
        return (triangle.front ? 0u : 1u) + 2 * (std::uint32_t(triangle.draw - firstTranslucent) & 1u);
    }

    void drawQuad(const RasterTriangle& triangle, const Quad& quad) const
    {
        const Draw& draw = draws[triangle.draw];
        const Material& material = *draw.material;
        const bool masked = material.alphaMode == AlphaMode::mask, blended = material.alphaMode == AlphaMode::blend;
        QuadPoints points;
        if (masked || blended)
            points = interpolate(draw, triangle, quad.x, quad.y);
        for (int lane = 0; lane < 4; ++lane) {
            if (!quad.covered[std::size_t(lane)])
                continue;
            int x = quad.x + (lane & 1), y = quad.y + (lane >> 1);
            float z = float(triangle.z.at(x + 0.5, y + 0.5));
            float& stored = map.reversedDepth[std::size_t(y) * std::size_t(map.size) + std::size_t(x)];
            if (!(z > stored))
                continue;
            const auto alpha = [&] { return baseColorOf({&view, &draw, &triangle, &points}, lane).w; };
            if (masked && alpha() < material.alphaCutoff)
                continue;
            if (blended && !(alpha() > f32::cotan_shadow_threshold(unsigned(x), unsigned(y), layerOf(triangle))))
                continue;
            stored = z;
        }
    }

    void drawTriangle(const RasterTriangle& triangle, Rectangle area) const
    {
        forEachQuad(triangle, area, samplePattern(1), [&](const Quad& quad) { drawQuad(triangle, quad); });
    }

    // Draws triangles into a block from near to far, regardless of their order in the scene. Triangles behind all
    // texels of the block are skipped.
    void drawBlock(std::span<const std::uint32_t> triangles, Rectangle block) const
    {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (const std::uint32_t index : triangles)
            if (mayCover(edgesOf(tiled.triangles[index]), block))
                order.emplace_back(nearestIn(tiled.triangles[index].z, block), index);
        std::sort(order.begin(), order.end(), std::greater<>());
        const auto farthest = [&] {
            float lowest = map.reversedDepth[std::size_t(block.y0) * std::size_t(map.size) + std::size_t(block.x0)];
            for (int y = block.y0; y < block.y1; ++y)
                for (int x = block.x0; x < block.x1; ++x)
                    lowest = std::min(lowest, map.at(x, y));
            return lowest;
        };
        float lowest = 0;
        int drawn = 0;
        for (const auto& [nearest, index] : order) {
            if (!(float(nearest) > lowest))
                return; // nor do the following ones pass
            drawTriangle(tiled.triangles[index], block);
            if (++drawn % kTrianglesPerSearch == 0)
                lowest = farthest();
        }
    }

    void drawTile(std::size_t tile) const
    {
        const Rectangle area = tiled.area(tile, map.size, map.size);
        std::vector<std::uint32_t> casters;
        for (const std::uint32_t index : tiled.tiles[tile])
            if (draws[tiled.triangles[index].draw].material->castsShadow())
                casters.push_back(index);
        if (casters.size() < kBlockedTileTriangles) {
            for (const std::uint32_t index : casters)
                drawTriangle(tiled.triangles[index], area);
            return;
        }
        for (int y = area.y0; y < area.y1; y += kBlock)
            for (int x = area.x0; x < area.x1; x += kBlock)
                drawBlock(casters, {x, y, std::min(x + kBlock, area.x1), std::min(y + kBlock, area.y1)});
    }
};

// Weights of four adjacent texels in the mean of three adjacent bilinear reads.
std::array<float, 4> filterWeights(float fraction) { return {(1 - fraction) / 3, 1.0f / 3, 1.0f / 3, fraction / 3}; }

float hardLightReaching(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight)
{
    float cosine = glm::dot(n, toLight);
    float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    glm::vec3 offsetPosition = position + n * (map.texel * (0.5f + 2.0f * sine));
    glm::dvec4 p = map.projection.toRaster * glm::dvec4(offsetPosition, 1);
    float slope = std::min(sine / std::max(std::abs(cosine), 0.05f), 4.0f);
    float receiver = float(p.z) + map.texel * map.depthUnit * (0.5f + 0.5f * slope);

    float u = float(p.x) - 0.5f, v = float(p.y) - 0.5f;
    if (!(u > 2 && v > 2 && u < float(map.size - 3) && v < float(map.size - 3)))
        return 1;
    int x = int(u), y = int(v);
    std::array<float, 4> kx = filterWeights(u - float(x)), ky = filterWeights(v - float(y));
    float blocked = 0;
    int blockedTexels = 0;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            if (receiver < map.at(x + i - 1, y + j - 1)) {
                blocked += kx[std::size_t(i)] * ky[std::size_t(j)];
                ++blockedTexels;
            }
    // Full light and full shadow are exact, regardless of the rounding of the weights.
    return blockedTexels == 16 ? 0.0f : std::max(0.0f, 1 - blocked);
}

float softLightReaching(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight, float softness)
{
    const float cosine = glm::dot(n, toLight), sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const glm::dvec4 offsetPosition(position + n * (map.texel * (0.5f + 1.5f * sine)), 1);
    const glm::dvec4 p = map.projection.toRaster * offsetPosition;
    const float edge = float(map.size);
    if (!(p.x > 0 && p.y > 0 && p.x < edge && p.y < edge))
        return 1;
    // Lengths are in texels. slope: change of reversed depth per texel in the plane through the point.
    const float nearer = map.texel * map.depthUnit / std::max(cosine, 0.2f);
    const glm::vec2 slope =
        glm::vec2(glm::dot(n, glm::vec3(map.projection.right)), -glm::dot(n, glm::vec3(map.projection.up))) * -nearer;
    const float tangent = std::min(sine / std::max(cosine, 0.2f), 4.0f);
    const float receiver = float(p.z) + map.texel * map.depthUnit * (0.5f + 0.5f * tangent);
    const float penumbraGrowth = softness / (map.depthUnit * map.texel), maxRadius = kMaxPenumbra * edge;
    const glm::vec2 middle(float(p.x), float(p.y));
    const auto visit = [&](glm::vec2 point, const auto& use) {
        const glm::vec2 corner = glm::floor(point - 0.5f), k = point - 0.5f - corner;
        for (int i = 0; i < 4; ++i) {
            const int dx = i & 1, dy = i >> 1;
            const int x = std::clamp(int(corner.x) + dx, 0, map.size - 1);
            const int y = std::clamp(int(corner.y) + dy, 0, map.size - 1);
            use(map.at(x, y), (dx ? k.x : 1 - k.x) * (dy ? k.y : 1 - k.y));
        }
    };

    glm::vec2 direction(1, 0);
    float sum = 0, count = 0;
    const float searchRadius = f32::cotan_penumbra(1 - float(p.z), penumbraGrowth, 2, maxRadius);
    for (int i = 0; i < COTAN_SHADOW_SEARCH; ++i) {
        const glm::vec2 offset = direction * (searchRadius * f32::cotan_tap_radius(i, COTAN_SHADOW_SEARCH));
        visit(middle + offset, [&](float reversedDepth, float) {
            if (reversedDepth > receiver + glm::dot(slope, offset))
                sum += reversedDepth, ++count;
        });
        direction = f32::cotan_next_tap(direction);
    }
    if (count == 0)
        return 1;
    const float radius = f32::cotan_penumbra(sum / count - float(p.z), penumbraGrowth, 1.5f, maxRadius);
    float visible = 0;
    for (int i = 0; i < COTAN_SHADOW_TAPS; ++i) {
        const glm::vec2 offset = direction * (radius * f32::cotan_tap_radius(i, COTAN_SHADOW_TAPS));
        visit(middle + offset, [&](float reversedDepth, float weight) {
            visible += reversedDepth > receiver + glm::dot(slope, offset) ? 0 : weight;
        });
        direction = f32::cotan_next_tap(direction);
    }
    return visible / COTAN_SHADOW_TAPS;
}

} // namespace

ShadowMap makeShadowMap(const View& view, const std::vector<Draw>& draws, glm::vec3 direction, const Ball& ball,
                        glm::dvec3 eye)
{
    ShadowMap map;
    map.size = kShadowTexels;
    map.projection = shadowProjection(glm::dvec3(direction), ball, eye, map.size);
    map.reversedDepth.assign(std::size_t(map.size) * std::size_t(map.size), 0.0f);
    map.texel = float(2 * ball.radius / (map.size - 2));
    map.depthUnit = float(0.5 / (ball.radius * 1.01));
    const TiledTriangles tiled = setUpTriangles(draws, map.projection, Cull::nothing);
    const auto first = std::ranges::find_if(draws, [](const Draw& draw) { return draw.material->translucent(); });
    ShadowPass pass{view, draws, map, std::size_t(first - draws.begin()), tiled};
    parallelFor(std::size_t(0), tiled.tiles.size(), [&](std::size_t tile) { pass.drawTile(tile); });
    return map;
}

float lightVisibility(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight, float softness)
{
    if (map.size == 0)
        return 1;
    return softness > 0 ? softLightReaching(map, position, n, toLight, softness)
                        : hardLightReaching(map, position, n, toLight);
}

} // namespace cotan::reference
