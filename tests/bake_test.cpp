// Error bars C1, C2 and C4 for the shipped baker, and its treatment of missed rays, charts and threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/bake_surfaces.hpp"
#include "tessellation_scene.hpp"

namespace cotan {
namespace {

double asStored(double component, int levels)
{
    const double c = (component * 127 + 128) / 255;
    return (std::round(std::clamp(c, 0.0, 1.0) * levels) / levels * 255 - 128) / 127;
}

struct RoundTrip {
    double mean = 0, worst = 0;
    bool negative = false, unit = true;
};

// Encodes the analytic normal of a relief in the baker's frame at random points, quantises it, and shades it with the
// frame from screen-space differences at the same point.
RoundTrip roundTrip(Frame frame, int levels)
{
    RoundTrip result;
    const Surface& surface = surfaces().front(); // the sphere
    const Tessellation mesh = tessellate(surface, 12, false);
    const auto low = makeLowSurface(sceneOf(mesh), -1, frame, TangentOrigin::generated);
    EXPECT_TRUE(low);
    Random random(17);
    constexpr int kSamples = 6000;
    for (int i = 0; i < kSamples; ++i) {
        const TrianglePoint at = randomPoint(random, mesh);
        const Interpolated x = interpolate(mesh, at);
        const SurfacePoint p = surface.at(x.parameters);
        const glm::dvec3 target = truthS(p, texelOf(Waves{1.2, 12}.at(x.uv.x, x.uv.y)));
        const LowPoint point = pointOf(*low, std::uint32_t(at.triangle), at.weights[1], at.weights[2]);
        glm::dvec3 m = encode(point.frame, Covector3d(target));
        result.negative = result.negative || (m.z < 0 && glm::dot(target, x.n) > 0);
        result.unit = result.unit && std::abs(glm::length(m) - 1) < 1e-12;
        if (levels > 0)
            m = {asStored(m.x, levels), asStored(m.y, levels), asStored(m.z, levels)};
        glm::dvec3 eye;
        do
            eye = random.direction();
        while (glm::dot(eye, x.plane.normal) < 0.1);
        const PixelCamera camera = PixelCamera::lookAt(x.position + eye * 4.0, x.position, {0.1, 0.2, 1}, 1800);
        const double e =
            degreesBetween(shade(frame, false, x, screenDifferences(camera, x.plane, x.position), m), target);
        result.mean += e / kSamples;
        result.worst = std::max(result.worst, e);
    }
    return result;
}

TEST(BakeBarC1, shadingReproducesTheBakedNormalsUpToQuantisation)
{
    for (Frame frame : {Frame::cotangent, Frame::orthonormal, Frame::exact, Frame::smooth, Frame::mikktspace}) {
        EXPECT_LT(roundTrip(frame, 0).worst, 1e-8) << name(frame); // raster in uv against screen
        EXPECT_LT(roundTrip(frame, 65535).worst, 0.005) << name(frame);
        const RoundTrip eight = roundTrip(frame, 255);
        EXPECT_LT(eight.mean, 0.20) << name(frame);
        const bool square = frame == Frame::orthonormal || frame == Frame::mikktspace;
        EXPECT_LT(eight.worst, square ? 0.45 : 1.0) << name(frame);
    }
}

TEST(BakeBarC4, encodedTexelsAreUnitAndAboveTheHorizon)
{
    for (Frame frame : {Frame::cotangent, Frame::orthonormal, Frame::exact, Frame::smooth, Frame::mikktspace}) {
        const RoundTrip r = roundTrip(frame, 0);
        EXPECT_FALSE(r.negative) << name(frame);
        EXPECT_TRUE(r.unit) << name(frame);
    }
}

TEST(BakeBarC2, aMapForAnotherFrameIsWrongByDegrees)
{
    // Made for MikkTSpace: drawn with cotangent the mean error is over 3 degrees, with orthonormal little more than
    // that of faceting. 32 segments.
    for (const auto& [which, limit] : {std::pair("sphere", 1.1), {"spout", 0.35}}) {
        const auto all = surfaces();
        const Surface& surface =
            *std::find_if(all.begin(), all.end(), [&](const Surface& s) { return s.name == which; });
        const Tessellation mesh = tessellate(surface, 32, false);
        const auto low = makeLowSurface(sceneOf(mesh), -1, Frame::mikktspace, TangentOrigin::generated);
        Random random(18);
        double toCotangent = 0, toOrthonormal = 0;
        constexpr int kSamples = 6000;
        for (int i = 0; i < kSamples; ++i) {
            const TrianglePoint at = randomPoint(random, mesh);
            const Interpolated x = interpolate(mesh, at);
            const glm::dvec3 target = truthS(surface.at(x.parameters), texelOf(Waves{1.2, 12}.at(x.uv.x, x.uv.y)));
            const LowPoint point = pointOf(*low, std::uint32_t(at.triangle), at.weights[1], at.weights[2]);
            const glm::dvec3 m = encode(point.frame, Covector3d(target));
            toCotangent += degreesBetween(shade(Frame::cotangent, false, x, x.edges, m), target) / kSamples;
            toOrthonormal += degreesBetween(shade(Frame::orthonormal, false, x, x.edges, m), target) / kSamples;
        }
        EXPECT_GT(toCotangent, 3) << which;
        EXPECT_LT(toOrthonormal, limit) << which;
    }
}

// A square low mesh at z = 0 and a wavy grid that extends beyond it.
struct Waves2 {
    Scene low, high;
};

double waveHeight(double x, double y) { return 0.02 * std::sin(9 * x + 1) * std::cos(7 * y); }

Waves2 wavyPair(int segments)
{
    Waves2 pair;
    for (int n : {1, segments}) {
        Scene scene;
        scene.name = n == 1 ? "low" : "high";
        Mesh mesh;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const double x = double(i) / n, y = double(j) / n;
                const double hx = 0.18 * std::cos(9 * x + 1) * std::cos(7 * y);
                const double hy = -0.14 * std::sin(9 * x + 1) * std::sin(7 * y);
                mesh.positions.emplace_back(float(x), float(y), n == 1 ? 0.0f : float(waveHeight(x, y)));
                mesh.normals.push_back(n == 1 ? glm::vec3(0, 0, 1)
                                              : glm::normalize(glm::vec3(float(-hx), float(-hy), 1)));
                mesh.texcoords[0].emplace_back(float(x), float(1 - y)); // v down
            }
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const auto a = std::uint32_t(j * (n + 1) + i), b = a + 1, d = a + std::uint32_t(n) + 1, c = d + 1;
                for (std::uint32_t k : {a, b, c, a, c, d})
                    mesh.indices.push_back(k);
            }
        scene.meshes.push_back(std::move(mesh));
        scene.materials.emplace_back();
        scene.instances.push_back({});
        (n == 1 ? pair.low : pair.high) = std::move(scene);
    }
    return pair;
}

