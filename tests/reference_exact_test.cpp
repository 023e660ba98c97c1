// The reference renderer against mathematics, with different x and y everywhere and on both sides of each threshold.
#include <algorithm>
#include <array>
#include <set>

#include "reference_scene.hpp"

using namespace cotan;
using namespace cotan::testing;

namespace {

const Patch kWide{{-1, 1, 0}, {2, 0, 0}, {0, -2, 0}};

// One world unit per pixel, 64 x 40; the centre of pixel (x, y) is at (x - 31.5, 19.5 - y).
View unitView(Output output)
{
    View view = viewOf(output);
    view.width = 64;
    view.height = 40;
    view.samples = 1;
    view.camera.eye = {0, 0, 50};
    view.camera.orthographic = true;
    view.camera.verticalExtent = 40;
    view.linearOutput = true;
    view.background = false;
    view.environment = false;
    return view;
}

glm::mat4 scaling(glm::vec3 s)
{
    glm::mat4 m(1);
    for (int i = 0; i < 3; ++i)
        m[i][i] = s[i];
    return m;
}

// An unlit square of 2 x 2 with uv from 0 to 1, one uv unit on 64 pixels; the image is linear.
Scene texturedSquare(Image image, glm::vec2 texelsPerPixel)
{
    Scene scene = sceneOf(meshOf(kWide));
    Material& m = scene.materials[0];
    m.unlit = true;
    m.baseColorMap.image = 0;
    m.baseColorMap.uRow.x = 64 * texelsPerPixel.x / float(image.width);
    m.baseColorMap.vRow.y = 64 * texelsPerPixel.y / float(image.height);
    scene.images.push_back(std::move(image));
    return scene;
}

View squareView()
{
    View view = unitView(Output::shaded);
    view.width = view.height = 64;
    view.camera.verticalExtent = 2;
    return view;
}

// Red and green without a pattern, so that a read of the wrong texel is noticed.
double noise(int x, int y, int channel) { return ((x * 29 + y * 57 + channel * 31 + x * y * 7) % 101) / 100.0; }

Image noiseImage(int width, int height)
{
    Image image = makeImage(width, height, PixelType::float32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float* p = image.floats() + 4 * (y * width + x);
            p[0] = float(noise(x, y, 0));
            p[1] = float(noise(x, y, 1));
            p[3] = 1;
        }
    return image;
}

// Red values of a mip level.
struct Level {
    int width, height;
    std::vector<double> values;
    double at(int x, int y) const
    {
        const int i = (x % width + width) % width, j = (y % height + height) % height;
        return values[std::size_t(j * width + i)];
    }
    // Bilinear interpolation with repeat; texel centres are at half-integers, uv in [0, 1).
    double bilinear(double u, double v) const
    {
        const double x = u * width - 0.5, y = v * height - 0.5;
        const int i = int(std::floor(x)), j = int(std::floor(y));
        const double kx = x - i, ky = y - j;
        return (at(i, j) * (1 - kx) + at(i + 1, j) * kx) * (1 - ky)
            + (at(i, j + 1) * (1 - kx) + at(i + 1, j + 1) * kx) * ky;
    }
};

Level levelZero(int width, int height)
{
    Level level{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            level.values.push_back(noise(x, y, 0));
    return level;
}

// Each texel is the mean over the area that it covers, on a grid that is fine enough to be exact: it contains every
// texel border of both levels.
Level halved(const Level& from)
{
    Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x) {
            double sum = 0;
            for (int j = y * from.height; j < (y + 1) * from.height; ++j)
                for (int i = x * from.width; i < (x + 1) * from.width; ++i)
                    sum += from.at(i / to.width, j / to.height);
            to.values.push_back(sum / (double(from.width) * from.height));
        }
    return to;
}

// Maximum difference between the image's red and expected(u, v), with uv in units of the image.
template<class Expected> double worst(const Image& image, glm::dvec2 size, glm::dvec2 texelsPerPixel, Expected expected)
{
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double u = (x + 0.5) * texelsPerPixel.x / size.x, v = (y + 0.5) * texelsPerPixel.y / size.y;
            largest = std::max(
                largest, std::abs(double(pixelOf(image, x, y).x) - expected(u - std::floor(u), v - std::floor(v))));
        }
    return largest;
}

} // namespace

