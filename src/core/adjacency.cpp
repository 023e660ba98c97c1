#include "cotan/gpu_meshes.hpp"

#include <numeric>

#include "corner_groups.hpp"
#include "tangents_mesh.hpp"

namespace cotan {

namespace {

using tangents::kNone;
using tangents::Side;

// Lists the items 0 to count - 1 by group, in their order; groupOf(item) may be kNone.
void listByGroup(std::uint32_t groups, std::size_t count, const auto& groupOf, std::vector<std::uint32_t>& begin,
                 std::vector<std::uint32_t>& items)
{
    begin.assign(std::size_t(groups) + 1, 0);
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::uint32_t g = groupOf(i); g != kNone)
            ++begin[g + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    items.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::uint32_t g = groupOf(i); g != kNone)
            items[next[g]++] = i;
}

// slots: per vertex the slot that it belongs to; slotOf(corner): the one that it adds to, or kNoSlot. Slots are a
// vertex and a side, as tangents::slot has them.
constexpr std::size_t kNoSlot = ~std::size_t(0);

Adjacency adjacencyOf(const MeshView& mesh, const std::vector<std::size_t>& slots, const auto& slotOf)
{
    std::vector<std::uint32_t> groupOf(2 * mesh.positions.size(), kNone); // by slot
    Adjacency a;
    std::uint32_t groups = 0;
    for (const Side side : {Side::unmirrored, Side::mirrored}) {
        if (side == Side::mirrored)
            a.firstMirrored = groups;
        for (const std::size_t slot : slots)
            if (slot % 2 == std::size_t(side) && groupOf[slot] == kNone)
                groupOf[slot] = groups++;
    }
    const auto ofCorner = [&](std::uint32_t c) {
        const std::size_t slot = slotOf(c);
        return slot == kNoSlot ? kNone : groupOf[slot];
    };
    const auto ofVertex = [&](std::uint32_t v) { return groupOf[slots[v]]; };
    listByGroup(groups, mesh.positions.size(), ofVertex, a.vertexBegin, a.vertices);
    listByGroup(groups, mesh.indices.size(), ofCorner, a.cornerBegin, a.corners);
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
    std::vector<std::uint32_t> corners(2 * count); // by slot
    for (std::uint32_t c = 0; c < slotOf.size(); ++c) {
        tangents::Edges e = tangents::edgesAt(mesh, c / 3, c % 3);
        e.duv1 = {1, 0}; // as if u and v ran along the edges: the side is then that of the winding
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

} // namespace cotan
