// Vulkan devices for the cost measurements: every device that compiles, whether it can draw or not.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "render/vulkan/device.hpp"

namespace cotan::cost {

struct Instance {
    vk::raii::Context context;
    vk::raii::Instance instance{nullptr};
};

// Throws vk::SystemError and others; cotan::reason formats them as one line.
Instance openInstance();

struct Device {
    vk::raii::PhysicalDevice physical{nullptr};
    std::unique_ptr<cotan::Device> opened; // by open(); as the renderer's, for its memory and commands
    std::uint32_t queueFamily = 0;
    std::string name;
    std::string maker; // AMD, NVIDIA, ...; empty if unknown
    std::string driver;
    bool cpu = false;
    bool radv = false;
    bool reports = false;          // reports machine code statistics
    bool meshShaders = false;      // VK_EXT_mesh_shader
    bool dynamicRendering = false; // Vulkan 1.3; older devices only compile
    bool compiles = false;         // has a graphics queue
    std::string missing;           // why it cannot draw; empty if it can
    double nanoseconds = 0;        // per timestamp tick; 0 if it has no timestamps
};

// Returns all devices, unopened; CPU devices come last.
std::vector<Device> listDevices(const Instance& instance);

// Creates the logical device. Throws.
void open(Device& device);

// Whether `names` is empty or `name` contains one of them, ignoring case.
bool wanted(const std::string& name, const std::vector<std::string>& names);

} // namespace cotan::cost
