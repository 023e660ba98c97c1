// Coverage, clipping and interpolation of the reference renderer.
#include "reference_scene.hpp"

using namespace cotan;
using namespace cotan::testing;

namespace {

// The ray through the centre of a pixel, computed from camera parameters alone.
struct Ray {
    glm::dvec3 origin, direction;
};

Ray rayThrough(const View& view, int x, int y)
{
    glm::dvec3 eye = view.camera.eye;
    glm::dvec3 forward = glm::normalize(glm::dvec3(view.camera.target) - eye);
    glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(view.camera.up)));
    glm::dvec3 up = glm::cross(right, forward);
    double sx = (2 * (x + 0.5) - view.width) / view.height;
    double sy = 1 - 2 * (y + 0.5) / view.height;
    if (view.camera.orthographic) {
        double half = 0.5 * double(view.camera.verticalExtent);
        return {eye + right * (sx * half) + up * (sy * half), forward};
    }
    double slope = std::tan(0.5 * double(view.camera.verticalFieldOfView));
    return {eye, forward + right * (sx * slope) + up * (sy * slope)};
}

// The ray's intersection with the patch's plane: (u, v, distance in units of the direction).
glm::dvec3 hit(const Patch& patch, const Ray& ray)
{
    double t = glm::dot(patch.origin - ray.origin, patch.normal()) / glm::dot(ray.direction, patch.normal());
    glm::dvec3 p = ray.origin + ray.direction * t - patch.origin;
    return {glm::dot(p, patch.gradU()), glm::dot(p, patch.gradV()), t};
}

// Compares a uv image with rays. margin: distance from the border in uv within which coverage is not tested, as corners
// are snapped to 1/256 pixel. tolerance: in uv.
void expectUvOfRays(const Patch& patch, View view, double margin, double tolerance)
{
    view.output = Output::uv;
    Image image = rendered(sceneOf(meshOf(patch)), view);
    int compared = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            glm::dvec3 h = hit(patch, rayThrough(view, x, y));
            glm::vec4 value = pixelOf(image, x, y);
            auto inside = [&](double m) { return h.z > 0 && h.x > m && h.x < 1 - m && h.y > m && h.y < 1 - m; };
            if (inside(margin)) {
                ASSERT_EQ(value.w, 1) << "gap at " << x << " " << y;
            }
            if (!inside(-margin)) {
                ASSERT_EQ(value.w, 0) << "beyond the patch at " << x << " " << y;
            }
            if (value.w == 0)
                continue;
            ++compared;
            ASSERT_NEAR(value.x, h.x, tolerance) << x << " " << y;
            ASSERT_NEAR(value.y, h.y, tolerance) << x << " " << y;
        }
    EXPECT_GT(compared, 300);
}

const Patch kTilted{{-1.2, 0.5, -2.5}, {2.2, 0.3, 1.5}, {0.2, -1.1, 2.9}};

} // namespace

// Rounding: uv and the corners relative to the eye are floats, 1e-7 each.
constexpr double kUvRounding = 2e-6;

TEST(ReferenceRaster, tiltedPatchInterpolatesUvAsRaysDo)
{
    expectUvOfRays(kTilted, viewOf(Output::uv), 1e-3, kUvRounding);
}

TEST(ReferenceRaster, orthographicPatchInterpolatesUvAsRaysDo)
{
    View view = viewOf(Output::uv);
    view.camera.orthographic = true;
    view.camera.verticalExtent = 3;
    expectUvOfRays(kTilted, view, 1e-3, kUvRounding);
}

TEST(ReferenceRaster, rotatedCamerasInterpolateUvAsRaysDo)
{
    View view = viewOf(Output::uv);
    view.width = 90;
    view.height = 50;
    view.camera.eye = {0.7f, 2.1f, 4};
    view.camera.target = {0.2f, -0.1f, -0.5f};
    view.camera.up = {0.2f, 1, 0.1f};
    view.camera.verticalExtent = 3.5f;
    for (const bool orthographic : {false, true})
        for (const bool rowsUpward : {false, true}) {
            view.camera.orthographic = orthographic;
            view.rowsUpward = rowsUpward;
            expectUvOfRays(kTilted, view, 1e-3, 2 * kUvRounding); // the camera's own axes are rounded too
        }
}

TEST(ReferenceRaster, oddSizesInterpolateUvAsRaysDo)
{
    View view = viewOf(Output::uv);
    view.width = 101;
    view.height = 67;
    for (bool upward : {false, true}) {
        view.rowsUpward = upward;
        expectUvOfRays(kTilted, view, 1e-3, kUvRounding);
    }
}

