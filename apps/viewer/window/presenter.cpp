#include "presenter.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "imgui_versions.hpp"

namespace cotan::viewer {

void check(VkResult code, const char* call)
{
    if (code != VK_SUCCESS)
        throw VulkanFailed(call, code);
}

VulkanFailed::VulkanFailed(const char* call, VkResult result)
    : std::runtime_error(std::string(call).substr(0, std::string(call).find('(')) + " failed (" + std::to_string(result)
                         + ")"),
      code(result)
{
}

Presenter::Presenter(const std::vector<const char*>& extensions, const WindowOptions& options,
                     std::function<VkSurfaceKHR(VkInstance)> makeSurface)
    : make_surface_(std::move(makeSurface))
{
    openInstance(extensions, options.validation);
    surface_ = make_surface_(instance_);
    openDevice(options.device);
    openCommands();
}

Presenter::~Presenter()
{
    if (device_) {
        vkDeviceWaitIdle(device_);
        if (interface_started_)
            ImGui_ImplVulkan_Shutdown();
        drop(picture_);
        drop(other_);
        dropSwapchain();
        vkDestroyBuffer(device_, read_, nullptr);
        vkFreeMemory(device_, read_memory_, nullptr);
        vkDestroyRenderPass(device_, pass_, nullptr);
        vkDestroyDescriptorPool(device_, descriptors_, nullptr);
        vkDestroySemaphore(device_, acquired_, nullptr);
        vkDestroyFence(device_, done_, nullptr);
        vkDestroyCommandPool(device_, pool_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (surface_)
        vkDestroySurfaceKHR(instance_, surface_, nullptr);
    if (messenger_)
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
    if (instance_)
        vkDestroyInstance(instance_, nullptr);
}

void Presenter::makeRenderPass()
{
    const auto formats = listOf<VkSurfaceFormatKHR>(
        [&](auto* count, auto* list) { vkGetPhysicalDeviceSurfaceFormatsKHR(physical_, surface_, count, list); });
    if (formats.empty())
        throw std::runtime_error("the window's surface offers no pixel format");
    format_ = formats[0];
    for (const VkSurfaceFormatKHR& f : formats) // not sRGB: the image bytes are shown unchanged
        if (f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM) {
            format_ = f;
            break;
        }
    VkAttachmentDescription color{};
    color.format = format_.format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD; // the image is already there
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    auto info = made<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    COTAN_CHECK(vkCreateRenderPass(device_, &info, nullptr, &pass_));
}

void Presenter::makeSwapchain(int width, int height)
{
    vkDeviceWaitIdle(device_);
    dropSwapchain();
    if (lost_) {
        vkDestroySurfaceKHR(instance_, surface_, nullptr);
        surface_ = VK_NULL_HANDLE;
        surface_ = make_surface_(instance_);
        lost_ = false;
    }
    if (!pass_)
        makeRenderPass();
    VkSurfaceCapabilitiesKHR can{};
    COTAN_CHECK(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(physical_, surface_, &can));
    extent_ = can.currentExtent;
    if (extent_.width == std::numeric_limits<std::uint32_t>::max())
        extent_ = {std::clamp(std::uint32_t(width), can.minImageExtent.width, can.maxImageExtent.width),
                   std::clamp(std::uint32_t(height), can.minImageExtent.height, can.maxImageExtent.height)};
    if (extent_.width == 0 || extent_.height == 0)
        return; // minimised
    constexpr VkImageUsageFlags kUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if ((can.supportedUsageFlags & kUsage) != kUsage)
        throw std::runtime_error("the window's surface cannot be copied to");
    auto info = made<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
    info.surface = surface_;
    info.minImageCount = std::max(2u, can.minImageCount);
    if (can.maxImageCount)
        info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = kUsage;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
        ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
        : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    COTAN_CHECK(vkCreateSwapchainKHR(device_, &info, nullptr, &swapchain_));
    images_ =
        listOf<VkImage>([&](auto* count, auto* list) { vkGetSwapchainImagesKHR(device_, swapchain_, count, list); });
    for (VkImage image : images_) {
        auto view = made<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
        view.image = image;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format_.format;
        view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        COTAN_CHECK(vkCreateImageView(device_, &view, nullptr, &views_.emplace_back()));
        auto framebuffer = made<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
        framebuffer.renderPass = pass_;
        framebuffer.attachmentCount = 1;
        framebuffer.pAttachments = &views_.back();
        framebuffer.width = extent_.width;
        framebuffer.height = extent_.height;
        framebuffer.layers = 1;
        COTAN_CHECK(vkCreateFramebuffer(device_, &framebuffer, nullptr, &framebuffers_.emplace_back()));
        auto semaphore = made<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
        COTAN_CHECK(vkCreateSemaphore(device_, &semaphore, nullptr, &drawn_.emplace_back()));
    }
    read_ =
        makeBuffer(VkDeviceSize(4) * extent_.width * extent_.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT, read_memory_);
    if (!interface_started_)
        startInterface();
}

void Presenter::dropSwapchain()
{
    for (VkFramebuffer framebuffer : framebuffers_)
        vkDestroyFramebuffer(device_, framebuffer, nullptr);
    for (VkImageView view : views_)
        vkDestroyImageView(device_, view, nullptr);
    for (VkSemaphore semaphore : drawn_)
        vkDestroySemaphore(device_, semaphore, nullptr);
    framebuffers_.clear();
    views_.clear();
    drawn_.clear();
    images_.clear();
    if (swapchain_)
        vkDestroySwapchainKHR(device_, swapchain_, nullptr);
    swapchain_ = VK_NULL_HANDLE;
    vkDestroyBuffer(device_, read_, nullptr);
    vkFreeMemory(device_, read_memory_, nullptr);
    read_ = VK_NULL_HANDLE;
    read_memory_ = VK_NULL_HANDLE;
    has_read_ = false;
}

void Presenter::startInterface()
{
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = instance_;
    info.PhysicalDevice = physical_;
    info.Device = device_;
    info.QueueFamily = family_;
    info.Queue = queue_;
    info.DescriptorPool = descriptors_;
    info.MinImageCount = 2;
    info.ImageCount = std::max(2u, std::uint32_t(images_.size()));
    startImGuiBackend(info, pass_);
    interface_started_ = true;
    uploadImGuiFonts([this](const auto& upload) {
        auto begin = made<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        COTAN_CHECK(vkBeginCommandBuffer(commands_, &begin));
        upload(commands_);
        COTAN_CHECK(vkEndCommandBuffer(commands_));
        auto submit = made<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands_;
        COTAN_CHECK(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE));
        COTAN_CHECK(vkQueueWaitIdle(queue_));
    });
}

// Restarts the backend, because it frees a font texture only when it ends.
void Presenter::useFont()
{
    if (!interface_started_)
        return;
    vkDeviceWaitIdle(device_);
    ImGui_ImplVulkan_Shutdown();
    startInterface();
}

bool Presenter::acquire(int width, int height, std::uint32_t& index)
{
    for (int attempt = 0; attempt < 3; ++attempt) {
        if (lost_ || !swapchain_ || int(extent_.width) != width || int(extent_.height) != height)
            makeSwapchain(width, height);
        if (!swapchain_)
            return false;
        const VkResult code = vkAcquireNextImageKHR(device_, swapchain_, std::numeric_limits<std::uint64_t>::max(),
                                                    acquired_, VK_NULL_HANDLE, &index);
        if (code == VK_SUCCESS || code == VK_SUBOPTIMAL_KHR)
            return true;
        if (code != VK_ERROR_OUT_OF_DATE_KHR && code != VK_ERROR_SURFACE_LOST_KHR)
            throw VulkanFailed("vkAcquireNextImageKHR", code);
        lost_ = lost_ || code == VK_ERROR_SURFACE_LOST_KHR;
        vkDeviceWaitIdle(device_);
        dropSwapchain();
    }
    return false;
}

bool Presenter::show(const Shown& shown, ImDrawData* interface, int width, int height)
{
    std::uint32_t index = 0;
    if (width <= 0 || height <= 0 || !acquire(width, height, index))
        return has_read_ = false;
    if (shown.picture && shown.serial != serial_) {
        keep(picture_, *shown.picture);
        if (shown.other)
            keep(other_, *shown.other);
        serial_ = shown.serial;
    }
    if (interface)
        nameImGuiTexture(*interface);
    record(index, shown, interface);
    const VkPipelineStageFlags waitStages =
        VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    auto submit = made<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.waitSemaphoreCount = 1;
    submit.pWaitSemaphores = &acquired_;
    submit.pWaitDstStageMask = &waitStages;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    submit.signalSemaphoreCount = 1;
    submit.pSignalSemaphores = &drawn_[index];
    COTAN_CHECK(vkQueueSubmit(queue_, 1, &submit, done_));
    auto present = made<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
    present.waitSemaphoreCount = 1;
    present.pWaitSemaphores = &drawn_[index];
    present.swapchainCount = 1;
    present.pSwapchains = &swapchain_;
    present.pImageIndices = &index;
    const VkResult code = vkQueuePresentKHR(queue_, &present);
    COTAN_CHECK(vkWaitForFences(device_, 1, &done_, VK_TRUE, std::numeric_limits<std::uint64_t>::max()));
    COTAN_CHECK(vkResetFences(device_, 1, &done_));
    has_read_ = true;
    if (code == VK_ERROR_SURFACE_LOST_KHR)
        lost_ = true;
    else if (code != VK_SUCCESS && code != VK_SUBOPTIMAL_KHR && code != VK_ERROR_OUT_OF_DATE_KHR)
        throw VulkanFailed("vkQueuePresentKHR", code);
    return true;
}

Image Presenter::read()
{
    Image image;
    if (!has_read_)
        return image;
    image = makeImage(int(extent_.width), int(extent_.height), PixelType::unorm8, "window");
    void* bytes = nullptr;
    COTAN_CHECK(vkMapMemory(device_, read_memory_, 0, VK_WHOLE_SIZE, 0, &bytes));
    std::memcpy(image.data.data(), bytes, image.data.size());
    vkUnmapMemory(device_, read_memory_);
    const bool blueFirst = format_.format == VK_FORMAT_B8G8R8A8_UNORM || format_.format == VK_FORMAT_B8G8R8A8_SRGB;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        std::uint8_t* pixel = image.bytes8() + 4 * i;
        if (blueFirst)
            std::swap(pixel[0], pixel[2]);
        pixel[3] = 255;
    }
    return image;
}

} // namespace cotan::viewer
