// The pipeline that is priced: triangles, one colour attachment, no depth, no blending.
#pragma once

#include "cost/rows.hpp"
#include "devices.hpp"

namespace cotan::cost {

inline constexpr vk::Format kColorFormat = vk::Format::eR16G16B16A16Sfloat;
// Read by index, shaders/cost/draw.glsl: positions, uv, indices, normals, what the row needs; then pixels.
inline constexpr std::uint32_t kBuffers = 6;
inline constexpr std::uint32_t kPassConstants = 128; // bytes that a compute pass may be handed

struct Layout {
    vk::raii::DescriptorSetLayout set{nullptr}; // 0 uniforms, 1 normal map, 2.. buffers
    vk::raii::PipelineLayout pipeline{nullptr};
    vk::raii::PipelineLayout pass{nullptr};   // of compute stages: the set, and constants
    vk::raii::RenderPass renderPass{nullptr}; // where the device lacks dynamic rendering
};

Layout makeLayout(const Device& device);

// Vertices: one binding; position, normal, uv, then what is stored, all as 32-bit floats, packed.
// capture: ask the driver for statistics. samples: a pixel. Throws vk::SystemError.
vk::raii::Pipeline makePipeline(const Device& device, const Layout& layout, Stored stored,
                                std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                                bool capture, int samples = 1);

// A mesh stage in place of the vertex stage; needs device.meshShaders. And a compute stage. Both capture.
vk::raii::Pipeline makeMeshPipeline(const Device& device, const Layout& layout, std::span<const std::uint32_t> mesh,
                                    std::span<const std::uint32_t> fragment);
vk::raii::Pipeline makePassPipeline(const Device& device, const Layout& layout, std::span<const std::uint32_t> compute);

// Floats of a vertex.
std::uint32_t vertexFloats(Stored stored);

} // namespace cotan::cost