TEST(ReferenceExact, surfacesBeforeTheNearPlaneAreNotDrawn)
{
    // The near plane is at 1e-4 of the distance to the far side of the scene's bounding sphere, whose scene is seen
    // here from one end.
    Mesh far = meshOf({{-300, 200, -1000}, {600, 0, 0}, {0, -400, 0}});
    const double halfDiagonal = 0.5 * std::sqrt(600.0 * 600 + 400 * 400 + 1000 * 1000);
    const double near = 1e-4 * (500 + halfDiagonal);
    for (const auto& [distance, drawn] : {std::pair{0.98, false}, {1.02, true}}) {
        const double d = distance * near;
        Scene scene = sceneOf(far);
        scene.meshes.push_back(meshOf({{-d, 0.1 * d, -d}, {2 * d, 0, 0}, {0, -d, 0}}));
        scene.instances.push_back({"", 1, glm::mat4(1)});
        View view = viewOf(Output::depth);
        view.camera.eye = {0, 0, 0};
        view.camera.target = {0, 0, -1};
        const float depth = pixelOf(rendered(scene, view), 30, 36).x;
        EXPECT_NEAR(depth, drawn ? d : 1000, drawn ? 1e-4 * d : 0.01) << distance;
    }
    // A pane from behind the eye to far away is clipped at the near plane.
    Scene scene = sceneOf(far);
    scene.materials[0].doubleSided = true;
    scene.meshes.push_back(meshOf({{-0.01, 0.02, 1}, {0.02, 0, 0}, {0, -0.04, -20}}));
    scene.instances.push_back({"", 1, glm::mat4(1)});
    View view = viewOf(Output::depth);
    view.camera.eye = {0, 0, 0};
    view.camera.target = {0, 0, -1};
    float nearest = 1e9f;
    const Image image = rendered(scene, view);
    forCovered(image, [&](int, int, glm::vec4 value) { nearest = std::min(nearest, value.x); });
    EXPECT_GT(nearest, 0.99 * near);
    EXPECT_LT(nearest, 900);
}

TEST(ReferenceExact, normalsOfMirroredAndScaledInstancesFollowTheInverseTranspose)
{
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
    for (const glm::vec3 s : {glm::vec3(1, 1, 1),
                              {-1, 1, 1},
                              {1, -1, 1},
                              {1, 1, -1},
                              {-1, -1, 1},
                              {-1, -1, -1},
                              {2, 3, 0.5f},
                              {-2, 3, 0.5f},
                              {2, -0.25f, 3}}) {
        Mesh mesh = meshOf(kWide);
        mesh.normals.assign(4, glm::vec3(n));
        const Scene scene = sceneOf(mesh, scaling(s)); // one-sided: the front must remain the front
        View view = viewOf(Output::normal);
        const double side = s.z < 0 ? -1 : 1; // mirrored along the view, the front faces the other way
        view.camera.eye.z = float(side) * 4;
        const glm::dvec3 expected = glm::normalize(n / glm::dvec3(s));
        const int count = forCovered(rendered(scene, view), [&](int, int, glm::vec4 value) {
            ASSERT_LT(degreesBetween(glm::vec3(value), expected), 1e-4) << s.x << " " << s.y << " " << s.z;
        });
        EXPECT_GT(count, 50) << s.x << " " << s.y << " " << s.z;
        view.camera.eye.z = float(-side) * 4;
        EXPECT_EQ(forCovered(rendered(scene, view), [](int, int, glm::vec4) {}), 0) << "seen from its back";
    }
}

TEST(ReferenceExact, bordersFollowTheTopLeftRule)
{
    // From (-16.5, 9.5) to (11.5, -3.5): the centres of columns 15 and 43, of rows 10 and 23.
    const Patch patch{{-16.5, 9.5, 0}, {28, 0, 0}, {0, -13, 0}};
    const Image image = rendered(sceneOf(meshOf(patch)), unitView(Output::uv));
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 64; ++x)
            ASSERT_EQ(pixelOf(image, x, y).w, x >= 15 && x < 43 && y >= 10 && y < 23 ? 1 : 0) << x << " " << y;
}

TEST(ReferenceExact, maskKeepsAlphaAtTheCutoff)
{
    for (const auto& [cutoff, kept] : {std::pair{0.124f, true}, {0.125f, true}, {0.1251f, false}}) {
        Mesh mesh = meshOf(kWide);
        mesh.colors.assign(4, {1, 1, 1, 0.5f});
        Scene scene = sceneOf(mesh);
        Image image = makeImage(1, 1, PixelType::float32);
        image.floats()[3] = 0.5f;
        scene.images.push_back(image);
        Material& m = scene.materials[0];
        m.baseColorMap.image = 0;
        m.baseColor.w = 0.5f;
        m.alphaMode = AlphaMode::mask;
        m.alphaCutoff = cutoff;
        EXPECT_EQ(pixelOf(rendered(scene, viewOf(Output::normal)), 30, 35).w, kept ? 1 : 0) << cutoff;
    }
}

