// Deforming models: stored tangents that follow the pose, compared with frames derived from the posed surface.
// docs/explanation/deforming.md has the numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cotan/gltf.hpp"
#include "cotan/portable.hpp"
#include "cotan/triangle.hpp"
#include "gltf/json/lookup.hpp"
#include "gltf_maker.hpp"
#include "test_data.hpp"

namespace cotan::test {
namespace {

// ---- vertex attributes that a file lacks ----

// The JSON and the binary part of a GLB file.
struct Glb {
    json root;
    std::string bytes;
};

Glb readGlb(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string all(std::istreambuf_iterator<char>(stream), {});
    std::uint32_t length = 0;
    std::memcpy(&length, all.data() + 12, 4);
    return {json::parse(all.substr(20, length)), all.substr(28 + length)};
}

void writeGlb(const std::filesystem::path& file, Glb glb)
{
    glb.bytes.resize((glb.bytes.size() + 3) / 4 * 4);
    glb.root["buffers"][0]["byteLength"] = glb.bytes.size();
    std::string text = glb.root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t n) {
        const std::uint32_t value = static_cast<std::uint32_t>(n);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &value, 4);
        return bytes;
    };
    std::ofstream(file, std::ios::binary)
        << "glTF" << word(2) << word(28 + text.size() + glb.bytes.size()) << word(text.size()) << "JSON" << text
        << word(glb.bytes.size()) << std::string("BIN\0", 4) << glb.bytes;
}

