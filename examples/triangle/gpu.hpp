// The parts of Vulkan 1.3 that all methods need: a device, buffers with addresses, a render target with depth.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

struct Gpu {
    vk::raii::Context context;
    vk::raii::Instance instance{nullptr};
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    vk::raii::CommandPool pool{nullptr};
    bool meshShaders = false;
};
Gpu openGpu(); // throws vk::SystemError or std::runtime_error

struct Buffer {
    vk::raii::Buffer buffer{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    std::uint64_t address = 0;
    void* data = nullptr; // mapped for the lifetime of the buffer
};
// A buffer that host and device can access, at least a few bytes large. data: its initial contents, or null.
Buffer makeBuffer(const Gpu& gpu, const void* data, std::size_t bytes);
template<class T> Buffer makeBuffer(const Gpu& gpu, const std::vector<T>& items)
{
    return makeBuffer(gpu, items.data(), items.size() * sizeof(T));
}

struct Target {
    vk::raii::Image image{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::ImageView view{nullptr};
};
Target makeTarget(const Gpu& gpu, vk::Format format, vk::Extent2D size, vk::ImageUsageFlags usage,
                  vk::ImageAspectFlags aspect);

// Waits for all earlier writes and changes the layout of the image.
void barrier(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
             vk::ImageLayout from, vk::ImageLayout to);

struct Stage {
    vk::ShaderStageFlagBits stage;
    std::span<const std::uint32_t> code; // SPIR-V
};
vk::raii::Pipeline makePipeline(const Gpu& gpu, vk::PipelineLayout layout, std::span<const Stage> stages,
                                vk::Format color, vk::Extent2D size);
