#include "scene/parts.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/tangents_mesh.hpp"
#include "cotan/covector.hpp"
#include "cotan/tangents.hpp"
#include "cotan/vector.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

constexpr std::size_t kSmall = 256;         // maximum number of triangles of a mesh that is joined with others
constexpr std::size_t kMaxJoined = 4 << 20; // triangles

bool isOpaque(const Scene& scene, const Mesh& mesh)
{
    const Material& m = scene.materials[std::size_t(mesh.material)];
    return m.alphaMode == AlphaMode::opaque && !m.translucent();
}

// ---- parts ----------------------------------------------------------------------------------

// Meshes with the same key have the same material and kinds of arrays.
auto keyOf(const Mesh& mesh)
{
    return std::tuple(mesh.material, mesh.normals.empty(), mesh.tangents.empty(), mesh.texcoords[0].empty(),
                      mesh.texcoords[1].empty(), mesh.colors.empty());
}

// Appends a transformed mesh: tangents transform like positions, normals as covectors. A mirroring matrix reverses the
// order of corners and the sign of tangents.
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

// All data of a mesh, except its material and name.
auto arraysOf(const Mesh& m) { return std::tuple_cat(std::tie(m.indices), attributesOf(m)); }

template<class T> std::string_view bytesOf(const std::vector<T>& array)
{
    return {reinterpret_cast<const char*>(array.data()), array.size() * sizeof(T)};
}

