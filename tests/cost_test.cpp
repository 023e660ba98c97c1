// Counting: operations, SPIR-V, break-even.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cotan/cost/break_even.hpp"
#include "cotan/cost/rows.hpp"
#include "cotan/cost/scalar_count.hpp"
#include "cotan/cost/spirv_count.hpp"

namespace cotan::cost {
namespace {

TEST(CostScalar, normalisingAndSummingCountAsByHand)
{
    // Floor: |n|^2 3 mul 2 add, root, 3 mul; by m.z 3; the same normalisation again.
    const Operations floor = operationsOfRow("floor");
    EXPECT_EQ(floor.multiply, 15);
    EXPECT_EQ(floor.add, 4);
    EXPECT_EQ(floor.inverseRoot, 2);
    EXPECT_EQ(floor.total(), 21);
    EXPECT_EQ(floor.totalFused(), 17); // every addition takes a product
    // Bitangent 6 mul 3 add and 3 mul; sum 9 mul 6 add; normalisation 6 mul 2 add and a root.
    const Operations mikktspace = operationsOfRow("mikktspace");
    EXPECT_EQ(mikktspace.multiply, 24);
    EXPECT_EQ(mikktspace.add, 11);
    EXPECT_EQ(mikktspace.total(), 36);
}

TEST(CostScalar, framesKeepTheirBars)
{
    // Published counts of the formulas, by an independent counter. `paper-full` has divisions where
    // that one has reciprocals.
    EXPECT_LE(operationsOfFrame("cotangent-2013").total(), 54);
    EXPECT_LE(operationsOfFrame("nonperspective").total(), 36);
    EXPECT_LE(operationsOfFrame("paper-full").total(), 110);
    EXPECT_EQ(operationsOfFrame("cotangent-2013").totalFused(), 38);
    EXPECT_EQ(operationsOfFrame("paper-transpose").total(), 63);
    EXPECT_EQ(operationsOfFrame("paper-orthogonal").total(), 36);
    // The total form without guarding n.
    EXPECT_LE(operationsOfFrame("cotangent").total() - operationsOfSafeNormal().total(), 120);
}

TEST(CostScalar, fusedFormsKeepTheBarsOfTheFramesTheyStandFor)
{
    // No frame is built in them. The whole may cost what the bars allow for the frame (60 with its
    // sign, 48 for the gradient) with normalising n (9) and applying it (24).
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

TEST(CostScalar, everyRowIsCountedAndCountsTheSameTwice)
{
    for (const Row& row : rows()) {
        EXPECT_GT(operationsOfRow(row.name).total(), 0) << row.name;
        EXPECT_EQ(operationsOfRow(row.name).total(), operationsOfRow(row.name).total());
    }
    EXPECT_EQ(operationsOfRow("no such row").total(), 0);
}

TEST(CostSpirv, countsWhatIsInsideFunctionsAndDoesSomething)
{
    // Header; OpTypeVoid %1; OpTypeFunction %2 %1; then OpFunction, OpLabel, OpReturn,
    // OpFunctionEnd.
    const std::array<std::uint32_t, 18> module = {
        0x07230203,    0x10000, 0, 5, 0, 2u << 16 | 19,  1, 3u << 16 | 33, 2, 1,
        5u << 16 | 54, 1,       3, 0, 2, 2u << 16 | 248, 4, 1u << 16 | 253};
    EXPECT_EQ(spirvInstructions(module), 1);
}

TEST(CostSpirv, whatIsNoModuleCountsAsNothing)
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

TEST(CostBreakEven, isWhereBothCostTheSame)
{
    // 12 at each vertex against 48 at each pixel: equal at a quarter of a pixel per vertex.
    EXPECT_DOUBLE_EQ(pixelsPerVertex(12, 48), 0.25);
    EXPECT_TRUE(std::isinf(pixelsPerVertex(16, 0)));
    EXPECT_EQ(pixelsPerVertex(0, 48), 0);
}

} // namespace
} // namespace cotan::cost
