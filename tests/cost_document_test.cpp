// The committed docs/explanation/cost.md and its chart: the bars, and that what they say of triangles follows from
// their own numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "cotan/cost/choices.hpp"

namespace cotan::cost {
namespace {

std::string documentText(const char* name)
{
    std::ifstream stream(std::string(COTAN_SOURCE_DIR "/docs/explanation/") + name, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

using Cells = std::map<std::string, std::string>; // of one line, by the name of the column

// The first table behind a heading that begins so: lines by their first cell.
std::map<std::string, Cells> tableUnder(const std::string& heading)
{
    std::istringstream document(documentText("cost.md"));
    std::vector<std::string> names;
    std::map<std::string, Cells> table;
    bool inside = false;
    for (std::string line; std::getline(document, line);) {
        if (line.rfind("#", 0) == 0)
            inside = line.rfind("### " + heading, 0) == 0;
        if (!inside || line.rfind("|", 0) != 0 || line.rfind("| ---", 0) == 0)
            continue;
        std::vector<std::string> cells;
        std::istringstream rest(line.substr(1));
        for (std::string cell; std::getline(rest, cell, '|');) {
            const std::size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
            cells.push_back(from == std::string::npos ? "" : cell.substr(from, to - from + 1));
        }
        if (names.empty()) {
            names = cells;
            continue;
        }
        for (std::size_t i = 0; i < cells.size() && i < names.size(); ++i)
            table[cells[0]][names[i]] = cells[i];
    }
    return table;
}

double cell(const std::map<std::string, Cells>& table, const std::string& line, const std::string& column)
{
    const auto found = table.find(line);
    if (found == table.end() || !found->second.contains(column)) {
        ADD_FAILURE() << "docs/explanation/cost.md has no '" << line << "' under '" << column << "'";
        return 0;
    }
    return std::stod(found->second.at(column));
}

TEST(CostDocument, theBarsHoldInTheCommittedTables)
{
    const auto over = tableUnder("What perturbing the normal adds");
    EXPECT_LE(cell(over, "triangle-fused", "NAVI21"), 13);
    EXPECT_LE(cell(over, "triangle-halfs", "NAVI21"), 10);
    EXPECT_LE(cell(over, "smooth-fused", "NAVI21"), 14);
    EXPECT_LE(cell(over, "cotangent-seen", "NAVI21"), 50);
    for (const std::string& family : usualFamilies()) {
        const auto whole = tableUnder(family + ": whole fragment shaders");
        for (const char* row : {"triangle-fused", "triangle-halfs", "triangle-read", "smooth-fused"})
            EXPECT_LE(cell(whole, row, "inverse throughput"), cell(whole, "mikktspace", "inverse throughput"))
                << family << " " << row;
    }
}

TEST(CostDocument, whatPaysByPixelsATriangleFollowsFromTheTablesBesides)
{
    const auto said = tableUnder("Pixels a triangle where it costs less");
    const std::string chart = documentText("cost.svg");
    for (const std::string& family : usualFamilies()) {
        const auto fragments = tableUnder(family + ": whole fragment shaders"),
                   others = tableUnder(family + ": whole other stages");
        const auto priceOf = [&](const Choice& choice) {
            const auto stage = "vertex: " + std::string(vertexStage(choice.vertex).name);
            return TrianglePrice{choice.verticesPerTriangle * cell(others, stage, "inverse throughput"),
                                 cell(fragments, std::string(choice.row), "inverse throughput")};
        };
        const TrianglePrice stored = priceOf(choices().front());
        for (std::size_t i = 1; i < choices().size(); ++i) {
            const Choice& choice = choices()[i];
            const auto line = said.find(std::string(choice.name));
            ASSERT_NE(line, said.end()) << choice.name;
            const std::string text = line->second.at(family);
            const PixelRange range = cheaperRange(priceOf(choice), stored);
            if (range.above == range.below) {
                EXPECT_EQ(text, "never") << family << " " << choice.name;
            } else if (std::isinf(range.below) && range.above <= 0) {
                EXPECT_EQ(text, "always") << family << " " << choice.name;
            } else {
                const bool above = std::isinf(range.below);
                ASSERT_EQ(text.substr(0, 6), above ? "above " : "below ") << family << " " << choice.name;
                const double pixels = above ? range.above : range.below;
                EXPECT_NEAR(std::stod(text.substr(6)), pixels, pixels < 1 ? 0.0051 : 0.051)
                    << family << " " << choice.name;
                if (family == "NAVI21" && pixels > 0.5) { // the chart begins there
                    EXPECT_NE(chart.find('>' + text.substr(6) + "</text>"), std::string::npos) << choice.name;
                }
            }
        }
    }
}

} // namespace
} // namespace cotan::cost