// For each mesh, the index of the first equal one. Ordering by bytes keeps it fast for any input.
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
    std::set<std::pair<std::array<std::uint32_t, 16>, int>> placed; // opaque: a duplicate is invisible
    std::map<decltype(keyOf(Mesh{})), Mesh> joined;
    std::vector<Instance> kept;
    std::size_t triangles = 0;
    for (Instance& instance : scene.instances) {
        if (!isFinite(instance.toWorld))
            continue;
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const std::size_t count = mesh.triangleCount();
        if (count > kSmall || triangles + count > kMaxJoined || !mesh.cotangentsU.empty() || !mesh.skin[0].empty()) {
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

constexpr std::size_t kSampleSize = 4096; // triangles in the sample
constexpr std::size_t kMinRepeats = 40;   // minimum number of repeats in the sample

// Equal for equal corners, where -0 equals 0, and equal keys.
std::array<std::uint32_t, 12> bitsOf(const CornersOfTriangle& triangle)
{
    std::array<std::uint32_t, 12> bits{std::uint32_t(triangle.key), std::uint32_t(triangle.key >> 32)};
    for (std::size_t k = 0; k < 3; ++k)
        for (int c = 0; c < 3; ++c)
            bits[2 + 3 * k + std::size_t(c)] = tangents::bitsOf(triangle.at[k][c]);
    return bits;
}

// Finds equal triangles: for each, the number of earlier equal ones; 2 means 2 or more.
std::vector<std::uint8_t> earlierEqual(std::size_t count, const TriangleCorners& triangle)
{
    const auto first = tangents::firstEqual(std::uint32_t(count), [&](std::uint32_t i) { return bitsOf(triangle(i)); });
    std::vector<std::uint8_t> repeated(count), occurrences(count); // occurrences of each first triangle, at most 2
    for (std::size_t i = 0; i < count; ++i) {
        repeated[i] = occurrences[first[i]];
        occurrences[first[i]] = std::uint8_t(std::min(repeated[i] + 1, 2));
    }
    return repeated;
}

void dropRepeated(Mesh& mesh)
{
    const std::vector<std::uint8_t> repeated = earlierEqual(mesh.triangleCount(), [&](std::size_t i) {
        CornersOfTriangle t = cornersOfTriangle(mesh.positions, mesh.indices, i);
        const auto isLess = [](const glm::vec3& a, const glm::vec3& b) {
            return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
        };
        std::rotate(t.at.begin(), std::min_element(t.at.begin(), t.at.end(), isLess), t.at.end());
        return t;
    });
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < repeated.size(); ++i)
        if (repeated[i] == 0)
            kept.insert(kept.end(), &mesh.indices[3 * i], &mesh.indices[3 * i] + 3);
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

std::vector<std::uint8_t> repeatedTriangles(std::size_t count, const TriangleCorners& triangle)
{
    const auto sampled = std::uint32_t(std::min(count, kSampleSize));
    const auto sample = tangents::firstEqual(sampled, [&](std::uint32_t k) {
        return bitsOf(triangle(std::size_t(double(k) * double(count) / double(sampled))));
    });
    std::size_t repeats = 0;
    for (std::uint32_t k = 0; k < sampled; ++k)
        repeats += sample[k] != k ? 1 : 0;
    if (repeats < kMinRepeats || count >= tangents::kNone) // larger counts have no indices
        return {};
    return earlierEqual(count, triangle);
}

Mesh trianglesOfMesh(const Mesh& mesh, std::span<const std::uint32_t> triangles)
{
    VertexSplit taken;
    std::map<std::uint32_t, std::uint32_t> numbers; // old to new
    for (const std::uint32_t f : triangles)
        for (std::size_t i = 3 * std::size_t(f); i < 3 * std::size_t(f) + 3; ++i) {
            const auto [number, isNew] = numbers.emplace(mesh.indices[i], std::uint32_t(taken.sources.size()));
            taken.indices.push_back(number->second);
            if (isNew)
                taken.sources.push_back(mesh.indices[i]);
        }
    Mesh part;
    part.name = mesh.name;
    part.material = mesh.material;
    part.source = mesh.source;
    part.named = mesh.named;
    part.readWith = mesh.readWith;
    const auto from = attributesOf(mesh);
    const auto to = attributesOf(part);
    [&]<std::size_t... N>(std::index_sequence<N...>)
    {
        ((std::get<N>(to) = gathered(std::span(std::get<N>(from)), taken)), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(from)>>());
    part.indices = std::move(taken.indices);
    return part;
}

Mesh partOfMesh(const Mesh& mesh, std::size_t triangles)
{
    if (mesh.triangleCount() <= triangles)
        return mesh;
    constexpr std::size_t kMaxRuns = 64;
    const std::size_t runs = std::min(kMaxRuns, triangles);
    const std::size_t run = triangles / runs, step = mesh.triangleCount() / runs;
    std::vector<std::uint32_t> taken;
    for (std::size_t r = 0; r < runs; ++r)
        for (std::size_t f = r * step; f < r * step + run; ++f)
            taken.push_back(std::uint32_t(f));
    return trianglesOfMesh(mesh, taken);
}

// ---- cost of the pixels of an image ----------------------------------------------------------

namespace {

// In units of the image's pixels. At one of these limits, Mesa's CPU driver takes about 10 s for 1280 x 720 pixels.
constexpr double kDroppedFrom = 20;   // opaque coverage above which repeated triangles are dropped
constexpr double kMaxCovered = 64;    // by opaque triangles
constexpr double kMaxLayers = 16;     // by translucent triangles: every layer is shaded and sorted
constexpr double kPlainLayer = 0.5;   // weight of a translucent layer without coat and the like; otherwise 1
constexpr double kFurtherLobe = 0.8;  // for each further lobe: coat, sheen, other highlights
constexpr double kMaxLights = 200;    // lights times coverage, which counts as at most 1
constexpr double kMaxEdges = 2;       // by pixels along long edges, each of which is shaded but covers little
constexpr double kLongEdge = 16;      // pixels; shorter edges are those of many small triangles
constexpr double kFewPoints = 30'000; // scenes of n times as many distinct positions may take n times as long

// A camera's axes and scale.
struct CameraProjection {
    CameraAxes axes;
    double scale;
    bool orthographic;

    explicit CameraProjection(const Camera& camera) : axes(cameraAxes(camera)), orthographic(camera.orthographic)
    {
        scale = orthographic ? 2 / double(camera.verticalExtent) : 1 / std::tan(double(camera.verticalFieldOfView) / 2);
    }
    // Returns x and y relative to the image's centre, in half image heights times the depth; and the depth.
    glm::dvec3 operator()(const glm::dvec3& p) const
    {
        const glm::dvec3 from = p - axes.eye;
        const double before = glm::dot(from, axes.forward);
        return {glm::dot(from, axes.right) * scale, glm::dot(from, axes.up) * scale,
                orthographic ? (before > 0 ? 1 : 0) : before};
    }
};

// Pixels of a projected triangle.
struct Pixels {
    double area = 0, edges = 0;
};

// The area is clamped to that of the bounding box; it is half the image if the triangle reaches behind the eye. side: 1
// or -1 if only triangles with counter-clockwise or clockwise corners are drawn; 0: all are.
Pixels pixelsOf(const std::array<glm::dvec3, 3>& projected, double width, double height, int side)
{
    if (projected[0].z <= 0 || projected[1].z <= 0 || projected[2].z <= 0)
        return {projected[0].z <= 0 && projected[1].z <= 0 && projected[2].z <= 0 ? 0 : width * height / 2, 0};
    std::array<glm::dvec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = glm::dvec2(projected[k]) / projected[k].z * (height / 2);
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
    const CameraProjection project(view.camera);
    Covered all;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const glm::dmat4 toWorld(instance.toWorld);
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const double weight = material.translucent() ? weightOfLayer(material) : 1;
        double& area = material.translucent() ? all.translucent : all.opaque;
        const int side = material.doubleSided ? 0 : glm::determinant(glm::dmat3(toWorld)) < 0 ? -1 : 1;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::array<glm::dvec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = project(glm::dvec3(toWorld * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + k]]), 1)));
            const Pixels covered = pixelsOf(p, view.width, view.height, side);
            if (std::isfinite(covered.area) && std::isfinite(covered.edges)) {
                area += weight * covered.area;
                all.edges += covered.edges;
            }
        }
    }
    return all;
}