TEST(ReferenceRaster, patchThroughTheEyePlaneInterpolatesUvAsRaysDo)
{
    // A floor that extends behind the camera on both sides: both triangles are clipped. Rounding grows with the floor:
    // 200 units, eye 1 above it.
    Patch floor{{-100, -1, -100}, {200, 0, 0}, {0, 0, 200}};
    View view = viewOf(Output::uv);
    view.camera.target = {0, -0.5f, 0};
    expectUvOfRays(floor, view, 2e-3, 1e-5);
    view.camera.up = {1, 1, 0}; // tilts the horizon
    expectUvOfRays(floor, view, 2e-3, 1e-5);
}

TEST(ReferenceRaster, depthIsTheDistanceAlongTheViewAxis)
{
    View view = viewOf(Output::depth);
    Image image = rendered(sceneOf(meshOf(kTilted)), view);
    int count = forCovered(image, [&](int x, int y, glm::vec4 value) {
        // The ray's direction has length one along the view axis, so its parameter is the distance.
        ASSERT_NEAR(value.x, hit(kTilted, rayThrough(view, x, y)).z, 1e-5);
    });
    EXPECT_GT(count, 300);
}

namespace {

// Makes coverage countable: each black surface that transmits half of the light halves what remains of the white
// ground.
Scene halfTransparent(Mesh mesh)
{
    Scene scene = sceneOf(std::move(mesh));
    Material& m = scene.materials[0];
    m.baseColor = {0, 0, 0, 0.5f};
    m.alphaMode = AlphaMode::blend;
    m.unlit = true;
    m.doubleSided = true;
    return scene;
}

} // namespace

TEST(ReferenceRaster, trianglesThatShareEdgesLeaveNoGapAndNoDoubleCoverage)
{
    // A fan around an off-centre point, rotated by many angles: inside the rim every sample must be covered exactly
    // once, at any angle of the spokes.
    for (int turn = 0; turn < 24; ++turn) {
        Mesh mesh;
        mesh.positions.push_back({0.13f, -0.07f, 0});
        const std::uint32_t spokes = 9;
        for (std::uint32_t i = 0; i < spokes; ++i) {
            double a = (i + turn / 24.0) * 2 * 3.14159265358979 / spokes;
            mesh.positions.push_back(glm::vec3(1.2 * std::cos(a), 1.2 * std::sin(a), 0));
            mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % spokes});
        }
        for (int samples : {1, 4}) {
            View view = viewOf(Output::shaded);
            view.samples = samples;
            view.linearOutput = true;
            view.background = false;
            Image image = rendered(halfTransparent(mesh), view);
            int inside = 0;
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    glm::dvec3 r = rayThrough(view, x, y).direction * 4.0;
                    float alpha = pixelOf(image, x, y).w;
                    ASSERT_LE(alpha, 0.5f) << "covered twice: " << x << " " << y;
                    if (std::hypot(r.x, r.y) > 1.0)
                        continue;
                    ++inside;
                    ASSERT_EQ(alpha, 0.5f) << "gap: " << x << " " << y << ", turn " << turn;
                }
            EXPECT_GT(inside, 500);
        }
    }
}

TEST(ReferenceRaster, edgesThroughSampleCentresBelongToOneTriangle)
{
    // In an orthographic view with one unit per pixel, every straight or diagonal edge of this grid passes exactly
    // through pixel centres.
    Mesh mesh;
    for (int i = 0; i < 81; ++i)
        mesh.positions.push_back({float(i % 9) * 4 - 16.5f, float(i / 9) * 4 - 16.5f, 0});
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            std::uint32_t a = y * 9 + x;
            if ((x + y) % 2)
                mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 10, a, a + 10, a + 9});
            else
                mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 9, a + 1, a + 10, a + 9});
        }
    View view = viewOf(Output::shaded);
    view.camera.orthographic = true;
    view.camera.verticalExtent = 64;
    view.samples = 1;
    view.linearOutput = true;
    view.background = false;
    Image image = rendered(halfTransparent(mesh), view);
    int count = forCovered(image, [](int x, int y, glm::vec4 value) { ASSERT_EQ(value.w, 0.5f) << x << " " << y; });
    EXPECT_EQ(count, 32 * 32); // 32 units a side, including the left and top borders
}

TEST(ReferenceRaster, fourSamplesGiveQuarterSteps)
{
    // A vertical border at 0.5 of a pixel: the samples at x = 3/8 and 1/8 are left of it.
    Patch patch{{-1.5, 40, 0}, {40, 0, 0}, {0, -80, 0}};
    Scene scene = sceneOf(meshOf(patch));
    scene.materials[0].unlit = true;
    View view = viewOf(Output::shaded);
    view.camera.orthographic = true;
    view.camera.verticalExtent = 64;
    view.linearOutput = true;
    view.background = false;
    Image image = rendered(scene, view);
    for (int y = 0; y < 64; ++y) {
        EXPECT_EQ(pixelOf(image, 29, y).w, 0);
        EXPECT_EQ(pixelOf(image, 30, y).w, 0.5f);
        EXPECT_EQ(pixelOf(image, 31, y).w, 1);
    }
}

