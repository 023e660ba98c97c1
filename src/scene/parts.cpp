#include "scene/parts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/tangents_mesh.hpp"
#include "cotan/covector.hpp"
#include "cotan/vector.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

constexpr std::size_t kSmall = 256;         // triangles of a mesh that is put together with others
constexpr std::size_t kMaxJoined = 4 << 20; // triangles

bool isOpaque(const Scene& scene, const Mesh& mesh)
{
    const Material& m = scene.materials[std::size_t(mesh.material)];
    return m.alphaMode == AlphaMode::opaque && !m.translucent();
}

// ---- parts ----------------------------------------------------------------------------------

// Meshes with the same key have the same arrays.
auto keyOf(const Mesh& mesh)
{
    return std::tuple(mesh.material, mesh.normals.empty(), mesh.tangents.empty(), mesh.texcoords[0].empty(),
                      mesh.texcoords[1].empty(), mesh.colors.empty());
}

// Adds a mesh as an instance places it: tangents along with positions, normals as covectors. A mirroring matrix turns
// the order of corners round, and the sign of tangents.
void append(Mesh& whole, const Mesh& part, const glm::mat4& toWorld)
{
    const LinearMap<double> map{glm::dmat3(toWorld)};
    const glm::dmat4 place(toWorld);
    const bool mirrored = map.determinant() < 0;
    const auto base = std::uint32_t(whole.positions.size());
    for (const glm::vec3& p : part.positions)
        whole.positions.emplace_back(place * glm::dvec4(glm::dvec3(p), 1));
    for (const glm::vec3& n : part.normals)
        whole.normals.push_back(unitOrZero(map.planeImage(Covector3d(glm::dvec3(n))).raw()));
    for (const glm::vec4& t : part.tangents)
        whole.tangents.emplace_back(unitOrZero(map(Vector3d(glm::dvec3(t))).raw()), mirrored ? -t.w : t.w);
    for (std::size_t set = 0; set < 2; ++set)
        whole.texcoords[set].insert(whole.texcoords[set].end(), part.texcoords[set].begin(), part.texcoords[set].end());
    whole.colors.insert(whole.colors.end(), part.colors.begin(), part.colors.end());
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3)
        for (const std::size_t k : {std::size_t(0), std::size_t(mirrored ? 2 : 1), std::size_t(mirrored ? 1 : 2)})
            whole.indices.push_back(base + part.indices[i + k]);
}

// All that says how a mesh looks, but for its material.
auto arraysOf(const Mesh& m) { return std::tuple_cat(std::tie(m.indices), attributesOf(m)); }

template<class T> std::string_view bytesOf(const std::vector<T>& array)
{
    return {reinterpret_cast<const char*>(array.data()), array.size() * sizeof(T)};
}

// For each mesh the first that is the same. By their bytes, which have an order: no choice of meshes makes that slow.
std::vector<int> firstSame(const std::vector<Mesh>& meshes)
{
    const auto key = [](const Mesh& mesh) {
        const auto with = [&](const auto&... arrays) { return std::tuple(mesh.material, bytesOf(arrays)...); };
        return std::apply(with, arraysOf(mesh));
    };
    std::map<decltype(key(meshes[0])), int> known;
    std::vector<int> first;
    for (const Mesh& mesh : meshes)
        first.push_back(known.try_emplace(key(mesh), int(first.size())).first->second);
    return first;
}

void joinSmall(Scene& scene)
{
    const std::vector<int> first = firstSame(scene.meshes);
    std::set<std::pair<std::array<std::uint32_t, 16>, int>> placed; // opaque: a second in the first's place is not seen
    std::map<decltype(keyOf(Mesh{})), Mesh> joined;
    std::vector<Instance> kept;
    std::size_t triangles = 0;
    for (Instance& instance : scene.instances) {
        if (!isFinite(instance.toWorld))
            continue;
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const std::size_t count = mesh.triangleCount();
        if (count > kSmall || triangles + count > kMaxJoined || !mesh.cotangentsU.empty()) {
            kept.push_back(std::move(instance));
            continue;
        }
        const auto place = std::bit_cast<std::array<std::uint32_t, 16>>(instance.toWorld);
        if (isOpaque(scene, mesh) && !placed.emplace(place, first[std::size_t(instance.mesh)]).second)
            continue;
        triangles += count;
        Mesh& whole = joined[keyOf(mesh)];
        whole.material = mesh.material;
        append(whole, mesh, instance.toWorld);
    }
    std::vector<int> number(scene.meshes.size(), -1);
    std::vector<Mesh> meshes;
    for (auto& [key, mesh] : joined)
        meshes.push_back(std::move(mesh));
    const std::size_t wholes = meshes.size();
    for (Instance& instance : kept) {
        int& n = number[std::size_t(instance.mesh)];
        if (n < 0) {
            n = int(meshes.size());
            meshes.push_back(std::move(scene.meshes[std::size_t(instance.mesh)]));
        }
        instance.mesh = n;
    }
    for (std::size_t i = 0; i < wholes; ++i)
        kept.push_back({"", int(i), glm::mat4(1)});
    scene.meshes = std::move(meshes);
    scene.instances = std::move(kept);
}

