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
#include "scene/sample_positions.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace {

using namespace reference;

constexpr int kMaxSide = 16384;

// Everything that is prepared before the first pixel is drawn.
struct Prepared : PixelInputs {
    TextureLibrary textures;
    std::vector<Draw> draws;
    TiledTriangles tiled;
};

Prepared prepare(const Scene& scene, const View& view)
{
    Prepared f{{view, {}, {}, {}}, {}, {}, {}};
    Ball ball = boundingBall(scene);
    f.projection = cameraProjection(view, ball);
    f.textures = makeTextures(scene, view);
    f.draws = makeDraws(scene, f.textures, f.projection.eye, view);
    f.lights = prepareLights(view, f.projection.eye);
    const auto caster = std::ranges::find(f.lights, true, &PreparedLight::castsShadow);
    if (view.output == Output::shaded && caster != f.lights.end())
        f.shadow = makeShadowMap(view, f.draws, -caster->toLight, ball, f.projection.eye);
    f.tiled = setUpTriangles(f.draws, f.projection, Cull::backFaces);
    return f;
}

// Mean number of writes per pixel of a tile after which the remaining opaque triangles are announced to it.
constexpr std::size_t kWritesUntilAnnounced = 4;

// Draws one quad of one triangle into the tile.
void drawQuad(const Prepared& f, const RasterTriangle& triangle, const Quad& quad, const SamplePattern& pattern,
              Tile& tile)
{
    const Draw& draw = f.draws[triangle.draw];
    const Material& material = *draw.material;
    SurfaceInputs in{&f.view, &draw, &triangle};
    bool blended = material.translucent() && f.view.output == Output::shaded;
    std::optional<QuadPoints> points; // set when the first pixel passes the depth test
    std::array<float, 4> alphas{};    // of a masked material
    for (int lane = 0; lane < 4; ++lane) {
        int x = quad.x + (lane & 1), y = quad.y + (lane >> 1);
        unsigned samples = tile.nearer(x, y, quad.covered[std::size_t(lane)], triangle.z);
        if (!samples)
            continue;
        const bool masked = material.alphaMode == AlphaMode::mask;
        if (!points) {
            in.points = &points.emplace(interpolate(draw, triangle, quad.x, quad.y));
            moveToRelief(f.projection, in, *points);
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
            tile.blend(x, y, samples, fragment->value, fragment->transmittance, triangle.z);
        else
            tile.write(x, y, samples, fragment->value, triangle.z);
    }
}

// Announces to the tile the triangles that hide what is behind them.
void announceOpaque(const Prepared& f, std::span<const std::uint32_t> triangles, const Rectangle& area,
                    const SamplePattern& pattern, Tile& tile)
{
    for (const std::uint32_t t : triangles) {
        const RasterTriangle& triangle = f.tiled.triangles[t];
        const Material& material = *f.draws[triangle.draw].material;
        if (material.alphaMode != AlphaMode::opaque || material.translucent())
            continue;
        forEachQuad(triangle, area, pattern, [&](const Quad& quad) {
            for (int lane = 0; lane < 4; ++lane)
                tile.announce(quad.x + (lane & 1), quad.y + (lane >> 1), quad.covered[std::size_t(lane)], triangle.z);
        });
    }
}

// Whether samples are shaded individually; they are drawn as images with one sample per pixel.
bool separatesSamples(const View& view) { return view.output == Output::shaded && view.samples > kMaxSharedSamples; }

// Calls store(x, y, value) for the pixels of a tile; x and y are in the upright image.
template<class Store> void drawTile(const Prepared& f, std::size_t index, const Store& store)
{
    const View& view = f.view;
    SamplePattern pattern = samplePattern(view.output == Output::shaded && !separatesSamples(view) ? view.samples : 1);
    Rectangle area = f.tiled.area(index, view.width, view.height);
    Tile tile(area, pattern);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            tile.clear(x, y, background(f, x, y));
    const std::vector<std::uint32_t>& triangles = f.tiled.tiles[index];
    const std::size_t writeLimit =
        kWritesUntilAnnounced * std::size_t(area.x1 - area.x0) * std::size_t(area.y1 - area.y0);
    bool announced = false;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (!announced && tile.written() > writeLimit) { // hidden samples are no longer shaded
            announceOpaque(f, std::span(triangles).subspan(i), area, pattern, tile);
            announced = true;
        }
        const RasterTriangle& triangle = f.tiled.triangles[triangles[i]];
        forEachQuad(triangle, area, pattern, [&](const Quad& quad) { drawQuad(f, triangle, quad, pattern, tile); });
    }
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            store(x, view.rowsUpward ? view.height - 1 - y : y, tile.resolve(x, y));
}

// Draws all tiles. Returns false if stopped.
template<class Store> bool drawTiles(const Prepared& prepared, CountedSteps& done, const Store& store)
{
    parallelFor(std::size_t(0), prepared.tiled.tiles.size(), [&](std::size_t index) {
        if (done.stopped())
            return;
        drawTile(prepared, index, store);
        done.step();
    });
    return !done.stopped();
}

Result<Image> draw(const Scene& scene, const View& view, const Progress& progress)
{
    bool bytes = view.output == Output::shaded && !view.linearOutput;
    Image image = makeImage(view.width, view.height, bytes ? PixelType::unorm8 : PixelType::float32, scene.name);
    Prepared prepared = prepare(scene, view);
    const std::size_t tiles = prepared.tiled.tiles.size();
    const auto store = [&](int x, int y, glm::vec4 value) { storePixel(image, x, y, value, view.dither); };
    if (!separatesSamples(view)) {
        CountedSteps done(progress, tiles);
        return drawTiles(prepared, done, store) ? Result<Image>(std::move(image)) : stoppedError();
    }
    std::vector<glm::vec4> sums(image.pixelCount(), glm::vec4(0));
    CountedSteps done(progress, tiles * kSampleCount);
    const Projection unshifted = prepared.projection;
    for (int sample = 0; sample < kSampleCount; ++sample) {
        prepared.projection = movedBy(unshifted, samplePosition(sample));
        prepared.tiled = setUpTriangles(prepared.draws, prepared.projection, Cull::backFaces);
        const bool drawn = drawTiles(prepared, done, [&](int x, int y, glm::vec4 value) {
            sums[std::size_t(y) * std::size_t(view.width) + std::size_t(x)] += value;
        });
        if (!drawn)
            return stoppedError();
    }
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            store(x, y, sums[std::size_t(y) * std::size_t(view.width) + std::size_t(x)] / float(kSampleCount));
    return image;
}

Status checkSize(const View& view)
{
    if (std::min(view.width, view.height) < 1 || std::max(view.width, view.height) > kMaxSide)
        return usageError("image size: expected 1 to 16384 pixels per side, found " + std::to_string(view.width) + "x"
                          + std::to_string(view.height));
    return Done{};
}

} // namespace

Result<Image> renderReference(const Scene& scene, const View& view, int threads, const Progress& progress)
{
    for (const Status& ok : {checkSize(view), checkView(view), checkTrianglesDrawn(scene)})
        if (!ok)
            return ok.error();
    if (Status has = checkVertexAttributes(scene, view.frame, view.framesOfMeshes);
        !has) // checkView has verified the frame
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
