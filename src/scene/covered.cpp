// How much work the pixels of a picture are, before it is drawn.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/geometry.hpp"
#include "scene/parts.hpp"

namespace cotan {

namespace {

// All in times the picture. On Mesa's driver for the CPU, 1280 x 720 pixels at one of these limits take about 10 s of
// processor.
constexpr double kDroppedFrom = 20;  // from which on it is worth looking for triangles that repeat
constexpr double kMaxCovered = 64;   // by what hides what is behind
constexpr double kMaxLayers = 16;    // by what is translucent: each is shaded, and put in order
constexpr double kPlainLayer = 0.5;  // of such a one without a coat and the like; with one of these it is 1
constexpr double kFurtherLobe = 0.8; // for each more: coat, sheen, other highlights
constexpr double kMaxLights = 200;   // times what is covered, at most once
constexpr double kMaxEdges = 2;      // by pixels along long edges, of which each is shaded and shows little
constexpr double kLongEdge = 16;     // pixels: shorter ones are what many small triangles have
constexpr double kFewPoints =
    30'000; // models of n times as many vertices, each in its own place, may take n times as long

// A camera's axes and scale.
struct Seeing {
    CameraAxes axes;
    double scale;
    bool orthographic;

    explicit Seeing(const Camera& camera) : axes(cameraAxes(camera)), orthographic(camera.orthographic)
    {
        scale = orthographic ? 2 / double(camera.verticalExtent) : 1 / std::tan(double(camera.verticalFieldOfView) / 2);
    }
    // Beside the middle and above it, in halves of the picture's height times the distance; and the distance.
    glm::dvec3 operator()(const glm::dvec3& p) const
    {
        const glm::dvec3 from = p - axes.eye;
        const double before = glm::dot(from, axes.forward);
        return {glm::dot(from, axes.right) * scale, glm::dot(from, axes.up) * scale,
                orthographic ? (before > 0 ? 1 : 0) : before};
    }
};

// Of a triangle on the picture.
struct Pixels {
    double area = 0, edges = 0;
};

// The area is at most that of its box; half the picture where it reaches behind the eye. side: 1 or -1 where only
// triangles are drawn whose corners turn so, counter-clockwise or clockwise; 0: all are.
Pixels pixelsOf(const std::array<glm::dvec3, 3>& seen, double width, double height, int side)
{
    if (seen[0].z <= 0 || seen[1].z <= 0 || seen[2].z <= 0)
        return {seen[0].z <= 0 && seen[1].z <= 0 && seen[2].z <= 0 ? 0 : width * height / 2, 0};
    std::array<glm::dvec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = glm::dvec2(seen[k]) / seen[k].z * (height / 2);
    const glm::dvec2 half(width / 2, height / 2);
    const glm::dvec2 low = glm::max(glm::min(p[0], glm::min(p[1], p[2])), -half);
    const glm::dvec2 high = glm::min(glm::max(p[0], glm::max(p[1], p[2])), half);
    if (!(low.x < high.x && low.y < high.y))
        return {};
    const glm::dvec2 a = p[1] - p[0], b = p[2] - p[0], box = high - low;
    const double area = (a.x * b.y - a.y * b.x) / 2;
    if (area * side < 0)
        return {};
    return {std::min(std::abs(area), box.x * box.y), std::max(0.0, glm::length(box) - kLongEdge)};
}

struct Covered {
    double opaque = 0, translucent = 0, edges = 0; // pixels
};

double weightOfLayer(const Material& material)
{
    const int lobes = int(material.glossy()) + int(material.sheen.present()) + int(material.coat.strength > 0);
    return lobes == 0 ? kPlainLayer : 1 + kFurtherLobe * (lobes - 1);
}

Covered coveredBy(const Scene& scene, const View& view)
{
    const Seeing see(view.camera);
    Covered all;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const glm::dmat4 toWorld(instance.toWorld);
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const double weight = material.translucent() ? weightOfLayer(material) : 1;
        double& area = material.translucent() ? all.translucent : all.opaque;
        const int side = material.doubleSided ? 0 : glm::determinant(glm::dmat3(toWorld)) < 0 ? -1 : 1;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::array<glm::dvec3, 3> seen;
            for (std::size_t k = 0; k < 3; ++k)
                seen[k] = see(glm::dvec3(toWorld * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + k]]), 1)));
            const Pixels covered = pixelsOf(seen, view.width, view.height, side);
            if (std::isfinite(covered.area) && std::isfinite(covered.edges)) {
                area += weight * covered.area;
                all.edges += covered.edges;
            }
        }
    }
    return all;
}

// The number of different positions among the vertices of all meshes. Not how many vertices there are: a loader may
// have made them, three for each triangle, of a few positions.
std::size_t distinctPositions(const Scene& scene)
{
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) {
        // Sorted, which no choice of positions makes slow: by their bits, which have an order.
        std::vector<std::array<std::uint32_t, 3>> own(mesh.positions.size());
        std::ranges::transform(mesh.positions, own.begin(),
                               [](glm::vec3 p) { return std::bit_cast<std::array<std::uint32_t, 3>>(p); });
        std::ranges::sort(own);
        count += std::size_t(std::unique(own.begin(), own.end()) - own.begin());
    }
    return count;
}

Error tooMuch(const Scene& scene, const std::string& what, double found, double most, const std::string& advice)
{
    std::ostringstream text;
    text << scene.name << ": " << what << " " << std::setprecision(found < 10 ? 2 : 17)
         << (found < 10 ? found : std::round(found)) << " times over, expected at most " << most << ": " << advice;
    return inputError(text.str());
}

} // namespace

double pixelsCovered(const Scene& scene, const View& view)
{
    const Covered covered = coveredBy(scene, view);
    return covered.opaque + covered.translucent;
}

Status settleCovered(Scene& scene, const View& view, std::size_t pictures)
{
    double picture = double(view.width) * view.height / double(pictures);
    Covered covered = coveredBy(scene, view);
    if (covered.opaque > kDroppedFrom * picture) {
        dropRepeated(scene);
        covered = coveredBy(scene, view);
    }
    const struct {
        const char* what;
        double pixels, most;
    } limits[] = {{"its triangles cover the picture", covered.opaque, kMaxCovered},
                  {"its translucent triangles cover the picture", covered.translucent, kMaxLayers},
                  {"the long edges of its triangles fill the picture", covered.edges, kMaxEdges}};
    const auto isOver = [&](const auto& limit) { return limit.pixels > limit.most * picture; };
    if (std::ranges::any_of(limits, isOver)) // only then: it takes time
        picture *= std::max(1.0, double(distinctPositions(scene)) / kFewPoints);
    for (const auto& limit : limits)
        if (isOver(limit))
            return tooMuch(scene, limit.what, limit.pixels / picture, limit.most,
                           "look from further away, or leave some out");
    const double lit = double(view.lights.size()) * std::min(1.0, (covered.opaque + covered.translucent) / picture);
    if (view.output == Output::shaded && lit > kMaxLights)
        return tooMuch(scene, "its lights shine on the picture", lit, kMaxLights, "leave some out");
    return Done{};
}

} // namespace cotan
