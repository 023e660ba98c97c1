// Default values of results: counts and fractions are zero, and indices are invalid.
#include <gtest/gtest.h>

#include "bake/bake_surfaces.hpp"
#include "bake/convert/map_jobs.hpp"
#include "bake/ray_starts.hpp"
#include "batch/record.hpp"
#include "batch/run.hpp"
#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "cotan/inspect.hpp"
#include "cotan/lint.hpp"
#include "cotan/maps.hpp"
#include "cotan/tangents.hpp"
#include "gltf/json/views.hpp"
#include "high_view.hpp"
#include "map_files/convert.hpp"
#include "map_files/height.hpp"
#include "scene/environment_map.hpp"
#include "smooth_report.hpp"

namespace cotan {

using namespace app;
namespace {

TEST(EmptyResults, ofBakingCountNothing)
{
    BakeStatistics s;
    for (const std::size_t n : {s.texels, s.covered, s.touched, s.missed, s.negative, s.twice, s.further, s.nearer,
                                s.rays, s.mirroredTriangles, s.degenerateTriangles})
        EXPECT_EQ(n, 0u);
    for (const double x : {s.rayDistance, s.rayStart, s.seconds, s.padSeconds})
        EXPECT_EQ(x, 0);
    Baked b;
    EXPECT_EQ(b.width, 0);
    EXPECT_EQ(b.height, 0);
    RayStarts starts;
    EXPECT_FALSE(starts.directionsDiffer);
    for (const float x : {starts.farthest, starts.skip, starts.limit})
        EXPECT_EQ(x, 0);
    app::HighView seen;
    EXPECT_EQ(seen.others, 0u);
    EXPECT_EQ(seen.compared, 0u);
}

TEST(EmptyResults, ofLintJudgeNothing)
{
    UvQuality u;
    for (const double x : {u.area, u.degenerate, u.mirrored, u.overlapping, u.overlappingMirrored, u.stretched,
                           u.sheared, u.gradient, u.largestUv})
        EXPECT_EQ(x, 0);
    EXPECT_EQ(EdgeSteps().edges, 0u);
    StoredTangents t;
    EXPECT_FALSE(t.present);
    EXPECT_EQ(t.reversedW, 0);
    EXPECT_EQ(t.rotated, 0);
    PrimitiveLint p;
    EXPECT_EQ(p.placing, 0u);
    EXPECT_EQ(p.placings, 1u);
    EXPECT_EQ(p.image, -1);
    EXPECT_FALSE(p.unread);
    EXPECT_EQ(p.triangles, 0u);
    EXPECT_FALSE(p.hasUv);
    EXPECT_EQ(p.madeFor, Frame::mikktspace);
    EXPECT_EQ(p.precision, 0);
    EXPECT_EQ(p.closest, 0);
    GreenEvidence g;
    EXPECT_EQ(g.image, -1);
    EXPECT_TRUE(g.declaredUp);
    EXPECT_EQ(MapFit().image, -1);
    LintReport r;
    EXPECT_EQ(r.distance, 0);
    EXPECT_TRUE(r.advice == Advice::nothing);
    EXPECT_FALSE(r.distrustStored);
    EXPECT_EQ(r.dropping, 0u);
    EXPECT_EQ(r.keeping, 0u);
    LintFailure f;
    EXPECT_EQ(f.value, 0);
    EXPECT_EQ(f.limit, -1);
    EXPECT_FALSE(f.percent);
}

TEST(EmptyResults, ofConversionsMakeNothing)
{
    ConvertedMap m;
    for (const std::size_t n : {m.image, m.surfaces, m.bytesBefore, m.bytesAfter, m.figures.covered, m.figures.padded,
                                m.figures.several, m.figures.disagreeing, m.figures.belowHorizon})
        EXPECT_EQ(n, 0u);
    for (const int n : {m.width, m.height, m.bits, m.quality})
        EXPECT_EQ(n, 0);
    EXPECT_FALSE(m.kept);
    EXPECT_FALSE(m.alsoElsewhere);
    EncodedLike e;
    EXPECT_EQ(e.quality, 0);
    PrimitiveTangents p;
    EXPECT_EQ(p.mesh, 0u);
    EXPECT_EQ(p.primitive, 0u);
    EXPECT_EQ(p.triangles, 0u);
    EXPECT_FALSE(p.stored);
    EXPECT_FALSE(p.generated);
    EXPECT_FALSE(p.difference);
    TangentDifference d;
    EXPECT_EQ(d.corners, 0u);
    EXPECT_EQ(d.degenerate, 0u);
    EXPECT_EQ(d.handedness, 0u);
}

TEST(EmptyResults, ofMapsKnowNothing)
{
    maps::GreenVerdict g;
    EXPECT_TRUE(g.green == maps::Green::undecidable);
    EXPECT_TRUE(g.swapped == maps::Swapped::undecidable);
    EXPECT_TRUE(g.confidence == maps::Confidence::none);
    for (const double x : {g.agreement, g.exchanged, g.deviations, g.votes, g.used})
        EXPECT_EQ(x, 0);
    EXPECT_EQ(g.residualRatio, 1);
    EXPECT_EQ(g.sampled, 1);
    maps::NormalStatistics s;
    EXPECT_TRUE(s.content == maps::Content::other);
    EXPECT_TRUE(s.centre == maps::Centre::unknown);
    EXPECT_TRUE(s.transfer == maps::Transfer::linear);
    EXPECT_FALSE(s.redIsZ);
    EXPECT_FALSE(s.eightBits);
    EXPECT_FALSE(s.signedStored);
    EXPECT_EQ(s.texels, 0u);
    for (const double x : {s.background, s.invalid, s.belowHorizon, s.outsideDisc, s.meanLength, s.lengthDeviation,
                           s.shortened, s.meanTilt, s.rmsExact, s.rmsBiased})
        EXPECT_EQ(x, 0);
    maps::Heights h;
    for (const double x : {h.lowest, h.highest, h.slope, h.residual, h.meanTilt})
        EXPECT_EQ(x, 0);
    EXPECT_EQ(h.invalid, 0u);
    ConvertedFile c;
    EXPECT_EQ(c.width, 0);
    EXPECT_EQ(c.height, 0);
    EXPECT_EQ(c.covered, 0u);
    EXPECT_EQ(ToHeightFile().unit, 1);
}

TEST(EmptyResults, ofGltfNameNothing)
{
    gltf::Node n;
    for (const int index : {n.mesh, n.skin, n.camera, n.light})
        EXPECT_EQ(index, -1);
    EXPECT_EQ(n.translation, glm::dvec3(0));
    EXPECT_EQ(n.scale, glm::dvec3(1));
    EXPECT_EQ(n.rotation, glm::dvec4(0, 0, 0, 1));
    gltf::TextureUse t;
    EXPECT_EQ(t.texture, -1);
    EXPECT_EQ(t.texcoord, 0);
    EXPECT_EQ(t.uRow, glm::dvec3(1, 0, 0));
    EXPECT_EQ(t.vRow, glm::dvec3(0, 1, 0));
    EXPECT_EQ(t.scale, 1);
    EXPECT_EQ(t.strength, 1);
}

TEST(EmptyResults, ofImagesAndSamplesHaveNoSize)
{
    Image i;
    EXPECT_EQ(i.width, 0);
    EXPECT_EQ(i.height, 0);
    EXPECT_EQ(i.channels, 4);
    RowFormat r;
    EXPECT_EQ(r.width, 0);
    EXPECT_EQ(r.height, 0);
    EXPECT_FALSE(r.alpha);
    EXPECT_FALSE(r.half);
    GroundMap g;
    EXPECT_EQ(g.height, 0);
    EXPECT_EQ(g.low, glm::vec2(0));
    EXPECT_EQ(g.extent, glm::vec2(1));
    Bounds b;
    EXPECT_TRUE(b.empty());
    ProblemArea h;
    EXPECT_EQ(h.mesh, 0u);
    EXPECT_EQ(h.share, 0);
    EXPECT_EQ(h.severity, 0);
    EXPECT_FALSE(h.storedTangents);
}

TEST(EmptyResults, ofJobsHaveTakenNoTime)
{
    JobRecord r;
    EXPECT_EQ(r.runs, 0);
    EXPECT_EQ(r.seconds, 0);
    EXPECT_EQ(r.processorSeconds, 0);
    EXPECT_EQ(r.megabytes, 0);
    EXPECT_EQ(r.at, 0);
    JobResult j;
    EXPECT_EQ(j.job, 0u);
    EXPECT_FALSE(j.kept);
    EXPECT_EQ(Job().line, 0u);
    EXPECT_FALSE(Job().threads);
    SmoothStatistics s;
    EXPECT_EQ(s.vertices, 0u);
    EXPECT_EQ(s.added, 0u);
    EXPECT_EQ(s.without, 0u);
}

} // namespace
} // namespace cotan
