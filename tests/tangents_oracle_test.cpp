// Compares MikkTSpace tangents of OBJ models with those of another implementation.
#include <array>
#include <cstdio>
#include <map>
#include <sstream>

#include "tangents_oracle.hpp"

namespace {

using namespace cotan::test;

// Reads an OBJ file whose corners are all v/vt/vn; polygons become fans. v is negated, which directs it downwards
// without rounding.
Arrays readObj(const std::filesystem::path& file)
{
    Arrays a;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::map<std::array<unsigned, 3>, std::uint32_t> seen;
    std::ifstream stream(file);
    for (std::string text; std::getline(stream, text);) {
        std::istringstream line(text);
        std::string word;
        line >> word;
        glm::vec3 x(0);
        if (word == "v" || word == "vn") {
            line >> x.x >> x.y >> x.z;
            (word == "v" ? positions : normals).push_back(x);
        } else if (word == "vt") {
            line >> x.x >> x.y;
            texcoords.emplace_back(x.x, -x.y);
        } else if (word == "f") {
            std::vector<std::uint32_t> polygon;
            std::array<unsigned, 3> k{};
            while (line >> word && std::sscanf(word.c_str(), "%u/%u/%u", &k[0], &k[1], &k[2]) == 3) {
                const auto [entry, isNew] = seen.try_emplace(k, std::uint32_t(a.positions.size()));
                if (isNew)
                    a.add(positions.at(k[0] - 1), normals.at(k[2] - 1), texcoords.at(k[1] - 1));
                polygon.push_back(entry->second);
            }
            for (std::size_t i = 2; i < polygon.size(); ++i)
                a.indices.insert(a.indices.end(), {polygon[0], polygon[i - 1], polygon[i]});
        }
    }
    return a;
}

class MikktspaceOracle : public testing::TestWithParam<const char*> {};

TEST_P(MikktspaceOracle, agreesOnObjModel)
{
    const std::filesystem::path model = dataFile(GetParam());
    const std::string oracle = oracleOf(model);
    COTAN_NEEDS_DATA(GetParam());
    COTAN_NEEDS_DATA(oracle);
    const Arrays a = readObj(model);
    std::vector<glm::vec4> expected = readOracle(dataFile(oracle));
    ASSERT_EQ(a.indices.size(), expected.size());
    // The oracle was computed with v upwards. Corners without a direction have w = -1 for either direction of v, which
    // is +1 in our convention.
    const std::vector<glm::vec4> ours = mikktspaceTangents(a.view());
    for (std::size_t c = 0; c < expected.size(); ++c)
        if (ours[c] == glm::vec4(1, 0, 0, 1) && expected[c] == glm::vec4(1, 0, 0, -1))
            expected[c].w = 1;
    const std::string name = model.stem().string();
    EXPECT_EQ(differingCorners(a.view(), expected, 0, name), 0u);
    EXPECT_EQ(differingCorners(unindexed(a).view(), expected, 0, name + ", unindexed"), 0u);
}

INSTANTIATE_TEST_SUITE_P(Models, MikktspaceOracle,
                         testing::Values("bake/bunny/bunny_low.obj", "classic/normal_map_stress_test_low.obj",
                                         "classic/teapot_patches.obj"),
                         [](const auto& model) { return std::filesystem::path(model.param).stem().string(); });

} // namespace
