// examples/deforming, built and run as shipped: compute passes compared with C++, and stored with derived frames on a
// surface known analytically.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <sstream>

#include "examples_sheets.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

#ifdef COTAN_DEFORMING_EXAMPLE
struct DeformingRun {
    int code = -1;
    std::string out, err;
};

DeformingRun runDeforming(const std::string& words)
{
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    const int status =
        std::system((programAt(COTAN_DEFORMING_EXAMPLE) + " " + words + " >'" + f + "/out' 2>'" + f + "/err'").c_str());
    return {WEXITSTATUS(status), readWhole(folder / "out"), readWhole(folder / "err")};
}

// What `check` prints after the name of a motion.
struct PassErrors {
    double smooth = 0, notCompared = 0, tangents = 0, further = 0, triangles = 0;
};

std::map<std::string, PassErrors> passErrors(const std::string& printed)
{
    std::map<std::string, PassErrors> found;
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        PassErrors errors;
        if (words >> name >> errors.smooth >> errors.notCompared >> errors.tangents >> errors.further
            >> errors.triangles)
            found[name] = errors;
    }
    return found;
}

struct DeformingCase {
    const char* mesh;
    double notCompared; // vertices where gradients cancel, or that coincide with others in the pose
    double further;     // corners where MikkTSpace groups more finely, or has a degenerate triangle
};

class ExampleDeforming : public testing::TestWithParam<DeformingCase> {};

TEST_P(ExampleDeforming, derivesTheFramesOfTheCppInEveryPose)
{
    const auto [mesh, notCompared, further] = GetParam();
    const DeformingRun run = runDeforming(std::string("check ") + mesh);
    if (run.code == 3)
        GTEST_SKIP() << run.err;
    ASSERT_EQ(run.code, 0) << run.err;
    std::cout << run.out; // includes the times
    const auto errors = passErrors(run.out);
    ASSERT_EQ(errors.size(), 3u);
    for (const auto& [motion, o] : errors) {
        SCOPED_TRACE(motion);
        // Half a step of SNORM16 in two or three components, normalised: 0.003; the remainder is float rounding.
        EXPECT_LT(o.smooth, 0.005);
        EXPECT_LT(o.tangents, 0.005);
        EXPECT_LT(o.triangles, 0.03); // half a step of half, 2^-12, in three components: 0.024
        EXPECT_LE(o.notCompared, notCompared);
        EXPECT_LE(o.further, further);
        EXPECT_GT(o.smooth + o.tangents, 0); // zero would mean that nothing was compared: floats always differ a little
    }
}

// teapot: a fiftieth of its 5400 vertices, at its poles and where the body meets the bottom; there MikkTSpace splits 28
// groups of up to 6 corners in two. strange: seven degenerate triangles, and two vertices that have an area or a
// distinct position only when bent.
INSTANTIATE_TEST_SUITE_P(Meshes, ExampleDeforming,
                         testing::Values(DeformingCase{"tube", 0, 0}, DeformingCase{"teapot", 150, 28 * 6},
                                         DeformingCase{"seam", 0, 0}, DeformingCase{"strange", 2, 21},
                                         DeformingCase{"large", 0, 0}),
                         [](const auto& c) { return std::string(c.param.mesh); });

// Rows of `figure`: motion, normals and time, then mean degrees of each method.
enum { kNormalAlone, kStored, kRederived, kCotangent, kTriangle, kSmooth, kWayCount };
using FigureRows = std::map<std::string, std::array<double, kWayCount>>;

