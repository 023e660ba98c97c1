#include "timing_scene.hpp"

#include <numeric>

#include <glm/vec2.hpp>

#include "cotan/gpu_meshes.hpp"
#include "cotan/triangle.hpp"

namespace cotan::cost {

bool provokes(Stored stored) { return stored == Stored::triangle || stored == Stored::triangleHalfs; }

std::unique_ptr<Grid> makeGrid(const Device& device, int leg, int side)
{
    const std::uint32_t cells = static_cast<std::uint32_t>(side / leg);
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    for (std::uint32_t y = 0; y <= cells; ++y)
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const float u = float(x) / float(cells), v = float(y) / float(cells);
            // A tilted plane inside the clip volume; the projection is the identity.
            positions.emplace_back(2 * u - 1, 2 * v - 1, 0.4f + 0.2f * u);
            normals.emplace_back(0.1f, 0.1f, 0.99f);
            texcoords.emplace_back(4 * u, 4 * v);
        }
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = y * (cells + 1) + x, b = a + cells + 1;
            indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
        }
    ProvokingMesh own = provokingMesh(indices, positions.size(), ProvokingVertex::first);
    own.corners.resize(3 * std::max(own.sources.size(), own.indices.size() / 3)); // for those that provoke none
    std::vector<std::uint32_t> all(positions.size());
    std::iota(all.begin(), all.end(), 0u);
    const auto triangles = packTriangles(triangleVectors({positions, normals, texcoords, indices}));

    using U = vk::BufferUsageFlagBits;
    auto made = std::make_unique<Grid>(*device.opened);
    Grid& grid = *made;
    Uploader uploader(*device.opened, 1 << 20);
    const auto buffer = [&](vk::BufferUsageFlags usage, const auto& list) {
        const auto bytes = std::as_bytes(std::span(list));
        Buffer b = makeDeviceBuffer(grid.memory, bytes.size(), usage | U::eTransferDst);
        uploader.buffer(b, 0, bytes);
        return b;
    };
    for (const VertexStage& stage : vertexStages()) {
        std::vector<float> floats;
        for (const std::uint32_t v : provokes(stage.stored) ? own.sources : all) {
            const glm::vec3 p = positions[v], n = normals[v];
            floats.insert(floats.end(), {p.x, p.y, p.z, n.x, n.y, n.z, texcoords[v].x, texcoords[v].y});
            const float extra[] = {1, 0, -0.1f, 1, 1, 0};
            floats.insert(floats.end(), extra, extra + vertexFloats(stage.stored) - 8);
        }
        grid.vertices.push_back(buffer(U::eVertexBuffer, floats));
    }
    grid.indices = buffer(U::eIndexBuffer, indices);
    grid.provokingIndices = buffer(U::eIndexBuffer, own.indices);
    grid.positions = buffer(U::eStorageBuffer, positions);
    grid.texcoords = buffer(U::eStorageBuffer, texcoords);
    grid.corners = buffer(U::eStorageBuffer, own.corners);
    grid.normals = buffer(U::eStorageBuffer, normals);
    grid.triangles = buffer(U::eStorageBuffer, triangles);
    grid.indexCount = static_cast<std::uint32_t>(indices.size());
    grid.vertexCount = static_cast<std::uint32_t>(all.size());
    grid.provokingVertexCount = static_cast<std::uint32_t>(own.sources.size());
    uploader.finish();
    return made;
}

} // namespace cotan::cost
