// The pipeline whose cost is measured: triangles, one colour attachment, no depth, no blending.
#pragma once

#include "cost/rows.hpp"
#include "devices.hpp"

namespace cotan::cost {

inline constexpr vk::Format kColorFormat = vk::Format::eR16G16B16A16Sfloat;
// Buffers that shaders/cost/draw.glsl indexes: positions, uv, indices, normals, the row's own data; then pixels.
inline constexpr std::uint32_t kBuffers = 6;
inline constexpr std::uint32_t kPassConstants = 128; // maximum push constants of a compute pass

struct Layout {
    vk::raii::DescriptorSetLayout set{nullptr}; // 0 uniforms, 1 normal map, 2.. buffers
    vk::raii::PipelineLayout pipeline{nullptr};
    vk::raii::PipelineLayout pass{nullptr};   // for compute stages: the set and push constants
    vk::raii::RenderPass renderPass{nullptr}; // only if the device lacks dynamic rendering
};

Layout makeLayout(const Device& device);

// Creates a pipeline with one vertex binding: position, normal, uv and the stored attributes, packed, in units of 32
// bits. capture: request statistics from the driver. samples: per pixel. Throws vk::SystemError.
vk::raii::Pipeline makePipeline(const Device& device, const Layout& layout, Stored stored,
                                std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                                bool capture, int samples = 1);

// Create pipelines with a mesh stage (needs device.meshShaders) or a compute stage. Both request statistics.
vk::raii::Pipeline makeMeshPipeline(const Device& device, const Layout& layout, std::span<const std::uint32_t> mesh,
                                    std::span<const std::uint32_t> fragment);
vk::raii::Pipeline makePassPipeline(const Device& device, const Layout& layout, std::span<const std::uint32_t> compute);

// Size of a vertex in floats.
std::uint32_t vertexFloats(Stored stored);

} // namespace cotan::cost
