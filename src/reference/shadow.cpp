#include "shadow.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/parallel/loops.hpp"
#include "setup.hpp"
#include "surface.hpp"

namespace cotan::reference {

namespace {

constexpr int kShadowTexels = 2048;

struct ShadowPass {
    const Scene& scene;
    const View& view;
    const std::vector<Draw>& draws;
    const TextureLibrary& textures;
    ShadowMap& map;

    void drawQuad(const RasterTriangle& triangle, const Quad& quad) const;
    void drawTile(const TiledTriangles& tiled, std::size_t tile) const;
};

void ShadowPass::drawQuad(const RasterTriangle& triangle, const Quad& quad) const
{
    const Draw& draw = draws[triangle.draw];
    const Material& material = scene.materials[std::size_t(draw.material)];
    const MaterialMaps& maps = textures.materials[std::size_t(draw.material)];
    bool masked = material.alphaMode == AlphaMode::mask;
    QuadPoints points;
    if (masked)
        points = interpolate(draw, triangle, quad.x, quad.y);
    for (int lane = 0; lane < 4; ++lane) {
        if (!quad.covered[std::size_t(lane)])
            continue;
        int x = quad.x + (lane & 1), y = quad.y + (lane >> 1);
        float z = float(triangle.z.at(x + 0.5, y + 0.5));
        float& stored = map.nearness[std::size_t(y) * std::size_t(map.size) + std::size_t(x)];
        if (!(z > stored))
            continue;
        if (masked && baseColorOf({&view, &draw, &material, &maps, &triangle}, points, lane).w < material.alphaCutoff)
            continue;
        stored = z;
    }
}

void ShadowPass::drawTile(const TiledTriangles& tiled, std::size_t tile) const
{
    Rectangle area = tiled.area(tile, map.size, map.size);
    for (std::uint32_t index : tiled.tiles[tile]) {
        const RasterTriangle& triangle = tiled.triangles[index];
        const Draw& draw = draws[triangle.draw];
        if (scene.materials[std::size_t(draw.material)].translucent())
            continue;
        forEachQuad(triangle, area, samplePattern(1), [&](const Quad& quad) { drawQuad(triangle, quad); });
    }
}

// What four texels in a row weigh when three bilinear reads side by side are averaged.
std::array<float, 4> filterWeights(float fraction) { return {(1 - fraction) / 3, 1.0f / 3, 1.0f / 3, fraction / 3}; }

} // namespace

ShadowMap makeShadowMap(const Scene& scene, const View& view, const std::vector<Draw>& draws,
                        const TextureLibrary& textures, glm::vec3 direction, const Ball& ball, glm::dvec3 origin)
{
    ShadowMap map;
    map.size = kShadowTexels;
    map.projection = shadowProjection(glm::dvec3(direction), ball, origin, map.size);
    map.nearness.assign(std::size_t(map.size) * std::size_t(map.size), 0.0f);
    map.texel = float(2 * ball.radius / (map.size - 2));
    map.depthUnit = float(0.5 / (ball.radius * 1.01));
    TiledTriangles tiled = setUpTriangles(scene, draws, map.projection, Cull::nothing);
    ShadowPass pass{scene, view, draws, textures, map};
    parallelFor(std::size_t(0), tiled.tiles.size(), [&](std::size_t tile) { pass.drawTile(tiled, tile); });
    return map;
}

float lightReaching(const ShadowMap& map, glm::vec3 position, glm::vec3 n, glm::vec3 toLight)
{
    if (map.size == 0)
        return 1;
    float cosine = glm::dot(n, toLight);
    float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    glm::vec3 moved = position + n * (map.texel * (0.5f + 2.0f * sine));
    glm::dvec4 p = map.projection.toRaster * glm::dvec4(moved, 1);
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
    // Full light and full shadow are exact, whatever the weights round to.
    return blockedTexels == 16 ? 0.0f : std::max(0.0f, 1 - blocked);
}

} // namespace cotan::reference
