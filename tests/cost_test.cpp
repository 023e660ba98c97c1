// Counts of scalar operations and SPIR-V instructions, and break-even points.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cost/break_even.hpp"
#include "cost/choices.hpp"
#include "cost/rows.hpp"
#include "cost/scalar_count.hpp"
#include "cost/spirv_count.hpp"
#include "cost/stages.hpp"

namespace cotan::cost {
namespace {

TEST(CostScalar, normalisingAndSummingCountAsByHand)
{
    // Floor: |n|^2 has 3 mul 2 add, a root and 3 mul to scale; m.z times n 3 mul; then the same normalisation again.
    const Operations floor = operationsOfRow("floor");
    EXPECT_EQ(floor.multiply, 15);
    EXPECT_EQ(floor.add, 4);
    EXPECT_EQ(floor.inverseRoot, 2);
    EXPECT_EQ(floor.total(), 21);
    EXPECT_EQ(floor.totalFused(), 17); // every addition fuses with a product
    // Bitangent: 6 mul 3 add and 3 mul. Sum: 9 mul 6 add. Normalisation: 6 mul 2 add and a root.
    const Operations mikktspace = operationsOfRow("mikktspace");
    EXPECT_EQ(mikktspace.multiply, 24);
    EXPECT_EQ(mikktspace.add, 11);
    EXPECT_EQ(mikktspace.total(), 36);
}

TEST(CostScalar, framesKeepTheirBars)
{
    // Published counts of the formulas, from an independent counter. `paper-full` has divisions where that counter
    // assumes reciprocals.
    EXPECT_LE(operationsOfFrame("cotangent-2013").total(), 54);
    EXPECT_LE(operationsOfFrame("nonperspective").total(), 36);
    EXPECT_LE(operationsOfFrame("paper-full").total(), 110);
    EXPECT_EQ(operationsOfFrame("cotangent-2013").totalFused(), 38);
    EXPECT_EQ(operationsOfFrame("paper-transpose").total(), 63);
    EXPECT_EQ(operationsOfFrame("paper-orthogonal").total(), 36);
    // The total form without the guard of n.
    EXPECT_LE(operationsOfFrame("cotangent").total() - operationsOfSafeNormal().total(), 120);
}

TEST(CostScalar, fusedFormsKeepTheBarsOfTheirFrames)
{
    // They build no frame. The whole may cost what the bars allow for the frame (60 with its sign, 48 for the gradient)
    // plus normalising n (9) and applying the frame (24).
    EXPECT_LE(operationsOfRow("cotangent-fused").total(), 60 + 9 + 24);
    EXPECT_LE(operationsOfRow("gradient-fused").total(), 48 + 9 + 24);
}

TEST(CostScalar, fusedFormsCostLessThanPlainOnes)
{
    for (const auto& [fused, plain] :
         {std::pair("cotangent-fused", "cotangent-plain"), std::pair("gradient-fused", "gradient-plain"),
          std::pair("orthonormal-fused", "orthonormal-plain")})
        EXPECT_LT(operationsOfRow(fused).total(), operationsOfRow(plain).total()) << fused;
    EXPECT_LT(operationsOfRow("cotangent-area-fused").total(), operationsOfRow("cotangent-fused").total());
}

TEST(CostRows, everyFrameAndItsFusedFormHaveOne)
{
    for (const FrameInfo& f : frames()) {
        const Row* row = rowFromName(f.name);
        if (f.frame == Frame::areaWeighted) { // the code of mikktspace
            EXPECT_FALSE(row);
            continue;
        }
        ASSERT_TRUE(row) << f.name;
        EXPECT_EQ(row->frame, f.frame);
        EXPECT_EQ(rowFromName(std::string(f.name) + "-fused") != nullptr, f.fused) << f.name;
    }
    EXPECT_EQ(rows().front().name, "floor");
}

TEST(CostRows, aFrameIsPricedWithItsInputs)
{
    EXPECT_EQ(rowFromName("mikktspace")->stored, Stored::tangent);
    EXPECT_EQ(rowFromName("smooth")->stored, Stored::cotangents);
    EXPECT_EQ(rowFromName("triangle-fused")->stored, Stored::triangle);
    EXPECT_EQ(rowFromName("cotangent")->stored, Stored::nothing);
    EXPECT_EQ(rowFromName("exact")->stored, Stored::nothing);
}

TEST(CostScalar, everyRowIsCountedReproducibly)
{
    for (const Row& row : rows()) {
        EXPECT_GT(operationsOfRow(row.name).total(), 0) << row.name;
        EXPECT_EQ(operationsOfRow(row.name).total(), operationsOfRow(row.name).total());
    }
    EXPECT_EQ(operationsOfRow("no such row").total(), 0);
}

TEST(CostSpirv, countsOnlyInstructionsThatExecute)
{
    // Header; OpTypeVoid %1; OpTypeFunction %2 %1; then OpFunction, OpLabel, OpReturn, OpFunctionEnd.
    const std::array<std::uint32_t, 18> module = {
        0x07230203,    0x10000, 0, 5, 0, 2u << 16 | 19,  1, 3u << 16 | 33, 2, 1,
        5u << 16 | 54, 1,       3, 0, 2, 2u << 16 | 248, 4, 1u << 16 | 253};
    EXPECT_EQ(spirvInstructions(module), 1);
}

TEST(CostSpirv, invalidModulesCountAsZero)
{
    const std::array<std::uint32_t, 6> wrongMagic = {1, 0x10000, 0, 5, 0, 1u << 16 | 253};
    const std::array<std::uint32_t, 6> zeroLength = {0x07230203, 0x10000, 0, 5, 0, 253};
    const std::array<std::uint32_t, 6> tooLong = {0x07230203, 0x10000, 0, 5, 0, 9u << 16 | 54};
    EXPECT_EQ(spirvInstructions(wrongMagic), 0);
    EXPECT_EQ(spirvInstructions(zeroLength), 0);
    EXPECT_EQ(spirvInstructions(tooLong), 0);
    EXPECT_EQ(spirvInstructions({}), 0);
}

TEST(CostSpirv, everyShaderOfEveryRowHasInstructions)
{
    for (const Row& row : rows())
        EXPECT_GT(spirvInstructions(row.fragment), 10) << row.name;
    for (const VertexStage& v : vertexStages())
        EXPECT_GT(spirvInstructions(v.vertex), 10) << v.name;
}

TEST(CostBreakEven, isAtEqualCost)
{
    // 12 per vertex against 48 per pixel: equal at a quarter of a pixel per vertex.
    EXPECT_DOUBLE_EQ(pixelsPerVertex(12, 48), 0.25);
    EXPECT_TRUE(std::isinf(pixelsPerVertex(16, 0)));
    EXPECT_EQ(pixelsPerVertex(0, 48), 0);
}

// Pixels in 2x2 quads of which at least one pixel centre is inside a right-angled triangle with axis-aligned legs: the
// mean over steps x steps offsets within a quad.
double shadedByRasterising(double leg, int steps)
{
    double quads = 0;
    const int end = int(leg) + 4;
    for (int sy = 0; sy < steps; ++sy)
        for (int sx = 0; sx < steps; ++sx) {
            const double x0 = 2 * (sx + 0.5) / steps, y0 = 2 * (sy + 0.5) / steps; // the right-angled corner
            for (int qy = -2; qy < end; qy += 2)
                for (int qx = -2; qx < end; qx += 2)
                    for (int k = 0; k < 4; ++k) {
                        const double x = qx + k % 2 + 0.5 - x0, y = qy + k / 2 + 0.5 - y0;
                        if (x >= 0 && y >= 0 && x + y <= leg) {
                            ++quads;
                            break;
                        }
                    }
        }
    return 4 * quads / (double(steps) * steps);
}

TEST(CostBreakEven, shadedPixelsAreThoseOfRasterisedTriangles)
{
    // The formula averages over all offsets, the reference over a grid with steps of 1/32 pixel. Points on the
    // hypotenuse count as inside, half a step too far out; four times, once per pixel centre.
    for (const double pixels : {0.2, 0.5, 1.0, 1.7, 2.0, 3.3, 8.0, 50.0, 300.0}) {
        const double leg = std::sqrt(2 * pixels);
        EXPECT_NEAR(shadedPixels(pixels), shadedByRasterising(leg, 64), 4 * leg / 64 + 1e-9) << pixels;
    }
    EXPECT_EQ(shadedPixels(0), 0);
    EXPECT_DOUBLE_EQ(shadedPixels(50), 50 + 2 * std::sqrt(2 * 50.0)); // legs of 10: 70
    EXPECT_DOUBLE_EQ(shadedPixels(0.25), 1);                          // four non-overlapping copies
}

TEST(CostBreakEven, rangesEndAtEqualCost)
{
    const TrianglePrice stored{60, 100}, early{120, 90}, late{20, 140};
    const PixelRange large = cheaperRange(early, stored), small = cheaperRange(late, stored);
    EXPECT_TRUE(std::isinf(large.below));
    EXPECT_NEAR(shadedPixels(large.above), 6, 1e-9); // 60 more per triangle, 10 less per pixel
    EXPECT_NEAR(large.above, 2, 1e-9);               // legs of 2 pixels
    EXPECT_NEAR(early.of(large.above), stored.of(large.above), 1e-6);
    EXPECT_EQ(small.above, 0);
    EXPECT_NEAR(shadedPixels(small.below), 1, 1e-9);
    EXPECT_NEAR(small.below, 0.25, 1e-9);
    EXPECT_TRUE(std::isinf(cheaperRange({1, 2}, {2, 2}).below));
    EXPECT_EQ(cheaperRange({2, 2}, {1, 2}).below, 0);
    EXPECT_EQ(cheaperRange({2, 2}, {2, 2}).below, 0);
}

TEST(CostChoices, pricesAreThoseOfTheirStages)
{
    DeviceCode device;
    const auto estimated = [](double estimate) {
        StageCode code;
        code.inverseThroughput = estimate;
        return code;
    };
    double next = 100;
    for (const Row& row : rows())
        device.rows.push_back({row.name, estimated(next++)});
    for (const VertexStage& stage : vertexStages())
        device.vertices.push_back({stage.stored, estimated(next++)});
    for (const Choice& choice : choices()) {
        const Row* row = rowFromName(choice.row);
        ASSERT_NE(row, nullptr) << choice.name;
        const auto price = trianglePrice(device, choice);
        ASSERT_TRUE(price) << choice.name;
        EXPECT_EQ(price->perPixel, 100 + double(row - rows().data())) << choice.name;
        EXPECT_DOUBLE_EQ(price->fixed,
                         choice.verticesPerTriangle * (100 + double(rows().size()) + double(choice.vertex)))
            << choice.name;
        // The vertex stage outputs what the row reads: the same, or unpacked from a smaller form.
        EXPECT_TRUE(row->stored == choice.vertex
                    || (row->stored == Stored::cotangents && choice.vertex == Stored::cotangents8))
            << choice.name;
    }
    device.rows.clear();
    EXPECT_FALSE(trianglePrice(device, choices()[0]));
}

TEST(CostStages, everyOtherStageHasInstructionsAndTheFrameAddsSome)
{
    const Stage* first = nullptr;
    for (const Stage& s : otherStages()) {
        if (!first || first->kind != s.kind)
            first = &s;
        EXPECT_GT(spirvInstructions(s.words), 10) << s.name;
        EXPECT_EQ(s.consumer.empty(), s.kind != StageKind::mesh) << s.name;
        EXPECT_GT(s.perVertex + s.perTriangle + s.perPixel, s.kind == StageKind::mesh && &s == first ? -1 : 0)
            << s.name;
        if (&s != first && s.kind != StageKind::pass) {
            EXPECT_GT(spirvInstructions(s.words), spirvInstructions(first->words)) << s.name;
        }
    }
    // U and V of valid edges: 12 products and 6 sums; two squared lengths with 6 and 4, their maximum and a guard; a
    // root; the side with 9 and 5 and a sign; 6 to scale. (The total form adds guards.)
    const Operations sound = operationsOfTriangleVectors(false);
    EXPECT_EQ(sound.multiply, 12 + 6 + 9 + 6);
    EXPECT_EQ(sound.add, 6 + 4 + 5);
    EXPECT_EQ(sound.inverseRoot, 1);
    EXPECT_EQ(sound.maximum, 2);
    EXPECT_EQ(sound.total(), 33 + 15 + 1 + 2 + 1);
    EXPECT_GT(operationsOfTriangleVectors(true).total(), sound.total());
}

// Each term of the roughness costs something, and both together less than the sum: they share the last root.
TEST(CostStages, beyondTheMapCurvatureAndLengthAddUp)
{
    const auto instructions = [](std::string_view name) {
        const auto is = [&](const Stage& s) { return s.kind == StageKind::beyond && s.name == name; };
        return spirvInstructions(std::ranges::find_if(otherStages(), is)->words);
    };
    const int floor = instructions("floor"), curvature = instructions("curvature") - floor,
              length = instructions("stored length") - floor;
    EXPECT_GE(curvature, 10); // two differences, two squared lengths and their sum, a product, a minimum, the rest
    EXPECT_GE(length, 10);
    const int both = instructions("curvature and stored length") - floor;
    EXPECT_GT(both, std::max(curvature, length));
    EXPECT_LT(both, curvature + length);
}

} // namespace
} // namespace cotan::cost
