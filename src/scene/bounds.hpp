// The box around a scene, and how much of it there is to draw.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/common.hpp>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/vector.hpp"

namespace cotan {

// Instances times vertices up to which the box is the smallest one: a tenth of a second.
inline constexpr std::size_t kMaxPlacedVertices = std::size_t(1) << 24;

// What a picture may draw, instances multiplied: minutes on a processor, and the memory of the
// reference renderer, which takes about 150 bytes a triangle.
inline constexpr std::size_t kMaxTrianglesDrawn = 100'000'000;

// The mesh that an instance places; null where it has none.
inline const Mesh* meshPlacedBy(const Scene& scene, const Instance& instance)
{
    const bool known = instance.mesh >= 0 && std::size_t(instance.mesh) < scene.meshes.size();
    return known ? &scene.meshes[std::size_t(instance.mesh)] : nullptr;
}

// A box that holds nothing, and every float is outside of it on both sides.
inline Bounds emptyBounds()
{
    return {glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
}

// Makes the box hold the point as the matrix moves it, unless that is not finite.
inline void extend(Bounds& box, const glm::mat4& toWorld, const glm::vec3& p)
{
    const glm::vec3 world(toWorld * glm::vec4(p, 1));
    if (!isFinite(world))
        return;
    box.low = glm::min(box.low, world);
    box.high = glm::max(box.high, world);
}

// The box around the finite vertices of a mesh, in its own space.
inline Bounds bounds(const Mesh& mesh)
{
    Bounds box = emptyBounds();
    for (const glm::vec3& p : mesh.positions)
        extend(box, glm::mat4(1), p);
    return box;
}

// Calls work(toWorld, point) for the points in whose box a scene lies: every vertex of every instance up to
// kMaxPlacedVertices; beyond, the corners of each instance's mesh's box.
template<class Work> void forEachPlacedPoint(const Scene& scene, const Work& work)
{
    std::size_t placed = 0;
    for (const Instance& instance : scene.instances)
        if (const Mesh* mesh = meshPlacedBy(scene, instance))
            placed += mesh->positions.size();

    std::vector<std::optional<Bounds>> own(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
        const Mesh* mesh = meshPlacedBy(scene, instance);
        if (!mesh)
            continue;
        if (placed <= kMaxPlacedVertices) {
            for (const glm::vec3& p : mesh->positions)
                work(instance.toWorld, p);
            continue;
        }
        std::optional<Bounds>& b = own[std::size_t(instance.mesh)];
        if (!b)
            b = bounds(*mesh);
        for (int corner = 0; corner < 8 && !b->empty(); ++corner)
            work(instance.toWorld,
                 glm::vec3(corner & 1 ? b->high.x : b->low.x, corner & 2 ? b->high.y : b->low.y,
                           corner & 4 ? b->high.z : b->low.z));
    }
}

// The box around all instances in world space; positions that are not finite count for nothing. It is
// the smallest one up to kMaxPlacedVertices; beyond, each instance counts with the corners of its mesh's
// box, which a matrix that turns makes larger: by sqrt(3) along an axis at most.
inline Bounds bounds(const Scene& scene)
{
    Bounds box = emptyBounds();
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& p) { extend(box, toWorld, p); });
    return box;
}

// The same for the points that a camera frames: those of Scene::reach where it has some.
template<class Work> void forEachFramedPoint(const Scene& scene, const Work& work)
{
    for (const glm::vec3& p : scene.reach)
        work(glm::mat4(1), p);
    if (scene.reach.empty())
        forEachPlacedPoint(scene, work);
}

inline Bounds framedBounds(const Scene& scene)
{
    Bounds box = emptyBounds();
    forEachFramedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& p) { extend(box, toWorld, p); });
    return box;
}

// Triangles of all instances together.
inline std::size_t trianglesDrawn(const Scene& scene)
{
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        if (const Mesh* mesh = meshPlacedBy(scene, instance))
            count += mesh->triangleCount();
    return count;
}

// Refuses a scene that no renderer here draws in reasonable time, before memory is taken.
inline Status checkTrianglesDrawn(const Scene& scene)
{
    const std::size_t count = trianglesDrawn(scene);
    if (count <= kMaxTrianglesDrawn)
        return Done{};
    return inputError((scene.name.empty() ? "scene" : scene.name) + ": " + std::to_string(scene.instances.size())
                      + " instances draw " + std::to_string(count) + " triangles: expected at most "
                      + std::to_string(kMaxTrianglesDrawn));
}

} // namespace cotan
