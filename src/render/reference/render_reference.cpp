#include "cotan/render.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "core/loops.hpp"
#include "pixel.hpp"
#include "scene/geometry.hpp"
#include "scene/sample_places.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace {

using namespace reference;

constexpr int kLargestSide = 16384;

// Everything that is known before the first pixel is drawn.
struct Frozen : PixelInputs {
    TextureLibrary textures;
    std::vector<Draw> draws;
    TiledTriangles tiled;
};

Frozen prepare(const Scene& scene, const View& view)
{
    Frozen f{{view, {}, {}, {}}, {}, {}, {}};
    Ball ball = boundingBall(scene);
    f.projection = cameraProjection(view, ball);
    f.textures = makeTextures(scene, view);
    f.draws = makeDraws(scene, f.textures, f.projection.eye, view.frame, view.output == Output::shaded);
    f.lights = prepareLights(view, f.projection.eye);
    const auto caster = std::ranges::find(f.lights, true, &PreparedLight::castsShadow);
    if (view.output == Output::shaded && caster != f.lights.end())
        f.shadow = makeShadowMap(view, f.draws, -caster->toLight, ball, f.projection.eye);
    f.tiled = setUpTriangles(f.draws, f.projection, Cull::backFaces);
    return f;
}

// How often the pixels of a tile are written, in the mean, before it is worth looking at what comes.
constexpr std::size_t kOftenWritten = 4;

// Draws one quad of one triangle into the tile.
void drawQuad(const Frozen& f, const RasterTriangle& triangle, const Quad& quad, const SamplePattern& pattern,
              Tile& tile)
{
    const Draw& draw = f.draws[triangle.draw];
    const Material& material = *draw.material;
    SurfaceInputs in{&f.view, &draw, &triangle};
    bool blended = material.translucent() && f.view.output == Output::shaded;
    std::optional<QuadPoints> points; // made when the first pixel passes the depth test
    std::array<float, 4> alphas{};    // of a masked material
    for (int lane = 0; lane < 4; ++lane) {
        int x = quad.x + (lane & 1), y = quad.y + (lane >> 1);
        unsigned samples = tile.nearer(x, y, quad.covered[std::size_t(lane)], triangle.z);
        if (!samples)
            continue;
        const bool masked = material.alphaMode == AlphaMode::mask;
        if (!points) {
            in.points = &points.emplace(interpolate(draw, triangle, quad.x, quad.y));
            for (int k = 0; masked && k < 4; ++k)
                alphas[std::size_t(k)] = baseColorOf(in, k).w;
        }
        if (masked)
            samples &= samplesOfMask(alphas, lane, material.alphaCutoff, pattern);
        if (!samples)
            continue;
        const std::optional<Fragment> fragment = shade(f, in, lane);
        if (!fragment)
            continue;
        if (blended)
            tile.blend(x, y, samples, fragment->value, fragment->through, triangle.z);
        else
            tile.write(x, y, samples, fragment->value, triangle.z);
    }
}

// Tells the tile of the triangles that hide what is behind them, whatever is shaded there.
void expectOpaque(const Frozen& f, std::span<const std::uint32_t> triangles, const Rectangle& area,
                  const SamplePattern& pattern, Tile& tile)
{
    for (const std::uint32_t t : triangles) {
        const RasterTriangle& triangle = f.tiled.triangles[t];
        const Material& material = *f.draws[triangle.draw].material;
        if (material.alphaMode != AlphaMode::opaque || material.translucent())
            continue;
        forEachQuad(triangle, area, pattern, [&](const Quad& quad) {
            for (int lane = 0; lane < 4; ++lane)
                tile.expect(quad.x + (lane & 1), quad.y + (lane >> 1), quad.covered[std::size_t(lane)], triangle.z);
        });
    }
}

// Samples that are lit one by one are drawn as pictures of one sample.
bool oneByOne(const View& view) { return view.output == Output::shaded && view.samples > kMaxSharedSamples; }

