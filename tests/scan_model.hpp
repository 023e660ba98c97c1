// A synthetic scan for tests and benchmarks of large models: a bumpy sphere with one chart and one normal map.
#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"

namespace cotan::test {

struct ScanOptions {
    int rows = 100;        // quads from pole to pole and twice as many around: 4 * rows * rows triangles
    int mapSide = 256;     // width and height of the normal map in texels
    bool tangents = false; // writes TANGENT, along +u
    float repeats = 1;     // of the map along u and v
};

inline std::size_t trianglesOf(const ScanOptions& o) { return 4 * std::size_t(o.rows) * std::size_t(o.rows); }

namespace scan {

// The surface point at u (around) and v (downwards), both from 0 to 1; the poles themselves are left out.
inline glm::dvec3 pointAt(double u, double v)
{
    const double around = 2 * std::numbers::pi * u, up = (0.5 - v) * std::numbers::pi * 0.98;
    const double radius = 1 + 0.03 * std::sin(40 * around) * std::sin(30 * up);
    return radius * glm::dvec3(std::cos(up) * std::cos(around), std::sin(up), -std::cos(up) * std::sin(around));
}

class Glb {
public:
    // Appends bytes; returns the index of their buffer view.
    int addView(const void* bytes, std::size_t size)
    {
        views_.push_back({{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", size}});
        data_.append(static_cast<const char*>(bytes), size);
        data_.resize((data_.size() + 3) / 4 * 4);
        return int(views_.size()) - 1;
    }

    template<class T> int add(const std::vector<T>& elements, int component, const char* type)
    {
        const int view = addView(elements.data(), elements.size() * sizeof(T));
        accessors_.push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", elements.size()}, {"type", type}});
        return int(accessors_.size()) - 1;
    }

    nlohmann::json& accessor(int i) { return accessors_[std::size_t(i)]; }

    void write(nlohmann::json root, const std::filesystem::path& file) const
    {
        root["asset"]["version"] = "2.0";
        root["bufferViews"] = views_;
        root["accessors"] = accessors_;
        root["buffers"] = {{{"byteLength", data_.size()}}};
        std::string text = root.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::ofstream out(file, std::ios::binary);
        const auto word = [&](std::size_t value) {
            const auto w = std::uint32_t(value);
            out.write(reinterpret_cast<const char*>(&w), 4);
        };
        for (const std::size_t w : {std::size_t(0x46546C67), std::size_t(2), 28 + text.size() + data_.size(),
                                    text.size(), std::size_t(0x4E4F534A)})
            word(w);
        out << text;
        word(data_.size());
        word(0x004E4942);
        out << data_;
    }

private:
    nlohmann::json views_ = nlohmann::json::array(), accessors_ = nlohmann::json::array();
    std::string data_;
};

} // namespace scan

// Writes the scan as a .glb file.
inline void writeScan(const std::filesystem::path& file, const ScanOptions& o)
{
    const int columns = 2 * o.rows;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> uv;
    std::vector<std::uint32_t> indices;
    for (int y = 0; y <= o.rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const double u = double(x) / columns, v = double(y) / o.rows, step = 1e-5;
            const glm::dvec3 du = scan::pointAt(u + step, v) - scan::pointAt(u - step, v);
            const glm::dvec3 dv = scan::pointAt(u, v + step) - scan::pointAt(u, v - step);
            positions.emplace_back(scan::pointAt(u, v));
            normals.emplace_back(glm::normalize(glm::cross(dv, du)));
            uv.emplace_back(double(o.repeats) * glm::dvec2(0.001 + 0.998 * u, 0.001 + 0.998 * v));
            if (o.tangents)
                tangents.emplace_back(glm::normalize(du), 1);
        }
    for (int y = 0; y < o.rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto a = std::uint32_t(y * (columns + 1) + x), b = a + std::uint32_t(columns) + 1;
            indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    scan::Glb glb;
    nlohmann::json attributes = {{"POSITION", glb.add(positions, 5126, "VEC3")},
                                 {"NORMAL", glb.add(normals, 5126, "VEC3")},
                                 {"TEXCOORD_0", glb.add(uv, 5126, "VEC2")}};
    glb.accessor(0)["min"] = {-1.1, -1.1, -1.1};
    glb.accessor(0)["max"] = {1.1, 1.1, 1.1};
    if (o.tangents)
        attributes["TANGENT"] = glb.add(tangents, 5126, "VEC4");
    const int corners = glb.add(indices, 5125, "SCALAR");
    const auto png = encodePng(makeReliefMap(Relief::waves, o.mapSide));
    ASSERT_TRUE(png) << png.error().message;
    const int view = glb.addView(png->data(), png->size());
    glb.write(
        {{"scene", 0},
         {"scenes", {{{"nodes", {0}}}}},
         {"nodes", {{{"mesh", 0}}}},
         {"meshes",
          {{{"name", "scan"}, {"primitives", {{{"attributes", attributes}, {"indices", corners}, {"material", 0}}}}}}},
         {"materials", {{{"name", "skin"}, {"normalTexture", {{"index", 0}}}}}},
         {"textures", {{{"source", 0}}}},
         {"images", {{{"name", "relief"}, {"bufferView", view}, {"mimeType", "image/png"}}}}},
        file);
}

} // namespace cotan::test
