// The sheet of the three.js example as a glTF model for Cotan's own renderer.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"

namespace cotan::test {

// Writes NAME.gltf with its parts: a sheet of two by two units whose left half has mirrored uv, rotated about y by
// `angle` (radians) and moved to (0.1, -0.05, -3.5), with a camera of 40 degrees at the origin. It is double-sided;
// `map` repeats twice in v.
inline void writeSheet(const std::filesystem::path& folder, const std::string& name, double angle, const Image& map)
{
    using nlohmann::json;
    std::vector<float> positions, normals, uv;
    for (const int cell : {0, 1})
        for (const int corner : {0, 1, 2, 2, 1, 3}) { // counter-clockwise from the front
            const float x = float(cell + corner / 2 - 1), y = corner % 2 ? -1.0f : 1.0f;
            positions.insert(positions.end(), {x, y, 0});
            normals.insert(normals.end(), {0, 0, 1});
            uv.insert(uv.end(), {std::abs(x), 1 - y}); // v down
        }
    json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0, 1}}}}}};
    std::string bytes;
    const auto add = [&](const std::vector<float>& values, const char* type, std::size_t width) {
        root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * 4}});
        root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"type", type},
                                     {"count", values.size() / width}});
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
        return root["accessors"].size() - 1;
    };
    const std::size_t p = add(positions, "VEC3", 3), n = add(normals, "VEC3", 3), t = add(uv, "VEC2", 2);
    root["accessors"][p]["min"] = {-1, -1, 0};
    root["accessors"][p]["max"] = {1, 1, 0};
    const json attributes = {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", t}};
    root["meshes"].push_back({{"primitives", json::array({{{"attributes", attributes}, {"material", 0}}})}});
    root["nodes"].push_back({{"mesh", 0},
                             {"translation", {0.1, -0.05, -3.5}},
                             {"rotation", {0, std::sin(angle / 2), 0, std::cos(angle / 2)}}});
    root["nodes"].push_back({{"camera", 0}});
    root["cameras"].push_back(
        {{"type", "perspective"},
         {"perspective", {{"yfov", 40 * 3.14159265358979 / 180}, {"aspectRatio", 1}, {"znear", 0.1}}}});
    root["materials"].push_back({{"doubleSided", true}, {"normalTexture", {{"index", 0}}}});
    root["textures"].push_back({{"source", 0}});
    root["images"].push_back({{"uri", name + ".png"}});
    root["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", name + ".bin"}});
    std::ofstream(folder / (name + ".bin"), std::ios::binary) << bytes;
    std::ofstream(folder / (name + ".gltf")) << root.dump();
    (void)writeImage(folder / (name + ".png"), map);
}

} // namespace cotan::test
