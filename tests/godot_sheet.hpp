// The analytic sheet for Godot: its map, its mesh, and the attributes that each frame reads.
#pragma once

#include <algorithm>

#include "cotan/frame.hpp"
#include "cotan/tangents.hpp"
#include "cotan/triangle.hpp"
#include "examples_sheets.hpp"
#include "godot_draw.hpp"

namespace cotan::test {

// Four domes in glTF's convention, 256 x 256, RGBA: red along u, green up the image, flat is (128, 128, 255).
inline constexpr int kMapSize = 256;
inline const std::string& domeBytes()
{
    static const std::string bytes = [] {
        std::string all;
        for (int row = 0; row < kMapSize; ++row)
            for (int column = 0; column < kMapSize; ++column) {
                const Vec n = domes((column + 0.5) / kMapSize, (row + 0.5) / kMapSize);
                const bool flat = dot(n, n) == 0;
                for (const double c : {n[0], -n[1], flat ? 1.0 : n[2]})
                    all += static_cast<char>(std::lround(127 * c + 128));
                all += '\xff';
            }
        return all;
    }();
    return bytes;
}

// The texel at u and v, with z reconstructed from x and y; zero near the texel's edge, where rounding decides.
inline Vec domeTexel(double u, double v)
{
    const double column = (u - std::floor(u)) * kMapSize, row = (v - std::floor(v)) * kMapSize;
    for (const double c : {column, row})
        if (std::abs(c - std::round(c)) < 0.05)
            return {0, 0, 0};
    const std::size_t at = (static_cast<std::size_t>(row) * kMapSize + static_cast<std::size_t>(column)) * 4;
    const auto number = [&](std::size_t k) { return (static_cast<unsigned char>(domeBytes()[at + k]) - 128) / 127.0; };
    const double x = number(0), y = -number(1);
    return {x, y, std::sqrt(std::max(1 - x * x - y * y, 0.0))};
}

// The sheet's two halves, clockwise as in Godot, with the attributes that a frame reads from the mesh.
struct SheetMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;
};

inline SheetMesh sheetMesh()
{
    SheetMesh mesh;
    for (const float left : {-1.0f, 0.0f})
        for (const glm::vec2 corner : {glm::vec2(0, 1), {1, -1}, {0, -1}, {0, 1}, {1, 1}, {1, -1}}) {
            const glm::vec3 p(left + corner.x, corner.y, 0);
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(p);
            mesh.normals.push_back({0, 0, 1});
            mesh.uvs.push_back({std::abs(p.x) + (1 - p.y) / 2, 1 - p.y});
        }
    return mesh;
}

template<class Vector> nlohmann::json numbersOf(const std::vector<Vector>& vectors)
{
    nlohmann::json list = nlohmann::json::array();
    for (const Vector& v : vectors)
        for (int k = 0; k < Vector::length(); ++k)
            list.push_back(v[k]);
    return list;
}

// scale: the mesh is divided by it, for a transform that scales by it.
inline nlohmann::json sheetFor(Frame frame, glm::vec3 scale = glm::vec3(1))
{
    SheetMesh mesh = sheetMesh();
    for (glm::vec3& p : mesh.positions)
        p /= scale;
    nlohmann::json sheet{
        {"positions", numbersOf(mesh.positions)}, {"normals", numbersOf(mesh.normals)}, {"uvs", numbersOf(mesh.uvs)}};
    const MeshView view{mesh.positions, mesh.normals, mesh.uvs, mesh.indices};
    std::vector<glm::vec4> first;
    std::vector<glm::vec3> second;
    if (frame == Frame::triangle)
        for (const TriangleVectors& t : triangleVectors(view))
            for (int corner = 0; corner < 3; ++corner) {
                first.push_back({t.u, 1});
                second.push_back(t.v);
            }
    if (frame == Frame::smooth) {
        const Cotangents c = unitCotangents(smoothCotangents(view));
        for (const glm::vec3& u : c.u)
            first.push_back({u, 1});
        second = c.v;
    }
    if (!second.empty()) {
        sheet["tangents"] = numbersOf(first);
        sheet["colors"] = numbersOf(second);
    }
    if (readsTangents(frame))
        sheet["generate_tangents"] = true;
    return sheet;
}

} // namespace cotan::test
