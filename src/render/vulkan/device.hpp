// Choosing and opening a Vulkan device.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "vulkan.hpp"

namespace cotan {

// An open device. Everything made from it must be destroyed before it. Threads may share it: whoever uses the queue
// holds `queueInUse`.
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
    mutable std::recursive_mutex queueInUse;
    mutable std::atomic<std::uint64_t> imagesRead = 0; // copied to the host
    bool presents = false;                             // in a window, whose commands wait for those of renderers
    bool asAsked = true; // false: the device that the options ask for cannot present in the window

    std::string name;
    bool cpu = false; // the driver renders on the CPU
    vk::PhysicalDeviceLimits limits;
    vk::PhysicalDeviceMemoryProperties memory;
    bool anisotropy = false;   // textures support anisotropic filtering
    bool exact = false;        // fragments can read their triangle's vertices
    bool dualSource = false;   // blending supports a factor per channel
    bool filterable16 = false; // 16-bit unorm textures support linear filtering
    bool filterable32 = false; // 32-bit float textures support linear filtering
};

// What a window needs of a device.
struct WindowNeeds {
    std::vector<const char*> extensions; // of the instance
    // Whether a queue family can present in the window.
    std::function<bool(const vk::raii::Instance&, const vk::raii::PhysicalDevice&, std::uint32_t family)> presents;
};

// name, validation: as for openVulkanRenderer. window: the device can present in it. Errors: those of
// openVulkanRenderer; ErrorKind::unavailable if no device can present.
Result<std::unique_ptr<Device>> openDevice(const std::string& name, bool validation,
                                           const WindowNeeds* window = nullptr);

// One line that describes the error in any exception of the Vulkan bindings.
std::string reason(const std::exception& e);

} // namespace cotan
