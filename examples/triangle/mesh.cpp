#include "mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cotan/model.hpp>
#include <cotan/scene.hpp>
#include <cotan/tangents.hpp>

namespace {

// Adds a sheet of two by two units around (middle, 0, -4), rotated about y.
void addSheet(Mesh& mesh, float middle, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 6; ++i) {
        const float x = float(i / 2 - 1), y = i % 2 == 0 ? 1.0f : -1.0f;
        mesh.positions.push_back({middle + c * x, y, -4 - s * x});
        mesh.normals.push_back({s, 0, c});
        mesh.texcoords.push_back({std::fabs(x) + 0.5f * (1 - y), 1 - y});
    }
    for (const std::uint32_t corner : {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5})
        mesh.indices.push_back(first + corner);
}

// The mesh, rotated a little and scaled to fit 5 x 3 units at distance 4 from the eye.
Mesh placed(const cotan::Mesh& source)
{
    Mesh mesh{source.positions, source.normals, source.texcoords[0], source.indices};
    const float c = std::cos(0.5f), s = std::sin(0.5f), d = std::cos(0.4f), t = std::sin(0.4f);
    const auto rotated = [&](glm::vec3 p) {
        const glm::vec3 q(c * p.x + s * p.z, p.y, c * p.z - s * p.x); // about y, then about x
        return glm::vec3(q.x, d * q.y - t * q.z, t * q.y + d * q.z);
    };
    glm::vec3 low(1e30f), high(-1e30f);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = rotated(mesh.positions[i]);
        mesh.normals[i] = rotated(mesh.normals[i]);
        low = glm::min(low, mesh.positions[i]);
        high = glm::max(high, mesh.positions[i]);
    }
    const glm::vec3 size = high - low;
    const float scale = std::min(5 / size.x, 3 / size.y);
    for (glm::vec3& p : mesh.positions)
        p = (p - 0.5f * (low + high)) * scale + glm::vec3(0, 0, -4);
    return mesh;
}

} // namespace

Mesh sheets()
{
    Mesh mesh;
    addSheet(mesh, -1.2f, 0.4f);
    addSheet(mesh, 1.2f, 3.14159265f - 0.4f);
    return mesh;
}

Mesh teapot() { return placed(cotan::makeTeapot(12)); }

Mesh splitAtMirrors(const Mesh& mesh)
{
    const cotan::VertexSplit split = cotan::splitMirrored({mesh.positions, mesh.normals, mesh.texcoords, mesh.indices});
    Mesh out;
    out.indices = split.indices;
    for (const std::uint32_t source : split.sources) {
        out.positions.push_back(mesh.positions[source]);
        out.normals.push_back(mesh.normals[source]);
        out.texcoords.push_back(mesh.texcoords[source]);
    }
    return out;
}

Mesh model(const std::string& file)
{
    const auto scene = cotan::loadScene(file);
    if (!scene)
        std::fprintf(stderr, "triangle_example: %s\n", scene.error().message.c_str()), std::exit(2);
    for (const cotan::Mesh& mesh : scene->meshes)
        if (!mesh.texcoords[0].empty())
            return placed(mesh);
    std::fprintf(stderr, "triangle_example: %s: expected a mesh with texture coordinates; found none\n", file.c_str());
    std::exit(2);
}
