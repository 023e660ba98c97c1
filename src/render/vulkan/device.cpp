#include "device.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/named_values.hpp"
#include "core/try.hpp"
#include "gpu_structs.hpp"
#include "pipeline.hpp"

namespace cotan {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages)
{
    // The layer calls this from inside Vulkan, which exceptions must not cross, and on the thread of the call.
    static std::mutex collecting;
    try {
        const std::lock_guard lock(collecting);
        static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
    } catch (...) {
    }
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(std::vector<std::string>& messages)
{
    // The C struct, because the callback's type differs between versions of the C++ header.
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = collectMessage;
    info.pUserData = &messages;
    return info;
}

bool hasValidation(const vk::raii::Context& context)
{
    return std::ranges::any_of(context.enumerateInstanceLayerProperties(), [](const vk::LayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
    });
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validate, std::vector<std::string>& messages,
                                std::vector<const char*> extensions)
{
    const vk::ApplicationInfo application("cotan", 1, "cotan", 1, VK_API_VERSION_1_3);
    std::vector<const char*> layers;
    const vk::DebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(messages);
    if (validate) {
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    const vk::InstanceCreateInfo info({}, &application, layers, extensions, validate ? &messenger : nullptr);
    return vk::raii::Instance(context, info);
}

// ---- choosing -------------------------------------------------------------------------------

// Order of preference of device types; 0 is best.
std::ptrdiff_t rank(const vk::raii::PhysicalDevice& physical)
{
    using T = vk::PhysicalDeviceType;
    constexpr std::array kOrder{T::eDiscreteGpu, T::eIntegratedGpu, T::eVirtualGpu, T::eCpu}; // other types come last
    return std::ranges::find(kOrder, physical.getProperties().deviceType) - kOrder.begin();
}

// Index of the first queue family with graphics, or -1.
int graphicsFamily(const vk::raii::PhysicalDevice& physical)
{
    const std::vector<vk::QueueFamilyProperties> families = physical.getQueueFamilyProperties();
    for (std::size_t i = 0; i < families.size(); ++i)
        if (families[i].queueFlags & vk::QueueFlagBits::eGraphics)
            return int(i);
    return -1;
}

std::string nameOf(const vk::raii::PhysicalDevice& physical)
{
    return std::string(physical.getProperties().deviceName.data());
}

// Why the device cannot run the renderer; empty if it can.
std::string missingFeature(const vk::raii::PhysicalDevice& physical)
{
    const vk::PhysicalDeviceProperties properties = physical.getProperties();
    if (properties.apiVersion < VK_API_VERSION_1_3)
        return "needs Vulkan 1.3, has " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "."
            + std::to_string(VK_API_VERSION_MINOR(properties.apiVersion));
    if (graphicsFamily(physical) < 0)
        return "has no graphics queue";
    const auto features = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features>();
    const auto& v13 = features.get<vk::PhysicalDeviceVulkan13Features>();
    if (!v13.dynamicRendering || !v13.synchronization2)
        return "lacks dynamicRendering or synchronization2";
    if (!features.get<vk::PhysicalDeviceFeatures2>().features.fragmentStoresAndAtomics)
        return "lacks fragmentStoresAndAtomics";
    const vk::PhysicalDeviceLimits& limits = properties.limits; // Vulkan guarantees 16 of each
    const std::uint32_t images =
        std::min(limits.maxPerStageDescriptorSamplers, limits.maxPerStageDescriptorSampledImages);
    if (images < kImagesInViewSet + COTAN_MAP_COUNT)
        return "reads at most " + std::to_string(images) + " images per shader, needs "
            + std::to_string(kImagesInViewSet + COTAN_MAP_COUNT);
    return {};
}

// All devices, in order of preference.
std::vector<vk::raii::PhysicalDevice> devicesOf(const vk::raii::Instance& instance)
{
    vk::raii::PhysicalDevices found(instance);
    std::ranges::stable_sort(found, {}, rank);
    return found;
}

std::string listed(const std::vector<vk::raii::PhysicalDevice>& devices)
{
    std::string text;
    for (const vk::raii::PhysicalDevice& d : devices) {
        const std::string missing = missingFeature(d);
        text += (text.empty() ? "" : ", ") + nameOf(d) + (missing.empty() ? "" : " (" + missing + ")");
    }
    return text.empty() ? "none" : text;
}

// Chooses the first usable device that can present in the window, those whose names contain `wanted` before others.
// Without a window: the first whose name does.
Status choose(Device& d, const std::string& wanted, const WindowNeeds* window)
{
    std::vector<vk::raii::PhysicalDevice> devices = devicesOf(d.instance);
    const auto asked = [&](const vk::raii::PhysicalDevice& known) {
        return missingFeature(known).empty() && lowerCase(nameOf(known)).find(lowerCase(wanted)) != std::string::npos;
    };
    std::stable_partition(devices.begin(), devices.end(), asked);
    for (vk::raii::PhysicalDevice& known : devices) {
        const auto family = std::uint32_t(graphicsFamily(known));
        if (missingFeature(known).empty() && (window ? window->presents(d.instance, known, family) : asked(known))) {
            d.asAsked = &known == &devices.front() && asked(known);
            d.physical = std::move(known);
            return Done{};
        }
    }
    const std::string does = window ? "can present in a window of this display" : "can be used";
    return unavailableError("no Vulkan device " + (wanted.empty() || window ? "" : "named '" + wanted + "' ") + does
                            + "; found: " + listed(devices));
}

// ---- opening --------------------------------------------------------------------------------

bool filterable(const vk::raii::PhysicalDevice& physical, vk::Format format)
{
    const auto needed = vk::FormatFeatureFlagBits::eSampledImage | vk::FormatFeatureFlagBits::eSampledImageFilterLinear
        | vk::FormatFeatureFlagBits::eTransferDst;
    return (physical.getFormatProperties(format).optimalTilingFeatures & needed) == needed;
}

void describe(Device& d)
{
    const vk::PhysicalDeviceProperties core = d.physical.getProperties();
    d.cpu = core.deviceType == vk::PhysicalDeviceType::eCpu;
    d.limits = core.limits;
    d.memory = d.physical.getMemoryProperties();
    d.filterable16 = filterable(d.physical, vk::Format::eR16G16B16A16Unorm);
    d.filterable32 = filterable(d.physical, vk::Format::eR32G32B32A32Sfloat);
}

void openLogicalDevice(Device& d)
{
    const auto has = d.physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
    const auto& core = has.get<vk::PhysicalDeviceFeatures2>().features;
    const auto& v12 = has.get<vk::PhysicalDeviceVulkan12Features>();
    // Mesa's CPU driver (22.3) draws dots along edges of magnified texels with anisotropic filtering, and is slow.
    d.anisotropy = core.samplerAnisotropy && !d.cpu;
    d.exact = core.geometryShader && v12.bufferDeviceAddress;
    d.dualSource = core.dualSrcBlend;

    vk::PhysicalDeviceVulkan13Features use13;
    use13.dynamicRendering = VK_TRUE;
    use13.synchronization2 = VK_TRUE;
    use13.shaderDemoteToHelperInvocation = VK_TRUE; // for discard as newer glslang compiles it; part of Vulkan 1.3
    vk::PhysicalDeviceVulkan12Features use12;
    use12.bufferDeviceAddress = d.exact;
    use12.pNext = &use13;
    vk::PhysicalDeviceFeatures2 use;
    use.features.fragmentStoresAndAtomics = VK_TRUE; // lists of translucent fragments
    use.features.samplerAnisotropy = d.anisotropy;
    use.features.dualSrcBlend = d.dualSource; // for layers that transmit coloured light
    use.features.geometryShader = d.exact;    // SPIR-V requires it for gl_PrimitiveID
    use.pNext = &use12;

    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, d.queueFamily, 1, &priority);
    const std::vector<const char*> extensions(d.presents ? 1 : 0, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    d.device = vk::raii::Device(d.physical, vk::DeviceCreateInfo({}, queue, {}, extensions, {}, &use));
    d.queue = d.device.getQueue(d.queueFamily, 0);
}

void openInstance(Device& d, bool wanted, const std::vector<const char*>& extensions)
{
    // The loader stays open until the process ends: threads of a driver may outlive their device.
    [[maybe_unused]] static const auto* const kept = new vk::raii::Context;
    const bool validate = wanted && hasValidation(d.context);
    if (wanted && !validate)
        d.messages->emplace_back("VK_LAYER_KHRONOS_validation is not installed");
    d.instance = makeInstance(d.context, validate, *d.messages, extensions);
    if (validate)
        d.messenger = vk::raii::DebugUtilsMessengerEXT(d.instance, messengerInfo(*d.messages));
}

} // namespace

std::string reason(const std::exception& e)
{
    const auto* failed = dynamic_cast<const vk::SystemError*>(&e);
    if (failed && failed->code() == vk::Result::eErrorIncompatibleDriver)
        return "no driver is installed (the loader found no usable ICD)";
    if (failed && failed->code() == vk::Result::eErrorOutOfDeviceMemory)
        return "the device does not have enough memory";
    std::string text = e.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

Result<std::unique_ptr<Device>> openDevice(const std::string& name, bool validation, const WindowNeeds* window)
{
    try {
        auto d = std::make_unique<Device>();
        d->presents = window != nullptr;
        openInstance(*d, validation, window ? window->extensions : std::vector<const char*>());
        COTAN_CHECK(choose(*d, name, window));
        d->name = nameOf(d->physical);
        d->queueFamily = std::uint32_t(graphicsFamily(d->physical)); // not -1: missingFeature has checked it
        describe(*d);
        openLogicalDevice(*d);
        return d;
    } catch (const std::exception& e) {
        return unavailableError("Vulkan cannot be used: " + reason(e));
    }
}

} // namespace cotan
