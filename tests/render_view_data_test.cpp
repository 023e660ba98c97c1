// The per-view constants of the device against plain geometry: projection to the image, the shadow map and the ground,
// and eye-space instances and lights.
#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "scene/environment_map.hpp"
#include "view_data.hpp"

namespace cotan {

namespace {

// A view from (4, 5, 6) along -x; right is -z, up is y. 60 x 40 pixels; at distance 1 the visible height is 1.
View sideView(bool orthographic)
{
    View view;
    view.width = 60;
    view.height = 40;
    view.camera.eye = {4, 5, 6};
    view.camera.target = {3, 5, 6};
    view.camera.orthographic = orthographic;
    view.camera.verticalExtent = 8;
    view.camera.verticalFieldOfView = 2 * std::atan(0.5f);
    return view;
}

Bounds boxFrom(glm::vec3 low, glm::vec3 high)
{
    Bounds box = emptyBounds();
    box.low = low;
    box.high = high;
    return box;
}

const Bounds kBox = boxFrom({-7, 1, 2}, {3, 8, 11});

gpu::CotanView constantsOf(const View& view, glm::dvec2 sampleOffset = glm::dvec2(0), const Bounds& box = kBox)
{
    return viewConstants(view, cameraAxes(view.camera), box, sampleOffset);
}

double along(const gpu::vec4& row, const glm::dvec3& p) { return glm::dot(glm::dvec4(row), glm::dvec4(p, 1)); }

// x, y and depth of a point relative to the eye, after the perspective division.
glm::dvec3 clipped(const gpu::CotanView& g, const glm::dvec3& fromEye)
{
    return glm::dvec3(along(g.clipX, fromEye), along(g.clipY, fromEye), along(g.clipZ, fromEye))
        / along(g.clipW, fromEye);
}

void expectNear(const glm::dvec3& found, const glm::dvec3& expected, double tolerance, const char* what)
{
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], expected[c], tolerance) << what << " " << c;
}

} // namespace

TEST(RenderViewData, imageCornersAreClipSpaceCorners)
{
    for (const bool orthographic : {false, true})
        for (const bool upward : {false, true}) {
            View view = sideView(orthographic);
            view.rowsUpward = upward;
            const gpu::CotanView g = constantsOf(view);
            for (const double away : {2.0, 7.0}) {
                const double high = orthographic ? 4 : 0.5 * away; // half the image height
                const glm::dvec3 rightAbove(-away, high, -1.5 * high);
                const glm::dvec3 seen = clipped(g, rightAbove), leftBelow = clipped(g, {-away, -high, 1.5 * high});
                const double y = upward ? 1 : -1; // if rows run down, the top is at -1
                EXPECT_NEAR(seen.x, 1, 1e-6);
                EXPECT_NEAR(seen.y, y, 1e-6);
                EXPECT_NEAR(leftBelow.x, -1, 1e-6);
                EXPECT_NEAR(leftBelow.y, -y, 1e-6);
                EXPECT_GT(seen.z, 0);
                EXPECT_LT(seen.z, 1);
            }
            EXPECT_GT(clipped(g, {-2, 0, 0}).z, clipped(g, {-2.1, 0, 0}).z) << "1 is near, 0 far";
            expectNear(glm::dvec3(g.forward), {-1, 0, 0}, 1e-7, "forward");
            EXPECT_EQ(g.forward.w, orthographic ? 0 : 1);
            expectNear(glm::dvec3(g.right), glm::dvec3(0, 0, orthographic ? 0 : -0.75), 1e-6, "right");
            const double up = orthographic ? 0 : upward ? 0.5 : -0.5;
            expectNear(glm::dvec3(g.up), {0, up, 0}, 1e-6, "up");
            EXPECT_EQ(g.counts.z, upward ? 40u : 0u);
        }
    // The near plane of a perspective view is at 1e-4 of the visible range; an orthographic view begins at the eye.
    const double reach = glm::length(glm::dvec3(-6, -0.5, 0.5)) + std::sqrt(10.0 * 10 + 7 * 7 + 9 * 9) / 2;
    EXPECT_NEAR(clipped(constantsOf(sideView(false)), {-1e-4 * reach, 0, 0}).z, 1, 1e-6);
    EXPECT_NEAR(clipped(constantsOf(sideView(true)), {0, 0, 0}).z, 1, 1e-6);
    EXPECT_NEAR(clipped(constantsOf(sideView(true)), {-1.01 * reach, 0, 0}).z, 0, 1e-6);
}

