// Draws images and Dear ImGui's triangles into the images of a window surface, with Vulkan.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "../window.hpp"

struct ImDrawData;

namespace cotan::viewer {

// A Vulkan call that failed.
class VulkanFailed : public std::runtime_error {
public:
    VulkanFailed(const char* call, VkResult code);
    VkResult code;
};

void check(VkResult code, const char* call);
#define COTAN_CHECK(call) ::cotan::viewer::check(call, #call)

// A Vulkan struct with sType set and everything else zero.
template<class T> T made(VkStructureType type)
{
    T value{};
    value.sType = type;
    return value;
}

// Calls a Vulkan enumeration twice: get(&count, nullptr), then get(&count, list) with enough space.
template<class T, class Get> std::vector<T> listOf(Get get)
{
    std::uint32_t count = 0;
    get(&count, static_cast<T*>(nullptr));
    std::vector<T> list(count);
    get(&count, list.data());
    list.resize(count);
    return list;
}

// Owns everything it creates. For one thread. Throws VulkanFailed, or std::runtime_error if nothing can present.
class Presenter {
public:
    // makeSurface: called again if the surface is lost. extensions: instance extensions that surfaces need.
    Presenter(const std::vector<const char*>& extensions, const WindowOptions& options,
              std::function<VkSurfaceKHR(VkInstance)> makeSurface);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Returns whether there was a surface to draw into. width, height: of the window; 0 draws nothing.
    bool show(const Shown& shown, ImDrawData* interface, int width, int height);
    Image read(); // reads back what the last show() drew
    void loseSurface() { lost_ = true; }
    void useFont(); // switches to Dear ImGui's current font
    const std::string& device() const { return device_name_; }

    std::vector<std::string> messages;

private:
    struct HostImage {
        VkImage image = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE, staging_memory = VK_NULL_HANDLE;
        VkBuffer staging = VK_NULL_HANDLE;
        int width = 0, height = 0;
        bool fresh = false; // the staging buffer has not been copied to the image yet
    };

    void openInstance(const std::vector<const char*>& extensions, bool validation);
    void openDevice(const std::string& wanted);
    void openCommands();
    void makeRenderPass();
    void makeSwapchain(int width, int height);
    void dropSwapchain();
    void startInterface();
    bool acquire(int width, int height, std::uint32_t& index);
    void record(std::uint32_t index, const Shown& shown, ImDrawData* interface);
    void keep(HostImage& into, const Image& image);
    void drop(HostImage& image);
    void blit(HostImage& from, std::uint32_t index, float left, float right);
    void barrier(VkImage image, VkImageLayout from, VkImageLayout to);
    VkBuffer makeBuffer(VkDeviceSize bytes, VkBufferUsageFlags usage, VkDeviceMemory& memory);
    std::uint32_t memoryType(std::uint32_t bits, VkMemoryPropertyFlags flags) const;

    std::function<VkSurfaceKHR(VkInstance)> make_surface_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::string device_name_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence done_ = VK_NULL_HANDLE;
    VkSemaphore acquired_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
    VkRenderPass pass_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<VkImage> images_;
    std::vector<VkImageView> views_;
    std::vector<VkFramebuffer> framebuffers_;
    std::vector<VkSemaphore> drawn_; // one per image, so that none is reused while a present still waits on it
    VkBuffer read_ = VK_NULL_HANDLE;
    VkDeviceMemory read_memory_ = VK_NULL_HANDLE;
    HostImage picture_, other_;
    std::uint64_t serial_ = 0;
    bool interface_started_ = false, lost_ = false, has_read_ = false;
};

} // namespace cotan::viewer