// ---- triangles ------------------------------------------------------------------------------

constexpr std::size_t kAsked = 4096; // triangles of the sample
constexpr std::size_t kMany = 40;    // of these that repeat others of them

// Equal for equal corners, of which -0 is 0, and equal keys.
std::array<std::uint32_t, 12> bitsOf(const CornersOfTriangle& triangle)
{
    std::array<std::uint32_t, 12> bits{std::uint32_t(triangle.key), std::uint32_t(triangle.key >> 32)};
    for (std::size_t k = 0; k < 3; ++k)
        for (int c = 0; c < 3; ++c)
            bits[2 + 3 * k + std::size_t(c)] = tangents::bitsOf(triangle.at[k][c]);
    return bits;
}

// The corners of a triangle from the least on, in their order round.
CornersOfTriangle cornersOf(const Mesh& mesh, std::size_t first)
{
    CornersOfTriangle t;
    for (std::size_t k = 0; k < 3; ++k)
        t.at[k] = mesh.positions[mesh.indices[first + k]];
    const auto isLess = [](const glm::vec3& a, const glm::vec3& b) {
        return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
    };
    std::rotate(t.at.begin(), std::min_element(t.at.begin(), t.at.end(), isLess), t.at.end());
    return t;
}

void dropRepeated(Mesh& mesh)
{
    const auto count = std::uint32_t(mesh.triangleCount());
    const auto first =
        tangents::firstEqual(count, [&](std::uint32_t i) { return bitsOf(cornersOf(mesh, 3 * std::size_t(i))); });
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < count; ++i)
        if (first[i] == i)
            kept.insert(kept.end(), &mesh.indices[3 * std::size_t(i)], &mesh.indices[3 * std::size_t(i)] + 3);
    mesh.indices = std::move(kept);
}

} // namespace

void joinParts(Scene& scene, std::size_t maxParts)
{
    if (scene.instances.size() > maxParts)
        joinSmall(scene);
}

void dropRepeated(Scene& scene)
{
    for (Mesh& mesh : scene.meshes)
        if (isOpaque(scene, mesh))
            dropRepeated(mesh);
}

std::vector<std::uint8_t> repeatedTriangles(std::size_t count,
                                            const std::function<CornersOfTriangle(std::size_t)>& triangle)
{
    const auto asked = std::uint32_t(std::min(count, kAsked));
    const auto sample = tangents::firstEqual(asked, [&](std::uint32_t k) {
        return bitsOf(triangle(std::size_t(double(k) * double(count) / double(asked))));
    });
    std::size_t many = 0;
    for (std::uint32_t k = 0; k < asked; ++k)
        many += sample[k] != k ? 1 : 0;
    if (many < kMany || count >= tangents::kNone) // more have no numbers
        return {};
    const auto first = tangents::firstEqual(std::uint32_t(count), [&](std::uint32_t i) { return bitsOf(triangle(i)); });
    std::vector<std::uint8_t> repeated(count), seen(count); // seen: how often the first of equal ones was, at most 2
    for (std::size_t i = 0; i < count; ++i) {
        repeated[i] = seen[first[i]];
        seen[first[i]] = std::uint8_t(std::min(repeated[i] + 1, 2));
    }
    return repeated;
}

// ---- how much work the pixels of a picture are -----------------------------------------------

namespace {

// All in times the picture. On Mesa's driver for the CPU, 1280 x 720 pixels at one of these limits take about 10 s of
// processor.
constexpr double kDroppedFrom = 20;   // from which on it is worth looking for triangles that repeat
constexpr double kMaxCovered = 64;    // by what hides what is behind
constexpr double kMaxLayers = 16;     // by what is translucent: each is shaded, and put in order
constexpr double kPlainLayer = 0.5;   // of such a one without a coat and the like; with one of these it is 1
constexpr double kFurtherLobe = 0.8;  // for each more: coat, sheen, other highlights
constexpr double kMaxLights = 200;    // times what is covered, at most once
constexpr double kMaxEdges = 2;       // by pixels along long edges, of which each is shaded and shows little
constexpr double kLongEdge = 16;      // pixels: shorter ones are what many small triangles have
constexpr double kFewPoints = 30'000; // models of n times as many places of vertices may take n times as long

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