TEST(RenderViewData, sampleOffsetsShiftTheProjection)
{
    for (const bool orthographic : {false, true}) {
        const View view = sideView(orthographic);
        const gpu::CotanView middle = constantsOf(view), moved = constantsOf(view, {0.25, -0.375});
        const glm::dvec3 p(-3, 0.5, -0.25), before = clipped(middle, p), after = clipped(moved, p);
        EXPECT_NEAR(before.x - after.x, 2 * 0.25 / 60, 1e-6);
        EXPECT_NEAR(before.y - after.y, 2 * -0.375 / 40, 1e-6);
        EXPECT_NEAR(before.z, after.z, 1e-7);
        // The ray through the image centre is shifted to the position of the sample.
        const glm::dvec3 shift = glm::dvec3(moved.forward) - glm::dvec3(middle.forward);
        const glm::dvec3 expected =
            glm::dvec3(middle.right) * (2 * 0.25 / 60) + glm::dvec3(middle.up) * (2 * -0.375 / 40);
        expectNear(shift, expected, 1e-6, "forward");
    }
}

// A square of the scene's maximum extent plus four texels on each side; depth from 0 to 1 with a margin of a hundredth.
TEST(RenderViewData, shadowMapCoversTheSceneAndAMargin)
{
    View view = sideView(false);
    view.lights.resize(3);
    view.lights[0].kind = LightKind::point;
    view.lights[1].direction = {0, 0, -2}; // the first directional light; any length
    view.lights[2].direction = {1, 0, 0};
    view.shadowSoftness = 0.25f;
    const gpu::CotanView g = constantsOf(view);
    const double size = 10 * (1 + 8.0 / 2048), deep = 9 * 1.02; // 10 x 7 across, 9 along the light
    glm::dvec3 least(1e9), most(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = glm::dvec3(i & 1 ? 3 : -7, i & 2 ? 8 : 1, i & 4 ? 11 : 2) - glm::dvec3(4, 5, 6);
        const glm::dvec3 at(along(g.shadowX, p), along(g.shadowY, p), along(g.shadowZ, p));
        least = glm::min(least, at);
        most = glm::max(most, at);
    }
    expectNear(most - least, {10 / size, 7 / size, 9 / deep}, 1e-6, "extent");
    expectNear(most + least, glm::dvec3(1), 1e-6, "middle");
    EXPECT_GT(along(g.shadowZ, {0, 0, -1}), along(g.shadowZ, {0, 0, 1})) << "farther along the light";
    EXPECT_NEAR(g.shadow.x, size / 2048, 1e-7);
    EXPECT_EQ(g.shadow.y, 2048);
    EXPECT_NEAR(g.shadow.z, 0.5 * size / 2048 / deep, 1e-8);
    EXPECT_NEAR(g.soft.x, 0.25 * deep / size, 1e-7);
    EXPECT_EQ(g.soft.y, kMaxPenumbra);
    EXPECT_NEAR(g.soft.z, size / deep, 1e-6);
    EXPECT_TRUE(castsShadow(view));
    view.shadows = false;
    EXPECT_FALSE(castsShadow(view));
    view.shadows = true;
    view.lights.resize(1);
    EXPECT_FALSE(castsShadow(view)) << "a point light casts none";
}

