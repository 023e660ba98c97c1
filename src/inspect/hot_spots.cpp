#include "cotan/inspect/hot_spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "cotan/lint/lint.hpp"
#include "cotan/lint/triangle_uv.hpp"
#include "cotan/scene/bounds.hpp"

namespace cotan {

namespace {

// One thing that can be wrong with triangles of a mesh: the largest of them counts among the worst.
struct Worst {
    double value = 0, area = 0; // of the worst triangle; of all that are wrong
    double weight = 0;
    std::size_t triangle = 0;

    void take(double found, double itsArea, std::size_t i)
    {
        area += itsArea;
        const double w = found * std::sqrt(itsArea);
        if (w > weight || area == itsArea) {
            weight = w;
            value = found;
            triangle = i;
        }
    }
};

Camera lookingAt(const Scene& scene, const Instance& instance, const Mesh& mesh, std::size_t triangle)
{
    std::array<glm::vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[mesh.indices[3 * triangle + k]], 1));
    const glm::vec3 middle = (p[0] + p[1] + p[2]) / 3.0f;
    glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    if (glm::determinant(glm::mat3(instance.toWorld)) < 0)
        normal = -normal;
    const float length = glm::length(normal);
    normal = length > 0 ? normal / length : glm::vec3(0, 0, 1);
    const Bounds box = bounds(scene);
    const float whole = glm::length(box.high - box.low);
    const float size = std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[0]), whole / 40});
    Camera camera;
    camera.target = middle;
    camera.eye = middle + normal * size * 4.0f;
    if (std::abs(normal.y) > 0.999f)
        camera.up = {0, 0, -1};
    return camera;
}

} // namespace

std::vector<HotSpot> hotSpots(const Scene& scene, std::size_t most)
{
    constexpr std::array<const char*, 4> kKinds = {"uv without area", "stretch {:.2g} : 1", "shear {:.0f} degrees",
                                                   "stored tangent on the wrong side"};
    std::vector<HotSpot> spots;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const auto instance = std::ranges::find(scene.instances, int(m), &Instance::mesh);
        if (instance == scene.instances.end())
            continue;
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const MappedSurface surface = makeSurface(mesh, material.normalMap, glm::dmat3(glm::mat3(instance->toWorld)));
        if (surface.uv.empty())
            continue;
        std::array<Worst, 4> worst;
        double whole = 0;
        for (std::size_t i = 0; i < mesh.triangleCount(); ++i) {
            const double area = areaOf(surface, i);
            const TriangleUv t = triangleUv(surface, i);
            whole += area;
            if (!t.usable)
                continue;
            if (t.degenerate) {
                worst[0].take(1, area, i);
                continue;
            }
            if (t.stretch > kStretched)
                worst[1].take(t.stretch, area, i);
            if (t.shear > kSheared)
                worst[2].take(t.shear, area, i);
            if (!mesh.tangents.empty() && t.orientation != 0
                && (mesh.tangents[mesh.indices[3 * i]].w < 0) != (t.orientation < 0))
                worst[3].take(1, area, i);
        }
        for (std::size_t k = 0; k < worst.size(); ++k) {
            const double share = whole > 0 ? worst[k].area / whole : 0;
            if (share < 0.001)
                continue;
            const double bad = k == 1 ? worst[k].value - 1 : k == 2 ? worst[k].value / 45 : 3;
            spots.push_back({fmt::format("{}, {:.0f} % of {}", fmt::format(fmt::runtime(kKinds[k]), worst[k].value),
                                         share * 100, mesh.name.empty() ? fmt::format("mesh {}", m) : mesh.name),
                             bad * share, lookingAt(scene, *instance, mesh, worst[k].triangle)});
        }
    }
    std::ranges::stable_sort(spots, std::greater(), &HotSpot::badness);
    spots.resize(std::min(spots.size(), most));
    return spots;
}

} // namespace cotan
