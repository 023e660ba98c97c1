// Lines and JSON of hand-made reports: all numbers differ, so each must appear under its name; lines for missing parts
// must be absent.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bake/reports.hpp"
#include "lint_lines.hpp"

namespace cotan {

using namespace app;
namespace {

using Lines = std::vector<std::string>;

nlohmann::json readBack(const Json& json) { return nlohmann::json::parse(toText(json)); }

ValueSummary summaryFrom(double mean) { return {7, mean, mean + 1, mean + 2}; }

// A primitive whose figures all differ.
PrimitiveLint primitive()
{
    PrimitiveLint p;
    p.mesh = "hull", p.material = "steel";
    p.triangles = 321;
    p.image = 4;
    p.hasUv = true;
    p.uv.area = 2;
    p.uv.degenerate = 0.011, p.uv.mirrored = 0.022, p.uv.overlapping = 0.033, p.uv.overlappingMirrored = 0.044;
    p.uv.stretched = 0.055, p.uv.sheared = 0.066, p.uv.gradient = 0.5, p.uv.largestUv = 3.5;
    p.uv.stretch = summaryFrom(11), p.uv.shear = summaryFrom(21);
    p.steps = {654, summaryFrom(31), summaryFrom(41)};
    p.stored = {true, 0.077, 0.088, summaryFrom(51)};
    p.readings = {{"cotangent", summaryFrom(61)}, {"smooth", summaryFrom(71)}};
    p.precision = 0.25, p.closest = 0.75;
    return p;
}

LintReport oneOf(const PrimitiveLint& p)
{
    LintReport report;
    report.primitives = {p};
    report.distance = 12;
    return report;
}

TEST(LintLines, detailsPrintEveryFigureOfAPrimitive)
{
    const Lines lines = detailLines(oneOf(primitive()));
    const Lines expected = {
        "Three values are mean / 95 % / maximum, weighted by area.",
        nameOf(primitive(), 0) + ": 321 triangles, normal map 4",
        "  uv: degenerate 1.1 %, mirrored 2.2 %, overlapping 3.3 % (in both orientations 4.4 %), stretch above 1.2 "
        "5.5 %, shear above 10 degrees 6.6 % of the area",
        "  stretch 11.00 / 12.00 / 13.00, shear 21.00 / 22.00 / 23.00 degrees",
        "  steps at 654 interior edges, texel tilted 35 degrees: cotangent 31.00 / 32.00 / 33.00, orthonormal 41.00 / "
        "42.00 / 43.00",
        "  stored tangents: w against the uv on 7.7 %, rotated by more than 45 degrees on 8.8 % of the area; 51.00 / "
        "52.00 / 53.00 degrees from dP/du",
        "  made for MikkTSpace, read with cotangent: 61.00 / 62.00 / 63.00",
        "  made for MikkTSpace, read with smooth: 71.00 / 72.00 / 73.00",
        "  rounding at distance 12: 0.25 degrees; half a degree at 0.75"};
    ASSERT_EQ(lines.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (i == 2) // the two limits are constants of lint
            EXPECT_EQ(lines[i].substr(0, 93), expected[i].substr(0, 93));
        else
            EXPECT_EQ(lines[i], expected[i]);
    }
}

TEST(LintLines, missingDataOfAPrimitiveIsStatedOrOmitted)
{
    const auto second = [](const PrimitiveLint& p) { return detailLines(oneOf(p)).at(2); };
    PrimitiveLint p = primitive();
    p.image = -1;
    EXPECT_EQ(detailLines(oneOf(p)).at(1), nameOf(p, 0) + ": 321 triangles, no normal map");
    p.uv.area = 0;
    EXPECT_EQ(second(p), "  nothing to measure: no area");
    p.hasUv = false;
    EXPECT_EQ(second(p), "  nothing to measure: no uv");
    p.triangles = 0;
    EXPECT_EQ(second(p), "  nothing to measure: no triangles");
    EXPECT_EQ(detailLines(oneOf(p)).size(), 3u);
    const auto has = [](const PrimitiveLint& one, const std::string& text) {
        for (const std::string& line : detailLines(oneOf(one)))
            if (line.find(text) != std::string::npos)
                return true;
        return false;
    };
    p = primitive();
    p.stored.angle.count = 0;
    EXPECT_TRUE(has(p, "stored tangents: nothing to compare them with"));
    p.stored.present = false;
    EXPECT_FALSE(has(p, "stored tangents"));
    p.notJudged = "too large";
    EXPECT_TRUE(has(p, "  normal map not judged: too large"));
    EXPECT_FALSE(has(p, "read with"));
    p.uv.gradient = 0;
    EXPECT_FALSE(has(p, "rounding"));
    p = primitive();
    p.madeFor = Frame::smooth;
    EXPECT_TRUE(has(p, "made for smooth, read with cotangent"));
}

// A report with different numbers of maps whose green is as declared, reversed, and undecidable.
LintReport withMaps()
{
    LintReport report = oneOf(primitive());
    report.primitives.push_back(primitive());
    report.primitives.push_back(primitive());
    report.primitives[2].image = -1;
    report.primitives[2].stored.present = false;
    report.primitives[1].stored.present = false;
    const auto add = [&](maps::Green green, bool declaredUp, const char* called) {
        GreenEvidence g;
        g.image = int(report.maps.size()) + 5;
        g.name = called;
        g.declaredUp = declaredUp;
        g.verdict.green = green;
        g.verdict.confidence = maps::Confidence::likely;
        g.verdict.agreement = green == maps::Green::up ? 0.25 : -0.75;
        g.verdict.votes = 0.625;
        report.maps.push_back(g);
    };
    add(maps::Green::up, true, "right");
    add(maps::Green::down, false, "");
    add(maps::Green::down, false, "too");
    add(maps::Green::up, false, "wrong");
    add(maps::Green::down, true, "wrong too");
    add(maps::Green::undecidable, true, "dim");
    report.maps.back().verdict.reason = "it is flat";
    MapFit fit;
    fit.image = 9;
    fit.name = "leather";
    fit.orthonormal = summaryFrom(1), fit.cotangent = summaryFrom(2), fit.smooth = summaryFrom(3);
    report.fits = {fit};
    return report;
}

TEST(LintLines, mapsAreListedWithTheirVerdicts)
{
    const Lines all = detailLines(withMaps());
    const Lines maps(all.end() - 7, all.end());
    EXPECT_EQ(maps[0],
              "normal map 5 right: green, if red points right, as declared (likely); agreement +0.25 for "
              "green up, 62.5 % of the detail agrees");
    EXPECT_EQ(maps[1],
              "normal map 6: green, if red points right, as declared (likely); agreement -0.75 for green up, "
              "62.5 % of the detail agrees");
    EXPECT_NE(maps[3].find("wrong: green, if red points right, opposite to the declaration (likely)"),
              std::string::npos);
    EXPECT_NE(maps[5].find("undecidable from the map (it is flat)"), std::string::npos);
    EXPECT_EQ(maps[6],
              "normal map 9 leather: read unchanged, orthonormal 1.00 / 2.00 / 3.00, cotangent 2.00 / 3.00 / "
              "4.00, smooth 3.00 / 4.00 / 5.00");
}

TEST(LintLines, verdictCountsAndOmitsEmptySentences)
{
    LintReport report = withMaps();
    report.defects = "D.", report.seen = "S.", report.notJudged = "N.", report.otherReaders = "O.";
    report.advised = "A.";
    const Lines expected = {"m.glb: 3 primitives, 2 with a normal map, 1 with stored tangents",
                            "D.",
                            "S.",
                            "Green, judged by the maps alone: as declared in 3, the other way in 2, undecidable "
                            "in 1.",
                            "N.",
                            "O.",
                            "A.",
                            "  cotan convert"};
    EXPECT_EQ(verdictLines("m.glb", report, "cotan convert"), expected);
    LintReport none;
    none.primitives.resize(1);
    EXPECT_EQ(verdictLines("m.glb", none, ""),
              Lines{"m.glb: 1 primitive, 0 with a normal map, 0 with stored tangents"});
}

// The three worst of four by `orthonormal`, each with its own name and choice; a name is cut between characters.
TEST(LintLines, theTableOfCandidatesHasTheWorstThreeWithTheirChoices)
{
    LintReport report;
    for (const char* const name : {"near", "ährenförmige Verzierungen am Tor", "worst", "of four"}) {
        report.primitives.emplace_back().mesh = name;
        report.primitives.back().meshIndex = report.primitives.size() - 1;
    }
    const double orthonormal[] = {0.1, 2, 4, 3};
    for (std::size_t i = 0; i < 4; ++i) {
        FrameDecision& d = report.decisions.emplace_back();
        d.mesh = i, d.meaning = MapMeaning::stored, d.reason = ChoiceReason::fits;
        d.candidates = {{Frame::orthonormal, TangentOrigin::generated, 7, orthonormal[i], 5, 6, 8},
                        {Frame::smooth, TangentOrigin::generated, 7, 0.25, 1, 1.5, 2},
                        {Frame::mikktspace, TangentOrigin::stored, 7, 0, 0, 0, 0}};
    }
    report.decisions[1].frame = Frame::smooth;
    report.decisions[2].frame = Frame::mikktspace, report.decisions[2].tangents = TangentOrigin::stored;
    const Lines lines = verdictLines("m.glb", report, "");
    ASSERT_GE(lines.size(), 4u);
    EXPECT_EQ(Lines(lines.end() - 3, lines.end()),
              (Lines{"  worst                   "
                     "    4.00 / 6.0"
                     "             -"
                     "    0.25 / 1.5"
                     "             -"
                     "     *0.00 / 0.0",
                     "  of four                 "
                     "   *3.00 / 6.0"
                     "             -"
                     "    0.25 / 1.5"
                     "             -"
                     "      0.00 / 0.0",
                     "  ährenförmige Verzieru~  "
                     "    2.00 / 6.0"
                     "             -"
                     "   *0.25 / 1.5"
                     "             -"
                     "      0.00 / 0.0"}));
}

TEST(LintLines, jsonHasEveryFigure)
{
    const auto lists = readBack(listsOf(withMaps()));
    ASSERT_EQ(lists["primitives"].size(), 3u);
    const auto& p = lists["primitives"][0];
    EXPECT_EQ(p["mesh"], "hull");
    EXPECT_EQ(p["material"], "steel");
    EXPECT_EQ(p["placing"], 0);
    EXPECT_EQ(p["placings"], 1);
    EXPECT_EQ(p["normal_map"], 4);
    EXPECT_EQ(p["made_for"], "mikktspace");
    EXPECT_EQ(p["triangles"], 321);
    EXPECT_EQ(p["has_uv"], true);
    const std::vector<std::pair<const char*, double>> fractions = {
        {"area", 2},          {"degenerate", 0.011}, {"mirrored", 0.022}, {"overlapping", 0.033},
        {"stretched", 0.055}, {"sheared", 0.066},    {"gradient", 0.5},   {"overlapping_mirrored", 0.044},
        {"largest_uv", 3.5}};
    for (const auto& [key, value] : fractions)
        EXPECT_EQ(p["uv"][key].get<double>(), value) << key;
    EXPECT_EQ(p["uv"]["stretch"]["mean"], 11);
    EXPECT_EQ(p["uv"]["stretch"]["percentile95"], 12);
    EXPECT_EQ(p["uv"]["stretch"]["maximum"], 13);
    EXPECT_EQ(p["uv"]["stretch"]["count"], 7);
    EXPECT_EQ(p["uv"]["shear_degrees"]["mean"], 21);
    EXPECT_EQ(p["edge_steps"]["edges"], 654);
    EXPECT_EQ(p["edge_steps"]["cotangent"]["mean"], 31);
    EXPECT_EQ(p["edge_steps"]["orthonormal"]["mean"], 41);
    EXPECT_EQ(p["stored_tangents"]["reversed_w"], 0.077);
    EXPECT_EQ(p["stored_tangents"]["rotated"], 0.088);
    EXPECT_EQ(p["stored_tangents"]["degrees_from_dpdu"]["mean"], 51);
    EXPECT_EQ(p["read_with"]["cotangent"]["mean"], 61);
    EXPECT_EQ(p["read_with"]["smooth"]["mean"], 71);
    EXPECT_EQ(p["rounding_degrees"], 0.25);
    EXPECT_EQ(p["half_a_degree_at"], 0.75);
    EXPECT_FALSE(lists["primitives"][1].contains("stored_tangents"));
    const auto& g = lists["maps"][3];
    EXPECT_EQ(g["image"], 8);
    EXPECT_EQ(g["name"], "wrong");
    EXPECT_EQ(g["decided"], true);
    EXPECT_EQ(g["as_declared"], false);
    EXPECT_EQ(g["green"], "up");
    EXPECT_EQ(g["confidence"], "likely");
    EXPECT_EQ(g["agreement"], 0.25);
    EXPECT_EQ(g["votes"], 0.625);
    EXPECT_EQ(g["verdict"], "opposite to the declaration (likely)");
    EXPECT_EQ(lists["maps"][5]["decided"], false);
    EXPECT_EQ(lists["maps"][5]["reason"], "it is flat");
    const auto& f = lists["fits"][0];
    EXPECT_EQ(f["image"], 9);
    EXPECT_EQ(f["name"], "leather");
    EXPECT_EQ(f["orthonormal"]["mean"], 1);
    EXPECT_EQ(f["cotangent"]["mean"], 2);
    EXPECT_EQ(f["smooth"]["mean"], 3);
}

LintCheck failed()
{
    LintCheck check;
    check.limits = {1, 2, "smooth"};
    check.failures = {{"reading", "hull", 3.5, 1, "First.", "hull", "", "map.png", false, "mean 2"},
                      {"degenerate_uv", "lid", 4.5, 2, "Second.", "lid", "tin", "", true, ""},
                      {"not_judged", "", 0, -1, "Third.", "", "", "", false, ""}};
    return check;
}

TEST(LintLines, checkPrintsFailuresAndTheNumberOfOthers)
{
    const LintCheck check = failed();
    EXPECT_EQ(checkLines(check, 5),
              (Lines{"check: failed: First. (mean 2)", "check: failed: Second.", "check: failed: Third."}));
    EXPECT_EQ(checkLines(check, 3).size(), 3u);
    EXPECT_EQ(checkLines(check, 2), (Lines{"check: failed: First. (mean 2)", "check: failed: Second. and 1 more"}));
    EXPECT_EQ(checkLines({}, 2), Lines{"check: passed"});
    EXPECT_EQ(summaryOf(check), "First. (mean 2) and 2 more");
    LintCheck one = check;
    one.failures.resize(1);
    EXPECT_EQ(summaryOf(one), "First. (mean 2)");
    EXPECT_EQ(summaryOf({}), "");
}

TEST(LintLines, jsonOfACheckHasNullForMissingFields)
{
    const auto over = readBack(overLimits(failed()));
    ASSERT_EQ(over.size(), 3u);
    EXPECT_EQ(over[0]["kind"], "reading");
    EXPECT_EQ(over[0]["mesh"], "hull");
    EXPECT_EQ(over[0]["material"], nullptr);
    EXPECT_EQ(over[0]["map"], "map.png");
    EXPECT_EQ(over[0]["degrees"], 3.5);
    EXPECT_EQ(over[0]["percent"], nullptr);
    EXPECT_EQ(over[0]["limit"], 1);
    EXPECT_EQ(over[0]["text"], "First.");
    EXPECT_EQ(over[1]["material"], "tin");
    EXPECT_EQ(over[1]["map"], nullptr);
    EXPECT_EQ(over[1]["degrees"], nullptr);
    EXPECT_EQ(over[1]["percent"], 4.5);
    for (const char* key : {"degrees", "percent", "limit", "mesh"})
        EXPECT_EQ(over[2][key], nullptr) << key;
    const auto json = readBack(toJson(failed()));
    EXPECT_EQ(json["passed"], false);
    EXPECT_EQ(json["limit"], 1);
    EXPECT_EQ(json["limit_area"], 2);
    EXPECT_EQ(json["frame"], "smooth");
    EXPECT_EQ(json["failures"][1]["where"], "lid");
    EXPECT_EQ(json["failures"][1]["value"], 4.5);
    EXPECT_EQ(json["failures"][2]["value"], nullptr);
    EXPECT_EQ(json["failures"][2]["limit"], nullptr);
    EXPECT_EQ(readBack(toJson(LintCheck{})), nullptr);
    LintCheck area;
    area.limits.area = 0;
    EXPECT_EQ(readBack(toJson(area))["limit"], nullptr);
    EXPECT_EQ(readBack(toJson(area))["limit_area"], 0);
    EXPECT_EQ(readBack(toJson(area))["passed"], true);
}

} // namespace
} // namespace cotan
