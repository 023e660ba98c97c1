// Clipping of triangles before rasterisation.
#include <limits>

#include <gtest/gtest.h>

#include "render/reference/raster.hpp"

namespace cotan::reference {
namespace {

TEST(Clip, removesTrianglesWithANonFiniteCorner)
{
    const std::array<glm::dvec4, 3> whole = {glm::dvec4(0, 0, 0.5, 1), {60, 0, 0.5, 1}, {0, 40, 0.5, 1}};
    EXPECT_EQ(clip(whole, 64, 64).count, 3);
    for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()})
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 4; ++axis) {
                std::array<glm::dvec4, 3> triangle = whole;
                triangle[corner][axis] = wrong;
                EXPECT_EQ(clip(triangle, 64, 64).count, 0) << wrong << ' ' << corner << ' ' << axis;
            }
}

TEST(Clip, cutsAtTheNearPlaneInProportion)
{
    // z <= w is kept: of an edge from z = 0 to z = 4 at w = 1, the quarter next to z = 0.
    const Polygon cut = clip({glm::dvec4(0, 0, 0, 1), {8, 0, 4, 1}, {0, 8, 0, 1}}, 64, 64);
    ASSERT_EQ(cut.count, 4);
    int on = 0;
    for (int i = 0; i < cut.count; ++i)
        on += cut.corner[std::size_t(i)] == glm::dvec4(2, 0, 1, 1)
            || cut.corner[std::size_t(i)] == glm::dvec4(2, 6, 1, 1);
    EXPECT_EQ(on, 2);
}

} // namespace
} // namespace cotan::reference
