// Facts about the frames, and the bars A1, A3 and A4 (docs/project/testing.md) on the shipped text.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "truth/signs.hpp"

namespace cotan {
namespace {

constexpr std::array kDifferenceFrames = {
    Frame::cotangent,   Frame::cotangent2013,  Frame::nonperspective,  Frame::paperFull,
    Frame::paperNodet,  Frame::paperTranspose, Frame::paperOrthogonal, Frame::unit,
    Frame::orthonormal, Frame::gradient,       Frame::exact,
};

// Frames that are right for both y directions, both facings and mirrored uv: all except the one that is kept as
// printed.
constexpr std::array kSignCorrectFrames = {
    Frame::cotangent,       Frame::nonperspective, Frame::paperFull,   Frame::paperNodet, Frame::paperTranspose,
    Frame::paperOrthogonal, Frame::unit,           Frame::orthonormal, Frame::gradient,   Frame::exact,
};

TEST(Frame, everyNameIsFoundAndNamesAreUnique)
{
    std::set<std::string_view> names;
    for (const FrameInfo& f : frames()) {
        EXPECT_EQ(frameFromName(f.name), f.frame);
        EXPECT_EQ(&info(f.frame), &f);
        names.insert(f.name);
    }
    EXPECT_EQ(names.size(), std::size_t(kFrameCount));
    EXPECT_FALSE(frameFromName("Cotangent"));
    EXPECT_FALSE(frameFromName(""));
}

TEST(Frame, flatTexelChangesNothing)
{
    Random random(1);
    for (Frame frame : kDifferenceFrames)
        for (int i = 0; i < 50; ++i) {
            const AffinePatch p = randomPatch(random, i & 1);
            const PixelCamera c =
                PixelCamera::lookAt(p.normal * 3.0 + random.direction(), {0, 0, 0}, random.direction(), 800);
            const auto d = screenDifferences(c, p, {0, 0, 0});
            EXPECT_LT(degreesBetween(shade(frame, p.normal, d, {0, 0, 1}), p.normal), 1e-12)
                << name(frame); // a product with one and a normalisation
        }
}

TEST(Frame, squarePatchFacingTheCameraGivesTheAxesForEveryFrame)
{
    const AffinePatch p = patchOf(kLayouts[0]);
    const PixelCamera c = PixelCamera::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 200, true);
    const auto d = screenDifferences(c, p, {0, 0, 0});
    for (Frame frame : kDifferenceFrames) {
        const auto f = makeFrame(frame, Covector3d(p.normal), d);
        EXPECT_LT(glm::length(f.t.raw() - glm::dvec3(1, 0, 0)), 1e-12) << name(frame);
        EXPECT_LT(glm::length(f.b.raw() - glm::dvec3(0, 1, 0)), 1e-12) << name(frame);
    }
}

TEST(Frame, uniformScaleOfTheObjectChangesOnlyTheMetricFrame)
{
    Random random(2);
    for (Frame frame : kDifferenceFrames) {
        const AffinePatch p = randomPatch(random, false);
        const PixelCamera c = PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800, true);
        auto d = screenDifferences(c, p, {0, 0, 0});
        const glm::dvec3 m = tiltedTexel(random, 35);
        const glm::dvec3 before = shade(frame, p.normal, d, m);
        d.dpdx = d.dpdx * 7.0;
        d.dpdy = d.dpdy * 7.0;
        const double change = degreesBetween(before, shade(frame, p.normal, d, m));
        if (frame == Frame::gradient) {
            EXPECT_GT(change, 5); // bumps of the same height on an object seven times larger
        } else {
            EXPECT_LT(change, 1e-10) << name(frame);
        }
    }
}

TEST(Frame, rotatingTheSceneRotatesTheNormal)
{
    Random random(3);
    const glm::dmat3 r(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
    for (Frame frame : kDifferenceFrames) {
        const AffinePatch p = randomPatch(random, true);
        const auto d =
            screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p, {0, 0, 0});
        auto flipped = d;
        flipped.dpdx = Vector3d(r * d.dpdx.raw());
        flipped.dpdy = Vector3d(r * d.dpdy.raw());
        const glm::dvec3 m = tiltedTexel(random, 40);
        EXPECT_LT(degreesBetween(r * shade(frame, p.normal, d, m), shade(frame, r * p.normal, flipped, m)), 1e-11)
            << name(frame);
    }
}

