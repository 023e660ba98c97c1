// Lines and JSON of hand-made conversion reports: all numbers differ.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bake/reports.hpp"
#include "convert_lines.hpp"
#include "cotan/scene.hpp"
#include "lint_lines.hpp"

namespace cotan {

using namespace app;
namespace {

using Lines = std::vector<std::string>;

nlohmann::json parsed(const Json& json) { return nlohmann::json::parse(toText(json)); }

ValueSummary figures(double mean) { return {7, mean, mean + 1, mean + 2}; }

ConvertedMap convertedMap()
{
    ConvertedMap m;
    m.image = 3, m.name = "leather", m.surfaces = 2;
    m.width = 20, m.height = 10;
    m.bits = 16, m.format = "JPEG", m.quality = 90;
    m.figures.covered = 50, m.figures.padded = 61, m.figures.several = 72, m.figures.disagreeing = 5;
    m.figures.belowHorizon = 8;
    m.figures.moved = figures(10), m.figures.disagreement = figures(20), m.figures.unconverted = figures(30);
    m.figures.error = figures(40);
    m.bytesBefore = 111, m.bytesAfter = 222;
    return m;
}

TEST(ConvertLines, printEveryFigureOfAMap)
{
    ConvertedMap m = convertedMap();
    EXPECT_EQ(mapLines(m, "smooth"),
              (Lines{"leather: 20x10, 25.0 % covered by 2 surfaces; read with smooth unchanged, error 30.00 / 31.00 / "
                     "32.00 degrees",
                     "  72 texels are used at several surface points; in 5 (10.00 % of the covered) these differ by "
                     "over 0.5 degrees: 20.00 / 21.00 / 22.00 at the worst point",
                     "  converted and rounded to 16 bits, error 40.00 / 41.00 / 42.00 degrees; 61 padding texels "
                     "converted too; JPEG of quality 90, 222 bytes, before 111",
                     "  8 texels point below the horizon of the frame"}));
    m.figures.disagreeing = 0, m.figures.belowHorizon = 0, m.quality = 0, m.surfaces = 1;
    const Lines lines = mapLines(m, "smooth");
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_NE(lines[0].find("by 1 surface;"), std::string::npos);
    EXPECT_EQ(lines[1],
              "  72 texels are used at several surface points; in 0 (0.00 % of the covered) these differ by over 0.5 "
              "degrees");
    EXPECT_NE(lines[2].find("too; JPEG 222 bytes"), std::string::npos) << lines[2];
    m.figures.several = 0;
    EXPECT_EQ(mapLines(m, "smooth").size(), 2u);
    m.kept = true;
    m.readWith = {Frame::smooth};
    EXPECT_EQ(mapLines(m, "smooth"),
              Lines{"leather: unchanged: read with smooth its error is 30.00 / 31.00 / 32.00 degrees on 1 surface"});
    m.figures.unconverted = {7, 0.1, 0.3, 0.5};
    EXPECT_EQ(mapLines(m, "smooth"),
              Lines{"leather: unchanged: read with smooth its error is 0.10 / 0.30 / 0.50 degrees on 1 surface, no "
                    "more than that of rounding a new map"});
    m.surfacesWithTangents = 1;
    EXPECT_EQ(mapLines(m, "smooth"), Lines{"leather: unchanged: TANGENT stays on 1 surface"});
    m.surfacesWithTangents = 0;
    m.figures.unconverted.count = 0;
    EXPECT_NE(mapLines(m, "smooth").at(0).find("not checked"), std::string::npos);
}

TEST(ConvertLines, jsonOfAMapHasEveryFigure)
{
    ConvertedMap m = convertedMap();
    m.alsoElsewhere = true;
    const auto j = parsed(toJson(m));
    const std::vector<std::pair<const char*, double>> numbers = {{"image", 3},
                                                                 {"surfaces", 2},
                                                                 {"bits", 16},
                                                                 {"quality", 90},
                                                                 {"bytes_before", 111},
                                                                 {"texels_covered", 50},
                                                                 {"texels_padded", 61},
                                                                 {"bytes_after", 222},
                                                                 {"texels_overlapped", 72},
                                                                 {"below_horizon", 8},
                                                                 {"texels_that_disagree", 5}};
    for (const auto& [key, value] : numbers)
        EXPECT_EQ(j[key].get<double>(), value) << key;
    EXPECT_EQ(j["name"], "leather");
    EXPECT_EQ(j["size"], nlohmann::json({20, 10}));
    EXPECT_EQ(j["kept"], false);
    EXPECT_EQ(j["format"], "JPEG");
    EXPECT_EQ(j["kept_elsewhere"], true);
    EXPECT_EQ(j["moved_degrees"]["mean"], 10);
    EXPECT_EQ(j["disagreement_degrees"]["mean"], 20);
    EXPECT_EQ(j["degrees_unconverted"]["mean"], 30);
    EXPECT_EQ(j["degrees_after_rounding"]["mean"], 40);
    m.quality = 0;
    EXPECT_EQ(parsed(toJson(m))["quality"], nullptr);
    m.kept = true;
    m.readWith = {Frame::smooth};
    const auto kept = parsed(toJson(m));
    EXPECT_EQ(kept["kept"], true);
    EXPECT_EQ(kept["image"], 3);
    EXPECT_EQ(kept["surfaces"], 2);
    EXPECT_EQ(kept["size"], nlohmann::json({20, 10}));
    EXPECT_EQ(kept["degrees_unconverted"]["mean"], 30);
    EXPECT_EQ(kept["bytes_before"], 111);
    EXPECT_EQ(kept["bytes_after"], 222);
    EXPECT_FALSE(kept.contains("bits"));
}

TEST(ConvertLines, tangentsLineNamesTheWorstDirection)
{
    ConvertModelReport report;
    report.tangents = TangentsAfter::kept;
    EXPECT_TRUE(tangentsLines(report, "smooth").empty());
    EXPECT_EQ(parsed(tangentsJson(report)), nlohmann::json({{"kept", true}}));
    report.tangents = TangentsAfter::given;
    report.primitivesGiven = 3;
    EXPECT_EQ(tangentsLines(report, "vertex"), Lines{"3 primitives got TANGENT for vertex"});
    EXPECT_EQ(parsed(tangentsJson(report)), nlohmann::json({{"given_primitives", 3}}));
    report.tangents = TangentsAfter::dropped;
    EXPECT_EQ(tangentsLines(report, "smooth"), Lines{"no TANGENT to drop"});
    report.dropped.vertices = 10, report.dropped.bytes = 160, report.dropped.primitives = 2;
    EXPECT_EQ(tangentsLines(report, "smooth"),
              Lines{"TANGENT dropped from 2 primitives: 16 bytes per vertex, 10 vertices, 160 bytes"});
    report.dropped.directions = {{0, 1, 5, figures(1), false},
                                 {1, 2, 6, figures(4), false},
                                 {2, 3, 7, figures(2), false},
                                 {3, 4, 8, figures(9), true}};
    const Lines lines = tangentsLines(report, "smooth");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_NE(lines[1].find("highlights of 3 primitives"), std::string::npos) << lines[1];
    EXPECT_NE(lines[1].find("4.00 / 5.00 / 6.00"), std::string::npos) << lines[1];
    EXPECT_NE(lines[1].find("meshes[1].primitives[2]"), std::string::npos) << lines[1];
    const auto j = parsed(tangentsJson(report));
    EXPECT_EQ(j["dropped_primitives"], 2);
    EXPECT_EQ(j["bytes_per_vertex"], 16);
    EXPECT_EQ(j["vertices"], 10);
    EXPECT_EQ(j["bytes"], 160);
    ASSERT_EQ(j["anisotropy"].size(), 4u);
    EXPECT_EQ(j["anisotropy"][3]["mesh"], 3);
    EXPECT_EQ(j["anisotropy"][3]["primitive"], 4);
    EXPECT_EQ(j["anisotropy"][3]["material"], 8);
    EXPECT_EQ(j["anisotropy"][3]["tangents_stay"], true);
    EXPECT_EQ(j["anisotropy"][3]["rotated_degrees"]["mean"], 9);
}

TEST(ConvertLines, provokingLineSumsThePrimitives)
{
    const std::vector<GltfProvoked> all = {{0, 0, 10, 20, 25}, {0, 1, 1, 4, 5}};
    EXPECT_EQ(provokingLine(all, ProvokingVertex::last),
              "11 triangles of 2 primitives: 30 vertices, before 24: 1.25 times as many; vertex k provokes triangle k "
              "as its last");
    EXPECT_EQ(provokingLine({}, ProvokingVertex::last), "no triangles: no vertices were reordered");
    const auto j = parsed(provokingJson(all, ProvokingVertex::first));
    EXPECT_EQ(j["vertex"], "first");
    EXPECT_EQ(j["triangles"], 11);
    EXPECT_EQ(j["vertices_before"], 24);
    EXPECT_EQ(j["vertices_after"], 30);
    EXPECT_EQ(j["growth"], 1.25);
    EXPECT_EQ(j["primitives"][1]["primitive"], 1);
    EXPECT_EQ(j["primitives"][1]["growth"], 1.25);
    EXPECT_EQ(j["primitives"][0]["vertices_after"], 25);
    EXPECT_EQ(parsed(provokingJson({}, ProvokingVertex::first))["growth"], 1);
}

TEST(ReportText, countsTheObjectsOfAScene)
{
    EXPECT_EQ(counted(0, "map"), "0 maps");
    EXPECT_EQ(counted(1, "map"), "1 map");
    EXPECT_EQ(counted(2, "map"), "2 maps");
    EXPECT_EQ(toText(ValueSummary{}), "nothing to measure");
    Scene scene;
    scene.meshes = {makePlane(1, 2, 1), makePlane(1, 1, 1)}; // 8 and 2 triangles
    scene.instances = {{"a", 0, glm::mat4(1)}, {"b", 1, glm::mat4(1)}, {"c", 0, glm::mat4(1)}};
    scene.materials.resize(1);
    scene.images.resize(4);
    scene.warnings = {"odd"};
    const auto j = parsed(countsOf(scene));
    EXPECT_EQ(j["meshes"], 2);
    EXPECT_EQ(j["instances"], 3);
    EXPECT_EQ(j["materials"], 1);
    EXPECT_EQ(j["images"], 4);
    EXPECT_EQ(j["triangles"], 10);
    EXPECT_EQ(j["triangles_drawn"], 18);
    EXPECT_EQ(j["warnings"], nlohmann::json({"odd"}));
}

} // namespace
} // namespace cotan
