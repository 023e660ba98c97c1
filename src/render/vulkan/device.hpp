// Choosing and opening a Vulkan device.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "vulkan.hpp"

namespace cotan {

// An open device. Everything made from it must be destroyed before it.
struct Device {
    vk::raii::Context context;
    // Messages of the validation layer, which keeps their address.
    std::unique_ptr<std::vector<std::string>> messages = std::make_unique<std::vector<std::string>>();
    vk::raii::Instance instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    std::uint32_t queueFamily = 0;

    std::string name;
    std::string driver;
    bool cpu = false; // the driver renders on the CPU
    vk::PhysicalDeviceLimits limits;
    vk::PhysicalDeviceMemoryProperties memory;
    bool anisotropy = false;   // textures support anisotropic filtering
    bool exact = false;        // fragments can read their triangle's vertices
    bool dualSource = false;   // blending supports a factor per channel
    bool filterable16 = false; // 16-bit unorm textures support linear filtering
    bool filterable32 = false; // 32-bit float textures support linear filtering
};

Result<std::unique_ptr<Device>> openDevice(const VulkanRendererOptions& options);

// One line that describes the error in any exception of the Vulkan bindings.
std::string reason(const std::exception& e);

} // namespace cotan