Baked bakeWaves(const BakeOptions& options, int segments = 200)
{
    const Waves2 pair = wavyPair(segments);
    const auto low = makeLowSurface(pair.low, -1, options.frame, TangentOrigin::generated);
    const auto high = HighSurface::make({pair.high}, 1);
    EXPECT_TRUE(low && high);
    const auto baked = bake(*low, *high, options);
    EXPECT_TRUE(baked);
    return *baked;
}

TEST(Bake, aWavySheetGivesTheSlopesOfItsWaves)
{
    BakeOptions options;
    options.width = options.height = 64;
    options.maxDistance = 0.1f;
    for (Frame frame : {Frame::cotangent, Frame::smooth, Frame::mikktspace, Frame::exact}) {
        options.frame = frame;
        const Baked baked = bakeWaves(options);
        EXPECT_EQ(baked.statistics.covered, 64u * 64u);
        EXPECT_EQ(baked.statistics.missed, 0u);
        EXPECT_EQ(baked.statistics.twice, 0u);
        double mean = 0;
        for (int j = 0; j < 64; ++j)
            for (int i = 0; i < 64; ++i) {
                const double x = (i + 0.5) / 64, y = 1 - (j + 0.5) / 64;
                // +u is +x, and +v (down) is -y.
                const glm::dvec3 truth(-0.18 * std::cos(9 * x + 1) * std::cos(7 * y),
                                       -0.14 * std::sin(9 * x + 1) * std::sin(7 * y), 1);
                mean += degreesBetween(glm::dvec3(baked.values[std::size_t(j * 64 + i)]), truth) / 4096;
            }
        // Error of interpolated normals of 200 cells: (9 / 200)^2 / 8 of the slope, below 0.01 degrees.
        EXPECT_LT(mean, 0.01) << name(frame);
    }
}

TEST(Bake, heightIsTheDistanceAlongTheLowNormal)
{
    BakeOptions options;
    options.samples = 1; // a texel has the value at its centre
    options.kind = BakeKind::height;
    options.width = options.height = 32;
    options.maxDistance = 0.1f;
    const Baked baked = bakeWaves(options);
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i)
            EXPECT_NEAR(double(baked.values[std::size_t(j * 32 + i)].x), waveHeight((i + 0.5) / 32, 1 - (j + 0.5) / 32),
                        2e-5); // chord error of 200 cells
}