TEST(Frame, mirroredUFlipsTheTangentOnly)
{
    Random random(4);
    for (Frame frame : kSignCorrectFrames) {
        const AffinePatch p = randomPatch(random, false);
        auto d =
            screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p, {0, 0, 0});
        const auto f = makeFrame(frame, Covector3d(p.normal), d);
        d.duvdx.x = -d.duvdx.x;
        d.duvdy.x = -d.duvdy.x;
        const auto g = makeFrame(frame, Covector3d(p.normal), d);
        EXPECT_LT(length(f.t + g.t), 1e-12) << name(frame);
        EXPECT_LT(length(f.b - g.b), 1e-12) << name(frame);
    }
}

TEST(Frame, reversingTheNormalKeepsTheCotangents)
{
    Random random(5);
    for (Frame frame : {Frame::cotangent, Frame::gradient, Frame::exact}) {
        const AffinePatch p = randomPatch(random, false);
        const auto d =
            screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p, {0, 0, 0});
        const Covector3d n(glm::normalize(p.normal + random.direction() * 0.2));
        const auto f = makeFrame(frame, n, d);
        const auto g = makeFrame(frame, -n, d);
        EXPECT_LT(length(f.t - g.t) + length(f.b - g.b), 1e-12) << name(frame);
    }
}

TEST(Frame, twoOptimisedPaperFormsAreEqual)
{
    Random random(6);
    for (int i = 0; i < 200; ++i) {
        const AffinePatch p = randomPatch(random, i & 1);
        const auto d = screenDifferences(
            PixelCamera::lookAt(p.normal * 3.0 + random.direction(), {0, 0, 0}, random.direction(), 800), p, {0, 0, 0});
        const glm::dvec3 m = tiltedTexel(random, 35);
        // The same products summed in the same order, except for terms multiplied by zero.
        EXPECT_LT(
            degreesBetween(shade(Frame::paperNodet, p.normal, d, m), shade(Frame::paperTranspose, p.normal, d, m)),
            1e-12);
    }
}

// If n is tilted from the face normal the cotangents stay perpendicular to n, so that a map's z keeps the sign of n.N.
TEST(Frame, cotangentsArePerpendicularToTheInterpolatedNormal)
{
    Random random(7);
    for (Frame frame : {Frame::cotangent, Frame::orthonormal, Frame::gradient, Frame::exact})
        for (int i = 0; i < 100; ++i) {
            const AffinePatch p = randomPatch(random, i & 1);
            const auto d = screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p,
                                             {0, 0, 0});
            const glm::dvec3 n = glm::normalize(p.normal + random.direction() * 0.9);
            const auto f = makeFrame(frame, Covector3d(n), d);
            EXPECT_LT(std::abs(glm::dot(f.t.raw(), n)), 1e-10) << name(frame);
            EXPECT_LT(std::abs(glm::dot(f.b.raw(), n)), 1e-10) << name(frame);
        }
}

TEST(Frame, encodeIsTheInverseOfApplyForSkewedFrames)
{
    Random random(8);
    double worst = 0;
    for (Frame frame : kDifferenceFrames)
        for (int i = 0; i < 300; ++i) {
            const AffinePatch p = randomPatch(random, i & 1);
            const auto d = screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p,
                                             {0, 0, 0});
            const auto f = makeFrame(frame, Covector3d(p.normal), d);
            const glm::dvec3 m = tiltedTexel(random, random.range(0, 80));
            worst = std::max(worst, degreesBetween(encode(f, perturb(f, m)), m));
        }
    // Bar C1 allows 1e-8 in double; the inverse loses accuracy by the frame's condition number.
    EXPECT_LT(worst, 1e-8);
}

TEST(Frame, transposeIsNotTheInverseOfASkewedFrame)
{
    const AffinePatch p = patchOf(kLayouts[3]);
    const auto d = screenDifferences(PixelCamera::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 200, true), p, {0, 0, 0});
    const auto f = makeFrame(Frame::cotangent, Covector3d(p.normal), d);
    const glm::dvec3 m = glm::normalize(glm::dvec3(0.5, 0.3, 1));
    const glm::dvec3 n = perturb(f, m).raw();
    const glm::dvec3 byTranspose =
        glm::normalize(glm::dvec3(glm::dot(f.t.raw(), n), glm::dot(f.b.raw(), n), glm::dot(f.n.raw(), n)));
    EXPECT_GT(degreesBetween(byTranspose, m), 5);
}

// ---- A1: flat patches, seven layouts, views tilted by 0 to 80 degrees ------------------------