// Number of distinct positions among the vertices of all meshes. Unlike the number of vertices, a loader that makes
// three vertices per triangle does not increase it.
std::size_t distinctPositions(const Scene& scene)
{
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) {
        // Sorting by bits keeps it fast for any input.
        std::vector<std::array<std::uint32_t, 3>> own(mesh.positions.size());
        std::ranges::transform(mesh.positions, own.begin(),
                               [](glm::vec3 p) { return std::bit_cast<std::array<std::uint32_t, 3>>(p); });
        std::ranges::sort(own);
        count += std::size_t(std::unique(own.begin(), own.end()) - own.begin());
    }
    return count;
}

// A number of times, with one decimal below 10.
std::string timesText(double times)
{
    const long long tenths = std::llround(10 * std::min(times, 1e15));
    const bool shown = tenths < 100 && tenths % 10 != 0;
    return shown ? std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) : std::to_string((tenths + 5) / 10);
}

Error coverageError(const Scene& scene, const std::string& what, double found, double limit, const std::string& advice)
{
    return inputError(scene.name + ": " + what + " " + timesText(found) + " times, expected at most " + timesText(limit)
                      + ": " + advice);
}

} // namespace

double pixelsCovered(const Scene& scene, const View& view)
{
    const Covered covered = coveredBy(scene, view);
    return covered.opaque + covered.translucent;
}

Status limitCoverage(Scene& scene, const View& view, std::size_t images)
{
    double imagePixels = double(view.width) * view.height / double(images);
    Covered covered = coveredBy(scene, view);
    if (covered.opaque > kDroppedFrom * imagePixels) {
        dropRepeated(scene);
        covered = coveredBy(scene, view);
    }
    const struct {
        const char* what;
        double pixels, maximum;
    } limits[] = {{"its triangles cover the image", covered.opaque, kMaxCovered},
                  {"its translucent triangles cover the image", covered.translucent, kMaxLayers},
                  {"the long edges of its triangles cover the image", covered.edges, kMaxEdges}};
    const auto isOver = [&](const auto& limit) { return limit.pixels > limit.maximum * imagePixels; };
    if (std::ranges::any_of(limits, isOver)) // costly, so only if a limit is exceeded
        imagePixels *= std::max(1.0, double(distinctPositions(scene)) / kFewPoints);
    for (const auto& limit : limits)
        if (isOver(limit))
            return coverageError(scene, limit.what, limit.pixels / imagePixels, limit.maximum,
                                 "move the camera away, or remove some triangles");
    const double lit = double(view.lights.size()) * std::min(1.0, (covered.opaque + covered.translucent) / imagePixels);
    if (view.output == Output::shaded && lit > kMaxLights)
        return coverageError(scene, "its lights illuminate the image", lit, kMaxLights, "remove some lights");
    return Done{};
}

} // namespace cotan
