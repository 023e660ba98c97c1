// MikkTSpace tangents computed by another implementation, and comparison with them.
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
#include "test_data.hpp"

namespace cotan::test {

// The file of the test data that has another implementation's tangents of a model.
inline std::string oracleOf(const std::filesystem::path& model)
{
    return "mikktspace/" + model.stem().string() + ".mikk.f32";
}

// Reads one tangent per triangle corner: little-endian floats x, y, z, w.
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

// Whether two tangents have different w, or differ by more degrees. Sums of floats in another order differ by less than
// 0.05, even near cancellation. Where directions cancel out, both tangents are zero.
inline bool differ(glm::vec4 a, glm::vec4 b, float degrees = 0.05f)
{
    const float tolerance = degrees * std::numbers::pi_v<float> / 180;
    return !(glm::length(glm::vec3(a) - glm::vec3(b)) <= tolerance) || a.w != b.w;
}

// Whether both tangents are (1,0,0), which means no direction. mikktspace.c then has w = -1 for either direction of v,
// which is +1 or -1 in our convention, depending on how it was called.
inline bool neitherHasDirection(glm::vec4 a, glm::vec4 b)
{
    return glm::vec3(a) == glm::vec3(1, 0, 0) && glm::vec3(b) == glm::vec3(1, 0, 0);
}

// Number of corners of a mesh at which our tangents differ from the oracle's, which start at oracle[first].
inline std::size_t differingCorners(const MeshView& mesh, const std::vector<glm::vec4>& oracle, std::size_t first,
                                    const std::string& name)
{
    const std::vector<glm::vec4> ours = mikktspaceTangents(mesh);
    EXPECT_EQ(ours.size(), mesh.indices.size()) << name;
    EXPECT_LE(first + ours.size(), oracle.size()) << name;
    std::size_t different = 0;
    for (std::size_t c = 0; c < ours.size() && first + c < oracle.size(); ++c)
        different += !neitherHasDirection(ours[c], oracle[first + c]) && differ(ours[c], oracle[first + c]);
    return different;
}

} // namespace cotan::test
