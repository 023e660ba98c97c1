#include "vertices.hpp"

#include <algorithm>

namespace cotan {

namespace {

// A table of all vertices: for primitives that use a good part of them.
std::vector<std::uint32_t> byTable(std::vector<std::uint32_t>& corners, std::size_t count)
{
    std::vector<std::uint32_t> place(count, 0);
    for (const std::uint32_t corner : corners)
        place[corner] = 1;
    std::vector<std::uint32_t> used;
    for (std::uint32_t vertex = 0; vertex < count; ++vertex)
        if (place[vertex]) {
            place[vertex] = std::uint32_t(used.size());
            used.push_back(vertex);
        }
    for (std::uint32_t& corner : corners)
        corner = place[corner];
    return used;
}

std::vector<std::uint32_t> bySearch(std::vector<std::uint32_t>& corners)
{
    std::vector<std::uint32_t> used = corners;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t& corner : corners)
        corner = std::uint32_t(std::ranges::lower_bound(used, corner) - used.begin());
    return used;
}

} // namespace

std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count)
{
    constexpr std::size_t kSparse = 8; // vertices a corner: about where the search is as fast
    return count / kSparse < corners.size() ? byTable(corners, count) : bySearch(corners);
}

} // namespace cotan