TEST(RenderViewData, groundAndCountsMatchTheView)
{
    View view = sideView(false);
    view.lights.resize(5);
    view.exposure = 1.75f;
    view.backdrop = Backdrop::blurred;
    auto ground = std::make_shared<GroundMap>();
    ground->height = -2.5f;
    ground->low = {-3, 7};
    ground->extent = {4, 16};
    view.ground = ground;
    const gpu::CotanView g = constantsOf(view);
    const auto groundUv = [&](double x, double z) { // world space
        return glm::dvec2((x - 4) * g.ground.x + g.ground.y, (z - 6) * g.ground.z + g.ground.w);
    };
    EXPECT_NEAR(groundUv(-3, 7).x, 0, 1e-6);
    EXPECT_NEAR(groundUv(-3, 7).y, 0, 1e-6);
    EXPECT_NEAR(groundUv(1, 23).x, 1, 1e-6);
    EXPECT_NEAR(groundUv(1, 23).y, 1, 1e-6);
    EXPECT_EQ(g.tone.x, 1.75f);
    EXPECT_EQ(g.tone.y, kBackdropRoughness);
    EXPECT_EQ(g.tone.z, -7.5f); // below the eye
    EXPECT_EQ(g.counts.x, 5u);
    EXPECT_EQ(g.counts.y, 1u);
    view.dither = false;
    view.backdrop = Backdrop::sharp;
    EXPECT_EQ(constantsOf(view).counts.y, 0u);
    EXPECT_EQ(constantsOf(view).tone.y, 0);
}

TEST(RenderViewData, lightsAreRelativeToTheEyeAndTheFirstDirectionalIsMarked)
{
    View view = sideView(false);
    Light spot{.kind = LightKind::spot,
               .color = {1, 0.5f, 0.25f},
               .intensity = 4,
               .position = {5, 7, 9},
               .direction = {0, 3, 4},
               .range = 11,
               .innerCone = 0.3f,
               .outerCone = 0.7f};
    Light point = spot, sun = spot, even = spot;
    point.kind = LightKind::point;
    sun.kind = LightKind::directional;
    sun.direction = {0, 0, 0};
    even.innerCone = even.outerCone;
    view.lights = {spot, point, sun, sun, even};
    const auto lights = lightConstants(view, cameraAxes(view.camera));
    ASSERT_EQ(lights.size(), 5u);
    const float kinds[] = {2, 1, 0, 0, 2};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(lights[i].position, gpu::vec4(1, 2, 3, kinds[i])) << i;
        EXPECT_EQ(lights[i].color, gpu::vec4(4, 2, 1, i == 2 ? 1 : 0)) << i;
        EXPECT_EQ(lights[i].direction.w, 11) << i;
        EXPECT_NEAR(lights[i].cone.x, std::cos(0.7), 1e-6) << i;
        EXPECT_NEAR(lights[i].cone.y, i == 4 ? std::cos(0.7) + 1e-4 : std::cos(0.3), 1e-6) << i;
    }
    expectNear(glm::dvec3(lights[0].direction), {0, 0.6, 0.8}, 1e-6, "unit");
    expectNear(glm::dvec3(lights[2].direction), {0, -1, 0}, 1e-6, "of none");
    view.shadows = false;
    EXPECT_EQ(lightConstants(view, cameraAxes(view.camera))[2].color.w, 0);
    view.lights.clear();
    EXPECT_EQ(lightConstants(view, cameraAxes(view.camera)).size(), 1u);
}