TEST(ReferenceRaster, nearerSurfaceHidesFartherInAnyOrder)
{
    Mesh front = meshOf({{-0.5, 0.5, 0.5}, {1, 0, 0}, {0, -1, 0}});
    Mesh back = meshOf({{-1, 1, 0}, {2, 0, 0}, {0, -2, 0}});
    for (bool frontFirst : {false, true}) {
        Scene scene = sceneOf(frontFirst ? front : back);
        scene.meshes.push_back(frontFirst ? back : front);
        scene.instances.push_back({"", 1, glm::mat4(1)});
        Image image = rendered(scene, viewOf(Output::depth));
        EXPECT_NEAR(pixelOf(image, 32, 32).x, 3.5f, 1e-5f);
        EXPECT_NEAR(pixelOf(image, 16, 32).x, 4.0f, 1e-5f);
    }
}

TEST(ReferenceRaster, everyThreadCountGivesTheSameBytes)
{
    Scene scene = sceneOf(meshOf(kTilted));
    addNormalMap(scene, {160, 100, 240});
    scene.meshes.push_back(meshOf({{-2, -0.5, 1}, {4, 0, 0}, {0.3, -0.2, -6}}));
    scene.instances.push_back({"", 1, glm::mat4(1)});
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.materials[1].baseColor.w = 0.4f;
    for (int i = 0; i < 5; ++i) {
        Mesh pane = meshOf({{-1.0 + 0.2 * i, 1, 1 - 0.3 * i}, {1, 0, 0.2}, {0, -1, 0}});
        pane.material = 1;
        scene.meshes.push_back(pane);
        scene.instances.push_back({"", int(scene.meshes.size()) - 1, glm::mat4(1)});
    }
    View view = viewOf(Output::shaded);
    view.width = 203;
    view.height = 117;
    view.lights.push_back({});
    Image one = rendered(scene, view, 1);
    for (int threads : {0, 2, 3, 7})
        EXPECT_EQ(one.data, rendered(scene, view, threads).data) << threads << " threads";
}

TEST(ReferenceRaster, sizesOutOfRangeAreUsageErrors)
{
    for (auto [width, height] : {std::pair{0, 64}, {64, 0}, {-1, 64}, {16385, 1}, {1, 16385}}) {
        View view = viewOf(Output::shaded);
        view.width = width;
        view.height = height;
        Result<Image> result = renderReference({}, view);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().kind, ErrorKind::usage);
        EXPECT_EQ(result.error().message,
                  "image size: expected 1 to 16384 pixels per side, found " + std::to_string(width) + "x"
                      + std::to_string(height));
    }
}

// One step for each tile of 32 x 32 pixels, or 16 per tile with 16 samples; returning false stops the render.
TEST(ReferenceRaster, progressAdvancesInEqualStepsToOne)
{
    const Scene scene = sceneOf(meshOf(Patch{}));
    for (const auto& [samples, steps] : {std::pair(1, 6), {4, 6}, {16, 96}}) {
        View view = viewOf(Output::shaded);
        view.width = 70;
        view.height = 40;
        view.samples = samples;
        std::vector<double> fractions;
        const auto whole = renderReference(scene, view, 1, [&](double fraction) {
            fractions.push_back(fraction);
            return true;
        });
        ASSERT_TRUE(whole);
        ASSERT_EQ(fractions.size(), std::size_t(steps));
        for (std::size_t i = 0; i < fractions.size(); ++i)
            EXPECT_NEAR(fractions[i], double(i + 1) / steps, 1e-9) << samples;
        for (const int last : {1, steps / 2, steps}) {
            int count = 0;
            const auto stopped = renderReference(scene, view, 1, [&](double) { return ++count < last; });
            ASSERT_FALSE(stopped) << samples << " " << last;
            EXPECT_EQ(stopped.error().kind, ErrorKind::stopped);
            EXPECT_EQ(count, last) << samples << ": asked no more";
        }
    }
}

TEST(ReferenceRaster, emptySceneIsBackground)
{
    View view = viewOf(Output::shaded);
    view.background = false;
    Image image = rendered({}, view);
    EXPECT_EQ(image.type, PixelType::unorm8);
    EXPECT_EQ(forCovered(image, [](int, int, glm::vec4) {}), 0);
}