TEST(FrameBarA1, exactOnFlatPatchesFromEveryView)
{
    struct Row {
        Frame frame;
        bool metric;
        double worst = 0, worstFloat = 0;
    };
    std::array rows = {Row{Frame::paperFull, false}, Row{Frame::cotangent, false}, Row{Frame::exact, false},
                       Row{Frame::gradient, true}};
    Random random(4);
    for (const Layout& layout : kLayouts)
        for (double tilt = 0; tilt <= 80; tilt += 5)
            for (int i = 0; i < 200; ++i) {
                const AffinePatch p = patchOf(layout);
                const PixelCamera c = viewAt(random, tilt, i & 1);
                const auto d = screenDifferences(c, p, {random.range(-0.5, 0.5), random.range(-0.5, 0.5), 0});
                const glm::dvec3 m = tiltedTexel(random, 35);
                for (Row& r : rows) {
                    const glm::dvec3 truth = r.metric ? truthE(p, m) : truthS(p, m);
                    r.worst = std::max(r.worst, degreesBetween(shade(r.frame, p.normal, d, m), truth));
                    r.worstFloat = std::max(r.worstFloat, degreesBetween(shadeFloat(r.frame, p.normal, d, m), truth));
                }
            }
    for (const Row& r : rows) {
        EXPECT_LT(r.worst, 1e-9) << name(r.frame);      // measured 1.2e-11
        EXPECT_LT(r.worstFloat, 1e-4) << name(r.frame); // measured 8.5e-6
    }
}

// The control: frames known to be wrong here have their known errors (A2).
TEST(FrameBarA2, squarePatchFramesAreWrongOnStretchedUvByTheKnownAmount)
{
    auto meanError = [](Frame frame, const Layout& layout) {
        const AffinePatch p = patchOf(layout);
        const PixelCamera c = PixelCamera::lookAt({1, 1, 5}, {1, 1, 0}, {0, 1, 0}, 200, true);
        double sum = 0;
        int count = 0;
        for (int j = 0; j < 128; ++j)
            for (int i = 0; i < 128; ++i) {
                const double u = (i + 0.5) / 128, v = (j + 0.5) / 128;
                const glm::dvec3 m = domeTexel(u, v);
                const glm::dvec3 truth = truthS(p, m);
                if (degreesBetween(truth, p.normal) < 5)
                    continue;
                const auto d = screenDifferences(c, p, {layout.a * u + layout.b * v, layout.c * u + layout.d * v, 0});
                sum += degreesBetween(shade(frame, p.normal, d, m), truth);
                ++count;
            }
        return sum / count;
    };
    EXPECT_NEAR(meanError(Frame::paperTranspose, kLayouts[1]), 9.47, 0.1);
    EXPECT_NEAR(meanError(Frame::unit, kLayouts[1]), 9.47, 0.1);
    EXPECT_NEAR(meanError(Frame::orthonormal, kLayouts[1]), 9.47, 0.1);
    EXPECT_NEAR(meanError(Frame::unit, kLayouts[2]), 14.91, 0.15);
    EXPECT_NEAR(meanError(Frame::orthonormal, kLayouts[3]), 16.3, 0.2);
    EXPECT_NEAR(meanError(Frame::paperTranspose, kLayouts[3]), 5.32, 0.1);
    EXPECT_LT(meanError(Frame::cotangent, kLayouts[3]), 1e-9);
}

// ---- A3: view independence -------------------------------------------------------------------

TEST(FrameBarA3, cotangentIsTheSameForAnyTwoDirectionsOfDifferences)
{
    Random random(11);
    double worst = 0, worstFloat = 0;
    for (int i = 0; i < 2000; ++i) {
        const AffinePatch p = randomPatch(random, i & 1);
        const glm::dvec3 n = glm::normalize(p.normal + random.direction() * 0.3);
        const glm::dvec3 e = glm::normalize(glm::cross(p.normal, random.direction()));
        const glm::dvec3 h = glm::cross(p.normal, e);
        const glm::dvec3 m = tiltedTexel(random, 45);
        std::vector<Differences<double>> sources;
        for (int k = 0; k < 3; ++k) { // screen quads of random views, one and 64 pixels wide
            glm::dvec3 eye;
            do
                eye = random.direction();
            while (glm::dot(eye, p.normal) < 0.2);
            PixelCamera c = PixelCamera::lookAt(eye * 4.0, {0, 0, 0}, random.direction(), 1800, k == 2);
            c.rowsDown = k == 1;
            sources.push_back(screenDifferences(c, p, e * 0.2, k == 1 ? 64 : 1));
        }
        // a uv-space raster, v down: steps of one texel along +u and -v
        const glm::dvec3 area = glm::cross(p.gradU, p.gradV);
        const double a2 = glm::dot(area, area);
        const glm::dvec3 dpdu = glm::cross(p.gradV, area) / a2, dpdv = glm::cross(area, p.gradU) / a2;
        Differences<double> raster;
        raster.dpdx = Vector3d(dpdu / 1024.0);
        raster.dpdy = Vector3d(-dpdv / 1024.0);
        raster.duvdx = {1 / 1024.0, 0};
        raster.duvdy = {0, -1 / 1024.0};
        sources.push_back(raster);
        // the edges of a triangle
        Differences<double> edges;
        edges.dpdx = Vector3d(e);
        edges.dpdy = Vector3d(h * 1.5 + e * 0.3);
        edges.duvdx = p.uvAt(edges.dpdx.raw());
        edges.duvdy = p.uvAt(edges.dpdy.raw());
        sources.push_back(edges);

        const glm::dvec3 first = shade(Frame::cotangent, n, sources[0], m);
        for (const auto& s : sources) {
            worst = std::max(worst, degreesBetween(first, shade(Frame::cotangent, n, s, m)));
            worstFloat = std::max(worstFloat, degreesBetween(first, shadeFloat(Frame::cotangent, n, s, m)));
        }
    }
    EXPECT_LT(worst, 1e-9);      // measured 3.7e-11
    EXPECT_LT(worstFloat, 5e-4); // measured 1.3e-5
}

