// The scene that is timed: a square of triangles, a normal map, a render target.
#pragma once

#include "pipeline.hpp"

namespace cotan::cost {

struct Buffer {
    vk::raii::Buffer buffer{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
};

struct GpuImage {
    vk::raii::Image image{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::ImageView view{nullptr};
};

// The square as a grid of right-angled triangles. Rows that take U and V from the provoking vertex use their own index
// buffer, in which every triangle owns a provoking vertex, which makes more vertices.
struct Grid {
    std::vector<Buffer> vertices; // in the order of Stored
    Buffer indices;
    Buffer provokingIndices;
    Buffer positions; // this and the following are storage buffers, read by index
    Buffer texcoords;
    Buffer corners; // three per triangle, or dummies for vertices that provoke no triangle
    Buffer normals;
    Buffer triangles; // U and V as six halfs
    std::uint32_t indexCount = 0;
    std::uint32_t vertexCount = 0, provokingVertexCount = 0;
};

bool provokes(Stored stored);

// Creates a host-visible buffer. All functions here throw vk::SystemError.
Buffer makeBuffer(const Device& device, vk::BufferUsageFlags usage, const void* data, std::size_t bytes);
// Creates a device-local buffer, so that draws do not read across the bus. Waits for the copy.
Buffer makeDeviceBuffer(const Device& device, vk::BufferUsageFlags usage, const void* data, std::size_t bytes);
GpuImage makeGpuImage(const Device& device, vk::Format format, std::uint32_t size, vk::ImageUsageFlags usage,
                      int samples = 1);
Grid makeGrid(const Device& device, int leg, int side);

// Records an image layout transition that waits for all stages.
void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to);

} // namespace cotan::cost
