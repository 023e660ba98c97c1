// The committed docs/explanation/cost.md with its chart and cost.csv: the bars, and that the statements of the page
// follow from the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "cost/cards.hpp"
#include "cost/choices.hpp"
#include "run_tool.hpp"

namespace cotan::cost {
namespace {

std::string documentText(const std::string& name)
{
    std::ifstream stream(COTAN_SOURCE_DIR "/" + name, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

// The text of a file with line breaks replaced by spaces.
std::string prose(const std::string& name) { return std::regex_replace(documentText(name), std::regex("\\s+"), " "); }

const std::vector<DeviceCode>& gpus()
{
    static const std::vector<DeviceCode> list = [] {
        auto read = gpusFromCsv(documentText("docs/explanation/cost.csv"));
        EXPECT_TRUE(read) << read.error().message;
        return read ? std::move(*read) : std::vector<DeviceCode>();
    }();
    return list;
}

const DeviceCode& gpu(const std::string& name)
{
    const auto found = std::ranges::find(gpus(), name, &DeviceCode::family);
    EXPECT_NE(found, gpus().end()) << name;
    return *found;
}

using Count = std::optional<double>;
using Counts = std::vector<std::pair<const DeviceCode*, double>>; // per GPU: difference from stored tangents

// Differences on the GPUs that have both figures.
template<class Read> Counts moreThanStored(const Read& read)
{
    Counts counts;
    for (const DeviceCode& d : gpus()) {
        const Count mine = read(d, false), stored = read(d, true);
        if (mine && stored)
            counts.emplace_back(&d, *mine - *stored);
    }
    return counts;
}

Counts inForward(std::string_view row)
{
    return moreThanStored(
        [&](const DeviceCode& d, bool stored) { return fragmentCode(d, stored ? "mikktspace" : row).instructions; });
}

Counts inResolve(std::string_view row)
{
    return moreThanStored(
        [&](const DeviceCode& d, bool stored) { return resolveCode(d, stored ? "mikktspace" : row).instructions; });
}

bool onAll(const Counts& counts, double limit)
{
    return !counts.empty() && std::ranges::all_of(counts, [&](const auto& c) { return c.second <= limit; });
}

TEST(CostDocument, theFileHasFourteenGpusOfSevenVendorsByOneMesa)
{
    std::set<std::string> makers, versions;
    for (const DeviceCode& d : gpus()) {
        EXPECT_TRUE(d.silence.empty()) << d.family << ": " << d.silence;
        EXPECT_EQ(d.date.size(), 10u) << d.family;
        makers.insert(d.maker);
        const std::size_t mesa = d.driver.find("Mesa 2");
        ASSERT_NE(mesa, std::string::npos) << d.family << ": " << d.driver;
        versions.insert(d.driver.substr(mesa));
    }
    EXPECT_GE(gpus().size(), 14u);
    EXPECT_GE(makers.size(), 7u);
    EXPECT_EQ(versions.size(), 1u);
    // Every page that gives these numbers must give exactly these.
    const std::regex claim("(\\d+) cards of (\\d+) makers");
    int claims = 0;
    for (const char* const page : {"README.md", "docs/explanation/cost.md"}) {
        const std::string text = prose(page);
        for (std::sregex_iterator i(text.begin(), text.end(), claim), end; i != end; ++i, ++claims) {
            EXPECT_EQ((*i)[1], std::to_string(gpus().size())) << page;
            EXPECT_EQ((*i)[2], std::to_string(makers.size())) << page;
        }
    }
    EXPECT_GE(claims, 1);
}

TEST(CostDocument, statementsAboutAllGpusHold)
{
    const std::string page = prose("docs/explanation/cost.md");
    const auto says = [&](const std::string& sentence) {
        EXPECT_NE(page.find(sentence), std::string::npos) << sentence;
    };
    const Counts smooth = inForward("smooth-fused"), read = inResolve("triangle-read"),
                 seen = inForward("cotangent-seen");
    EXPECT_TRUE(onAll(smooth, -1));
    says("`smooth-fused` has fewer instructions than stored tangents on all " + std::to_string(smooth.size())
         + " cards");
    EXPECT_TRUE(onAll(read, 0));
    const auto fewer = std::ranges::count_if(read, [](const auto& c) { return c.second < 0; });
    says("`triangle-read` has at most as many instructions as stored tangents on all " + std::to_string(read.size())
         + " cards that compile that stage, and fewer on " + std::to_string(fewer) + " of them.");
    // triangle, in the cheaper of its two forms
    int at = 0, compared = 0;
    std::vector<std::string> over;
    for (const DeviceCode& d : gpus()) {
        const auto measure = d.maker == "Arm" ? &StageCode::inverseThroughput : &StageCode::instructions;
        const Count stored = fragmentCode(d, "mikktspace").*measure, halfs = fragmentCode(d, "triangle-halfs").*measure,
                    floats = fragmentCode(d, "triangle-fused").*measure;
        if (!stored || !halfs || !floats)
            continue;
        ++compared;
        if (std::min(*halfs, *floats) <= *stored)
            ++at;
        else
            over.push_back(d.family);
    }
    std::string except;
    for (std::size_t i = 0; i < over.size(); ++i)
        except += (i == 0 ? "" : i + 1 == over.size() ? " and " : ", ") + over[i];
    says(std::to_string(at) + " of " + std::to_string(compared) + " cards, in the better of its two forms"
         + (over.empty() ? "." : "; not on " + except + "."));
    const auto [minimum, maximum] = std::ranges::minmax_element(seen, {}, [](const auto& c) { return c.second; });
    EXPECT_GT(minimum->second, 0);
    says("`cotangent-seen` " + std::to_string(int(minimum->second)) + " to " + std::to_string(int(maximum->second))
         + " more");
}

// The page beyond the normal map gives these ranges over all cards that compile the shader and count its instructions.
TEST(CostDocument, beyondTheMapEachCostsWhatItsPageSays)
{
    const std::string page = prose("docs/how-to/beyond.md");
    const auto stageOf = [](std::string_view name) -> const Stage& {
        return *std::ranges::find_if(otherStages(),
                                     [&](const Stage& s) { return s.kind == StageKind::beyond && s.name == name; });
    };
    const auto range = [&](std::string_view name) {
        std::vector<int> more;
        for (const DeviceCode& d : gpus())
            if (const Count mine = otherCode(d, stageOf(name)).instructions)
                more.push_back(int(*mine - otherCode(d, stageOf("floor")).instructions.value()));
        EXPECT_GE(more.size(), 20u) << name;
        const auto [least, most] = std::ranges::minmax(more);
        return std::to_string(least) + " to " + std::to_string(most);
    };
    for (const std::string& sentence :
         {"Curvature costs " + range("curvature") + " instructions a pixel, the length " + range("stored length")
              + ", both " + range("curvature and stored length") + " ",
          "The offset costs " + range("parallax offset") + " instructions a pixel and one reading, the relief "
              + range("relief") + " with one turn of its loop "})
        EXPECT_NE(page.find(sentence), std::string::npos) << sentence;
}

TEST(CostDocument, theChoiceForEachVendorCostsNoMoreThanStoredTangents)
{
    // The table under "How to choose": maker, then a form for each renderer, or "-".
    std::istringstream page(documentText("docs/explanation/cost.md"));
    int lines = 0;
    for (std::string line; std::getline(page, line) && line != "## What is measured";) {
        const std::regex shape(R"(\| ([^|]+) \| ([^|]*) \| ([^|]*) \| ([^|]*) \| ([^|]*) \|)");
        std::smatch cells;
        if (!std::regex_match(line, cells, shape) || cells[1] == "maker" || cells[1] == "---")
            continue;
        ++lines;
        const auto form = [&](int i) {
            const std::string text = cells[i];
            return text.rfind('`', 0) == 0 ? text.substr(1, text.find('`', 1) - 1) : std::string();
        };
        int compared = 0;
        for (const DeviceCode& d : gpus()) {
            if (d.maker != cells[1] && cells[1] != "one shader for all")
                continue;
            ++compared;
            for (const int column : {2, 3, 5}) {
                const StageCode& stored = fragmentCode(d, "mikktspace");
                if (form(column).empty())
                    continue;
                const StageCode& mine = fragmentCode(d, form(column));
                const bool cycles = d.maker == "Arm" && cells[1] == "Arm"; // there the bound is another unit
                const auto measure = cycles ? &StageCode::inverseThroughput
                    : stored.instructions   ? &StageCode::instructions
                                            : &StageCode::bytes;
                ASSERT_TRUE(mine.*measure && stored.*measure) << d.family << " " << form(column);
                EXPECT_LE(*(mine.*measure), *(stored.*measure)) << d.family << " " << form(column);
            }
            const Count mine = resolveCode(d, "triangle-read").instructions;
            if (!form(4).empty() && mine) {
                EXPECT_EQ(form(4), "triangle-read");
                EXPECT_LE(*mine, *resolveCode(d, "mikktspace").instructions) << d.family;
            }
        }
        EXPECT_GE(compared, 1) << cells[1];
    }
    EXPECT_EQ(lines, 9);
}

TEST(CostDocument, theBarsHoldInTheFile)
{
    const auto over = [](const char* name, const char* row) {
        return *fragmentCode(gpu(name), row).instructions - *fragmentCode(gpu(name), "floor").instructions;
    };
    EXPECT_LE(over("NAVI21", "triangle-fused"), 13);
    EXPECT_LE(over("NAVI21", "triangle-halfs"), 10);
    EXPECT_LE(over("NAVI21", "smooth-fused"), 14);
    EXPECT_LE(over("NAVI21", "cotangent-seen"), 50);
    for (const DeviceCode& d : gpus())
        for (const char* const row : {"triangle-fused", "triangle-halfs", "smooth-fused"})
            if (d.maker == "AMD") {
                EXPECT_LE(*fragmentCode(d, row).inverseThroughput, *fragmentCode(d, "mikktspace").inverseThroughput)
                    << d.family << " " << row;
            }
}

TEST(CostDocument, tablesAndChartMatchTheFile)
{
    const std::string page = documentText("docs/explanation/cost.md"),
                      compiler = "SPIR-V: " + std::string(spirvCompiler()) + ".";
    if (page.find(compiler) == std::string::npos)
        GTEST_SKIP() << "the page was made with another compiler than " << spirvCompiler();
    const test::TemporaryFolder folder;
    std::ofstream(folder / "cost.md") << page;
    const test::ToolRun run = test::runTool(
        {"cost", "--cards", COTAN_SOURCE_DIR "/docs/explanation/cost.csv", "-o", "cost.md", "--overwrite"},
        folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(test::readWhole(folder / "cost.md") == page) << "run bench/cards, or cotan cost --cards";
    EXPECT_TRUE(test::readWhole(folder / "cost.svg") == documentText("docs/explanation/cost.svg"));
}

TEST(CostDocument, breakEvenPixelsPerTriangleFollowFromTheTables)
{
    const std::string page = documentText("docs/explanation/cost.md"),
                      chart = documentText("docs/explanation/cost.svg");
    const std::string heading = "### Pixels per triangle where it costs less";
    const std::size_t begin = page.find(heading);
    ASSERT_NE(begin, std::string::npos);
    const std::string table = page.substr(begin, page.find("\n#", begin + 1) - begin);
    const DeviceCode d = gpu("NAVI21");
    const auto stored = trianglePrice(d, choices().front());
    for (std::size_t i = 1; i < choices().size(); ++i) {
        const Choice& choice = choices()[i];
        EXPECT_NE(table.find(choice.name), std::string::npos) << choice.name;
        const PixelRange range = cheaperRange(trianglePrice(d, choice).value(), stored.value());
        const double pixels = std::isinf(range.below) ? range.above : range.below;
        if (range.above == range.below || pixels <= 0.5) // the chart begins there
            continue;
        char text[32];
        std::snprintf(text, sizeof text, pixels < 1 ? "%.2f" : "%.1f", pixels);
        EXPECT_NE(chart.find('>' + std::string(text) + "</text>"), std::string::npos) << choice.name << " " << text;
        EXPECT_NE(table.find((std::isinf(range.below) ? "above " : "below ") + std::string(text)), std::string::npos)
            << choice.name;
    }
}

} // namespace
} // namespace cotan::cost
