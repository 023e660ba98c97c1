// One folded sheet as glTF files that store its triangles in every unusual way: lists, strips and fans; triangles
// without area; indices of 8, 16 and 32 bits or none; vertices shared, also across a mirrored seam, or not.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cotan::test {

struct OddModel {
    const char* name;
    int mode = 4;                       // glTF: 4 list, 5 strip, 6 fan
    std::vector<std::uint32_t> indices; // into the six vertices below
    int bits = 32;                      // 0: no indices, one vertex for each of them
};

// Vertices 0 and 1 are on the left edge, 2 and 3 on the fold, 4 and 5 on the right edge; u is mirrored at the fold.
inline const std::vector<OddModel>& oddModels()
{
    static const std::vector<OddModel> models = {
        {"list of 32 bits", 4, {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5}, 32},
        {"list with triangles without area", 4, {1, 1, 2, 0, 1, 2, 2, 1, 3, 3, 3, 3, 2, 3, 4, 4, 3, 5, 0, 5, 5}, 16},
        {"strip of 8 bits", 5, {0, 1, 2, 3, 4, 5}, 8},
        {"strip that turns corners", 5, {0, 1, 2, 3, 3, 2, 2, 3, 4, 5}, 16},
        {"fan", 6, {2, 0, 1, 3, 5, 4}, 8},
        {"list without indices", 4, {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5}, 0},
        {"strip without indices", 5, {0, 1, 2, 3, 4, 5}, 0}};
    return models;
}

inline void writeOddModel(const std::filesystem::path& file, const OddModel& model)
{
    using nlohmann::json;
    json root = {
        {"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
    std::string bytes;
    const auto add = [&](const void* data, std::size_t size, int component, const char* type, std::size_t count) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
        bytes.append(static_cast<const char*>(data), size);
        root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"type", type},
                                     {"count", count}});
        return root["accessors"].size() - 1;
    };
    const auto addFloats = [&](const std::vector<float>& values, const char* type, std::size_t width) {
        return add(values.data(), values.size() * 4, 5126, type, values.size() / width);
    };
    std::vector<float> positions, normals, uv;
    std::vector<std::uint32_t> vertices = {0, 1, 2, 3, 4, 5};
    if (model.bits == 0)
        vertices = model.indices;
    for (const std::uint32_t v : vertices) {
        const float x = float(v / 2) - 1, y = v % 2 ? -1.0f : 1.0f;
        positions.insert(positions.end(), {x, y, -0.2f * std::abs(x)});
        normals.insert(normals.end(), {0, 0, 1});
        uv.insert(uv.end(), {std::abs(x) + 0.5f * (1 - y), 1 - y}); // sheared; v down
    }
    const std::size_t p = addFloats(positions, "VEC3", 3);
    root["accessors"][p]["min"] = {-1, -1, -0.2f};
    root["accessors"][p]["max"] = {1, 1, 0};
    json primitive = {
        {"mode", model.mode},
        {"attributes",
         {{"POSITION", p}, {"NORMAL", addFloats(normals, "VEC3", 3)}, {"TEXCOORD_0", addFloats(uv, "VEC2", 2)}}}};
    if (model.bits > 0) {
        std::string packed; // little-endian
        for (const std::uint32_t i : model.indices)
            packed.append(reinterpret_cast<const char*>(&i), std::size_t(model.bits) / 8);
        const int component = model.bits == 8 ? 5121 : model.bits == 16 ? 5123 : 5125;
        primitive["indices"] = add(packed.data(), packed.size(), component, "SCALAR", model.indices.size());
    }
    root["meshes"].push_back({{"primitives", json::array({primitive})}});
    const std::filesystem::path buffer = std::filesystem::path(file).replace_extension(".bin");
    root["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", buffer.filename().string()}});
    std::ofstream(buffer, std::ios::binary) << bytes;
    std::ofstream(file) << root.dump();
}

} // namespace cotan::test
