// examples/raytracing and examples/vulkan, built and run as shipped: both draw the analytic sheets, and their normals
// must be those of the sheets.
#include <gtest/gtest.h>

#include "examples_sheets.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

TEST(ExampleRaytracing, thePastedTextIsWhatTheToolPrintsToday)
{
    TemporaryFolder folder;
    const ToolRun printed = runTool({"shader", "--lang", "cpp", "--frame", "exact"}, folder.path());
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(readWhole(COTAN_SOURCE_DIR "/examples/raytracing/cotan.hpp"), printed.out)
        << "cotan shader --lang cpp --frame exact -o examples/raytracing/cotan.hpp";
}

#ifdef COTAN_RAYTRACING
TEST(ExampleRaytracing, normalsMatchTheShearedSheetOnBothSides)
{
    // The frame is accurate to 3e-6 degrees. The texel is read where float computes the hit: a rounding of 3e-7 at a
    // distance of four, times 4 for the domes in u and 1.7 for their steepest slope, is 5e-4 degrees.
    expectSheets(COTAN_RAYTRACING, 2e-3);
}
#endif

#ifdef COTAN_VULKAN_EXAMPLE
TEST(ExampleVulkan, thePastedTextIsWhatTheToolPrintsToday)
{
    TemporaryFolder folder;
    const ToolRun printed = runTool({"shader", "--lang", "glsl", "--frame", "cotangent"}, folder.path());
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(readWhole(COTAN_SOURCE_DIR "/examples/vulkan/cotan.glsl"), printed.out)
        << "cotan shader --lang glsl --frame cotangent -o examples/vulkan/cotan.glsl";
}

TEST(ExampleVulkan, normalsMatchTheShearedSheetOnBothSides)
{
    // Interpolated position and uv are accurate to 4e-7, their differences over a pixel, 0.015, to 3e-5: 0.002 degrees
    // in the frame, more for oblique sheets. One step of an 8-bit texel is at least 0.4 degrees.
    expectSheets(COTAN_VULKAN_EXAMPLE, 0.02);
}
#endif

} // namespace
} // namespace cotan::test