TEST(ReferenceExact, wrapModesActOnTheirOwnAxis)
{
    const auto wrapped = [](int i, int size, Wrap mode) {
        if (mode == Wrap::clamp)
            return std::clamp(i, 0, size - 1);
        const int in = ((i % size) + size) % size, period = (i - in) / size;
        return mode == Wrap::mirror && period % 2 != 0 ? size - 1 - in : in;
    };
    const Wrap modes[] = {Wrap::repeat, Wrap::mirror, Wrap::clamp};
    for (const Wrap u : modes)
        for (const Wrap v : modes) {
            Scene scene = texturedSquare(noiseImage(5, 3), {0.5f, 0.25f});
            Texture& map = scene.materials[0].baseColorMap;
            map.uRow.z = -2; // columns -10 .. 21
            map.vRow.z = -3; // rows -9 .. 6
            map.sampler.wrapU = u;
            map.sampler.wrapV = v;
            View view = squareView();
            view.pointSampled = true;
            const Image image = rendered(scene, view);
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    const int i = wrapped(x / 2 - 10, 5, u), j = wrapped(y / 4 - 9, 3, v);
                    ASSERT_FLOAT_EQ(pixelOf(image, x, y).x, float(noise(i, j, 0))) << x << " " << y;
                    ASSERT_FLOAT_EQ(pixelOf(image, x, y).y, float(noise(i, j, 1))) << x << " " << y;
                }
        }
}

TEST(ReferenceExact, footprintsSelectTheMipLevelAlsoForOddSizes)
{
    // 45 x 27 -> 22 x 13 -> 11 x 6. Footprints are square, so each pixel is read by one probe.
    const Level zero = levelZero(45, 27), one = halved(zero), two = halved(one);
    ASSERT_EQ(two.width, 11);
    ASSERT_EQ(two.height, 6);
    const glm::dvec2 size(45, 27);
    const auto drawn = [&](double texels, MipFilter mip, Filter magnify, Filter minify) {
        Scene scene = texturedSquare(noiseImage(45, 27), glm::vec2(float(texels)));
        Sampler& s = scene.materials[0].baseColorMap.sampler;
        s.mip = mip;
        s.magnify = magnify;
        s.minify = minify;
        return rendered(scene, squareView());
    };
    const auto differs = [&](const Image& image, double texels, auto expected) {
        return worst(image, size, glm::dvec2(texels), expected);
    };
    const auto readZero = [&](double u, double v) { return zero.bilinear(u, v); };
    const auto readOne = [&](double u, double v) { return one.bilinear(u, v); };
    const auto readTwo = [&](double u, double v) { return two.bilinear(u, v); };
    const auto nearestZero = [&](double u, double v) { return zero.at(int(u * 45), int(v * 27)); };
    // Rounding of uv (1e-6 of the image, 60 texels, times a step of the noise).
    constexpr double kSame = 1e-3;
    // The footprints are slightly off a power of two, whose logarithm could round to either side.
    EXPECT_LT(differs(drawn(1.999, MipFilter::linear, Filter::linear, Filter::linear), 1.999, readOne), 2e-3);
    EXPECT_LT(differs(drawn(4.002, MipFilter::linear, Filter::linear, Filter::linear), 4.002, readTwo), 2e-3);
    const double between = std::pow(2, 1.25);
    EXPECT_LT(differs(drawn(between, MipFilter::linear, Filter::linear, Filter::linear), between,
                      [&](double u, double v) { return readOne(u, v) * 0.75 + readTwo(u, v) * 0.25; }),
              kSame);
    // With nearest, the level changes half way between two levels.
    const double below = std::pow(2, 1.49), above = std::pow(2, 1.51);
    EXPECT_LT(differs(drawn(below, MipFilter::nearest, Filter::linear, Filter::linear), below, readOne), kSame);
    EXPECT_LT(differs(drawn(above, MipFilter::nearest, Filter::linear, Filter::linear), above, readTwo), kSame);
    // One texel per pixel separates magnification from minification; without levels both read the finest.
    EXPECT_LT(differs(drawn(0.98, MipFilter::none, Filter::linear, Filter::nearest), 0.98, readZero), kSame);
    EXPECT_LT(differs(drawn(1.02, MipFilter::none, Filter::nearest, Filter::linear), 1.02, readZero), kSame);
    EXPECT_GT(differs(drawn(0.98, MipFilter::none, Filter::nearest, Filter::linear), 0.98, readZero), 0.1);
    EXPECT_LT(differs(drawn(3, MipFilter::none, Filter::linear, Filter::linear), 3, readZero), kSame);
    EXPECT_LT(differs(drawn(0.7, MipFilter::linear, Filter::nearest, Filter::linear), 0.7, nearestZero), 1e-6);
}

