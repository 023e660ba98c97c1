#include "cotan/gpu_meshes.hpp"

#include <algorithm>
#include <array>

namespace cotan {

namespace {

constexpr std::uint32_t kNoVertex = 0xffffffffu;

// For each triangle the corner that provokes it. A vertex that provokes nothing yet goes first, and of
// several such the one that has the fewest triangles left to provoke.
std::vector<std::uint8_t> chooseCorners(std::span<const std::uint32_t> indices, std::size_t vertexCount)
{
    std::vector<std::uint32_t> left(vertexCount, 0); // triangles that have not chosen, per vertex
    for (const std::uint32_t v : indices)
        ++left[v];
    std::vector<bool> provokes(vertexCount, false);
    std::vector<std::uint8_t> chosen(indices.size() / 3, 0);
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        const auto corner = indices.subspan(3 * f, 3);
        std::uint32_t best = kNoVertex;
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
    for (std::size_t f = 0; f < chosen.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            mesh.corners.push_back(indices[3 * f + (chosen[f] + k) % 3]);

    // The copy of each vertex that was used last: near in the list, so that it is still in the cache.
    std::vector<std::uint32_t> copies(vertexCount, kNoVertex);
    for (std::size_t f = chosen.size(); f-- > 0;)
        copies[mesh.corners[3 * f]] = static_cast<std::uint32_t>(f);
    for (std::size_t f = 0; f < chosen.size(); ++f)
        mesh.sources.push_back(mesh.corners[3 * f]);
    mesh.indices.reserve(indices.size());
    for (std::uint32_t f = 0; f < chosen.size(); ++f) {
        copies[mesh.corners[3 * f]] = f;
        std::array<std::uint32_t, 3> triangle{f, 0, 0};
        for (std::size_t k = 1; k < 3; ++k) {
            std::uint32_t& copy = copies[mesh.corners[3 * f + k]];
            if (copy == kNoVertex) {
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

void addTriangle(std::vector<std::uint32_t>& out, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    if (a != b && b != c && c != a)
        out.insert(out.end(), {a, b, c});
}

// Calls add(run) for each run of indices between restarts.
void forEachRun(std::span<const std::uint32_t> indices, std::uint32_t restart, const auto& add)
{
    while (!indices.empty()) {
        const auto end = std::find(indices.begin(), indices.end(), restart);
        const std::size_t size = static_cast<std::size_t>(end - indices.begin());
        add(indices.first(size));
        indices = indices.subspan(std::min(size + 1, indices.size()));
    }
}

} // namespace

std::vector<std::uint32_t> trianglesOfStrip(std::span<const std::uint32_t> indices, std::uint32_t restart)
{
    std::vector<std::uint32_t> out;
    forEachRun(indices, restart, [&](std::span<const std::uint32_t> run) {
        for (std::size_t i = 2; i < run.size(); ++i)
            if (i % 2 == 0)
                addTriangle(out, run[i - 2], run[i - 1], run[i]);
            else
                addTriangle(out, run[i - 1], run[i - 2], run[i]);
    });
    return out;
}

std::vector<std::uint32_t> trianglesOfFan(std::span<const std::uint32_t> indices, std::uint32_t restart)
{
    std::vector<std::uint32_t> out;
    forEachRun(indices, restart, [&](std::span<const std::uint32_t> run) {
        for (std::size_t i = 2; i < run.size(); ++i)
            addTriangle(out, run[0], run[i - 1], run[i]);
    });
    return out;
}

} // namespace cotan
