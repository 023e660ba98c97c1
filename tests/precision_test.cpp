// Bar D1: float, camera-relative, uv in [0,1): the error for a pixel footprint and a distance from the origin, against
// exact arithmetic on the same stored mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "truth/precision.hpp"

namespace cotan {
namespace {

struct Deviation {
    double mean = 0;
    int notFinite = 0;
};

Deviation meanError(double offset, double footprint, PositionSource source)
{
    Random random(81);
    Deviation error;
    constexpr int kTrials = 3000;
    for (int i = 0; i < kTrials; ++i) {
        const PrecisionTrial t = makeTrial(random, {offset, footprint});
        const glm::dvec3 r = shadeFloat(Frame::cotangent, t.normal, measuredDifferences(t, source), t.texel);
        const double e = degreesBetween(r, shade(Frame::cotangent, t.normal, t.exact, t.texel));
        if (std::isfinite(e))
            error.mean += e / kTrials;
        else
            ++error.notFinite;
    }
    return error;
}

TEST(FrameBarD1, cameraRelativePositionsAreIndependentOfTheOrigin)
{
    for (auto [footprint, bar] : {std::pair(1e-3, 0.002), std::pair(1e-5, 0.12)}) {
        const Deviation near = meanError(0, footprint, PositionSource::cameraRelative);
        EXPECT_EQ(near.notFinite, 0);
        EXPECT_LT(near.mean, bar) << footprint;
        for (double offset : {1e3, 1e6}) {
            const Deviation far = meanError(offset, footprint, PositionSource::cameraRelative);
            EXPECT_EQ(far.notFinite, 0);
            EXPECT_NEAR(far.mean, near.mean, 0.1 * near.mean) << footprint << " at " << offset;
        }
    }
}

TEST(FrameBarD1, interpolatedWorldPositionsAreUnusableFarFromTheOrigin)
{
    EXPECT_GT(meanError(1e5, 1e-3, PositionSource::world).mean, 10); // the control; measured 24
}

TEST(FrameBarD1, exactGradientsAreAccurateAtEveryFootprint)
{
    for (double offset : {0.0, 1e6}) {
        Random random(83);
        double worst = 0;
        for (int i = 0; i < 3000; ++i) {
            const PrecisionTrial t = makeTrial(random, {offset, 1e-6});
            const glm::dvec3 r = shadeFloat(Frame::exact, t.normal, floatEdges(t), t.texel);
            // Pixel differences in double at 1e6 would lose more digits than `exact` loses in float.
            worst = std::max(worst, degreesBetween(r, shade(Frame::exact, t.normal, exactEdges(t), t.texel)));
        }
        EXPECT_LT(worst, 1e-4) << offset; // the bar limits the mean; measured mean 3e-6
    }
}

} // namespace
} // namespace cotan
