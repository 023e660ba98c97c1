#include "cotan/adjacency.hpp"

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

} // namespace

Adjacency makeAdjacency(const MeshView& mesh)
{
    if (!tangents::usable(mesh))
        return {};
    const tangents::CornerGroups found = tangents::groupCorners(mesh);
    std::vector<std::uint32_t> groupOf(2 * mesh.positions.size(), kNone); // by slot
    Adjacency a;
    std::uint32_t groups = 0;
    for (const Side side : {Side::unmirrored, Side::mirrored}) {
        if (side == Side::mirrored)
            a.firstMirrored = groups;
        for (const std::size_t slot : found.slots)
            if (slot % 2 == std::size_t(side) && groupOf[slot] == kNone)
                groupOf[slot] = groups++;
    }
    const auto ofVertex = [&](std::uint32_t v) { return groupOf[found.slots[v]]; };
    const auto ofCorner = [&](std::uint32_t c) {
        const Side side = found.sides[c];
        return side == Side::none ? kNone : groupOf[tangents::slot(found.first[mesh.indices[c]], side)];
    };
    listByGroup(groups, mesh.positions.size(), ofVertex, a.vertexBegin, a.vertices);
    listByGroup(groups, mesh.indices.size(), ofCorner, a.cornerBegin, a.corners);
    return a;
}

} // namespace cotan