TEST(Bake, anOpenSheetIsAlmostUnoccluded)
{
    BakeOptions options;
    options.kind = BakeKind::occlusion;
    options.width = options.height = 16;
    options.maxDistance = 0.1f;
    for (const glm::vec3& v : bakeWaves(options, 60).values) {
        EXPECT_GE(v.x, 0.85f); // slopes of up to 0.18 hide little
        EXPECT_LE(v.x, 1.0f);
    }
}

TEST(Bake, missedTexelsAreCounted)
{
    BakeOptions options;
    options.width = options.height = 32;
    options.maxDistance = 0.005f; // less than the waves' height of 0.02
    const Baked baked = bakeWaves(options);
    EXPECT_GT(baked.statistics.missed, 300u);
    EXPECT_LT(baked.statistics.missed, 1024u);
}

TEST(Bake, bytesDoNotDependOnThreads)
{
    BakeOptions options;
    options.width = 96;
    options.height = 64;
    options.samples = 2;
    options.maxDistance = 0.1f;
    options.threads = 1;
    const Baked one = bakeWaves(options, 50);
    options.threads = 2;
    const Baked two = bakeWaves(options, 50);
    EXPECT_TRUE(one.values == two.values);
    EXPECT_TRUE(one.states == two.states);
}

TEST(Bake, frameThatDependsOnTheViewIsRefused)
{
    const Waves2 pair = wavyPair(4);
    for (Frame frame : {Frame::nonperspective, Frame::paperOrthogonal, Frame::cotangent2013}) {
        const auto low = makeLowSurface(pair.low, -1, frame, TangentOrigin::generated);
        ASSERT_FALSE(low);
        EXPECT_EQ(low.error().kind, ErrorKind::usage);
    }
}

TEST(Padding, everyTexelTakesTheValueOfItsNearestChart)
{
    Baked baked;
    baked.width = 9;
    baked.height = 5;
    baked.values.assign(45, glm::vec3(0));
    baked.states.assign(45, 0);
    auto at = [](int x, int y) { return std::size_t(y * 9 + x); };
    for (int y = 1; y < 4; ++y) { // two charts, each one texel wide
        baked.values[at(1, y)] = {1, 0, 0};
        baked.values[at(7, y)] = {0, 1, 0};
        baked.states[at(1, y)] = baked.states[at(7, y)] = texelCovered;
    }
    padCharts(baked, 2);
    for (int y = 0; y < 5; ++y) {
        EXPECT_EQ(baked.values[at(0, y)], glm::vec3(1, 0, 0));
        EXPECT_EQ(baked.values[at(2, y)], glm::vec3(1, 0, 0));
        EXPECT_EQ(baked.values[at(8, y)], glm::vec3(0, 1, 0));
        EXPECT_EQ(baked.values[at(4, y)], glm::vec3(0)); // three texels from both charts
    }
    padCharts(baked, 0);
    for (const glm::vec3& v : baked.values)
        EXPECT_TRUE(v == glm::vec3(1, 0, 0) || v == glm::vec3(0, 1, 0));
}

TEST(Store, greenFollowsTheFormat)
{
    Baked baked;
    baked.width = baked.height = 1;
    baked.values = {glm::vec3(0, 0.6f, 0.8f)}; // along +v
    baked.states = {texelCovered};
    StoredAs as;
    as.format.greenUp = false;
    EXPECT_EQ(int(storeBaked(baked, BakeKind::normal, as).bytes8()[1]), 128 + 76); // 0.6 * 127
    as.format.greenUp = true;
    EXPECT_EQ(int(storeBaked(baked, BakeKind::normal, as).bytes8()[1]), 128 - 76);
}

TEST(Store, ditherKeepsTheMeanWithinOneLevel)
{
    Baked baked;
    baked.width = baked.height = 64;
    baked.values.assign(4096, glm::normalize(glm::vec3(0.1013f, 0, 1)));
    baked.states.assign(4096, texelCovered);
    StoredAs as;
    as.dither = true;
    const Image image = storeBaked(baked, BakeKind::normal, as);
    double sum = 0;
    const double exact = (double(baked.values[0].x) * 127 + 128);
    for (std::size_t i = 0; i < 4096; ++i) {
        EXPECT_LE(std::abs(double(image.bytes8()[4 * i]) - exact), 1.0);
        sum += image.bytes8()[4 * i];
    }
    EXPECT_NEAR(sum / 4096, exact, 1.0 / 64); // the pattern has 64 steps
}

} // namespace
} // namespace cotan
