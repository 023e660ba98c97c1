// Creates what lives as long as the presenter: the instance, a device that can present, the command buffer.
#include <algorithm>
#include <cstring>

#include "core/named_values.hpp"
#include "presenter.hpp"

namespace cotan::viewer {

namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages)
{
    try { // called by Vulkan, which exceptions must not pass through
        static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
    } catch (...) {
    }
    return VK_FALSE;
}

} // namespace

void Presenter::openInstance(const std::vector<const char*>& needed, bool validation)
{
    constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";
    const auto layers =
        listOf<VkLayerProperties>([](auto* count, auto* list) { vkEnumerateInstanceLayerProperties(count, list); });
    const bool validate =
        validation && std::ranges::any_of(layers, [&](const auto& l) { return !std::strcmp(l.layerName, kLayer); });
    if (validation && !validate)
        messages.push_back(std::string(kLayer) + " is not installed");
    std::vector<const char*> extensions = needed;
    if (validate)
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    auto application = made<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "cotan view";
    application.apiVersion = VK_API_VERSION_1_1;
    auto info = made<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    info.enabledLayerCount = validate ? 1 : 0;
    info.ppEnabledLayerNames = &kLayer;
    info.enabledExtensionCount = std::uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult code = vkCreateInstance(&info, nullptr, &instance_);
    if (code == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw std::runtime_error("no Vulkan driver is installed (the loader found none that it can use)");
    check(code, "vkCreateInstance");
    if (!validate)
        return;
    auto messenger = made<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = collect;
    messenger.pUserData = &messages;
    const auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    COTAN_CHECK(make(instance_, &messenger, nullptr, &messenger_));
}

// Chooses the renderer's device if it can present, else a discrete GPU, else any device.
void Presenter::openDevice(const std::string& wanted)
{
    const auto devices =
        listOf<VkPhysicalDevice>([&](auto* count, auto* list) { vkEnumeratePhysicalDevices(instance_, count, list); });
    int best = -1;
    for (VkPhysicalDevice candidate : devices) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(candidate, &properties);
        const auto known = listOf<VkExtensionProperties>(
            [&](auto* count, auto* list) { vkEnumerateDeviceExtensionProperties(candidate, nullptr, count, list); });
        if (std::ranges::none_of(
                known, [](const auto& e) { return !std::strcmp(e.extensionName, VK_KHR_SWAPCHAIN_EXTENSION_NAME); }))
            continue;
        const auto families = listOf<VkQueueFamilyProperties>(
            [&](auto* count, auto* list) { vkGetPhysicalDeviceQueueFamilyProperties(candidate, count, list); });
        for (std::uint32_t f = 0; f < families.size(); ++f) {
            VkBool32 presents = VK_FALSE;
            if (vkGetPhysicalDeviceSurfaceSupportKHR(candidate, f, surface_, &presents) != VK_SUCCESS || !presents
                || !(families[f].queueFlags & VK_QUEUE_GRAPHICS_BIT))
                continue;
            const bool named =
                !wanted.empty() && lowerCase(properties.deviceName).find(lowerCase(wanted)) != std::string::npos;
            const int score = named                                             ? 3
                : properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU ? 2
                : properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU          ? 0
                                                                                : 1;
            if (score > best) {
                best = score;
                physical_ = candidate;
                family_ = f;
                device_name_ = properties.deviceName;
            }
            break;
        }
    }
    if (best < 0)
        throw std::runtime_error("no Vulkan device can present in a window of this display");
    const float priority = 1;
    auto queue = made<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    auto info = made<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &swapchain;
    COTAN_CHECK(vkCreateDevice(physical_, &info, nullptr, &device_));
    vkGetDeviceQueue(device_, family_, 0, &queue_);
}

void Presenter::openCommands()
{
    auto pool = made<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = family_;
    COTAN_CHECK(vkCreateCommandPool(device_, &pool, nullptr, &pool_));
    auto buffer = made<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    buffer.commandPool = pool_;
    buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffer.commandBufferCount = 1;
    COTAN_CHECK(vkAllocateCommandBuffers(device_, &buffer, &commands_));
    auto fence = made<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    COTAN_CHECK(vkCreateFence(device_, &fence, nullptr, &done_));
    auto semaphore = made<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    COTAN_CHECK(vkCreateSemaphore(device_, &semaphore, nullptr, &acquired_));
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8};
    auto descriptors = made<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    descriptors.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    descriptors.maxSets = 8;
    descriptors.poolSizeCount = 1;
    descriptors.pPoolSizes = &size;
    COTAN_CHECK(vkCreateDescriptorPool(device_, &descriptors, nullptr, &descriptors_));
}

} // namespace cotan::viewer
