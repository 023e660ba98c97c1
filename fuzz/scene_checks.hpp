// Checks of what must hold for every scene that a reader returns.
#pragma once

#include <algorithm>

#include "cotan/scene.hpp"
#include "cotan/tangents.hpp"
#include "fuzz.hpp"
#include "limits.hpp"
#include "scene/geometry.hpp"

namespace cotan::fuzz {

inline void checkMesh(const Mesh& mesh, const Scene& scene)
{
    const std::size_t count = mesh.vertexCount();
    COTAN_HOLDS(std::size_t(mesh.material) < scene.materials.size(), "{}", mesh.material);
    COTAN_HOLDS(mesh.normals.size() == count, "{} of {}", mesh.normals.size(), count);
    COTAN_HOLDS(mesh.tangents.empty() || mesh.tangents.size() == count, "{} of {}", mesh.tangents.size(), count);
    COTAN_HOLDS(mesh.colors.empty() || mesh.colors.size() == count, "{} of {}", mesh.colors.size(), count);
    for (const auto& uv : mesh.texcoords)
        COTAN_HOLDS(uv.empty() || uv.size() == count, "{} of {}", uv.size(), count);
    COTAN_HOLDS(mesh.indices.size() % 3 == 0, "{}", mesh.indices.size());
    for (const std::uint32_t i : mesh.indices)
        COTAN_HOLDS(i < count, "{} of {}", i, count);
    for (const glm::vec3& p : mesh.positions)
        COTAN_HOLDS(finite(p), "{} {} {}", p.x, p.y, p.z);
    for (const glm::vec3& n : mesh.normals) {
        const float length = glm::length(n);
        COTAN_HOLDS(length == 0 || std::abs(length - 1) < 1e-4f, "{}", length);
    }
}

inline void checkTexture(const Texture& texture, const Scene& scene)
{
    COTAN_HOLDS(texture.image < int(scene.images.size()), "{}", texture.image);
    COTAN_HOLDS(texture.texcoord == 0 || texture.texcoord == 1, "{}", texture.texcoord);
    COTAN_HOLDS(finite(texture.uRow) && finite(texture.vRow));
}

inline void checkScene(const Scene& scene)
{
    for (const Mesh& mesh : scene.meshes)
        checkMesh(mesh, scene);
    for (const Material& m : scene.materials)
        for (const Texture* t :
             {&m.baseColorMap, &m.metallicRoughnessMap, &m.normalMap, &m.occlusionMap, &m.emissiveMap})
            checkTexture(*t, scene);
    for (const Image& image : scene.images)
        COTAN_HOLDS(image.data.size() == image.pixelCount() * image.bytesPerPixel(), "{}", image.name);
    for (const Instance& instance : scene.instances)
        COTAN_HOLDS(std::size_t(instance.mesh) < scene.meshes.size(), "{}", instance.mesh);
    for (const std::string& warning : scene.warnings)
        COTAN_HOLDS(!warning.empty() && warning.find('\n') == std::string::npos, "{}", warning);
    const Bounds box = bounds(scene);
    const Camera camera = fitCamera(box, 640, 360);
    if (!box.empty() && finite(box.high - box.low))
        COTAN_HOLDS(finite(camera.eye) && finite(camera.target));
}

inline MeshView viewOf(const Mesh& mesh) { return {mesh.positions, mesh.normals, mesh.texcoords[0], mesh.indices}; }

// Checks that there is one tangent per corner, and that all are finite if no square of a coordinate overflows.
inline void checkTangents(const MeshView& mesh)
{
    const bool complete =
        mesh.texcoords.size() == mesh.positions.size() && mesh.normals.size() == mesh.positions.size();
    const std::size_t corners = complete ? mesh.indices.size() : 0;
    const auto ordinary = [](const auto& v) { return glm::dot(v, v) < 1e12f; };
    const bool all = std::ranges::all_of(mesh.positions, ordinary) && std::ranges::all_of(mesh.texcoords, ordinary);
    for (const auto& tangents : {mikktspaceTangents(mesh, 1), vertexTangents(mesh)}) {
        COTAN_HOLDS(tangents.size() == corners, "{} of {}", tangents.size(), corners);
        for (const glm::vec4& t : tangents)
            COTAN_HOLDS(!all || (finite(t) && (t.w == 1 || t.w == -1)), "{} {} {} {}", t.x, t.y, t.z, t.w);
    }
    for (const auto& u : smoothCotangents(mesh).u)
        COTAN_HOLDS(!all || finite(u), "{} {} {}", u.x, u.y, u.z);
}

} // namespace cotan::fuzz