TEST(RenderViewData, instanceMatricesAreRelativeToTheEye)
{
    glm::mat4 toWorld(1); // columns
    toWorld[0] = {2, 1, 0, 0};
    toWorld[1] = {0, -3, 0.5f, 0};
    toWorld[2] = {1, 0, 4, 0};
    toWorld[3] = {10, 20, 30, 1};
    const gpu::CotanDraw g = drawConstants(toWorld, {1, 2, 3});
    const glm::dvec3 p(0.5, -1, 2);
    const glm::dvec3 expected = glm::dvec3(glm::dmat4(toWorld) * glm::dvec4(p, 1)) - glm::dvec3(1, 2, 3);
    expectNear({along(g.rowX, p), along(g.rowY, p), along(g.rowZ, p)}, expected, 1e-5, "position");
    const glm::dmat3 m(toWorld);
    const double determinant = glm::determinant(m);
    EXPECT_LT(determinant, 0);
    EXPECT_EQ(g.normalX.w, -1);
    // Normals transform by the inverse transpose, times a positive factor.
    const glm::dmat3 inverse = glm::transpose(glm::inverse(m));
    const auto normal = [&](const glm::dvec3& n) {
        return glm::dvec3(glm::dot(glm::dvec3(g.normalX), n), glm::dot(glm::dvec3(g.normalY), n),
                          glm::dot(glm::dvec3(g.normalZ), n));
    };
    double longest = 0;
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 axis(0);
        axis[c] = 1;
        const glm::dvec3 found = normal(axis);
        EXPECT_NEAR(glm::dot(glm::normalize(found), glm::normalize(inverse * axis)), 1, 1e-6) << c;
        longest = std::max(longest, glm::length(found));
    }
    EXPECT_NEAR(longest, 1, 1e-6) << "of the size one";
    toWorld[0] = -toWorld[0];
    EXPECT_EQ(drawConstants(toWorld, {1, 2, 3}).normalX.w, 1);
    const gpu::CotanDraw flat = drawConstants(glm::mat4(0), {0, 0, 0});
    EXPECT_EQ(glm::dvec3(flat.normalX), glm::dvec3(0));
}

// Whole pixels, with a margin of two on the left and top and three on the right and bottom, clamped to the image.
TEST(RenderViewData, pixelAreaOfAnInstanceIsItsBoxAndAMargin)
{
    View view = sideView(true);
    view.camera.eye = {0, 0, 10};
    view.camera.target = {0, 0, 0};
    view.camera.verticalExtent = 40; // one unit per pixel; the centre is at (30, 20)
    const gpu::CotanView g = constantsOf(view, glm::dvec2(0), boxFrom({-50, -50, -5}, {50, 50, 5}));
    const gpu::CotanDraw draw = drawConstants(glm::mat4(1), {0, 0, 10});
    const auto area = [&](glm::vec3 low, glm::vec3 high) {
        const PixelArea a = areaOf(g, draw, boxFrom(low, high), 60, 40);
        return glm::ivec4(a.x0, a.y0, a.x1, a.y1);
    };
    EXPECT_EQ(area({-9.5f, -3.5f, -1}, {4.5f, 7.5f, 1}), glm::ivec4(18, 10, 37, 26));
    EXPECT_EQ(area({-100, -3.5f, -1}, {4.5f, 100, 1}), glm::ivec4(0, 0, 37, 26));
    EXPECT_EQ(area({-9.5f, -100, -1}, {100, 7.5f, 1}), glm::ivec4(18, 10, 60, 40));
    EXPECT_EQ(area({-1, -1, -1}, {1, 1, 11}), glm::ivec4(0, 0, 60, 40)) << "reaches behind the eye";
    EXPECT_TRUE(areaOf(g, draw, emptyBounds(), 60, 40).empty());
    const PixelArea outside = areaOf(g, draw, boxFrom({-90, -3, -1}, {-80, 3, 1}), 60, 40);
    EXPECT_TRUE(outside.empty());
    const PixelArea a{3, 4, 10, 20}, b{5, 2, 30, 6}, none{5, 5, 5, 9}, flat{5, 5, 9, 5};
    for (const auto& [first, second, whole] : {std::tuple(a, b, glm::ivec4(3, 2, 30, 20)),
                                               {b, a, glm::ivec4(3, 2, 30, 20)},
                                               {a, none, glm::ivec4(3, 4, 10, 20)},
                                               {flat, b, glm::ivec4(5, 2, 30, 6)}}) {
        const PixelArea both = around(first, second);
        EXPECT_EQ(glm::ivec4(both.x0, both.y0, both.x1, both.y1), whole);
    }
    EXPECT_TRUE(none.empty() && flat.empty());
    EXPECT_FALSE(a.empty());
}

} // namespace cotan
