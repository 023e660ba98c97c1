#include "scene/hard_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>

#include "core/tangents_mesh.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

constexpr float kHardCosine = 0.94f; // of 20 degrees

// The first vertex at each vertex's position.
LargeArray<std::uint32_t> pointsOf(std::span<const glm::vec3> positions)
{
    using tangents::bitsOf;
    return tangents::firstEqual(std::uint32_t(positions.size()), [&](std::uint32_t v) {
        return std::array{bitsOf(positions[v].x), bitsOf(positions[v].y), bitsOf(positions[v].z), 0u};
    });
}

} // namespace

std::size_t unsplitHardEdges(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                             std::span<const glm::vec2> uv, std::span<const std::uint32_t> indices)
{
    struct Edge { // from the smaller point to the larger, and the vertices there
        std::uint32_t from, to, vertexFrom, vertexTo;
    };
    const LargeArray<std::uint32_t> points = pointsOf(positions);
    std::vector<Edge> edges;
    edges.reserve(indices.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t a = indices[i + k], b = indices[i + (k + 1) % 3];
            if (points[a] > points[b])
                std::swap(a, b);
            if (points[a] != points[b])
                edges.push_back({points[a], points[b], a, b});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.from, a.to, a.vertexFrom, a.vertexTo) < std::tie(b.from, b.to, b.vertexFrom, b.vertexTo);
    });
    const auto apart = [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3 m = normals[a], n = normals[b];
        const float cosine = glm::dot(m, n), lengths = std::sqrt(glm::dot(m, m) * glm::dot(n, n));
        return lengths > 0 && cosine < kHardCosine * lengths;
    };
    std::size_t hard = 0;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const Edge &a = edges[i], &b = edges[i + 1];
        hard += a.from == b.from && a.to == b.to && uv[a.vertexFrom] == uv[b.vertexFrom]
            && uv[a.vertexTo] == uv[b.vertexTo] && (apart(a.vertexFrom, b.vertexFrom) || apart(a.vertexTo, b.vertexTo));
    }
    return hard;
}

std::vector<std::string> hardEdgeHints(const Scene& scene, bool beforeBaking)
{
    std::vector<std::string> lines;
    const bool any = beforeBaking
        && std::ranges::none_of(scene.materials, [](const Material& material) { return material.normalMap.present(); });
    for (const Mesh& mesh : scene.meshes) {
        const Texture& map = scene.materials[std::size_t(mesh.material)].normalMap;
        if ((!map.present() && !any) || mesh.texcoords[uvSetOf(map)].empty())
            continue;
        if (const std::size_t hard =
                unsplitHardEdges(mesh.positions, mesh.normals, mesh.texcoords[uvSetOf(map)], mesh.indices);
            hard > 0)
            lines.push_back("mesh '" + mesh.name + "': " + std::to_string(hard) + " " + kHardEdgeAdvice);
    }
    return lines;
}

} // namespace cotan
