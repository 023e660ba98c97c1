#include "scene/parts.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

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

template<class T> std::size_t hashOf(const std::vector<T>& array)
{
    const auto* const bytes = reinterpret_cast<const char*>(array.data());
    return std::hash<std::string_view>()({bytes, array.size() * sizeof(T)});
}

// For each mesh the first that is the same.
std::vector<int> firstSame(const std::vector<Mesh>& meshes)
{
    std::vector<int> first(meshes.size());
    std::unordered_multimap<std::size_t, int> known;
    for (int n = 0; n < int(meshes.size()); ++n) {
        const Mesh& mesh = meshes[std::size_t(n)];
        std::size_t hash = std::size_t(mesh.material);
        std::apply([&](const auto&... arrays) { ((hash = hash * 31 + hashOf(arrays)), ...); }, arraysOf(mesh));
        const auto [begin, end] = known.equal_range(hash);
        const auto found = std::find_if(begin, end, [&](const auto& entry) {
            const Mesh& other = meshes[std::size_t(entry.second)];
            return other.material == mesh.material && arraysOf(other) == arraysOf(mesh);
        });
        first[std::size_t(n)] = found != end ? found->second : n;
        if (found == end)
            known.emplace(hash, n);
    }
    return first;
}

struct Placed {
    glm::mat4 toWorld;
    int mesh;

    bool operator==(const Placed&) const = default;
};

struct PlacedHash {
    std::size_t operator()(const Placed& placed) const
    {
        const auto* const bytes = reinterpret_cast<const char*>(&placed.toWorld);
        return std::hash<std::string_view>()({bytes, sizeof placed.toWorld}) * 31 + std::size_t(placed.mesh);
    }
};

void joinSmall(Scene& scene)
{
    const std::vector<int> first = firstSame(scene.meshes);
    std::unordered_set<Placed, PlacedHash> placed; // opaque ones: a second in the place of the first is not seen
    placed.reserve(std::min(scene.instances.size(), kMaxJoined));
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
        if (isOpaque(scene, mesh) && !placed.insert({instance.toWorld, first[std::size_t(instance.mesh)]}).second)
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

} // namespace cotan
