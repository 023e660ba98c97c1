// The scene that is timed: a square of triangles, a normal map, a render target.
#pragma once

#include "pipeline.hpp"
#include "render/vulkan/memory.hpp"

namespace cotan::cost {

// The square as a grid of right-angled triangles. Rows that take U and V from the provoking vertex use their own index
// buffer, in which every triangle owns a provoking vertex, which makes more vertices.
struct Grid {
    explicit Grid(const cotan::Device& device) : memory(device) {}

    Memory memory;
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

// Copies the grid to the device, so that draws do not read across the bus. Throws vk::SystemError.
std::unique_ptr<Grid> makeGrid(const Device& device, int leg, int side);

} // namespace cotan::cost
