// examples/triangle, built and run as shipped: each method of delivering U and V, on the analytic sheets and the
// teapot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "examples_odd_models.hpp"
#include "examples_sheets.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

#ifdef COTAN_TRIANGLE_EXAMPLE
std::string shellLine(const std::string& name) { return programAt(COTAN_TRIANGLE_EXAMPLE) + " " + name; }

// All normals of the teapot or of a file; empty pixels are zero.
std::vector<Vec> drawn(const std::string& name, const std::string& what)
{
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    if (std::system((shellLine(name) + " '" + f + "/a.ppm' '" + f + "/a.pfm' '" + what + "' >/dev/null").c_str()) != 0)
        return {};
    return normalsOf(f + "/a.pfm");
}
std::vector<Vec> teapot(const std::string& name) { return drawn(name, "teapot"); }

struct Difference {
    double mean = 0, most95 = 0;
    std::size_t pixels = 0;
};
Difference between(const std::vector<Vec>& a, const std::vector<Vec>& b)
{
    std::vector<double> degrees;
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
        if (dot(a[i], a[i]) > 0 && dot(b[i], b[i]) > 0)
            degrees.push_back(degreesBetween(a[i], b[i]));
    Difference d;
    d.pixels = degrees.size();
    std::sort(degrees.begin(), degrees.end());
    for (const double x : degrees)
        d.mean += x / double(d.pixels);
    d.most95 = degrees.empty() ? 0 : degrees[d.pixels * 95 / 100];
    return d;
}

// Expects the same sheet from lists, strips and fans, shared and unshared vertices, indices of all widths and none.
void expectSameHoweverStored(const std::string& name)
{
    TemporaryFolder folder;
    std::vector<Vec> first;
    for (const OddModel& model : oddModels()) {
        writeOddModel(folder / "odd.gltf", model);
        const std::vector<Vec> normals = drawn(name, (folder / "odd.gltf").string());
        if (first.empty())
            first = normals;
        ASSERT_EQ(normals.size(), 480u * 240u) << model.name;
        std::size_t pixels = 0, only = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const bool here = dot(normals[i], normals[i]) > 0, there = dot(first[i], first[i]) > 0;
            only += here != there;
            if (!here || !there)
                continue;
            ++pixels;
            // Both were rounded to halfs from different edges; on the seam another triangle may be hit.
            if (degreesBetween(normals[i], first[i]) > 0.06)
                ++only;
        }
        EXPECT_GT(pixels, 20000u) << model.name;
        EXPECT_LT(only, 20u) << model.name;
    }
}

class ExampleTriangle : public testing::TestWithParam<const char*> {};

TEST_P(ExampleTriangle, normalsMatchTheShearedSheetOnBothSides)
{
    // Rounding U and V to halfs may rotate a normal by 0.03 degrees; all else is as for floats in an image.
    expectSheets(shellLine(GetParam()), 0.03);
}

TEST_P(ExampleTriangle, drawsTheTeapotAsScreenDerivativesDo)
{
    const Difference d = between(teapot(GetParam()), teapot("derivatives"));
    EXPECT_GT(d.pixels, 40000u); // of 115,200
    // The scale is the triangle's: with 12 cells a patch, normals are tilted by about 4 degrees from their triangle.
    // Slopes change by 1 - cos(4 degrees) = 0.2 %, which is 0.07 degrees on 45-degree domes. `smooth` is another frame:
    // it is closer to the curved surface by a fraction of a degree.
    const bool smooth = std::string(GetParam()) == "smooth" || std::string(GetParam()) == "ring";
    EXPECT_LT(d.mean, smooth ? 0.5 : 0.02);
    EXPECT_LT(d.most95, smooth ? 2 : 0.1);
    EXPECT_GT(d.mean, 0); // not the same image
}

TEST_P(ExampleTriangle, drawsTheSameSheetHoweverItsTrianglesAreStored) { expectSameHoweverStored(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Ways, ExampleTriangle,
                         testing::Values("provoking", "read", "smooth", "ring", "visibility", "visibility-read"),
                         [](const auto& shellLine) {
                             const std::string name = shellLine.param;
                             return name == "visibility-read" ? std::string("visibilityRead") : name;
                         });

// The same frames, computed on the GPU from a meshlet and its ring; only the rounding to SNORM16 differs.
TEST(ExampleTriangleRing, makesTheFramesOfTheCpu)
{
    for (const char* what : {"sheets", "teapot"}) {
        const std::vector<Vec> made = drawn("ring", what), stored = drawn("smooth", what);
        const Difference d = between(made, stored);
        EXPECT_GT(d.pixels, 30000u) << what;
        EXPECT_LT(d.mean, 0.0005) << what;
        EXPECT_LT(d.most95, 0.003) << what;
    }
}

class ExampleTriangleMesh : public testing::TestWithParam<const char*> {};

TEST_P(ExampleTriangleMesh, drawsTheSheetsOrReportsMissingSupport)
{
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    const int status = std::system((shellLine(GetParam()) + " '" + f + "/a.ppm' 2>'" + f + "/err'").c_str());
    if (WEXITSTATUS(status) == 3) {
        EXPECT_EQ(readWhole(folder / "err"), "triangle_example: this device has no VK_EXT_mesh_shader\n");
        GTEST_SKIP() << "no mesh shaders here; the shaders are compiled and validated when they are built";
    }
    expectSheets(shellLine(GetParam()), 0.03);
    expectSameHoweverStored(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Ways, ExampleTriangleMesh, testing::Values("mesh", "mesh-smooth"),
                         [](const auto& each) { return std::string(each.param) == "mesh" ? "triangle" : "smooth"; });

// glslang does not support mesh shaders in HLSL; tests/direct3d/compilers_test.py compiles this one by DXC.
TEST(ExampleTriangleHlsl, compilesForEveryStage)
{
    if (std::system("glslangValidator --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "glslangValidator is missing";
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    for (const auto& [entry, stage] : {std::pair{"provokingVertex", "vert"},
                                       {"plainVertex", "vert"},
                                       {"shadeFlat", "frag"},
                                       {"shadeRead", "frag"},
                                       {"pack", "comp"},
                                       {"resolve", "comp"}}) {
        const std::string shellLine = std::string("glslangValidator -D -V --auto-map-bindings -e ") + entry + " -S "
            + stage
            + " '-I" COTAN_SOURCE_DIR "/shaders' '" COTAN_SOURCE_DIR "/examples/triangle/hlsl/triangle.hlsl' -o '" + f
            + "/a.spv' > '" + f + "/log' 2>&1";
        EXPECT_EQ(std::system(shellLine.c_str()), 0) << entry << ": " << readWhole(folder / "log");
    }
}

TEST(ExampleTriangleArguments, areCheckedBeforeDrawing)
{
    EXPECT_EQ(WEXITSTATUS(std::system((shellLine("rumour a.ppm") + " 2>/dev/null").c_str())), 1);
    EXPECT_EQ(WEXITSTATUS(std::system((shellLine("read /tmp/a.ppm /tmp/a.pfm /no/such.glb") + " 2>/dev/null").c_str())),
              2);
}
#endif

} // namespace
} // namespace cotan::test
