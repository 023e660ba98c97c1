#include "meshes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <glm/common.hpp>

#include <cotan/model.hpp>

namespace {

Mesh centred(Mesh mesh)
{
    glm::vec3 low(1e30f), high(-1e30f);
    for (const glm::vec3 p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 size = high - low;
    const float scale = 2 / std::max({size.x, size.y, size.z});
    for (glm::vec3& p : mesh.positions)
        p = (p - 0.5f * (low + high)) * scale;
    return mesh;
}

Mesh seam()
{
    Mesh mesh = tube(48, 32);
    for (glm::vec2& uv : mesh.texcoords)
        uv.x = std::abs(uv.x - float(std::numbers::pi * kTubeRadius));
    return mesh;
}

Mesh strange()
{
    Mesh mesh = tube(24, 16);
    const auto add = [&](glm::vec3 p, glm::vec2 uv) {
        mesh.positions.push_back(p);
        mesh.normals.push_back({0, 0, 1});
        mesh.texcoords.push_back(uv);
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::uint32_t a = add({1, 0, 0}, {0, 0}), b = add({2, 0, 0}, {1, 0}), c = add({3, 0, 0}, {0, 1}),
                        d = add({1, 1, 0}, {2, 0}), e = add({nan, 0, 0}, {0, 2}), f = add({2, 1, 0}, {nan, 0}),
                        equal = add({1, 0, 0}, {1, 1});
    // Collinear positions, collinear uv, a vertex used twice, one used three times, equal positions, non-finite values.
    for (const std::uint32_t i : {a, b, c, a, b, d, a, b, b, a, a, a, a, equal, d, a, b, e, a, b, f})
        mesh.indices.push_back(i);
    add({0, 1, 0}, {0, 0});                                      // used by no triangle
    mesh.indices.insert(mesh.indices.end(), {0, 1, 0, 5, 5, 5}); // degenerate triangles at regular vertices
    return mesh;
}

Mesh fromFile(const std::string& file)
{
    const auto scene = cotan::loadScene(file);
    if (!scene)
        throw std::runtime_error(scene.error().message);
    for (const cotan::Mesh& mesh : scene->meshes)
        if (!mesh.texcoords[0].empty())
            return centred({mesh.positions, mesh.normals, mesh.texcoords[0], mesh.indices});
    throw std::runtime_error(file + ": expected a mesh with texture coordinates; found none");
}

} // namespace

Mesh named(const std::string& name)
{
    return splitAtMirrors(name == "teapot"        ? centred(teapot())
                              : name == "tube"    ? tube(48, 64)
                              : name == "seam"    ? seam()
                              : name == "strange" ? strange()
                              : name == "large"   ? tube(500, 1000)
                                                  : fromFile(name));
}
