#include "vertices.hpp"

#include <algorithm>
#include <array>

#include "codes.hpp"

namespace cotan {

namespace {

// The corners of triangle i of a strip or fan, with the winding that the specification gives it.
std::array<std::size_t, 3> cornersOf(int mode, std::size_t i)
{
    if (mode == gltf::kTriangleStrip)
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    return {i + 1, i + 2, 0};
}

std::vector<std::uint32_t> unroll(int mode, const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> triangles;
    triangles.reserve(order.size() * 3);
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {
        const auto [a, b, c] = cornersOf(mode, i);
        if (order[a] == order[b] || order[b] == order[c] || order[c] == order[a])
            continue;
        triangles.insert(triangles.end(), {order[a], order[b], order[c]});
    }
    return triangles;
}

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

std::vector<std::uint32_t> gltfTriangles(int mode, std::vector<std::uint32_t> order)
{
    if (mode == gltf::kTriangleStrip || mode == gltf::kTriangleFan)
        return unroll(mode, order);
    order.resize(mode == gltf::kTriangles ? order.size() / 3 * 3 : 0);
    return order;
}

std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count)
{
    constexpr std::size_t kSparse = 8; // vertices a corner: about where the search is as fast
    return count / kSparse < corners.size() ? byTable(corners, count) : bySearch(corners);
}

} // namespace cotan
