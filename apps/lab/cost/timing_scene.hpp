// What is drawn to be timed: a square of triangles, a normal map, a target.
#pragma once

#include "pipeline.hpp"

namespace cotan::cost {

struct Buffer {
    vk::raii::Buffer buffer{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
};

struct Picture {
    vk::raii::Image image{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::ImageView view{nullptr};
};

// The square as a grid of right-angled triangles. Rows that take U and V from the provoking vertex draw their own
// index buffer, in which every triangle owns one, and so more vertices.
struct Grid {
    std::vector<Buffer> vertices; // in the order of Stored
    Buffer indices;
    Buffer provokingIndices;
    Buffer positions; // read by index, as are the next
    Buffer texcoords;
    Buffer corners; // three a triangle, and a triangle for each vertex that provokes none
    Buffer normals;
    Buffer triangles; // U and V as six halfs
    std::uint32_t indexCount = 0;
    std::uint32_t vertexCount = 0, provokingVertexCount = 0;
};

bool provokes(Stored stored);

// All throw vk::SystemError. In memory that the host sees:
Buffer makeBuffer(const Device& device, vk::BufferUsageFlags usage, const void* data, std::size_t bytes);
// In the device's own, so that what is timed does not cross the bus. Waits for the copy.
Buffer makeDeviceBuffer(const Device& device, vk::BufferUsageFlags usage, const void* data, std::size_t bytes);
Picture makePicture(const Device& device, vk::Format format, std::uint32_t size, vk::ImageUsageFlags usage,
                    int samples = 1);
Grid makeGrid(const Device& device, int leg, int side);

// A commands buffer's image barrier, all stages.
void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to);

} // namespace cotan::cost