// The largest angle between the normals that a frame gives for one texel from two eyes; rows of the second image run in
// either direction.
double changeWithTheView(Frame frame)
{
    Random random(21);
    double largest = 0;
    for (int i = 0; i < 200; ++i) {
        const AffinePatch p = randomPatch(random, false);
        const glm::dvec3 m = tiltedTexel(random, 45);
        glm::dvec3 seen[2];
        for (glm::dvec3& s : seen) {
            glm::dvec3 eye;
            do
                eye = random.direction();
            while (glm::dot(eye, p.normal) < 0.2);
            Differences<double> d =
                screenDifferences(PixelCamera::lookAt(eye * 4.0, {0, 0, 0}, random.direction(), 1800), p, {0, 0, 0});
            if (&s != seen && i % 2 == 1) {
                d.dpdy = Vector3d(-d.dpdy.raw());
                d.duvdy = -d.duvdy;
            }
            s = shade(frame, p.normal, d, m);
        }
        largest = std::max(largest, degreesBetween(seen[0], seen[1]));
    }
    return largest;
}

TEST(FrameTable, saysWhichFramesDependOnTheView)
{
    for (const FrameInfo& f : frames()) {
        if (readsVertices(f.frame)) {
            EXPECT_FALSE(f.dependsOnView) << f.name; // uses no differences
        } else if (f.dependsOnView) {
            EXPECT_GT(changeWithTheView(f.frame), 30) << f.name;
        } else {
            EXPECT_LT(changeWithTheView(f.frame), 1e-6) << f.name; // in double
        }
    }
}

TEST(FrameBarA3, nonperspectiveDependsOnTheView)
{
    Random random(12);
    double sum = 0;
    for (int i = 0; i < 500; ++i) {
        const AffinePatch p = randomPatch(random, false);
        const glm::dvec3 m = tiltedTexel(random, 45);
        glm::dvec3 result[2];
        for (glm::dvec3& r : result) {
            glm::dvec3 eye;
            do
                eye = random.direction();
            while (glm::dot(eye, p.normal) < 0.2);
            r = shade(
                Frame::nonperspective, p.normal,
                screenDifferences(PixelCamera::lookAt(eye * 4.0, {0, 0, 0}, random.direction(), 1800), p, {0, 0, 0}),
                m);
        }
        sum += degreesBetween(result[0], result[1]);
    }
    EXPECT_GT(sum / 500, 10); // measured 21
}

// ---- A4: signs -------------------------------------------------------------------------------

// Fraction of random planes where t points along grad u and b along grad v.
double fractionRight(Frame frame, const SignCase& c)
{
    Random random(7);
    int right = 0;
    constexpr int kPlanes = 400;
    for (int i = 0; i < kPlanes; ++i)
        right += signsRight(frame, makeSignTrial(random, c));
    return double(right) / kPlanes;
}

TEST(FrameBarA4, all24SignCombinationsAreRightForEverySignCorrectFrame)
{
    ASSERT_EQ(signCases().size(), 24u);
    for (Frame frame : kSignCorrectFrames)
        for (const SignCase& c : signCases())
            EXPECT_EQ(fractionRight(frame, c), 1) << name(frame) << ", " << c.name();
}

TEST(FrameBarA4, cotangent2013IsReversedInExactlyHalfOfThem)
{
    int reversed = 0;
    for (const SignCase& c : signCases()) {
        const double fraction = fractionRight(Frame::cotangent2013, c);
        EXPECT_TRUE(fraction == 0 || fraction == 1);
        reversed += fraction == 0;
        EXPECT_EQ(fraction == 1, c.positive());
    }
    EXPECT_EQ(reversed, 12);
}

} // namespace
} // namespace cotan
