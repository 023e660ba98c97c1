// MikkTSpace tangents that another implementation made, and the comparison with them.
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
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

// Whether the corner's triangle has no area in uv or two equal positions: there the oracle may
// hold its default, which says nothing.
inline bool hasNoDirection(const MeshView& mesh, std::size_t corner)
{
    const auto i = mesh.indices.subspan(corner / 3 * 3, 3);
    const glm::vec2 a = mesh.texcoords[i[1]] - mesh.texcoords[i[0]];
    const glm::vec2 b = mesh.texcoords[i[2]] - mesh.texcoords[i[0]];
    const glm::vec3 p = mesh.positions[i[0]], q = mesh.positions[i[1]], r = mesh.positions[i[2]];
    return a.x * b.y - a.y * b.x == 0 || p == q || q == r || p == r;
}

// Our tangents of one mesh against the oracle's, from oracle[first] on: w is equal everywhere; the
// result counts the corners that are over 0.05 degrees apart (float sums in another order, next
// to nearly cancelling ones, stay below).
inline std::size_t cornersApart(const MeshView& mesh, const std::vector<glm::vec4>& oracle, std::size_t first,
                                const std::string& name)
{
    const std::vector<glm::vec4> ours = mikktspaceTangents(mesh);
    EXPECT_EQ(ours.size(), mesh.indices.size()) << name;
    EXPECT_LE(first + ours.size(), oracle.size()) << name;
    std::size_t apart = 0;
    for (std::size_t c = 0; c < ours.size() && first + c < oracle.size(); ++c) {
        if (hasNoDirection(mesh, c))
            continue;
        const glm::dvec4 expected(oracle[first + c]), found(ours[c]);
        apart += degreesBetween(glm::dvec3(found), glm::dvec3(expected)) > 0.05;
        EXPECT_EQ(found.w, expected.w) << name << ", corner " << c;
    }
    return apart;
}

} // namespace cotan::test
