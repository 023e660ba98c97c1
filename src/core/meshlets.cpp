#include "cotan/gpu_meshes.hpp"

namespace cotan {

namespace {

constexpr std::uint32_t kNowhere = 0xffffffffu;

// Takes triangles until a limit is met. places: per vertex of the mesh its place in the meshlet, or kNowhere.
class Cutter {
public:
    Cutter(RingMeshlets& out, std::size_t vertexCount, std::uint32_t maxVertices, std::uint32_t maxTriangles)
        : out_(out), places_(vertexCount, kNowhere), maxVertices_(maxVertices), maxTriangles_(maxTriangles)
    {
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        const std::uint32_t fresh = std::uint32_t(places_[a] == kNowhere)
            + std::uint32_t(places_[b] == kNowhere && b != a)
            + std::uint32_t(places_[c] == kNowhere && c != a && c != b);
        if (open_.vertexCount + fresh > maxVertices_ || open_.triangleCount == maxTriangles_)
            close();
        const std::uint32_t packed = place(a) | place(b) << 8 | place(c) << 16;
        out_.triangles.push_back(packed);
        ++open_.triangleCount;
    }

    void close()
    {
        if (open_.triangleCount > 0)
            out_.meshlets.push_back(open_);
        for (std::uint32_t i = 0; i < open_.vertexCount; ++i)
            places_[out_.vertices[open_.firstVertex + i]] = kNowhere;
        open_ = {std::uint32_t(out_.vertices.size()), 0, std::uint32_t(out_.triangles.size()), 0};
    }

private:
    std::uint32_t place(std::uint32_t vertex)
    {
        if (places_[vertex] == kNowhere) {
            places_[vertex] = open_.vertexCount++;
            out_.vertices.push_back(vertex);
        }
        return places_[vertex];
    }

    RingMeshlets& out_;
    std::vector<std::uint32_t> places_;
    std::uint32_t maxVertices_, maxTriangles_;
    RingMeshlet open_;
};

// Gives each vertex of the meshlets the corners of its group.
void addRings(RingMeshlets& out, const Adjacency& adjacency, std::size_t vertexCount)
{
    std::vector<std::uint32_t> groupOf(vertexCount);
    for (std::uint32_t g = 0; g < adjacency.groups(); ++g)
        for (std::uint32_t i = adjacency.vertexBegin[g]; i < adjacency.vertexBegin[g + 1]; ++i)
            groupOf[adjacency.vertices[i]] = g;
    out.ringBegin.reserve(out.vertices.size() + 1);
    for (const std::uint32_t vertex : out.vertices) {
        out.ringBegin.push_back(std::uint32_t(out.corners.size()));
        const auto corners = adjacency.corners.begin();
        const std::uint32_t g = groupOf[vertex];
        out.corners.insert(out.corners.end(), corners + adjacency.cornerBegin[g],
                           corners + adjacency.cornerBegin[g + 1]);
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
    Cutter cutter(out, mesh.positions.size(), maxVertices, maxTriangles);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        cutter.add(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
    cutter.close();
    addRings(out, adjacency, mesh.positions.size());
    return out;
}

} // namespace cotan
