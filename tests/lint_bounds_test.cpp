// Lint's verdicts exactly at its limits, and their full sentences, on hand-made reports in which no two figures are
// equal.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bake/lint/map_fit.hpp"
#include "cotan/lint.hpp"
#include "lint_advice.hpp"
#include "lint_parts.hpp"

namespace cotan {
namespace {

constexpr double kJustOver = 1 + 1e-9;

// A summary of a single value, the fewest that count.
ValueSummary oneValue(double mean, double percentile95) { return {1, mean, percentile95, 2 * percentile95}; }

PrimitiveLint judgedAs(const std::string& mesh, double mean, double percentile95, double area = 1)
{
    PrimitiveLint p;
    p.mesh = mesh;
    p.image = 0;
    p.triangles = 2;
    p.hasUv = true;
    p.uv.area = area;
    p.steps = {1, oneValue(0.1, 0.2), {}};
    p.readings = {{"cotangent", oneValue(7.25, 9)}, {"orthonormal", oneValue(mean, percentile95)}};
    return p;
}

MapFit fitAs(double mean, double percentile95 = 9)
{
    return {{oneValue(mean, percentile95), oneValue(mean, percentile95), oneValue(mean, percentile95)}, 0, "map"};
}

GreenEvidence greenOf(const std::string& name, maps::Green green, int image = 3)
{
    GreenEvidence g{image, name, true, {}};
    g.verdict.green = green;
    g.verdict.confidence = maps::Confidence::certain;
    return g;
}

LintReport advisedOn(std::vector<PrimitiveLint> primitives, std::vector<MapFit> fits = {fitAs(9)},
                     std::vector<GreenEvidence> maps = {})
{
    return adviceOn(std::move(primitives), std::move(fits), std::move(maps));
}

PrimitiveLint storedAs(double reversedW, double turned, double area = 1)
{
    PrimitiveLint p = judgedAs("stored", 0.1, 0.2, area);
    p.stored = {true, reversedW, turned, oneValue(1, 2)};
    return p;
}

// ---- checks -----------------------------------------------------------------------------------

std::vector<std::string> textsOf(const LintCheck& check)
{
    std::vector<std::string> texts;
    for (const LintFailure& f : check.failures)
        texts.push_back(f.kind + " | " + f.text);
    return texts;
}

using Texts = std::vector<std::string>;

TEST(LintCheck, valuesAtALimitPassAndValuesOverItFail)
{
    struct Case {
        const char* kind;
        double PrimitiveLint::*precision;
        double UvQuality::*uv;
        double StoredTangents::*stored;
        double factor; // factor from the unit of the limits to that of the value
    };
    const Case cases[] = {{"reading", nullptr, nullptr, nullptr, 1},
                          {"rounding", &PrimitiveLint::precision, nullptr, nullptr, 1},
                          {"degenerate_uv", nullptr, &UvQuality::degenerate, nullptr, 0.01},
                          {"mirrored_overlap", nullptr, &UvQuality::overlappingMirrored, nullptr, 0.01},
                          {"reversed_w", nullptr, nullptr, &StoredTangents::reversedW, 0.01},
                          {"rotated_tangents", nullptr, nullptr, &StoredTangents::rotated, 0.01}};
    for (const Case& c : cases)
        for (const double limit : {0.0, 25.0}) {
            const auto checkAt = [&](double value) {
                PrimitiveLint p = judgedAs("door", 0, 0);
                double& field = c.precision ? p.*c.precision
                    : c.uv                  ? p.uv.*c.uv
                    : c.stored              ? p.stored.*c.stored
                                            : p.readings[1].error.percentile95;
                field = value * c.factor;
                LintReport report;
                report.primitives = {p};
                return checkLimits(report, c.factor == 1 ? LintLimits{.degrees = limit} : LintLimits{.area = limit});
            };
            EXPECT_TRUE(checkAt(limit).passed()) << c.kind << " " << limit;
            const LintCheck over = checkAt(limit + 0.5);
            ASSERT_EQ(over.failures.size(), 1u) << c.kind << " " << limit;
            const LintFailure& f = over.failures[0];
            EXPECT_EQ(f.kind, c.kind);
            EXPECT_DOUBLE_EQ(f.value, limit + 0.5);
            EXPECT_EQ(f.limit, limit);
            EXPECT_EQ(f.percent, c.factor != 1) << c.kind;
            EXPECT_EQ(f.beside.empty(), std::string(c.kind) != "reading");
        }
}

TEST(LintCheck, failuresAreSentencesWithNamesAndFigures)
{
    PrimitiveLint p = judgedAs("door", 1.5, 3);
    p.material = "oak";
    p.placing = 1;
    p.placings = 4;
    p.precision = 7.5;
    p.uv.degenerate = 0.02;
    p.uv.overlappingMirrored = 0.03;
    p.stored = {true, 0.04, 0.055, oneValue(1, 2)};
    PrimitiveLint unread = judgedAs("", 0, 0);
    unread.readings.clear();
    unread.unread = true;
    unread.notJudged = "x.webp was not read";
    LintReport report;
    report.primitives = {p, unread};
    report.maps = {greenOf("bumps", maps::Green::down), greenOf("", maps::Green::down, 7),
                   greenOf("right", maps::Green::up)};
    const LintCheck check = checkLimits(report, {.degrees = 1, .area = 1});
    const std::string door = "door, material oak, node scaling 2 of 4";
    EXPECT_EQ(textsOf(check),
              (Texts{"reading | " + door + ": 95th percentile of the error with orthonormal 3 degrees, limit 1",
                     "rounding | " + door + ": rounding 7.5 degrees, limit 1",
                     "degenerate_uv | " + door + ": degenerate uv on 2 % of the area, limit 1",
                     "mirrored_overlap | " + door + ": uv overlapping in both orientations on 3 % of the area, limit 1",
                     "reversed_w | " + door + ": TANGENT.w contradicting the uv on 4 % of the area, limit 1",
                     "rotated_tangents | " + door + ": stored tangents rotated on 5.5 % of the area, limit 1",
                     "not_judged | primitive 1: not judged, x.webp was not read",
                     "reversed_green | normal map bumps: green points opposite to what the file says (certain)",
                     "reversed_green | normal map image 7: green points opposite to what the file says (certain)"}));
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(check.failures[i].where, door);
        EXPECT_EQ(check.failures[i].mesh, "door");
        EXPECT_EQ(check.failures[i].material, "oak");
        EXPECT_EQ(check.failures[i].map, "");
    }
    EXPECT_EQ(check.failures[6].where, "primitive 1");
    EXPECT_EQ(check.failures[6].limit, -1);
    EXPECT_EQ(check.failures[7].map, "bumps");
    EXPECT_EQ(check.failures[8].where, "image 7");
}

TEST(LintCheck, modelWithoutJudgedMapsFailsOnce)
{
    PrimitiveLint p = judgedAs("door", 0, 0);
    p.readings.clear();
    p.notJudged = "no uv";
    LintReport report;
    report.primitives = {p};
    EXPECT_EQ(textsOf(checkLimits(report, {.degrees = 1})), (Texts{"not_judged | no normal map could be judged"}));
    EXPECT_EQ(checkLimits(report, {.degrees = 0}).failures.at(0).where, "");
    EXPECT_TRUE(checkLimits(report, {.area = 1}).passed());
    report.primitives[0].precision = 2; // another failure replaces the message
    EXPECT_EQ(textsOf(checkLimits(report, {.degrees = 1})), (Texts{"rounding | door: rounding 2 degrees, limit 1"}));
    report.primitives[0].image = -1; // rounding concerns a map
    EXPECT_TRUE(checkLimits(report, {.degrees = 1}).passed());
}

// A primitive without area does not count in the model's mean; if there is no other, its own mean is used.
TEST(LintCheck, meanOfAModelWithoutAreaIsThatOfThePrimitive)
{
    LintReport report;
    report.primitives = {judgedAs("door", 1.5, 3, 0)};
    EXPECT_EQ(checkLimits(report, {.degrees = 1}).failures.at(0).beside,
              "the limit applies to each primitive; the mean of this one is 1.5, of the model 1.5");
}

// ---- recommendations --------------------------------------------------------------------------

TEST(Recommend, valuesExactlyAtALimitAreOnTheDefinedSide)
{
    // A tenth of the area, if a map determines green.
    const std::vector<GreenEvidence> evidence = {greenOf("bumps", maps::Green::up)};
    EXPECT_FALSE(advisedOn({storedAs(0.1, 0.1)}, {fitAs(9)}, evidence).distrustStored);
    EXPECT_TRUE(advisedOn({storedAs(0.1 * kJustOver, 0)}, {fitAs(9)}, evidence).distrustStored);
    EXPECT_TRUE(advisedOn({storedAs(0, 0.1 * kJustOver)}, {fitAs(9)}, evidence).distrustStored);
    // Half of the area: with reversed green that is still a contradiction; above half, the two compensate each other.
    const std::vector<GreenEvidence> both = {greenOf("sound", maps::Green::up), greenOf("bumps", maps::Green::down)};
    EXPECT_TRUE(advisedOn({storedAs(0.5, 0)}, {fitAs(9)}, both).distrustStored);
    EXPECT_FALSE(advisedOn({storedAs(0.5 * kJustOver, 0)}, {fitAs(9)}, both).distrustStored);
}

TEST(Recommend, visibilityIsOneSentence)
{
    const auto sentence = [](const std::string& how, const std::string& mean) {
        return "If the maps were made for MikkTSpace and are read without tangents, " + how + ": the error is " + mean
            + " degrees on average with the frame orthonormal (7.25 with cotangent).";
    };
    EXPECT_EQ(advisedOn({judgedAs("a", 0.25, 1)}).seen, sentence("the difference is invisible", "0.25"));
    EXPECT_EQ(advisedOn({judgedAs("a", 4.996, 9)}).seen, sentence("moving highlights show a difference", "5.00"));
    EXPECT_EQ(advisedOn({judgedAs("a", 5, 9)}).seen, sentence("the light seems to come from elsewhere", "5.00"));
}

TEST(Recommend, firstOfEqualWorstPrimitivesIsNamed)
{
    const auto worst = [](std::vector<PrimitiveLint> all) { return advisedOn(std::move(all)).worst; };
    const auto said = [](const std::string& name, const char* figures) {
        return "The largest error is in " + name + ": " + figures + " on 5 % of its area.";
    };
    EXPECT_EQ(worst({judgedAs("a", 0.3, 3), judgedAs("b", 0.1, 0.2)}), "");
    EXPECT_EQ(worst({judgedAs("a", 0.3 * kJustOver, 1), judgedAs("b", 0.1, 0.2)}),
              said("a", "0.30 degrees on average, over 1.0"));
    EXPECT_EQ(worst({judgedAs("a", 0.75, 1), judgedAs("b", 0.75, 3)}), said("a", "0.75 degrees on average, over 1.0"));
    PrimitiveLint unnamed = judgedAs("", 3, 8.25);
    EXPECT_EQ(worst({judgedAs("a", 2, 4), unnamed}), said("a primitive", "3.00 degrees on average, over 8.2"));
    unnamed.material = "oak";
    EXPECT_EQ(worst({unnamed, judgedAs("a", 2, 4)}), said("oak", "3.00 degrees on average, over 8.2"));
}

TEST(Recommend, eachAdviceIsOneSentence)
{
    const PrimitiveLint good = judgedAs("a", 0.1, 0.2);
    const auto withTangents = [](PrimitiveLint p) {
        p.stored = {true, 0, 0, oneValue(0, 0)};
        return p;
    };
    const auto advised = [](const PrimitiveLint& p, std::vector<GreenEvidence> maps = {}) {
        return advisedOn({p}, {fitAs(0.1, 0.1)}, std::move(maps)).advised;
    };
    EXPECT_EQ(advised(good), "Nothing has to be changed: read the maps with orthonormal as they are.");
    EXPECT_EQ(advised(withTangents(good)),
              "Read the maps with orthonormal as they are; the command drops the tangents.");
    EXPECT_EQ(advised(good, {greenOf("bumps", maps::Green::down)}),
              "Fix the maps; then they can be read with orthonormal.");
}

// Broken image files: nothing to convert, but something to fix.
TEST(Recommend, brokenMapsAreListed)
{
    GreenEvidence first = greenOf("", maps::Green::undecidable, 5), second = greenOf("bark", maps::Green::undecidable);
    maps::NormalStatistics eightBits;
    eightBits.content = maps::Content::tangentSpace;
    eightBits.meanLength = 1;
    eightBits.eightBits = true;
    for (GreenEvidence* g : {&first, &second}) {
        g->faults = maps::faultsInModel(eightBits);
        ASSERT_EQ(g->faults.size(), 1u);
        g->sentence = maps::sentenceOf(g->name.empty() ? "Image 5" : g->name, g->faults, eightBits);
    }
    const LintReport r =
        advisedOn({judgedAs("a", 0.1, 0.2)}, {fitAs(0.1)}, {first, greenOf("sound", maps::Green::up), second});
    EXPECT_EQ(r.defects.find("Image 5: its 16-bit values are all multiples of an 8-bit step"), 0u) << r.defects;
    EXPECT_NE(r.defects.find(" bark: its 16-bit values"), std::string::npos) << r.defects;
    EXPECT_EQ(r.defects.find("sound"), std::string::npos) << r.defects;
    EXPECT_EQ(r.advised, "Fix the maps; then they can be read with orthonormal.");
}

TEST(Recommend, tangentAndGreenDefectsAreSentences)
{
    const auto defects = [](const PrimitiveLint& p, std::vector<GreenEvidence> maps = {}) {
        return advisedOn({p}, {fitAs(9)}, std::move(maps)).defects;
    };
    const GreenEvidence up = greenOf("sound", maps::Green::up), down = greenOf("", maps::Green::down, 4);
    const std::string followed = " The maps do not show whether green is right, so the tangents are trusted.";
    const std::string contradict = "The stored tangents contradict the uv: w is reversed on 20 % of the area, the "
                                   "tangent is rotated by more than 45 degrees on 30 %.";
    EXPECT_EQ(defects(storedAs(0.1, 0.1)), "");
    EXPECT_EQ(defects(storedAs(0.5, 0), {up}).find("The stored tangents contradict the uv: w is reversed on 50 %"), 0u);
    EXPECT_EQ(defects(storedAs(0.2, 0.3), {up}), contradict);
    EXPECT_EQ(defects(storedAs(0.2, 0.3)), contradict + followed);
    EXPECT_EQ(defects(storedAs(0.7, 0.3)), "The stored TANGENT.w is reversed on 70 % of the area." + followed);
    EXPECT_EQ(
        defects(storedAs(0.7, 0.3), {down}),
        "The stored TANGENT.w is reversed on 70 % of the area and green is flipped in image 4: together they cancel "
        "out, each alone is wrong.");
    EXPECT_EQ(defects(storedAs(0.2, 0.3), {down}),
              contradict
                  + " Green seems to be flipped in image 4 (cotan map convert --from directx --to opengl flips it "
                    "back).");
}

TEST(Recommend, defectPercentagesAreAveragedByArea)
{
    // 40 % of 1 and 12 % of 3 are 19 %; 8 % of 1 and 60 % of 3 are 47 %.
    EXPECT_NE(advisedOn({storedAs(0.4, 0.08, 1), storedAs(0.12, 0.6, 3)})
                  .defects.find("w is reversed on 19 % of the area, the tangent is rotated by more than 45 degrees on "
                                "47 %"),
              std::string::npos);
}

TEST(Recommend, tangentsAreKeptForOtherReadersOverFiveDegrees)
{
    const auto reading = [](double orthonormal, double cotangent, double smooth) {
        PrimitiveLint p = judgedAs("a", 4, 5);
        p.tangentsFor = "KHR_materials_anisotropy";
        p.rotation = {oneValue(0, orthonormal), oneValue(0, cotangent), oneValue(0, smooth)};
        p.stored = {true, 0, 0, oneValue(0, 0)};
        return p;
    };
    const std::string stay = "Tangents are also read by unconverted extensions and are kept for them: a material "
                             "(KHR_materials_anisotropy).";
    for (const auto& [turned, stays] : {std::pair(5.0, false), {5 * kJustOver, true}})
        for (const Frame frame : {Frame::orthonormal, Frame::smooth}) { // with the frame that is chosen
            const bool smooth = frame == Frame::smooth;
            const double other = stays ? 0 : 9;
            const LintReport r = adviceOn({reading(smooth ? other : turned, other, smooth ? turned : other)},
                                          {fitAs(9)}, {}, {{.reason = ChoiceReason::fits, .frame = frame}});
            EXPECT_EQ(r.otherReaders, stays ? stay : "") << name(frame);
            EXPECT_EQ(r.dropping, stays ? 0u : 1u) << name(frame);
        }
}

TEST(Recommend, eachCaseWithoutAJudgedMapHasItsSentence)
{
    PrimitiveLint bare;
    bare.mesh = "wall";
    EXPECT_EQ(advisedOn({bare}, {}).advised,
              "No primitive has a normal map and uv to read it with: nothing here uses tangents, they can be dropped.");
    EXPECT_EQ(advisedOn({bare}, {fitAs(0)}).advised,
              "Only clear coats have normal maps: cotan convert judges each by itself.");
    PrimitiveLint hair = bare, unread = bare;
    hair.tangentsFor = "KHR_materials_anisotropy";
    hair.rotation = {oneValue(0, 9), {}, {}};
    EXPECT_EQ(advisedOn({hair}, {}).advised,
              "No primitive has a normal map and uv to read it with: no normal map uses tangents.");
    unread.notJudged = "no uv";
    const LintReport r = advisedOn({unread}, {fitAs(0)});
    EXPECT_EQ(r.advised, "No normal map was judged, so nothing is advised.");
    EXPECT_EQ(r.notJudged, "The normal map could not be judged in wall (no uv).");
}

TEST(Recommend, namedFrameIsReadAndTangentsAreDropped)
{
    for (const auto& [frame, seen] :
         {std::pair(Frame::orthonormal, "The file says that its maps are for the frame orthonormal."),
          {Frame::cotangent,
           "The file says that its maps are for the frame cotangent; read with orthonormal, their error is 7.50 "
           "degrees on average."}}) {
        LintReport r;
        r.primitives = {judgedAs("a", 7.5, 9)};
        r.primitives[0].stored = {true, 0, 0, oneValue(0, 0)};
        r.fits = {fitAs(9, 9), fitAs(0.1, 0.1)};
        r.named = frame;
        r.decisions = {{.meaning = MapMeaning::named, .reason = ChoiceReason::named, .frame = frame}};
        lint::recommend(r);
        EXPECT_EQ(frameOf(r), frame);
        EXPECT_EQ(r.seen, seen);
        EXPECT_EQ(r.worst, "");
        EXPECT_EQ(r.dropping, 1u);
    }
}

TEST(Recommend, sentencesAreInFixedOrder)
{
    PrimitiveLint p = storedAs(0.7, 0.3), unread = judgedAs("wall", 0, 0);
    p.readings[1].error = oneValue(4, 5);
    p.tangentsFor = "KHR_materials_anisotropy";
    unread.readings.clear();
    unread.notJudged = "no uv";
    const LintReport r = advisedOn({p, unread});
    EXPECT_FALSE(r.worst.empty() || r.notJudged.empty() || r.otherReaders.empty());
    EXPECT_EQ(r.recommendation,
              r.defects + " " + r.seen + " " + r.worst + " " + r.advised + " " + r.notJudged + " " + r.otherReaders);
}

} // namespace
} // namespace cotan