// The tables of docs/explanation/deforming.md must match the measurements within the rounding differences of drivers.
void expectDocumented(const FigureRows& measured)
{
    std::istringstream lines(readWhole(COTAN_SOURCE_DIR "/docs/explanation/deforming.md"));
    std::string time;
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '|' || c == ',' || c == '*'; }, ' ');
        std::istringstream words(line);
        std::string first, second, normals;
        words >> first >> second;
        if (first == "time")
            time = second == "1" ? "1.00" : "0.50";
        if (second != "normals" || !(words >> normals))
            continue;
        if (normals == "carried")
            words >> second; // skips "along"
        const auto row = measured.find(first + " " + normals + " " + time);
        ASSERT_NE(row, measured.end()) << line;
        ++rows;
        for (const double degrees : row->second) {
            double documented = -1;
            words >> documented;
            EXPECT_NEAR(documented, degrees, 0.015) << line;
        }
    }
    EXPECT_EQ(rows, 12u);
}

TEST(ExampleDeformingFigure, onlyDerivedFramesFollowBendTwistAndShear)
{
    TemporaryFolder folder;
    const std::string file = (folder.path() / "page.html").string();
    const DeformingRun run = runDeforming("figure '" + file + "'");
    if (run.code == 3)
        GTEST_SKIP() << run.err;
    ASSERT_EQ(run.code, 0) << run.err;
    FigureRows rows;
    std::istringstream lines(run.out);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string bar, motion, normals, time;
        words >> bar >> motion >> bar >> normals >> bar >> time;
        std::array<double, kWayCount> row{};
        for (double& degrees : row)
            words >> bar >> degrees;
        if (words)
            rows[motion + " " + normals + " " + time] = row;
    }
    ASSERT_EQ(rows.size(), 30u);
    for (const char* motion : {"bend", "twist", "shear"}) {
        SCOPED_TRACE(motion);
        const std::string name = motion;
        for (const char* normals : {" carried 0.00", " derived 0.00"})
            for (const double degrees : rows[name + normals])
                EXPECT_LT(degrees, 0.05); // at rest all are right: the texture is square on the tube
        const auto end = rows[name + " derived 1.00"], half = rows[name + " derived 0.50"];
        // An orthonormal frame cannot represent stretch and shear, whether stored or recomputed.
        EXPECT_GT(end[kStored], 3);
        EXPECT_GT(end[kRederived], 3);
        // The remaining error is that of one gradient per triangle on any curved mesh; smooth is second order.
        EXPECT_LT(end[kTriangle], 0.4);
        EXPECT_LT(half[kTriangle], 0.2);
        EXPECT_LT(end[kSmooth], 0.2);
        EXPECT_NEAR(end[kTriangle], end[kCotangent], 0.02);
        EXPECT_LT(end[kNormalAlone], 0.2); // from normals.comp
        // With normals carried along by the engine, no frame is better than they are.
        const auto carried = rows[name + " carried 0.50"];
        EXPECT_NEAR(carried[kSmooth], carried[kNormalAlone], 0.1 * carried[kNormalAlone]);
    }
    // Sheared by 45 degrees: the error of stored tangents is more than 40 times that of triangle.
    EXPECT_GT(rows["shear derived 1.00"][kStored], 40 * rows["shear derived 1.00"][kTriangle]);
    expectDocumented(rows);
    const std::string page = readWhole(file);
    EXPECT_NE(page.find("<input id=\"time\" type=\"range\""), std::string::npos);
    EXPECT_EQ(page.find("http://", page.find("<script>")),
              page.find("http://www.w3.org/2000/svg")); // names the SVG namespace, loads nothing
    EXPECT_EQ(page.find("src="), std::string::npos);
}

TEST(ExampleDeformingArguments, wrongOnesAreRefused)
{
    for (const char* words : {"", "check", "rumour a", "check tube more"}) {
        const DeformingRun run = runDeforming(words);
        EXPECT_EQ(run.code, 1) << words;
        EXPECT_EQ(run.err.substr(0, 24), "usage: deforming_example");
    }
    const DeformingRun none = runDeforming("check /no/such.glb");
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("/no/such.glb"), std::string::npos) << none.err;
    const DeformingRun closed = runDeforming("figure /no/such/folder/page.html");
    EXPECT_TRUE(closed.code == 4 || closed.code == 3) << closed.err;
}
#endif

} // namespace
} // namespace cotan::test
