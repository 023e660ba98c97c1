// Which triangles around a vertex share a MikkTSpace tangent.
#include <algorithm>

#include <gtest/gtest.h>

#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;

// Number of different tangents at the tip of a fan of n triangles, which is wavy so that each has its own direction.
// Without triangles 0 and n/2 (`whole` is false) the fan falls into two groups that share only the tip.
std::size_t groupsAtTheTip(std::uint32_t n, bool whole)
{
    const glm::vec3 up(0, 0, 1);
    Arrays mesh;
    mesh.add({0, 0, 0}, up, {0.5f, 0.5f});
    for (std::uint32_t i = 0; i < n; ++i) {
        const float a = 6.2831853f * float(i) / float(n), x = std::cos(a), y = std::sin(a);
        mesh.add({x, y, 0.3f * std::sin(3 * a)}, up, {0.5f + 0.5f * x, 0.5f - 0.5f * y});
        if (whole || (i != 0 && i != n / 2))
            for (const std::uint32_t v : {0u, 1 + i, 1 + (i + 1) % n})
                mesh.indices.push_back(v);
    }
    const std::vector<glm::vec4> tangents = cotan::mikktspaceTangents(mesh.view());
    std::vector<glm::vec4> different;
    for (std::size_t c = 0; c < tangents.size(); c += 3)
        if (std::find(different.begin(), different.end(), tangents[c]) == different.end())
            different.push_back(tangents[c]);
    return different.size();
}

TEST(MikktspaceTangents, connectedTrianglesAtAVertexFormOneGroup)
{
    for (const std::uint32_t n :
         {7u, 8u, 9u, 10u, 16u, 17u, 18u, 19u, 41u, 200u}) { // paired differently up to 8, up to 16 and above
        EXPECT_EQ(groupsAtTheTip(n, true), 1u) << n;
        EXPECT_EQ(groupsAtTheTip(n, false), 2u) << n;
    }
}

} // namespace
