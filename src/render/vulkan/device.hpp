// Choosing and opening a Vulkan device.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "vulkan.hpp"

namespace cotan {

// A device that is open. Everything made from it must be destroyed before it.
struct Device {
    vk::raii::Context context;
    // Of the validation layer; their address is kept.
    std::unique_ptr<std::vector<std::string>> messages = std::make_unique<std::vector<std::string>>();
    vk::raii::Instance instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    std::uint32_t queueFamily = 0;

    std::string name;
    std::string driver;
    bool cpu = false; // a driver that draws on the processor
    vk::PhysicalDeviceLimits limits;
    vk::PhysicalDeviceMemoryProperties memory;
    bool anisotropy = false;   // textures can be filtered anisotropically
    bool exact = false;        // fragments can read their triangle's vertices
    bool dualSource = false;   // blending can have a factor for each channel
    bool filterable16 = false; // 16-bit unorm textures can be filtered
    bool filterable32 = false; // 32-bit float textures can be filtered
};

Result<std::unique_ptr<Device>> openDevice(const VulkanRendererOptions& options);

// One line for what went wrong, from any exception of the Vulkan bindings.
std::string reason(const std::exception& e);

} // namespace cotan
