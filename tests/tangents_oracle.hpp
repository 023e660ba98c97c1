// MikkTSpace tangents that another implementation made, and the comparison with them.
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tangent_meshes.hpp"

namespace cotan::test {

// The file's little-endian floats x y z w, one tangent a triangle corner.
inline std::vector<glm::vec4> readOracle(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::vector<glm::vec4> tangents;
    glm::vec4 t;
    static_assert(std::endian::native == std::endian::little);
    while (stream.read(reinterpret_cast<char*>(&t), sizeof t))
        tangents.push_back(t);
    return tangents;
}

// Whether two tangents differ: another w, or over 0.05 degrees apart (float sums in another order, next to nearly
// cancelling ones, stay below). Where directions cancel out both are zero.
inline bool differ(glm::vec4 a, glm::vec4 b)
{
    constexpr float kApart = 0.05f * std::numbers::pi_v<float> / 180;
    return !(glm::length(glm::vec3(a) - glm::vec3(b)) <= kApart) || a.w != b.w;
}

// Whether neither has a direction, which is (1,0,0) in both: mikktspace.c has w = -1 then whichever way v runs, which
// is +1 or -1 by the way in which it was called.
inline bool bothWithout(glm::vec4 a, glm::vec4 b)
{
    return glm::vec3(a) == glm::vec3(1, 0, 0) && glm::vec3(b) == glm::vec3(1, 0, 0);
}

// Our tangents of one mesh against the oracle's, from oracle[first] on: the number of corners that differ.
inline std::size_t cornersApart(const MeshView& mesh, const std::vector<glm::vec4>& oracle, std::size_t first,
                                const std::string& name)
{
    const std::vector<glm::vec4> ours = mikktspaceTangents(mesh);
    EXPECT_EQ(ours.size(), mesh.indices.size()) << name;
    EXPECT_LE(first + ours.size(), oracle.size()) << name;
    std::size_t apart = 0;
    for (std::size_t c = 0; c < ours.size() && first + c < oracle.size(); ++c)
        apart += !bothWithout(ours[c], oracle[first + c]) && differ(ours[c], oracle[first + c]);
    return apart;
}

} // namespace cotan::test