// Adds normals averaged over equal positions to a file whose only primitive has neither indices nor normals.
void addNormals(Glb& glb, const std::vector<glm::vec3>& positions)
{
    std::map<std::array<float, 3>, glm::vec3> sums;
    const auto key = [](glm::vec3 p) { return std::array{p.x, p.y, p.z}; };
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k)
            sums[key(positions[i + k])] += glm::cross(positions[i + 1] - positions[i], positions[i + 2] - positions[i]);
    glb.bytes.resize((glb.bytes.size() + 3) / 4 * 4);
    glb.root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", glb.bytes.size()}, {"byteLength", 12 * positions.size()}});
    glb.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = glb.root["accessors"].size();
    glb.root["accessors"].push_back({{"bufferView", glb.root["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"type", "VEC3"},
                                     {"count", positions.size()}});
    for (const glm::vec3 p : positions) {
        const glm::vec3 n = glm::normalize(sums[key(p)]);
        glb.bytes.append(reinterpret_cast<const char*>(&n.x), 12);
    }
}

// Writes the model with MikkTSpace tangents of its rest pose; returns the path.
std::filesystem::path withTangents(const TemporaryFolder& folder, const std::string& name)
{
    std::filesystem::path source = dataFile("animated/" + name);
    if (name == "Fox.glb") { // Fox.glb has no normals
        auto document = openGltfDocument(source);
        EXPECT_TRUE(document);
        Glb glb = readGlb(source);
        addNormals(glb, gltfGeometry(*document, 0, 0)->positions);
        source = folder.path / "fox-with-normals.glb";
        writeGlb(source, std::move(glb));
    }
    auto document = openGltfDocument(source);
    EXPECT_TRUE(document) << document.error().message;
    std::vector<GltfCornerTangents> tangents;
    for (std::size_t m = 0; m < rootOf(*document)["meshes"].size(); ++m)
        for (std::size_t p = 0; p < rootOf(*document)["meshes"][m]["primitives"].size(); ++p) {
            const auto g = gltfGeometry(*document, m, p);
            std::vector<glm::vec3> normals = g->normals;
            for (glm::vec3& n : normals)
                n = glm::normalize(n);
            tangents.push_back({m, p, mikktspaceTangents({g->positions, normals, g->texcoords, g->indices}, 1)});
        }
    EXPECT_TRUE(setGltfTangents(*document, tangents));
    const std::filesystem::path file = folder.path / "tangents.glb";
    EXPECT_TRUE(writeGltf(*document, file));
    return file;
}

// ---- errors of perturbed normals ----

enum Method { kStored, kRemade, kTriangle, kSmooth, kMethods };
using Errors = std::array<double, kMethods>; // mean degrees, weighted by area

glm::dvec3 waves(glm::dvec2 uv)
{
    const glm::dvec2 phase = uv * (16 * std::numbers::pi);
    return glm::normalize(glm::dvec3(0.7 * std::sin(phase.x), 0.7 * std::sin(phase.y), 1));
}

glm::vec3 byTangent(glm::vec3 n, glm::vec4 t, glm::vec3 m)
{
    return f32::cotan_apply(f32::cotan_frame_mikktspace(n, glm::vec3(t), t.w), {m.x, -m.y, m.z});
}

double degrees(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

// The posed triangles are the surface and texcoords are linear on each, so the exact gradients are known. All methods
// use the interpolated normal as the engine transforms it.
void add(const Mesh& mesh, Errors& sums, double& area)
{
    const auto& uv = mesh.texcoords[0];
    if (uv.empty() || mesh.tangents.empty())
        return;
    const MeshView view{mesh.positions, mesh.normals, uv, mesh.indices};
    const std::vector<glm::vec4> remade = mikktspaceTangents(view, 1);
    const std::vector<TriangleVectors> triangles = triangleVectors(view, 1);
    const SplitCotangents smooth = splitSmoothCotangents(view);
    const Cotangents unit = unitCotangents(smooth.cotangents);
    for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
        const std::array v{mesh.indices[f], mesh.indices[f + 1], mesh.indices[f + 2]};
        const glm::dvec3 p0(mesh.positions[v[0]]), e1 = glm::dvec3(mesh.positions[v[1]]) - p0,
                                                   e2 = glm::dvec3(mesh.positions[v[2]]) - p0;
        const glm::dvec2 d1 = glm::dvec2(uv[v[1]]) - glm::dvec2(uv[v[0]]),
                         d2 = glm::dvec2(uv[v[2]]) - glm::dvec2(uv[v[0]]);
        const double size = glm::length(glm::cross(e1, e2)) / 2;
        if (!(size > 0) || std::abs(d1.x * d2.y - d1.y * d2.x) < 1e-9)
            continue;
        for (const glm::vec3 w : {glm::vec3(1, 1, 1) / 3.0f, glm::vec3(4, 1, 1) / 6.0f, glm::vec3(1, 4, 1) / 6.0f,
                                  glm::vec3(1, 1, 4) / 6.0f}) {
            const auto at = [&](const auto& values, const auto& index) {
                return values[index[0]] * w.x + values[index[1]] * w.y + values[index[2]] * w.z;
            };
            const std::array corner{f, f + 1, f + 2};
            const std::array s{smooth.split.indices[f], smooth.split.indices[f + 1], smooth.split.indices[f + 2]};
            const glm::vec3 n = at(mesh.normals, v);
            const glm::dvec3 m = waves(glm::dvec2(at(uv, v)));
            if (!(glm::length(n) > 0.1f))
                continue;
            const glm::dvec3 truth =
                f64::cotan_apply(f64::cotan_frame_cotangent(glm::normalize(glm::dvec3(n)), e1, e2, d1, d2), m);
            const TriangleVectors& t = triangles[f / 3];
            const std::array<glm::vec3, kMethods> found = {
                byTangent(n, at(mesh.tangents, v), m), byTangent(n, at(remade, corner), m),
                f32::cotan_perturb_triangle(n, t.u, t.v, m),
                f32::cotan_perturb_smooth(n, at(unit.u, s), at(unit.v, s), m)};
            for (std::size_t method = 0; method < kMethods; ++method)
                sums[method] += degrees(found[method], truth) * size / 4;
        }
        area += size;
    }
}

Errors errorsOf(const std::filesystem::path& file, const std::string& animation, double seconds)
{
    LoadLimits limits;
    if (!animation.empty())
        limits.pose = {animation, seconds};
    const auto scene = loadGltf(file, limits);
    EXPECT_TRUE(scene) << scene.error().message;
    Errors sums{};
    double area = 0;
    for (const Mesh& mesh : scene->meshes)
        add(mesh, sums, area);
    EXPECT_GT(area, 0);
    for (double& sum : sums)
        sum /= area;
    return sums;
}

class DeformingModel : public testing::TestWithParam<const char*> {};

TEST_P(DeformingModel, derivedFramesFollowAndStoredTangentsDoNot)
{
    COTAN_NEEDS_DATA(std::string("animated/") + GetParam());
    const std::map<std::string, std::vector<std::pair<std::string, double>>> moments = {
        {"MorphStressTest.gltf", {{"Pulse", 0.5}, {"TheWave", 1}, {"TheWave", 2}, {"Individuals", 1}}},
        {"Fox.glb", {{"Survey", 1}, {"Walk", 0.35}, {"Run", 0.2}, {"Run", 0.6}}},
        {"lumberjack.glb", {{"Walk", 0.5}, {"Poses", 2}, {"Poses", 4}}}};
    TemporaryFolder folder;
    const auto file = withTangents(folder, GetParam());
    const Errors rest = errorsOf(file, "", 0);
    const auto tell = [](const std::string& what, const Errors& e) {
        std::string row;
        for (const double degrees : e)
            row += std::to_string(degrees).substr(0, 4) + " ";
        ::testing::Test::RecordProperty(what, row);
    };
    tell("rest", rest);
    double largest = 0;
    for (const auto& [animation, seconds] : moments.at(GetParam())) {
        const Errors posed = errorsOf(file, animation, seconds);
        tell(animation + std::to_string(int(100 * seconds)), posed);
        largest = std::max(largest, posed[kStored]);
        EXPECT_LT(posed[kTriangle], posed[kStored] / 5) << animation;
        EXPECT_LT(posed[kSmooth], posed[kStored]) << animation;
        EXPECT_NEAR(posed[kRemade], posed[kStored], 0.3) << animation; // recomputed tangents are still orthonormal
    }
    // The lumberjack's bones are rigid. Parts that swell, or stretch like the fox's legs, deform the texture.
    if (std::string(GetParam()) != "lumberjack.glb") {
        EXPECT_GT(largest, rest[kStored] + 3);
    }
}

INSTANTIATE_TEST_SUITE_P(Models, DeformingModel, testing::Values("MorphStressTest.gltf", "Fox.glb", "lumberjack.glb"),
                         [](const auto& model) { return std::string(model.param, std::strchr(model.param, '.')); });

} // namespace
} // namespace cotan::test