TEST(ReferenceExact, longFootprintsAreSampledAlongTheirLongerAxis)
{
    // Two texels per pixel along one axis, one along the other: two probes a third of a pixel apart in the finest
    // level.
    const Level zero = levelZero(45, 27);
    for (const bool alongX : {true, false}) {
        const glm::dvec2 texels = alongX ? glm::dvec2(1.98, 1) : glm::dvec2(1, 1.98);
        const Image image = rendered(texturedSquare(noiseImage(45, 27), glm::vec2(texels)), squareView());
        const double step = 1.98 / 6, u1 = alongX ? step / 45 : 0, v1 = alongX ? 0 : step / 27;
        EXPECT_LT(worst(image, {45, 27}, texels,
                        [&](double u, double v) {
                            return 0.5 * (zero.bilinear(u - u1, v - v1) + zero.bilinear(u + u1, v + v1));
                        }),
                  1e-3);
    }
}

namespace {

// Light at a pixel centre of a white diffuse floor (z = 0), relative to the same light without range and cone.
double lightFraction(Light light, int x, int y)
{
    Scene scene = sceneOf(meshOf({{-40, 30, 0}, {80, 0, 0}, {0, -60, 0}}));
    scene.materials[0].metallic = 0;
    View view = unitView(Output::shaded);
    view.lights = {light};
    const double with = double(pixelOf(rendered(scene, view), x, y).x);
    view.lights[0].kind = LightKind::point;
    view.lights[0].range = 0;
    return with / double(pixelOf(rendered(scene, view), x, y).x);
}

} // namespace

TEST(ReferenceExact, pointLightsFadeToZeroAtTheirRange)
{
    Light light;
    light.kind = LightKind::point;
    light.intensity = 100;
    light.position = {3.5f, -6.5f, 8}; // above pixel (35, 26)
    // KHR_lights_punctual: 1/d^2 times 1 - (d / range)^4, not below 0.
    light.range = 10;
    EXPECT_NEAR(lightFraction(light, 35, 26), 1 - std::pow(0.8, 4), 1e-5);
    EXPECT_NEAR(lightFraction(light, 39, 23), 1 - std::pow(std::sqrt(16 + 9 + 64.0) / 10, 4), 1e-5);
    light.range = 8.01f;
    EXPECT_NEAR(lightFraction(light, 35, 26), 1 - std::pow(8 / 8.01, 4), 1e-4);
    light.range = 7.99f;
    EXPECT_EQ(lightFraction(light, 35, 26), 0);
    light.range = -1; // like 0: unlimited
    EXPECT_EQ(lightFraction(light, 35, 26), 1);
    // Without range, light falls with the square of the distance.
    Scene scene = sceneOf(meshOf({{-40, 30, 0}, {80, 0, 0}, {0, -60, 0}}));
    scene.materials[0].metallic = 0;
    View view = unitView(Output::shaded);
    light.range = 0;
    view.lights = {light};
    const float near = pixelOf(rendered(scene, view), 35, 26).x;
    view.lights[0].position.z = 24;
    EXPECT_NEAR(pixelOf(rendered(scene, view), 35, 26).x * 9, near, 1e-4 * near);
}

TEST(ReferenceExact, spotLightsFadeFromTheirInnerToTheirOuterCone)
{
    Light light;
    light.kind = LightKind::spot;
    light.intensity = 100;
    light.position = {3.5f, -6.5f, 10};
    light.direction = glm::normalize(glm::vec3(6, 4, -10)); // at pixel (41, 22)
    light.innerCone = 0.1f;
    light.outerCone = 0.3f;
    // The angle between the axis and the direction to a pixel, and the smooth step of its cosine.
    const auto expected = [&](int x, int y) {
        const glm::dvec3 direction(x - 31.5 - 3.5, 19.5 - y + 6.5, -10);
        const double cosine = glm::dot(glm::normalize(direction), glm::normalize(glm::dvec3(6, 4, -10)));
        const double k = (cosine - std::cos(0.3)) / (std::cos(0.1) - std::cos(0.3));
        return k <= 0 ? 0.0 : k >= 1 ? 1.0 : k * k * (3 - 2 * k);
    };
    std::set<double> seen;
    for (const auto& [x, y] : {std::pair{41, 22},
                               {42, 22},
                               {41, 21},
                               {43, 21},
                               {39, 23},
                               {44, 24},
                               {41, 19},
                               {37, 22},
                               {29, 30},
                               {29, 22},
                               {41, 30}}) {
        EXPECT_NEAR(lightFraction(light, x, y), expected(x, y), 1e-4) << x << " " << y;
        seen.insert(expected(x, y));
    }
    EXPECT_GT(seen.size(), 4u); // inside, outside, and between
}

