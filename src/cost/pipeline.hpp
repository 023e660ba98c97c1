// The pipeline that is priced: triangles, one colour attachment, no depth, no blending.
#pragma once

#include "cotan/cost/rows.hpp"
#include "devices.hpp"

namespace cotan::cost {

inline constexpr vk::Format kColorFormat = vk::Format::eR16G16B16A16Sfloat;
inline constexpr std::uint32_t kBuffers = 4; // of the mesh, read by index: positions, uv, indices, normals

struct Layout {
    vk::raii::DescriptorSetLayout set{nullptr}; // 0 uniforms, 1 normal map, 2.. buffers
    vk::raii::PipelineLayout pipeline{nullptr};
};

Layout makeLayout(const Device& device);

// Vertices: one binding; position, normal, uv, then what is stored, all as 32-bit floats, packed.
// capture: ask the driver for statistics. samples: a pixel. Throws vk::SystemError.
vk::raii::Pipeline makePipeline(const Device& device, const Layout& layout, Stored stored,
                                std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                                bool capture, int samples = 1);

// Floats of a vertex.
std::uint32_t vertexFloats(Stored stored);

} // namespace cotan::cost
