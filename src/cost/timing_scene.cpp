#include "timing_scene.hpp"

#include <cstring>

namespace cotan::cost {

namespace {

std::uint32_t memoryType(const Device& device, std::uint32_t allowed, vk::MemoryPropertyFlags needed)
{
    const auto memory = device.physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (memory.memoryTypes[i].propertyFlags & needed) == needed)
            return i;
    throw std::runtime_error("the device has no memory of the kind that is needed");
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

Picture makePicture(const Device& device, vk::Format format, std::uint32_t size, vk::ImageUsageFlags usage,
                    int samples)
{
    Picture p;
    vk::ImageCreateInfo info({}, vk::ImageType::e2D, format, {size, size, 1}, 1, 1, vk::SampleCountFlagBits(samples),
                             vk::ImageTiling::eOptimal, usage);
    p.image = vk::raii::Image(device.device, info);
    const auto needs = p.image.getMemoryRequirements();
    p.memory = vk::raii::DeviceMemory(device.device, {needs.size, memoryType(device, needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal)});
    p.image.bindMemory(*p.memory, 0);
    p.view = vk::raii::ImageView(device.device,
                                 vk::ImageViewCreateInfo({}, *p.image, vk::ImageViewType::e2D, format, {},
                                                         {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}));
    return p;
}

Grid makeGrid(const Device& device, int leg, int side)
{
    const std::uint32_t cells = static_cast<std::uint32_t>(side / leg);
    std::vector<float> positions, texcoords, normals;
    std::vector<std::vector<float>> vertices(vertexStages().size());
    for (std::uint32_t y = 0; y <= cells; ++y)
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const float u = float(x) / float(cells), v = float(y) / float(cells);
            // A tilted plane inside the clip volume; the projection is the identity.
            const float base[] = {2 * u - 1, 2 * v - 1, 0.4f + 0.2f * u, 0.1f, 0.1f, 0.99f, 4 * u, 4 * v};
            positions.insert(positions.end(), base, base + 3);
            texcoords.insert(texcoords.end(), base + 6, base + 8);
            normals.insert(normals.end(), base + 3, base + 6);
            const float extra[] = {1, 0, -0.1f, 1, 1, 0};
            for (std::size_t s = 0; s < vertices.size(); ++s) {
                vertices[s].insert(vertices[s].end(), base, base + 8);
                vertices[s].insert(vertices[s].end(), extra, extra + (vertexStages()[s].bytes + 3) / 4);
            }
        }
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = y * (cells + 1) + x, b = a + cells + 1;
            indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
        }
    using U = vk::BufferUsageFlagBits;
    Grid grid;
    for (const auto& list : vertices)
        grid.vertices.push_back(makeDeviceBuffer(device, U::eVertexBuffer, list.data(), list.size() * 4));
    grid.indices = makeDeviceBuffer(device, U::eIndexBuffer | U::eStorageBuffer, indices.data(), indices.size() * 4);
    grid.positions = makeDeviceBuffer(device, U::eStorageBuffer, positions.data(), positions.size() * 4);
    grid.texcoords = makeDeviceBuffer(device, U::eStorageBuffer, texcoords.data(), texcoords.size() * 4);
    grid.normals = makeDeviceBuffer(device, U::eStorageBuffer, normals.data(), normals.size() * 4);
    grid.indexCount = static_cast<std::uint32_t>(indices.size());
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