TEST(ReferenceExact, orthographicViewHasOneReflectionDirection)
{
    // A smooth floor under a directional light: highlights depend on the view direction, which is constant in an
    // orthographic view.
    Scene scene = sceneOf(meshOf({{-40, 30, 0}, {80, 0, 0}, {0, -60, 0}}));
    scene.materials[0].metallic = 0;
    scene.materials[0].roughness = 0.3f;
    View view = unitView(Output::shaded);
    view.shadows = false;
    view.lights.push_back({});
    view.lights[0].direction = glm::normalize(glm::vec3(0.2f, -0.1f, -1));
    const Image flat = rendered(scene, view);
    for (const auto& [x, y] : {std::pair{1, 1}, {60, 5}, {7, 38}})
        EXPECT_EQ(pixelOf(flat, x, y), pixelOf(flat, 31, 20)) << x << " " << y;
    view.camera.orthographic = false;
    const Image deep = rendered(scene, view);
    EXPECT_GT(std::abs(pixelOf(deep, 1, 1).x - pixelOf(deep, 60, 38).x), 0.01f);
}

TEST(ReferenceExact, onlyTheFirstDirectionalLightCastsAShadow)
{
    Scene scene = sceneOf(meshOf({{-30, 18, 0}, {60, 0, 0}, {0, -36, 0}}));
    scene.materials[0].metallic = 0;
    scene.meshes.push_back(meshOf({{-14, 6, 8}, {8, 0, 0}, {0, -8, 0}}));
    scene.instances.push_back({"", 1, glm::mat4(1)});
    View view = unitView(Output::shaded);
    view.lights.resize(3);
    view.lights[0].kind = LightKind::point;
    view.lights[0].position = {0, 0, 30};
    view.lights[0].intensity = 300;
    view.lights[1].direction = glm::normalize(glm::vec3(1, 0, -0.5f));  // the shadow is 16 to the right: x 2 to 10
    view.lights[2].direction = glm::normalize(glm::vec3(0, -1, -0.8f)); // 10 down: y -12 to -4
    const Image all = rendered(scene, view);
    View others = view;
    others.lights.erase(others.lights.begin() + 1);
    others.shadows = false;
    const Image without = rendered(scene, others);
    view.shadows = false;
    const Image lit = rendered(scene, view);
    EXPECT_EQ(pixelOf(all, 38, 18), pixelOf(without, 38, 18)); // in the shadow, only the two other lights remain
    EXPECT_LT(pixelOf(all, 38, 18).x, pixelOf(lit, 38, 18).x);
    EXPECT_EQ(pixelOf(all, 22, 28), pixelOf(lit, 22, 28)); // the third light casts no shadow
    EXPECT_EQ(pixelOf(all, 55, 5), pixelOf(lit, 55, 5));
}

TEST(ReferenceExact, vertexColoursAndAlphaAreInterpolatedInPerspective)
{
    // A floor at a grazing angle: half way up the image is not half way along the floor.
    Mesh mesh = meshOf({{-1, 0, 0}, {2, 0, 0}, {0, 0, -6}});
    mesh.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1}}; // red along u, green along v
    Scene scene = sceneOf(mesh);
    scene.materials[0].unlit = true;
    scene.materials[0].doubleSided = true;
    View view = viewOf(Output::shaded);
    view.samples = 1;
    view.linearOutput = true;
    view.background = false;
    view.camera.eye = {0.3f, 2, 3};
    view.camera.target = {0, 0, -2};
    const Image colours = rendered(scene, view);
    view.output = Output::uv;
    const Image uv = rendered(scene, view);
    int count = forCovered(uv, [&](int x, int y, glm::vec4 value) {
        ASSERT_NEAR(pixelOf(colours, x, y).x, value.x, 1e-5);
        ASSERT_NEAR(pixelOf(colours, x, y).y, value.y, 1e-5);
    });
    EXPECT_GT(count, 300);
}
