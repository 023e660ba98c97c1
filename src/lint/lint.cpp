#include "cotan/lint/lint.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/lint/texel.hpp"
#include "parts.hpp"

namespace cotan {

namespace {

constexpr double kFieldOfView = 45; // degrees, vertical
constexpr double kLines = 1080;     // of the picture
constexpr double kHalfDegree = 0.5;

glm::dmat3 placing(const Scene& scene, std::size_t mesh)
{
    for (const Instance& i : scene.instances)
        if (std::size_t(i.mesh) == mesh)
            return glm::dmat3(glm::dmat4(i.toWorld));
    return glm::dmat3(1);
}

// Where a sphere around everything just fits into the picture.
double fittingDistance(const Scene& scene)
{
    glm::dvec3 low(1e300), high(-1e300);
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& p : scene.meshes[std::size_t(instance.mesh)].positions) {
            const glm::dvec3 world(glm::dmat4(instance.toWorld) * glm::dvec4(glm::dvec3(p), 1));
            if (!std::isfinite(world.x + world.y + world.z))
                continue;
            low = glm::min(low, world);
            high = glm::max(high, world);
        }
    if (low.x > high.x)
        return 1;
    const double radius = glm::length(high - low) / 2;
    return radius > 0 ? radius / std::sin(glm::radians(kFieldOfView / 2)) : 1;
}

// What float derivatives of uv cost: about 1 degree times uv * 1e-6 / footprint, the footprint in
// uv (docs/theory.md, "Rounding"). Both are proportional to 1 / distance.
void addPrecision(PrimitiveLint& p, double distance)
{
    const double footprintPerDistance =
        2 * std::tan(glm::radians(kFieldOfView / 2)) / kLines * p.uv.gradient;
    if (!(footprintPerDistance > 0))
        return;
    const double error = std::max(p.uv.largestUv, 1.0) * 1e-6 / footprintPerDistance;
    p.precision = std::min(error / distance, 180.0);
    p.closest = error / kHalfDegree;
}

PrimitiveLint lintPrimitive(const Scene& scene, const Mesh& mesh, const MappedSurface& surface, double distance)
{
    const Material& material = scene.materials[std::size_t(mesh.material)];
    PrimitiveLint p;
    p.mesh = mesh.name;
    p.material = material.name;
    p.triangles = mesh.triangleCount();
    p.hasUv = !surface.uv.empty();
    p.uv = lint::uvQuality(surface);
    p.steps = lint::edgeSteps(surface);
    p.stored = lint::storedTangents(surface);
    addPrecision(p, distance);
    const int image = material.normalMap.image;
    if (material.normalMap.present() && std::size_t(image) < scene.images.size()) {
        p.image = image;
        if (p.hasUv && hasPixels(scene.images[std::size_t(image)]))
            p.readings = lint::readings(surface, material, scene.images[std::size_t(image)]);
    }
    return p;
}

// Primitives that read the same normal map share its texels; one without a map stands alone.
void addOverlaps(LintReport& report, const std::vector<MappedSurface>& surfaces)
{
    std::map<int, std::pair<std::vector<const MappedSurface*>, std::vector<UvQuality*>>> groups;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const int key = report.primitives[i].image >= 0 ? report.primitives[i].image : -1 - int(i);
        groups[key].first.push_back(&surfaces[i]);
        groups[key].second.push_back(&report.primitives[i].uv);
    }
    for (const auto& [key, group] : groups)
        lint::countOverlaps(group.first, group.second);
}

void addMaps(LintReport& report, const Scene& scene)
{
    std::vector<int> done;
    for (const Material& m : scene.materials) {
        const int image = m.normalMap.image;
        if (!m.normalMap.present() || std::size_t(image) >= scene.images.size()
            || std::find(done.begin(), done.end(), image) != done.end())
            continue;
        done.push_back(image);
        report.maps.push_back(lint::greenEvidence(scene.images[std::size_t(image)], m));
        report.maps.back().image = image;
    }
}

} // namespace

LintReport lintScene(const Scene& scene, const LintOptions& options)
{
    LintReport report;
    report.distance = options.distance > 0 ? options.distance : fittingDistance(scene);
    std::vector<MappedSurface> surfaces;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        surfaces.push_back(
            makeSurface(mesh, scene.materials[std::size_t(mesh.material)].normalMap, placing(scene, i)));
        report.primitives.push_back(lintPrimitive(scene, mesh, surfaces.back(), report.distance));
    }
    addOverlaps(report, surfaces);
    addMaps(report, scene);
    lint::recommend(report);
    return report;
}

} // namespace cotan