// Calls store(x, y, value) for the pixels of a tile, x and y in the upright picture.
template<class Store> void drawTile(const Frozen& f, std::size_t index, const Store& store)
{
    const View& view = f.view;
    SamplePattern pattern = samplePattern(view.output == Output::shaded && !oneByOne(view) ? view.samples : 1);
    Rectangle area = f.tiled.area(index, view.width, view.height);
    Tile tile(area, pattern);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            tile.clear(x, y, background(f, x, y));
    const std::vector<std::uint32_t>& triangles = f.tiled.tiles[index];
    const std::size_t often = kOftenWritten * std::size_t(area.x1 - area.x0) * std::size_t(area.y1 - area.y0);
    bool expects = false;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (!expects && tile.written() > often) { // what is hidden is shaded no more
            expectOpaque(f, std::span(triangles).subspan(i), area, pattern, tile);
            expects = true;
        }
        const RasterTriangle& triangle = f.tiled.triangles[triangles[i]];
        forEachQuad(triangle, area, pattern, [&](const Quad& quad) { drawQuad(f, triangle, quad, pattern, tile); });
    }
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            store(x, view.rowsUpward ? view.height - 1 - y : y, tile.resolve(x, y));
}

// Draws all tiles; false where it was stopped.
template<class Store> bool drawTiles(const Frozen& frozen, CountedSteps& done, const Store& store)
{
    parallelFor(std::size_t(0), frozen.tiled.tiles.size(), [&](std::size_t index) {
        if (done.stopped())
            return;
        drawTile(frozen, index, store);
        done.step();
    });
    return !done.stopped();
}

Result<Image> draw(const Scene& scene, const View& view, const Progress& progress)
{
    bool bytes = view.output == Output::shaded && !view.linearOutput;
    Image picture = makeImage(view.width, view.height, bytes ? PixelType::unorm8 : PixelType::float32, scene.name);
    Frozen frozen = prepare(scene, view);
    const std::size_t tiles = frozen.tiled.tiles.size();
    const auto store = [&](int x, int y, glm::vec4 value) { storePixel(picture, x, y, value, view.dither); };
    if (!oneByOne(view)) {
        CountedSteps done(progress, tiles);
        return drawTiles(frozen, done, store) ? Result<Image>(std::move(picture)) : stoppedError();
    }
    std::vector<glm::vec4> sums(picture.pixelCount(), glm::vec4(0));
    CountedSteps done(progress, tiles * kPlaces);
    const Projection still = frozen.projection;
    for (int sample = 0; sample < kPlaces; ++sample) {
        frozen.projection = movedBy(still, samplePlace(sample));
        frozen.tiled = setUpTriangles(frozen.draws, frozen.projection, Cull::backFaces);
        const bool drawn = drawTiles(frozen, done, [&](int x, int y, glm::vec4 value) {
            sums[std::size_t(y) * std::size_t(view.width) + std::size_t(x)] += value;
        });
        if (!drawn)
            return stoppedError();
    }
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            store(x, y, sums[std::size_t(y) * std::size_t(view.width) + std::size_t(x)] / float(kPlaces));
    return picture;
}

Status checkSize(const View& view)
{
    if (std::min(view.width, view.height) < 1 || std::max(view.width, view.height) > kLargestSide)
        return usageError("picture size: expected 1 to 16384 pixels a side, found " + std::to_string(view.width) + "x"
                          + std::to_string(view.height));
    return Done{};
}

} // namespace

Result<Image> renderReference(const Scene& scene, const View& view, int threads, const Progress& progress)
{
    for (const Status& ok : {checkSize(view), checkView(view), checkTrianglesDrawn(scene)})
        if (!ok)
            return ok.error();
    if (Status has = checkVertexAttributes(scene, view.frame); !has) // only now the frame is known to be one
        return has.error();
    try {
        return withThreads(threads, [&] { return draw(scene, view, progress); });
    } catch (const TooManyLayers&) {
        return unavailableError("reference renderer: more than " + std::to_string(kMaxLayers)
                                + " translucent fragments in a tile of 32x32 pixels");
    } catch (const std::bad_alloc&) {
        return unavailableError("reference renderer: not enough memory for this scene and size");
    }
}

} // namespace cotan
