#include "cotan/gpu_meshes.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "corner_groups.hpp"
#include "groups.hpp"
#include "tangents_mesh.hpp"

namespace cotan {

// ---- adjacency -----------------------------------------------------------------------------

namespace {

using tangents::kNone;
using tangents::Side;

// Builds the adjacency. slots: per vertex its slot, a vertex and a side as in tangents::slot. slotOf(corner): the slot
// that the corner contributes to, or kNoSlot.
constexpr std::size_t kNoSlot = ~std::size_t(0);

Adjacency adjacencyOf(const MeshView& mesh, const std::vector<std::size_t>& slots, const auto& slotOf)
{
    std::vector<std::uint32_t> groupOf(2 * mesh.positions.size(), kNone); // indexed by slot
    Adjacency a;
    std::uint32_t groups = 0;
    for (const Side side : {Side::unmirrored, Side::mirrored}) {
        if (side == Side::mirrored)
            a.firstMirrored = groups;
        for (const std::size_t slot : slots)
            if (slot % 2 == std::size_t(side) && groupOf[slot] == kNone)
                groupOf[slot] = groups++;
    }
    const auto eachVertex = [&](const auto& add) {
        for (std::uint32_t v = 0; v < slots.size(); ++v)
            add(groupOf[slots[v]], v);
    };
    const auto eachCorner = [&](const auto& add) {
        for (std::uint32_t c = 0; c < mesh.indices.size(); ++c)
            if (const std::size_t slot = slotOf(c); slot != kNoSlot && groupOf[slot] != kNone)
                add(groupOf[slot], c);
    };
    listByGroup(groups, eachVertex, a.vertexBegin, a.vertices);
    listByGroup(groups, eachCorner, a.cornerBegin, a.corners);
    return a;
}

} // namespace

Adjacency makeAdjacency(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const tangents::CornerGroups found = tangents::groupCorners(mesh);
    const std::vector<Side> sides = tangents::cornerSides(mesh);
    std::vector<std::size_t> slots;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        slots.push_back(tangents::slot(found.first[v], found.sides[v]));
    return adjacencyOf(mesh, slots, [&](std::uint32_t c) {
        const Side side = sides[c];
        return side == Side::none ? kNoSlot : tangents::slot(found.first[mesh.indices[c]], side);
    });
}

Adjacency makeNormalAdjacency(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const std::size_t count = mesh.positions.size();
    const std::vector<glm::vec2> none(count, glm::vec2(0));
    const LargeArray<std::uint32_t> first = tangents::weld({mesh.positions, mesh.normals, none, mesh.indices});
    std::vector<std::size_t> slotOf(mesh.indices.size(), kNoSlot);
    std::vector<std::uint32_t> corners(2 * count); // indexed by slot
    for (std::uint32_t c = 0; c < slotOf.size(); ++c) {
        tangents::Edges e = tangents::edgesAt(mesh, c / 3, c % 3);
        e.duv1 = {1, 0}; // u and v along the edges make the side that of the winding
        e.duv2 = {0, -1};
        const Side side = tangents::sideAt(e, mesh.normals[mesh.indices[c]]);
        if (side != Side::none)
            ++corners[slotOf[c] = tangents::slot(first[mesh.indices[c]], side)];
    }
    std::vector<std::size_t> slots(count);
    for (std::size_t v = 0; v < count; ++v)
        slots[v] = 2 * std::size_t(first[v])
            + (corners[2 * std::size_t(first[v]) + 1] > corners[2 * std::size_t(first[v])] ? 1 : 0);
    return adjacencyOf(mesh, slots, [&](std::uint32_t c) { return slotOf[c]; });
}

// ---- meshlets ------------------------------------------------------------------------------

namespace {

// Collects triangles until a limit is reached. indices_: per vertex of the mesh its index in the meshlet, or kNone.
class MeshletBuilder {
public:
    MeshletBuilder(RingMeshlets& out, std::size_t vertexCount, std::uint32_t maxVertices, std::uint32_t maxTriangles)
        : out_(out), indices_(vertexCount, kNone), maxVertices_(maxVertices), maxTriangles_(maxTriangles)
    {
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        const std::uint32_t fresh = std::uint32_t(indices_[a] == kNone) + std::uint32_t(indices_[b] == kNone && b != a)
            + std::uint32_t(indices_[c] == kNone && c != a && c != b);
        if (open_.vertexCount + fresh > maxVertices_ || open_.triangleCount == maxTriangles_)
            close();
        const std::uint32_t packed = localIndex(a) | localIndex(b) << 8 | localIndex(c) << 16;
        out_.triangles.push_back(packed);
        ++open_.triangleCount;
    }

    void close()
    {
        if (open_.triangleCount > 0)
            out_.meshlets.push_back(open_);
        for (std::uint32_t i = 0; i < open_.vertexCount; ++i)
            indices_[out_.vertices[open_.firstVertex + i]] = kNone;
        open_ = {std::uint32_t(out_.vertices.size()), 0, std::uint32_t(out_.triangles.size()), 0};
    }

private:
    std::uint32_t localIndex(std::uint32_t vertex)
    {
        if (indices_[vertex] == kNone) {
            indices_[vertex] = open_.vertexCount++;
            out_.vertices.push_back(vertex);
        }
        return indices_[vertex];
    }

