// A small glTF model for tests of commands, whose parts are separate files.
#pragma once

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"

namespace cotan::test {

using nlohmann::json;

// A rectangle in xy with TANGENT and a map of waves, as JSON and a buffer that tests may change and write.
struct Made {
    json root;
    std::string bytes;
    int add(const std::vector<float>& values, const char* type, int width)
    {
        const std::size_t offset = bytes.size();
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(float)}});
        root["accessors"].push_back({{"bufferView", int(root["bufferViews"].size()) - 1},
                                     {"componentType", 5126},
                                     {"type", type},
                                     {"count", values.size() / std::size_t(width)}});
        return int(root["accessors"].size()) - 1;
    }
};

// stretch: width of the rectangle, whose height is 1; uv cover the unit square. uvScale: scale of the vertices' uv.
inline Made quad(float stretch, float uvScale = 1)
{
    Made m;
    m.root = {{"asset", {{"version", "2.0"}, {"extras", {{"keep", "me"}}}}}, {"scene", 0}};
    const std::vector<float> positions = {0, 0, 0, stretch, 0, 0, stretch, 1, 0, 0, 0, 0, stretch, 1, 0, 0, 1, 0};
    std::vector<float> normals, tangents;
    const float u = uvScale;
    const std::vector<float> uv = {0, u, u, u, u, 0, 0, u, u, 0, 0, 0};
    for (int i = 0; i < 6; ++i) {
        normals.insert(normals.end(), {0, 0, 1});
        tangents.insert(tangents.end(), {1, 0, 0, 1});
    }
    const int p = m.add(positions, "VEC3", 3), n = m.add(normals, "VEC3", 3), t = m.add(tangents, "VEC4", 4),
              c = m.add(uv, "VEC2", 2);
    m.root["accessors"][std::size_t(p)]["min"] = {0, 0, 0};
    m.root["accessors"][std::size_t(p)]["max"] = {stretch, 1, 0};
    m.root["meshes"] = json::array(
        {{{"name", "quad"},
          {"primitives",
           json::array({{{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TANGENT", t}, {"TEXCOORD_0", c}}},
                         {"material", 0}}})}}});
    m.root["nodes"] = json::array({{{"mesh", 0}}});
    m.root["scenes"] = json::array({{{"nodes", {0}}}});
    m.root["materials"] =
        json::array({{{"name", "relief"}, {"normalTexture", {{"index", 0}}}, {"extras", {{"mine", 7}}}}});
    m.root["textures"] = json::array({{{"source", 0}}});
    m.root["images"] = json::array({{{"uri", "waves.png"}}});
    return m;
}

// Rotates TANGENT in its plane.
inline void rotateTangents(Made& m, double degrees)
{
    const float a = float(degrees * 3.14159265358979 / 180);
    const std::size_t accessor = m.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"];
    const std::size_t view = m.root["accessors"][accessor]["bufferView"];
    const std::size_t at = m.root["bufferViews"][view]["byteOffset"];
    for (std::size_t v = 0; v < 6; ++v) {
        const float tangent[] = {std::cos(a), std::sin(a), 0, 1};
        std::memcpy(m.bytes.data() + at + 16 * v, tangent, sizeof tangent);
    }
}

// Adds a clear coat with a normal map: texture 1 reads the image coat.png, the same waves.
inline void addCoat(Made& m, json normalTexture)
{
    m.root["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_texture_transform"};
    m.root["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {
        {"clearcoatFactor", 1},
        {"clearcoatRoughnessFactor", 0.3},
        {"clearcoatNormalTexture", std::move(normalTexture)}};
    m.root["textures"].push_back({{"source", 1}});
    m.root["images"].push_back({{"uri", "coat.png"}});
}

inline void write(Made m, const std::filesystem::path& folder)
{
    std::ofstream(folder / "quad.bin", std::ios::binary) << m.bytes;
    m.root["buffers"] = json::array({{{"byteLength", m.bytes.size()}, {"uri", "quad.bin"}}});
    std::ofstream(folder / "quad.gltf") << m.root.dump();
    ASSERT_TRUE(writeImage(folder / "waves.png", makeReliefMap(Relief::waves, 128)));
    if (m.root["images"].size() > 1 && m.root["images"][1].value("uri", "") == "coat.png")
        std::filesystem::copy_file(folder / "waves.png", folder / "coat.png",
                                   std::filesystem::copy_options::overwrite_existing);
}

// A rectangle that rises by 1 in 2 s, or by 3 in 4 s.
inline Made movingQuad()
{
    Made m = quad(2);
    m.root["animations"] = json::array();
    for (const float length : {2.0f, 4.0f}) {
        const int times = m.add({0, length}, "SCALAR", 1), places = m.add({0, 0, 0, 0, length - 1, 0}, "VEC3", 3);
        m.root["animations"].push_back(
            {{"name", length > 2 ? "high" : "low"},
             {"samplers", json::array({{{"input", times}, {"output", places}}})},
             {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}})}});
    }
    return m;
}

} // namespace cotan::test
