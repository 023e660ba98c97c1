// Small glTF files for tests: JSON with an embedded buffer, written to a folder of their own.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "cotan/model.hpp"
#include "png_maker.hpp"

namespace cotan::test {

using nlohmann::json;

inline std::string base64(const std::string& bytes)
{
    const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// A temporary folder, removed by the destructor.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        static int counter = 0;
        path = std::filesystem::temp_directory_path()
            / ("cotan-gltf-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
        std::filesystem::create_directories(path);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path write(const std::string& name, const std::string& content) const
    {
        std::filesystem::create_directories((path / name).parent_path());
        std::filesystem::remove(path / name); // overwriting makes some file systems wait for the disk
        std::ofstream(path / name, std::ios::binary) << content;
        return path / name;
    }
    std::filesystem::path path;
};

inline Result<Scene> loadText(const std::string& text, const std::string& name = "model.gltf",
                              const LoadLimits& limits = {})
{
    const TemporaryFolder folder;
    return loadGltf(folder.write(name, text), limits);
}

inline std::string word(std::uint32_t value)
{
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &value, 4);
    return bytes;
}

// Component types of glTF.
enum : int { kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126 };

// A 2 x 2 PNG of the colour (128, 128, 255).
inline std::string flatPng()
{
    const std::string row = std::string(1, '\0') + "\x80\x80\xff\x80\x80\xff";
    const Bytes bytes = makePng({.width = 2, .height = 2, .rows = row + row});
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Gltf {
    json root = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    // Adds a buffer view of these numbers, aligned to four bytes.
    template<class T> int view(const std::vector<T>& values)
    {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        const std::size_t offset = bytes.size();
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
        return int(root["bufferViews"].size()) - 1;
    }

    int accessor(json description)
    {
        root["accessors"].push_back(std::move(description));
        return int(root["accessors"].size()) - 1;
    }

    template<class T>
    int accessor(const std::vector<T>& values, const std::string& type, int componentType, bool normalized = false)
    {
        const std::size_t size = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : std::size_t(type.back() - '0');
        return accessor({{"bufferView", view(values)},
                         {"componentType", componentType},
                         {"type", type},
                         {"count", values.size() / size},
                         {"normalized", normalized}});
    }

    int floats(const std::vector<float>& values, const std::string& type) { return accessor(values, type, kFloat); }

    int add(const char* collection, json item)
    {
        root[collection].push_back(std::move(item));
        return int(root[collection].size()) - 1;
    }

    // The file's text, with the buffer as a data URI.
    std::string text() const
    {
        json whole = root;
        if (!bytes.empty())
            whole["buffers"] = {
                {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return whole.dump();
    }

    Result<Scene> load(const LoadLimits& limits = {}) const { return loadText(text(), "model.gltf", limits); }
};

// Positions of a unit square in xy, counter-clockwise seen from +z.
inline const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
inline const std::vector<float> kSquareNormals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
// Upright: v = 0, the top row of the image, is at y = 1.
inline const std::vector<float> kSquareUv = {0, 1, 1, 1, 1, 0, 0, 0};
inline const std::vector<std::uint16_t> kSquareIndices = {0, 1, 2, 0, 2, 3};

// A square with normals and uv, shown by one node. JSON pointers of what tests change: /meshes/0/primitives/0,
// /nodes/0, /materials/0.
inline Gltf square()
{
    Gltf g;
    const json attributes = {{"POSITION", g.floats(kSquare, "VEC3")},
                             {"NORMAL", g.floats(kSquareNormals, "VEC3")},
                             {"TEXCOORD_0", g.floats(kSquareUv, "VEC2")}};
    const int indices = g.accessor(kSquareIndices, "SCALAR", kUShort);
    g.add("materials", {{"name", "first"}});
    g.add("meshes",
          {{"name", "square"}, {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}});
    g.add("nodes", {{"mesh", 0}});
    g.add("scenes", {{"nodes", {0}}});
    return g;
}

inline json& primitive(Gltf& g) { return g.root["meshes"][0]["primitives"][0]; }

// Adds a flat normal map to the square's material.
inline void addNormalMap(Gltf& g)
{
    g.add("images", {{"uri", "data:image/png;base64," + base64(flatPng())}});
    g.add("textures", {{"source", 0}});
    g.root["materials"][0]["normalTexture"] = {{"index", 0}};
}

inline bool warns(const Scene& scene, const std::string& word)
{
    for (const std::string& warning : scene.warnings)
        if (warning.find(word) != std::string::npos)
            return true;
    return false;
}

// Rounding of a few float operations on numbers near one.
inline constexpr float kRounding = 1e-6f;

inline void expectNear(const glm::vec3& a, const glm::vec3& b)
{
    EXPECT_LT(glm::length(a - b), kRounding)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

} // namespace cotan::test

// Defines `name` as the loaded scene; on failure ends the test with the reader's message.
#define COTAN_LOADED(name, result)                                                                                     \
    auto name##Result = (result);                                                                                      \
    ASSERT_TRUE(name##Result) << name##Result.error().message;                                                         \
    auto& name = *name##Result

#define COTAN_REFUSED(result, word)                                                                                    \
    do {                                                                                                               \
        const auto refused = (result);                                                                                 \
        ASSERT_FALSE(refused);                                                                                         \
        EXPECT_EQ(refused.error().kind, cotan::ErrorKind::input);                                                      \
        EXPECT_NE(refused.error().message.find(word), std::string::npos) << refused.error().message;                   \
        EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);                                              \
    } while (false)
