// Lint's advice on hand-made reports, with each limit from both sides.
#include <gtest/gtest.h>

#include "bake/lint/map_fit.hpp"
#include "cotan/lint.hpp"
#include "lint_advice.hpp"
#include "lint_parts.hpp"

namespace cotan {
namespace {

ValueSummary summaryAt(double mean, double percentile95) { return {100, mean, percentile95, 2 * percentile95}; }

// A primitive whose normal map has the given errors in degrees when it is read with orthonormal.
PrimitiveLint judgedAs(double mean, double percentile95, double area = 1)
{
    PrimitiveLint p;
    p.mesh = "some mesh";
    p.image = 0;
    p.triangles = 2;
    p.hasUv = true;
    p.uv.area = area;
    p.steps.edges = 1;
    p.steps.cotangent = summaryAt(0.1, 0.2);
    p.readings = {{"cotangent", summaryAt(7.25, 9)}, {"orthonormal", summaryAt(mean, percentile95)}};
    return p;
}

MapFit fitAs(double orthonormal95, double cotangent95 = 9, double smooth95 = 9)
{
    return {{summaryAt(0, orthonormal95), summaryAt(0, cotangent95), summaryAt(0, smooth95)}, 0, "map"};
}

LintReport advisedOn(std::vector<PrimitiveLint> primitives, std::vector<MapFit> fits = {fitAs(9)},
                     std::vector<GreenEvidence> maps = {}, std::vector<FrameDecision> decisions = {})
{
    return adviceOn(std::move(primitives), std::move(fits), std::move(maps), std::move(decisions));
}

FrameDecision readWith(std::size_t mesh, Frame frame)
{
    return {.mesh = mesh, .reason = ChoiceReason::fits, .frame = frame};
}

FrameDecision keepsAt(std::size_t mesh)
{
    return {.mesh = mesh,
            .meaning = MapMeaning::stored,
            .reason = ChoiceReason::keeps,
            .frame = Frame::mikktspace,
            .tangents = TangentOrigin::stored};
}

PrimitiveLint withTangents(PrimitiveLint p)
{
    p.stored = {true, 0, 0, summaryAt(0, 0)};
    return p;
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(Recommend, theFramesAreThoseOfTheDecisions)
{
    const PrimitiveLint p = withTangents(judgedAs(4, 5));
    const LintReport r = advisedOn(
        {p, p, p, p}, {fitAs(9)}, {},
        {readWith(0, Frame::smooth), readWith(1, Frame::orthonormal), readWith(2, Frame::smooth), keepsAt(3)});
    EXPECT_EQ(r.advice, Advice::readChosen);
    EXPECT_EQ(frameOf(r), Frame::smooth); // of most meshes
    EXPECT_EQ(r.dropping, 3u);
    EXPECT_EQ(r.keeping, 1u);
    EXPECT_EQ(r.advised,
              "Read the maps with orthonormal (1), smooth (2) as they are; the command drops the tangents. "
              "Those of 1 primitive stay.");
    const LintReport one = advisedOn({p, p}, {fitAs(9)}, {}, {readWith(0, Frame::smooth), readWith(1, Frame::smooth)});
    EXPECT_EQ(one.advised, "Read the maps with smooth as they are; the command drops the tangents.");
    const LintReport none = advisedOn({p, p}, {fitAs(9)}, {}, {keepsAt(0), keepsAt(1)});
    EXPECT_EQ(none.dropping, 0u);
    EXPECT_EQ(none.advised, "Keep the tangents: without them the difference would be visible.");
    const LintReport bare = advisedOn({judgedAs(4, 5)}, {fitAs(9)}, {}, {readWith(0, Frame::smooth)});
    EXPECT_EQ(bare.advised, "Nothing has to be changed: read the maps with smooth as they are.");
}

// Each placing of a mesh is reported, but the file has its tangents once.
TEST(Recommend, placingsOfAMeshCountOnce)
{
    LintReport r;
    r.primitives = {withTangents(judgedAs(4, 5)), withTangents(judgedAs(4, 5))};
    r.fits = {fitAs(9)};
    r.decisions = {readWith(0, Frame::smooth)};
    lint::recommend(r);
    EXPECT_EQ(r.dropping, 1u);
    EXPECT_EQ(r.keeping, 0u);
}

TEST(Recommend, frameNamedByTheFileIsAdvised)
{
    LintReport report;
    report.primitives = {judgedAs(7, 9)};
    report.fits = {fitAs(9)};
    report.named = Frame::smooth;
    report.decisions = {{.meaning = MapMeaning::named, .reason = ChoiceReason::named, .frame = Frame::smooth}};
    lint::recommend(report);
    EXPECT_EQ(report.advice, Advice::readNamed);
    EXPECT_EQ(frameOf(report), Frame::smooth);
    EXPECT_EQ(report.dropping, 0u);
    EXPECT_TRUE(says(report.advised, "read the maps with the frame smooth as they are")) << report.advised;
    EXPECT_TRUE(says(report.seen, "its maps are for the frame smooth; read with orthonormal, their error is 7.00"))
        << report.seen;
}

TEST(Recommend, largerAreasWeighMore)
{
    // 9:1 gives 0.45 on average, 1:9 gives 3.6.
    EXPECT_TRUE(says(advisedOn({judgedAs(0.05, 0.1, 9), judgedAs(4, 5, 1)}).seen, "the error is 0.45 degrees"));
    EXPECT_TRUE(says(advisedOn({judgedAs(0.05, 0.1, 1), judgedAs(4, 1.9, 9)}).seen, "the error is 3.60 degrees"));
}

TEST(Recommend, unmeasuredPrimitiveDoesNotDiluteTheOthers)
{
    PrimitiveLint nothing = judgedAs(0, 0, 1000);
    for (Reading& r : nothing.readings)
        r.error = {};
    EXPECT_TRUE(says(advisedOn({nothing, judgedAs(4, 5)}).seen, "the error is 4.00 degrees"));
    const LintReport alone = advisedOn({nothing});
    EXPECT_EQ(alone.advice, Advice::nothing);
    EXPECT_TRUE(alone.seen.empty());
}

TEST(Recommend, visibilityHasThreeLevels)
{
    EXPECT_TRUE(says(advisedOn({judgedAs(0.3, 1)}).seen, "the difference is invisible"));
    EXPECT_TRUE(says(advisedOn({judgedAs(0.31, 1)}).seen, "moving highlights"));
    EXPECT_TRUE(says(advisedOn({judgedAs(4.9, 9)}).seen, "moving highlights"));
    EXPECT_TRUE(says(advisedOn({judgedAs(5.1, 9)}).seen, "from elsewhere"));
    EXPECT_TRUE(says(advisedOn({judgedAs(5.1, 9)}).seen,
                     "5.10 degrees on average with the frame orthonormal (7.25 with cotangent)"));
}

// As for the choice of the frame, which measures at other points than the readings.
TEST(Recommend, whatIsInvisibleIsWhatTheChoiceOfTheFrameAllows)
{
    const auto seenAt = [](double mean, double percentile99, Frame chosen, double reading) {
        FrameDecision d = readWith(0, chosen);
        d.candidates = {{Frame::orthonormal, TangentOrigin::generated, 100, mean, 0.2, percentile99, 9}};
        return advisedOn({judgedAs(reading, 1)}, {fitAs(9)}, {}, {d});
    };
    const LintReport within = seenAt(0.29, 2.9, Frame::orthonormal, 0.32);
    EXPECT_TRUE(says(within.seen, "the difference is invisible: the error is 0.32")) << within.seen;
    EXPECT_TRUE(says(within.advised, "read the maps with orthonormal")) << within.advised;
    EXPECT_EQ(within.worst, "");
    for (const auto& [mean, percentile99] : {std::pair(0.31, 2.9), {0.29, 3.1}}) {
        const LintReport over = seenAt(mean, percentile99, Frame::mikktspace, 0.28);
        EXPECT_TRUE(says(over.seen, "moving highlights show a difference")) << over.seen;
        EXPECT_TRUE(says(over.advised, "read the maps with mikktspace")) << over.advised;
        EXPECT_TRUE(says(over.worst, "0.28 degrees on average")) << over.worst;
    }
}

TEST(Recommend, worstVisiblePrimitiveIsNamed)
{
    PrimitiveLint a = judgedAs(0.6, 1), b = judgedAs(0.9, 1.5), c = judgedAs(0.1, 0.2, 1000);
    a.mesh = "first";
    b.mesh = "second";
    c.mesh = "third";
    EXPECT_TRUE(says(advisedOn({a, b, c}).worst, "in second: 0.90 degrees on average, over 1.5 on 5 % of its area."));
    EXPECT_TRUE(says(advisedOn({b, a, c}).worst, "in second"));
    EXPECT_EQ(advisedOn({c}).worst, "");
    b.readings[1].error = summaryAt(0.2, 3.1); // rarely, but by much
    EXPECT_TRUE(says(advisedOn({b, c}).worst, "in second"));
    b.readings[1].error = summaryAt(0.2, 2.9);
    EXPECT_EQ(advisedOn({b, c}).worst, "");
}

TEST(Recommend, tangentsWithoutOtherReadersAreDropped)
{
    PrimitiveLint p = judgedAs(0.1, 0.2);
    EXPECT_EQ(advisedOn({p}, {fitAs(0.1)}).dropping, 0u);
    p = withTangents(p);
    const LintReport r = advisedOn({p}, {fitAs(0.1)});
    EXPECT_EQ(r.dropping, 1u);
    EXPECT_TRUE(says(r.advised, "as they are; the command drops the tangents")) << r.advised;
    p.tangentsFor = "KHR_materials_anisotropy";
    EXPECT_EQ(advisedOn({p}, {fitAs(0.1)}).dropping, 0u);
    EXPECT_EQ(advisedOn({p}, {fitAs(0.1)}).keeping, 1u);
    p.tangentsFor.clear();
    p.unread = true;
    EXPECT_EQ(advisedOn({p}, {fitAs(0.1)}).dropping, 0u);
    p.unread = false;
    PrimitiveLint bare = judgedAs(0.1, 0.2);
    EXPECT_EQ(advisedOn({p, bare}, {fitAs(0.1)}).dropping, 1u);
    EXPECT_EQ(advisedOn({bare, p}, {fitAs(0.1)}).dropping, 1u);
}

PrimitiveLint storedAs(double reversedW, double turned, double area = 1)
{
    PrimitiveLint p = judgedAs(0.1, 0.2, area);
    p.stored = {true, reversedW, turned, summaryAt(1, 2)};
    return p;
}

GreenEvidence greenAs(bool decided, bool asDeclared, const std::string& name)
{
    GreenEvidence g;
    g.image = 3;
    g.name = name;
    g.declaredUp = true;
    g.verdict.green = !decided ? maps::Green::undecidable : asDeclared ? maps::Green::up : maps::Green::down;
    return g;
}

TEST(Recommend, storedTangentsAreDistrustedFrom10PercentOfTheArea)
{
    // One map determines that green is as declared.
    const auto withEvidence = [](std::vector<PrimitiveLint> primitives) {
        return advisedOn(std::move(primitives), {fitAs(9)}, {greenAs(true, true, "bumps")});
    };
    EXPECT_FALSE(withEvidence({storedAs(0.09, 0)}).distrustStored);
    EXPECT_TRUE(withEvidence({storedAs(0.11, 0)}).distrustStored);
    EXPECT_FALSE(withEvidence({storedAs(0, 0.09)}).distrustStored);
    EXPECT_TRUE(withEvidence({storedAs(0, 0.11)}).distrustStored);
    // 0.5 on a third of the area is 0.17 of the total, on a ninth 0.06.
    EXPECT_TRUE(withEvidence({storedAs(0.5, 0, 1), storedAs(0, 0, 2)}).distrustStored);
    EXPECT_FALSE(withEvidence({storedAs(0.5, 0, 1), storedAs(0, 0, 8)}).distrustStored);
    PrimitiveLint unmapped = storedAs(1, 1, 100);
    unmapped.image = -1;
    unmapped.readings.clear();
    EXPECT_FALSE(withEvidence({storedAs(0, 0), unmapped}).distrustStored);
    PrimitiveLint unmeasured = storedAs(1, 1, 100);
    unmeasured.stored.angle = {};
    EXPECT_FALSE(withEvidence({storedAs(0, 0), unmeasured}).distrustStored);
}

TEST(Recommend, storedTangentsAreTrustedIfGreenIsUndecidable)
{
    for (const PrimitiveLint& p : {storedAs(1, 0), storedAs(0.5, 0), storedAs(0, 1)}) {
        const LintReport r = advisedOn({p}, {fitAs(9)}, {greenAs(false, false, "bumps")});
        EXPECT_FALSE(r.distrustStored);
        EXPECT_TRUE(says(r.defects, "so the tangents are trusted")) << r.defects;
    }
}

TEST(Recommend, tangentDefectsAreStatedInPercentOfArea)
{
    EXPECT_TRUE(advisedOn({storedAs(0.09, 0.05)}).defects.empty());
    EXPECT_TRUE(says(advisedOn({storedAs(0.49, 0.2)}).defects,
                     "contradict the uv: w is reversed on 49 % of the area, the tangent is rotated by more than 45 "
                     "degrees on 20 %"));
    EXPECT_EQ(advisedOn({storedAs(0.51, 0.2)}, {}, {greenAs(true, true, "bumps")}).defects,
              "The stored TANGENT.w is reversed on 51 % of the area.");
}

TEST(Recommend, reversedWAndReversedGreenCancelOut)
{
    const std::vector<GreenEvidence> other = {greenAs(true, false, "bumps")};
    const LintReport both = advisedOn({storedAs(0.51, 0)}, {fitAs(9)}, other);
    EXPECT_FALSE(both.distrustStored);
    EXPECT_TRUE(says(both.defects, "together they cancel out"));
    const LintReport less = advisedOn({storedAs(0.49, 0)}, {fitAs(9)}, other);
    EXPECT_FALSE(less.distrustStored); // neither is right everywhere, so nothing changes
    EXPECT_TRUE(says(less.defects, "contradict the uv") && says(less.defects, "Green seems to be flipped in bumps"))
        << less.defects;
    EXPECT_TRUE(
        advisedOn({storedAs(0.51, 0)}, {fitAs(9)}, {greenAs(true, true, "bumps")}).distrustStored); // as declared
    EXPECT_TRUE(says(advisedOn({judgedAs(0.1, 0.2)}, {fitAs(9)}, {greenAs(true, false, "")}).defects, "in image 3 "));
}

TEST(Recommend, greenIsReversedAboutTheZeroCodeOfTheMap)
{
    std::vector<GreenEvidence> given = {greenAs(true, false, "a"), greenAs(true, false, "b"),
                                        greenAs(true, true, "sound")};
    given[0].verdict.statistics.centre = maps::Centre::biased;
    const char* const about128 = "(cotan map convert --from directx --to opengl flips it back)";
    EXPECT_TRUE(says(advisedOn({judgedAs(0.1, 0.2)}, {}, given).defects, about128));
    given[1].verdict.statistics.centre = maps::Centre::biased;
    EXPECT_TRUE(says(advisedOn({judgedAs(0.1, 0.2)}, {}, given).defects,
                     "(cotan map convert --from directx,biased --to opengl,biased flips it back)"));
}

TEST(Recommend, atMostThreeNamesAreListed)
{
    std::vector<GreenEvidence> maps;
    for (const char* name : {"a", "b", "c", "d", "e"})
        maps.push_back(greenAs(true, false, name));
    EXPECT_TRUE(says(advisedOn({judgedAs(0.1, 0.2)}, {}, maps).defects, "in a, b, c and 2 more "));
    maps.resize(4);
    EXPECT_TRUE(says(advisedOn({judgedAs(0.1, 0.2)}, {}, maps).defects, "in a, b, c and 1 more "));
    maps.resize(3);
    EXPECT_TRUE(says(advisedOn({judgedAs(0.1, 0.2)}, {}, maps).defects, "in a, b, c ("));
}

TEST(Recommend, tangentsWithoutMapCanBeDroppedUnlessReadElsewhere)
{
    PrimitiveLint p;
    EXPECT_TRUE(says(advisedOn({p}, {}).advised, "can be dropped"));
    EXPECT_TRUE(says(advisedOn({}, {}).advised, "can be dropped"));
    p.material = "hair";
    p.tangentsFor = "KHR_materials_anisotropy";
    const LintReport r = advisedOn({p, p}, {});
    EXPECT_FALSE(says(r.recommendation, "can be dropped"));
    EXPECT_TRUE(says(r.otherReaders, "for them: hair (KHR_materials_anisotropy).")) << r.otherReaders; // named once
    EXPECT_EQ(r.advice, Advice::nothing);
}

TEST(Recommend, unjudgedMapIsNamedAndIgnored)
{
    PrimitiveLint p;
    p.mesh = "door";
    p.image = 0;
    p.hasUv = true;
    p.unread = true;
    p.notJudged = "door.webp (WebP) was not read";
    const LintReport alone = advisedOn({p}, {MapFit{}});
    EXPECT_FALSE(says(alone.recommendation, "can be dropped")) << alone.recommendation;
    EXPECT_TRUE(says(alone.notJudged, "door (door.webp (WebP) was not read)")) << alone.notJudged;
    const LintReport both = advisedOn({p, judgedAs(4, 5)});
    EXPECT_EQ(both.advice, Advice::readChosen);
    EXPECT_TRUE(says(both.recommendation, "could not be judged in door"));
}

TEST(Recommend, recommendationIsAllSentencesJoined)
{
    PrimitiveLint p = storedAs(0.6, 0);
    p.tangentsFor = "KHR_materials_clearcoat";
    const LintReport r = advisedOn({p});
    EXPECT_EQ(r.recommendation, r.defects + " " + r.seen + " " + r.advised + " " + r.otherReaders);
}

} // namespace
} // namespace cotan