    RingMeshlets& out_;
    std::vector<std::uint32_t> indices_;
    std::uint32_t maxVertices_, maxTriangles_;
    RingMeshlet open_;
};

// Appends the corners of its group for each vertex of the meshlets.
void addRings(RingMeshlets& out, const Adjacency& adjacency, std::size_t vertexCount)
{
    std::vector<std::uint32_t> groupOf(vertexCount);
    for (std::uint32_t g = 0; g < adjacency.groups(); ++g)
        for (std::uint32_t i = adjacency.vertexBegin[g]; i < adjacency.vertexBegin[g + 1]; ++i)
            groupOf[adjacency.vertices[i]] = g;
    out.ringBegin.reserve(out.vertices.size() + 1);
    const auto all = adjacency.corners.begin();
    for (const std::uint32_t vertex : out.vertices) {
        out.ringBegin.push_back(std::uint32_t(out.corners.size()));
        const std::uint32_t g = groupOf[vertex];
        out.corners.insert(out.corners.end(), all + adjacency.cornerBegin[g], all + adjacency.cornerBegin[g + 1]);
    }
    out.ringBegin.push_back(std::uint32_t(out.corners.size()));
}

} // namespace

RingMeshlets ringMeshlets(const MeshView& mesh, std::uint32_t maxVertices, std::uint32_t maxTriangles)
{
    const Adjacency adjacency = makeAdjacency(mesh);
    if (adjacency.vertexBegin.empty() || maxVertices < 3 || maxVertices > 256 || maxTriangles < 1)
        return {};
    RingMeshlets out;
    out.triangles.reserve(mesh.indices.size() / 3);
    MeshletBuilder builder(out, mesh.positions.size(), maxVertices, maxTriangles);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        builder.add(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
    builder.close();
    addRings(out, adjacency, mesh.positions.size());
    return out;
}

// ---- provoking vertices --------------------------------------------------------------------

namespace {

// Returns the provoking corner of each triangle: a vertex that provokes no triangle yet, and among several such
// vertices the one with the fewest triangles left.
std::vector<std::uint8_t> chooseCorners(std::span<const std::uint32_t> indices, std::size_t vertexCount)
{
    std::vector<std::uint32_t> left(vertexCount, 0); // per vertex: its triangles that have no provoking corner yet
    for (const std::uint32_t v : indices)
        ++left[v];
    std::vector<bool> provokes(vertexCount, false);
    std::vector<std::uint8_t> chosen(indices.size() / 3, 0);
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        const auto corner = indices.subspan(3 * f, 3);
        std::uint32_t best = kNone;
        for (std::uint8_t k = 0; k < 3; ++k) {
            --left[corner[k]];
            if (!provokes[corner[k]] && left[corner[k]] < best) {
                best = left[corner[k]];
                chosen[f] = k;
            }
        }
        provokes[corner[chosen[f]]] = true;
    }
    return chosen;
}

} // namespace

ProvokingMesh provokingMesh(std::span<const std::uint32_t> indices, std::size_t vertexCount, ProvokingVertex provoking)
{
    if (indices.size() % 3 != 0 || indices.size() >= std::size_t(1) << 31
        || std::any_of(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= vertexCount; }))
        return {};
    const std::vector<std::uint8_t> chosen = chooseCorners(indices, vertexCount);
    ProvokingMesh mesh;
    mesh.corners.reserve(indices.size());
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        mesh.sources.push_back(indices[3 * f + chosen[f]]);
        for (std::size_t k = 0; k < 3; ++k)
            mesh.corners.push_back(indices[3 * f + (chosen[f] + k) % 3]);
    }

    // The most recently used copy of each vertex: its index is near, so it is likely to be in the vertex cache.
    std::vector<std::uint32_t> copies(vertexCount, kNone);
    for (std::size_t f = chosen.size(); f-- > 0;)
        copies[mesh.sources[f]] = static_cast<std::uint32_t>(f);
    mesh.indices.reserve(indices.size());
    for (std::uint32_t f = 0; f < chosen.size(); ++f) {
        copies[mesh.sources[f]] = f;
        std::array<std::uint32_t, 3> triangle{f, 0, 0};
        for (std::size_t k = 1; k < 3; ++k) {
            std::uint32_t& copy = copies[mesh.corners[3 * f + k]];
            if (copy == kNone) {
                copy = static_cast<std::uint32_t>(mesh.sources.size());
                mesh.sources.push_back(mesh.corners[3 * f + k]);
            }
            triangle[k] = copy;
        }
        if (provoking == ProvokingVertex::last)
            std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
        mesh.indices.insert(mesh.indices.end(), triangle.begin(), triangle.end());
    }
    return mesh;
}

namespace {

// Returns the triangles of the runs of indices between restarts: each index from the third on, together with the two
// earlier ones of the run whose positions pair(i) returns.
std::vector<std::uint32_t> trianglesOf(std::span<const std::uint32_t> indices, std::uint32_t restart, const auto& pair)
{
    std::vector<std::uint32_t> out;
    while (!indices.empty()) {
        const auto end = std::find(indices.begin(), indices.end(), restart);
        const auto run = indices.first(static_cast<std::size_t>(end - indices.begin()));
        for (std::size_t i = 2; i < run.size(); ++i) {
            const auto [first, second] = pair(i);
            const std::uint32_t a = run[first], b = run[second], c = run[i];
            if (a != b && b != c && c != a)
                out.insert(out.end(), {a, b, c});
        }
        indices = indices.subspan(std::min(run.size() + 1, indices.size()));
    }
    return out;
}

} // namespace

std::vector<std::uint32_t> trianglesOfStrip(std::span<const std::uint32_t> indices, std::uint32_t restart)
{
    return trianglesOf(indices, restart,
                       [](std::size_t i) { return i % 2 == 0 ? std::pair(i - 2, i - 1) : std::pair(i - 1, i - 2); });
}

std::vector<std::uint32_t> trianglesOfFan(std::span<const std::uint32_t> indices, std::uint32_t restart)
{
    return trianglesOf(indices, restart, [](std::size_t i) { return std::pair(std::size_t(0), i - 1); });
}

} // namespace cotan
