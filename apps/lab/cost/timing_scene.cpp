#include "timing_scene.hpp"

#include <cstring>
#include <numeric>

#include <glm/vec2.hpp>

#include "cotan/gpu_meshes.hpp"
#include "cotan/triangle.hpp"

namespace cotan::cost {

namespace {

std::uint32_t memoryType(const Device& device, std::uint32_t allowed, vk::MemoryPropertyFlags needed)
{
    const auto memory = device.physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (memory.memoryTypes[i].propertyFlags & needed) == needed)
            return i;
    throw std::runtime_error("the device has no memory of the required type");
}

} // namespace

static Buffer emptyBuffer(const Device& device, vk::BufferUsageFlags usage, std::size_t bytes,
                          vk::MemoryPropertyFlags memory)
{
    Buffer b;
    b.buffer = vk::raii::Buffer(device.device, vk::BufferCreateInfo({}, bytes, usage));
    const auto needs = b.buffer.getMemoryRequirements();
    b.memory = vk::raii::DeviceMemory(device.device, {needs.size, memoryType(device, needs.memoryTypeBits, memory)});
    b.buffer.bindMemory(*b.memory, 0);
    return b;
}

Buffer makeBuffer(const Device& device, vk::BufferUsageFlags usage, const void* data, std::size_t bytes)
{
    using M = vk::MemoryPropertyFlagBits;
    Buffer b = emptyBuffer(device, usage, bytes, M::eHostVisible | M::eHostCoherent);
    std::memcpy(b.memory.mapMemory(0, bytes), data, bytes);
    b.memory.unmapMemory();
    return b;
}

Buffer makeDeviceBuffer(const Device& device, vk::BufferUsageFlags usage, const void* data, std::size_t bytes)
{
    using U = vk::BufferUsageFlagBits;
    const Buffer staging = makeBuffer(device, U::eTransferSrc, data, bytes);
    Buffer b = emptyBuffer(device, usage | U::eTransferDst, bytes, vk::MemoryPropertyFlagBits::eDeviceLocal);
    const vk::raii::CommandPool pool(device.device, {{}, device.queueFamily});
    const vk::raii::CommandBuffers list(device.device, {*pool, vk::CommandBufferLevel::ePrimary, 1});
    list[0].begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    list[0].copyBuffer(*staging.buffer, *b.buffer, vk::BufferCopy(0, 0, bytes));
    list[0].end();
    const vk::raii::Queue queue = device.device.getQueue(device.queueFamily, 0);
    queue.submit(vk::SubmitInfo({}, {}, *list[0]));
    queue.waitIdle();
    return b;
}

GpuImage makeGpuImage(const Device& device, vk::Format format, std::uint32_t size, vk::ImageUsageFlags usage,
                      int samples)
{
    GpuImage p;
    vk::ImageCreateInfo info({}, vk::ImageType::e2D, format, {size, size, 1}, 1, 1, vk::SampleCountFlagBits(samples),
                             vk::ImageTiling::eOptimal, usage);
    p.image = vk::raii::Image(device.device, info);
    const auto needs = p.image.getMemoryRequirements();
    p.memory = vk::raii::DeviceMemory(
        device.device,
        {needs.size, memoryType(device, needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal)});
    p.image.bindMemory(*p.memory, 0);
    p.view = vk::raii::ImageView(device.device,
                                 vk::ImageViewCreateInfo({}, *p.image, vk::ImageViewType::e2D, format, {},
                                                         {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}));
    return p;
}

bool provokes(Stored stored) { return stored == Stored::triangle || stored == Stored::triangleHalfs; }

Grid makeGrid(const Device& device, int leg, int side)
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
    const auto buffer = [&](vk::BufferUsageFlags usage, const auto& list) {
        return makeDeviceBuffer(device, usage, list.data(), list.size() * sizeof(list[0]));
    };
    Grid grid;
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
    return grid;
}

void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to)
{
    using S = vk::PipelineStageFlagBits2;
    using A = vk::AccessFlagBits2;
    const vk::ImageMemoryBarrier2 barrier(
        S::eAllCommands, A::eMemoryWrite, S::eAllCommands, A::eMemoryRead | A::eMemoryWrite, from, to,
        VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, nullptr, nullptr, barrier));
}

} // namespace cotan::cost
