#include "cotan/tangents.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "corner_groups.hpp"
#include "tangents_mesh.hpp"

namespace cotan {

namespace {

using tangents::Edges;
using tangents::edgesAt;
using tangents::Side;
using tangents::slot;

constexpr std::size_t kLeastCorners = 100000; // of a thread

// The unit direction of dP/du, or zero.
glm::vec3 alongU(const Edges& e)
{
    const glm::dvec3 t = (e.dp1 * e.duv2.y - e.dp2 * e.duv1.y) * (e.uvArea() < 0 ? -1.0 : 1.0);
    const double length = glm::length(t);
    return length > 0 && std::isfinite(length) ? glm::vec3(t / length) : glm::vec3(0);
}

} // namespace

std::vector<glm::vec4> vertexTangents(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const LargeArray<std::uint32_t> first = tangents::weld(mesh);
    const std::vector<Side> sides = tangents::cornerSides(mesh);
    std::vector<glm::vec3> sums(2 * mesh.positions.size(), glm::vec3(0));
    for (std::size_t c = 0; c < sides.size(); ++c)
        if (sides[c] != Side::none)
            sums[slot(first[mesh.indices[c]], sides[c])] += alongU(edgesAt(mesh, c / 3, c % 3));

    const auto isEmpty = [&](std::size_t at) { return tangents::isZero(sums[at]); };
    std::vector<glm::vec4> out(sides.size());
    for (std::size_t c = 0; c < out.size(); ++c) {
        const std::uint32_t vertex = first[mesh.indices[c]];
        const glm::vec3 n = mesh.normals[vertex];
        const Side side = tangents::sideOrNearest(sides[c], vertex, isEmpty);
        const glm::vec3 t = tangents::projectedUnit(sums[slot(vertex, side)], n);
        out[c] = glm::dot(t, t) > 0.5f ? glm::vec4(t, side == Side::mirrored ? -1 : 1)
                                       : glm::vec4(tangents::anyPerpendicular(n), 1);
    }
    return out;
}

Cotangents smoothCotangents(const MeshView& mesh, int threads)
{
    const std::size_t all = threadsFor(mesh.indices.size(), kLeastCorners, threads);
    if (!tangents::usable(mesh, all))
        return {};
    Cotangents made{std::vector<glm::vec3>(mesh.positions.size()), std::vector<glm::vec3>(mesh.positions.size())};
    tangents::groupCorners(mesh, all, &made);
    return made;
}

std::vector<std::uint32_t> firstEqualVertices(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const LargeArray<std::uint32_t> first = tangents::weld(mesh);
    return {first.get(), first.get() + mesh.positions.size()};
}

VertexSplit splitVertices(std::size_t vertexCount, std::span<const std::uint32_t> indices,
                          std::span<const glm::vec4> corners)
{
    if (corners.size() != indices.size() || vertexCount >= tangents::kNone || indices.size() >= tangents::kNone
        || std::any_of(indices.begin(), indices.end(), [&](auto i) { return i >= vertexCount; }))
        return {};
    const auto first = tangents::firstEqual(static_cast<std::uint32_t>(indices.size()), [&](std::uint32_t c) {
        const glm::vec4 x = corners[c];
        return std::array{indices[c],           0u, tangents::bitsOf(x.x), tangents::bitsOf(x.y), tangents::bitsOf(x.z),
                          tangents::bitsOf(x.w)};
    });
    VertexSplit split{std::vector<std::uint32_t>(vertexCount), {indices.begin(), indices.end()}};
    for (std::uint32_t i = 0; i < vertexCount; ++i)
        split.sources[i] = i;
    std::vector<bool> claimed(vertexCount); // by the first value met, which stays where it is
    for (std::uint32_t c = 0; c < indices.size(); ++c) {
        if (first[c] != c) {
            split.indices[c] = split.indices[first[c]];
        } else if (claimed[indices[c]]) {
            split.indices[c] = static_cast<std::uint32_t>(split.sources.size());
            split.sources.push_back(indices[c]);
        }
        claimed[indices[c]] = true;
    }
    return split;
}

namespace {

VertexSplit unsplit(const MeshView& mesh)
{
    VertexSplit split{std::vector<std::uint32_t>(mesh.positions.size()), {mesh.indices.begin(), mesh.indices.end()}};
    std::iota(split.sources.begin(), split.sources.end(), 0u);
    return split;
}

// For every vertex whether it has corners of each side.
std::vector<std::uint8_t> sidesOfVertices(const MeshView& mesh, const std::vector<Side>& sides)
{
    std::vector<std::uint8_t> has(mesh.positions.size(), 0);
    for (std::size_t c = 0; c < sides.size(); ++c)
        if (sides[c] != Side::none)
            has[mesh.indices[c]] = std::uint8_t(has[mesh.indices[c]] | 1 << int(sides[c]));
    return has;
}

constexpr std::uint8_t kUnmirrored = 1, kBoth = 3;

bool anyHasBoth(const MeshView& mesh, std::size_t threads)
{
    const std::vector<std::uint8_t> has = sidesOfVertices(mesh, tangents::cornerSides(mesh, threads));
    return std::find(has.begin(), has.end(), kBoth) != has.end();
}

} // namespace

VertexSplit splitMirrored(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const std::vector<Side> sides = tangents::cornerSides(mesh);
    const std::vector<std::uint8_t> has = sidesOfVertices(mesh, sides);
    VertexSplit split = unsplit(mesh);
    std::vector<Side> owner(has.size(), Side::none); // the side met first keeps the vertex
    std::vector<std::uint32_t> copies;               // per vertex, that of the other side
    for (std::size_t c = 0; c < sides.size(); ++c) {
        const std::uint32_t vertex = mesh.indices[c];
        const bool mirrored = sides[c] == Side::mirrored || (sides[c] == Side::none && !(has[vertex] & kUnmirrored));
        const Side side = mirrored ? Side::mirrored : Side::unmirrored;
        if (owner[vertex] == Side::none)
            owner[vertex] = side;
        if (owner[vertex] == side)
            continue;
        if (copies.empty())
            copies.assign(has.size(), tangents::kNone);
        if (copies[vertex] == tangents::kNone) {
            copies[vertex] = static_cast<std::uint32_t>(split.sources.size());
            split.sources.push_back(vertex);
        }
        split.indices[c] = copies[vertex];
    }
    return split;
}

std::vector<glm::vec4> generateTangents(Frame frame, const MeshView& mesh, int threads)
{
    if (frame == Frame::mikktspace)
        return mikktspaceTangents(mesh, threads);
    return frame == Frame::vertex ? vertexTangents(mesh) : std::vector<glm::vec4>{};
}

SplitCotangents splitSmoothCotangents(const MeshView& mesh, int threads)
{
    const std::size_t all = threadsFor(mesh.indices.size(), kLeastCorners, threads);
    if (!tangents::usable(mesh, all))
        return {};
    if (!anyHasBoth(mesh, all)) { // the copies of the indices come last: that is the most memory that it takes
        SplitCotangents made{{}, smoothCotangents(mesh, threads)};
        made.split = unsplit(mesh);
        return made;
    }
    SplitCotangents made{splitMirrored(mesh), {}};
    const auto positions = gathered(mesh.positions, made.split);
    const auto normals = gathered(mesh.normals, made.split);
    const auto texcoords = gathered(mesh.texcoords, made.split);
    made.cotangents = smoothCotangents({positions, normals, texcoords, made.split.indices}, threads);
    return made;
}

} // namespace cotan
