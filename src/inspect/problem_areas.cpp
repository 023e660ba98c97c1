#include "cotan/inspect.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "bake/lint/lint_parts.hpp"
#include "cotan/lint.hpp"
#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

// One kind of problem of a mesh, with its worst triangle: the largest value, weighted by the square root of the area.
struct Worst {
    double value = 0, area = 0; // value of the worst triangle; area of all triangles with the problem
    double weight = 0;
    std::size_t triangle = 0;

    void take(double found, double triangleArea, std::size_t i)
    {
        area += triangleArea;
        const double w = found * std::sqrt(triangleArea);
        if (w > weight || area == triangleArea) {
            weight = w;
            value = found;
            triangle = i;
        }
    }
};

std::array<glm::vec3, 3> cornersOf(const Instance& instance, const Mesh& mesh, std::size_t triangle)
{
    std::array<glm::vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[mesh.indices[3 * triangle + k]], 1));
    return p;
}

float longestEdge(const std::array<glm::vec3, 3>& p)
{
    return std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[0]), glm::length(p[2] - p[1])});
}

// A camera whose image is 0.83 of its distance high: the triangle fills at most a third of that, and the image height
// is at least 1/7 of `whole`, the diagonal of the scene.
Camera lookingAt(float whole, const Instance& instance, const std::array<glm::vec3, 3>& p)
{
    const glm::vec3 middle = (p[0] + p[1] + p[2]) / 3.0f;
    glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    if (glm::determinant(glm::mat3(instance.toWorld)) < 0)
        normal = -normal;
    const float length = glm::length(normal);
    normal = length > 0 ? normal / length : glm::vec3(0, 0, 1);
    const float size = std::max(longestEdge(p), whole / 24);
    Camera camera;
    camera.target = middle;
    camera.eye = middle + normal * size * 4.0f;
    if (std::abs(normal.y) > 0.999f)
        camera.up = {0, 0, -1};
    return camera;
}

// Moves the camera closer until nothing hides its target. Leaves it unchanged if the triangle would not fit into the
// image then.
void avoidOccluders(const Scene& scene, const std::array<glm::vec3, 3>& corners, Camera& camera)
{
    constexpr glm::ivec2 kSize{2, 2};
    const float minDistance = 2 * longestEdge(corners);
    Camera nearer = camera;
    for (int tries = 0; tries < 4; ++tries) {
        const glm::vec3 back = nearer.eye - nearer.target;
        const float distance = glm::length(back);
        const auto hit = pick(scene, nearer, kSize, {1, 1}); // the centre of the image
        if (!hit || hit->depth > 0.99f * distance) {
            camera = nearer;
            return;
        }
        const float next = 0.9f * (distance - hit->depth);
        if (next < minDistance)
            return;
        nearer.eye = nearer.target + back * (next / distance);
    }
}

// A kind of problem that lint measures.
struct Kind {
    std::string words;
    const char* here;  // format of the value at the worst triangle; empty: no value
    double weight = 0; // severity of a value of one
    std::string_view view;
    bool storedTangents = false;
};

const std::array<Kind, 5>& kinds()
{
    static const std::array<Kind, 5> all = {
        {{"uv without area", "", 3, "mirrored"},
         {fmt::format("stretched by more than {:.1f}", kStretched), ", here {:.3g}", 0.5, "stretch"},
         {fmt::format("sheared by more than {:.0f} degrees", kSheared), ", here {:.0f}", 1 / 45.0, "shear"},
         {"stored w contradicts the uv", "", 3, "w"},
         {fmt::format("stored tangents rotated by more than {:.0f} degrees", kMaxTangentAngle), ", here {:.0f}",
          1 / 45.0, "tangent", true}}};
    return all;
}

struct Found {
    std::array<Worst, 5> worst;
    double area = 0, compared = 0; // area of all triangles; area with stored tangents that could be compared

    double shareOf(std::size_t kind) const
    {
        const double whole = kind < 3 ? area : compared;
        return whole > 0 ? worst[kind].area / whole : 0;
    }
};

Found findOn(const MappedSurface& surface)
{
    Found found;
    for (std::size_t i = 0; i < surface.triangleCount(); ++i) {
        const TriangleEdges edges = edgesOf(surface, i);
        const double area = areaOf(edges);
        found.area += area;
        const TriangleUv t = triangleUv(surface, i, edges);
        if (!t.usable)
            continue;
        if (t.degenerate)
            found.worst[0].take(1, area, i);
        if (t.stretch > kStretched)
            found.worst[1].take(t.stretch, area, i);
        if (t.shear > kSheared)
            found.worst[2].take(t.shear, area, i);
        if (!surface.hasStored())
            continue;
        for (const StoredCorner& corner : storedCorners(surface, i, edges)) {
            found.compared += corner.compared ? area / 3 : 0;
            if (corner.compared && corner.reversed)
                found.worst[3].take(1, area / 3, i);
            if (corner.compared && corner.degrees > kMaxTangentAngle)
                found.worst[4].take(corner.degrees, area / 3, i);
        }
    }
    return found;
}

} // namespace

std::vector<ProblemArea> problemAreas(const Scene& scene, std::size_t maxCount)
{
    std::vector<ProblemArea> areas;
    const Bounds box = bounds(scene);
    const float whole = glm::length(box.high - box.low);
    std::vector<const Instance*> firstOf(scene.meshes.size()); // first instance of each mesh
    for (const Instance& instance : scene.instances)
        if (const Instance*& first = firstOf[std::size_t(instance.mesh)]; !first)
            first = &instance;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const Instance* const instance = firstOf[m];
        if (!instance)
            continue;
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const std::shared_ptr<const Mesh> held(std::shared_ptr<void>(), &mesh); // the scene outlives the surface
        const MappedSurface surface =
            makeSurface(held, frameTexture(material), glm::dmat3(glm::mat3(instance->toWorld)), {});
        if (!surface.hasUv())
            continue;
        const Found found = findOn(surface);
        for (std::size_t k = 0; k < found.worst.size(); ++k) {
            const Worst& worst = found.worst[k];
            const double share = found.shareOf(k);
            if (share < 0.001)
                continue;
            const std::string name = mesh.name.empty() ? fmt::format("mesh {}", m) : mesh.name;
            const Kind& kind = kinds()[k];
            const std::string text = fmt::format("{}: {:.1f} % of {}", kind.words, share * 100, name)
                + fmt::format(fmt::runtime(kind.here), worst.value);
            const auto corners = cornersOf(*instance, mesh, worst.triangle);
            areas.push_back({text, m, share, kind.weight * worst.value * share, lookingAt(whole, *instance, corners),
                             corners, kind.view, kind.storedTangents});
        }
    }
    std::ranges::stable_sort(areas, std::greater(), &ProblemArea::severity);
    areas.resize(std::min(areas.size(), maxCount));
    for (ProblemArea& area : areas)
        avoidOccluders(scene, area.corners, area.camera);
    return areas;
}

} // namespace cotan
