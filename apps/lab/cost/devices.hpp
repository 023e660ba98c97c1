// Vulkan devices, for pricing: anything that compiles, whether it can draw or not.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "vulkan.hpp"

namespace cotan::cost {

struct Instance {
    vk::raii::Context context;
    vk::raii::Instance instance{nullptr};
};

// Throws vk::SystemError and others; `reason` makes a line of them.
Instance openInstance();

struct Device {
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    std::uint32_t queueFamily = 0;
    std::string name;
    std::string maker; // AMD, NVIDIA, ...; empty where it is not known
    std::string driver;
    bool cpu = false;
    bool radv = false;
    bool reports = false;          // machine code
    bool meshShaders = false;      // VK_EXT_mesh_shader
    bool dynamicRendering = false; // Vulkan 1.3; older devices only compile
    bool compiles = false;         // has a graphics queue
    std::string missing;           // empty: it can draw
    double nanoseconds = 0;        // per tick of its timestamps; 0: it has none
};

// All devices, not opened; those that draw on the processor last.
std::vector<Device> listDevices(const Instance& instance);

// Makes the logical device. Throws.
void open(Device& device);

// True where `names` is empty or `name` contains one of them, any case.
bool wanted(const std::string& name, const std::vector<std::string>& names);

std::string reason(const std::exception& e);

} // namespace cotan::cost
