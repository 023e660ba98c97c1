#include "render/vulkan/memory.hpp"

#include "presenter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "core/try.hpp"
#include "imgui_versions.hpp"

namespace cotan::viewer {

namespace {

constexpr auto kColor = vk::ImageAspectFlagBits::eColor;
constexpr auto kForever = std::numeric_limits<std::uint64_t>::max();

// Changes the layout of an image and waits for all earlier commands, which is fast enough for the few of a frame.
void change(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to)
{
    transition(commands, image, kColor, {from, Stage::eAllCommands, Access::eMemoryWrite},
               {to, Stage::eAllCommands, Access::eMemoryRead | Access::eMemoryWrite});
}

bool blueFirst(vk::Format format)
{
    return format == vk::Format::eB8G8R8A8Unorm || format == vk::Format::eB8G8R8A8Srgb;
}

} // namespace

// In the order of dependence: later members are destroyed first.
struct Presenter::State {
    struct Target { // an image of the window
        vk::Image image;
        vk::raii::ImageView view{nullptr};
        vk::raii::Framebuffer framebuffer{nullptr};
        vk::raii::Semaphore drawn{nullptr}; // one per image, so that none is reused while a present still waits on it
    };

    struct Upload { // of an image of the host
        std::shared_ptr<const Image> from;
        std::optional<DeviceImage> image;
    };

    std::function<VkSurfaceKHR(VkInstance)> makeSurface;
    std::shared_ptr<Device> device;
    vk::raii::SurfaceKHR surface{nullptr};
    std::optional<Commands> commands;
    vk::raii::Semaphore acquired{nullptr};
    vk::raii::DescriptorPool descriptors{nullptr};
    vk::SurfaceFormatKHR format;
    vk::raii::RenderPass pass{nullptr};
    vk::Extent2D extent;
    vk::raii::SwapchainKHR swapchain{nullptr};
    std::vector<Target> targets;
    std::array<Upload, 2> uploads;
    bool interfaceStarted = false, lost = false;

    Status open(const std::vector<const char*>& extensions, const WindowOptions& options);
    void remakeSurface();
    void waitForQueue();
    void makeRenderPass();
    void makeSwapchain(int width, int height);
    void dropSwapchain();
    void startInterface();
    bool acquire(int width, int height, std::uint32_t& index);
    const DeviceImage* onDevice(const Drawing& drawing, Upload& upload);
    void record(const vk::raii::CommandBuffer& buffer, const Target& target, const Shown& shown, ImDrawData* interface);
    void blit(const vk::raii::CommandBuffer& buffer, const DeviceImage& from, vk::Image into, float left, float right);
    void present(std::uint32_t index);
};

// ---- what lives as long as the window ---------------------------------------------------------

Status Presenter::State::open(const std::vector<const char*>& extensions, const WindowOptions& options)
{
    const auto presents = [this](const vk::raii::Instance& instance, const vk::raii::PhysicalDevice& physical,
                                 std::uint32_t family) {
        if (std::ranges::none_of(physical.enumerateDeviceExtensionProperties(),
                                 [](const vk::ExtensionProperties& known) {
                                     return std::strcmp(known.extensionName, VK_KHR_SWAPCHAIN_EXTENSION_NAME) == 0;
                                 }))
            return false;
        const vk::raii::SurfaceKHR trial(instance, makeSurface(*instance));
        return bool(physical.getSurfaceSupportKHR(family, *trial));
    };
    const WindowNeeds needs{extensions, presents};
    COTAN_TRY(opened, openDevice(options.device, /*validation*/ false, &needs));
    device = std::move(*opened);
    remakeSurface();
    commands.emplace(*device);
    acquired = vk::raii::Semaphore(device->device, vk::SemaphoreCreateInfo());
    const vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 8);
    descriptors = vk::raii::DescriptorPool(
        device->device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 8, size));
    return Done{};
}

void Presenter::State::remakeSurface()
{
    surface = nullptr; // a window has one
    surface = vk::raii::SurfaceKHR(device->instance, makeSurface(*device->instance));
    if (!device->physical.getSurfaceSupportKHR(device->queueFamily, *surface))
        throw std::runtime_error("the device can no longer present in the window");
    lost = false;
}

void Presenter::State::waitForQueue()
{
    const std::lock_guard lock(device->queueInUse);
    device->device.getDispatcher()->vkQueueWaitIdle(*device->queue); // a lost device has nothing to wait for
}

void Presenter::State::makeRenderPass()
{
    const std::vector<vk::SurfaceFormatKHR> formats = device->physical.getSurfaceFormatsKHR(*surface);
    if (formats.empty())
        throw std::runtime_error("the window's surface offers no pixel format");
    const auto bytes = std::ranges::find_if(formats, [](const vk::SurfaceFormatKHR& f) { // not sRGB: shown unchanged
        return f.format == vk::Format::eB8G8R8A8Unorm || f.format == vk::Format::eR8G8B8A8Unorm;
    });
    format = bytes == formats.end() ? formats[0] : *bytes;
    constexpr auto drawn = vk::ImageLayout::eColorAttachmentOptimal;
    const vk::AttachmentDescription color({}, format.format, vk::SampleCountFlagBits::e1,
                                          vk::AttachmentLoadOp::eLoad, // the image is already there
                                          vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare,
                                          vk::AttachmentStoreOp::eDontCare, drawn, drawn);
    const vk::AttachmentReference reference(0, drawn);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, reference);
    pass = vk::raii::RenderPass(device->device, vk::RenderPassCreateInfo({}, color, subpass));
}

void Presenter::State::startInterface()
{
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = *device->instance;
    info.PhysicalDevice = *device->physical;
    info.Device = *device->device;
    info.QueueFamily = device->queueFamily;
    info.Queue = *device->queue;
    info.DescriptorPool = *descriptors;
    info.MinImageCount = 2;
    info.ImageCount = std::max(2u, std::uint32_t(targets.size()));
    giveImGuiFunctions([&](const char* name) {
        return device->instance.getDispatcher()->vkGetInstanceProcAddr(*device->instance, name);
    });
    startImGuiBackend(info, *pass);
    interfaceStarted = true;
    const auto submit = [this](const auto& upload) {
        upload(*commands->begin());
        commands->submitAndWait();
    };
    uploadImGuiFonts(submit, device->queueInUse);
}

// ---- what lives as long as the window's size --------------------------------------------------

void Presenter::State::makeSwapchain(int width, int height)
{
    dropSwapchain();
    if (lost)
        remakeSurface();
    if (!*pass)
        makeRenderPass();
    const vk::SurfaceCapabilitiesKHR can = device->physical.getSurfaceCapabilitiesKHR(*surface);
    extent = can.currentExtent;
    if (extent.width == std::numeric_limits<std::uint32_t>::max())
        extent = vk::Extent2D(std::clamp(std::uint32_t(width), can.minImageExtent.width, can.maxImageExtent.width),
                              std::clamp(std::uint32_t(height), can.minImageExtent.height, can.maxImageExtent.height));
    if (extent.width == 0 || extent.height == 0)
        return; // minimised
    using Usage = vk::ImageUsageFlagBits;
    constexpr auto usage = Usage::eColorAttachment | Usage::eTransferDst | Usage::eTransferSrc;
    if ((can.supportedUsageFlags & usage) != usage)
        throw std::runtime_error("the window's surface cannot be copied to");
    const std::uint32_t count = std::min(std::max(2u, can.minImageCount), can.maxImageCount ? can.maxImageCount : ~0u);
    using Alpha = vk::CompositeAlphaFlagBitsKHR;
    const auto alpha = can.supportedCompositeAlpha & Alpha::eOpaque ? Alpha::eOpaque : Alpha::eInherit;
    swapchain = vk::raii::SwapchainKHR(device->device,
                                       vk::SwapchainCreateInfoKHR({}, *surface, count, format.format, format.colorSpace,
                                                                  extent, 1, usage, vk::SharingMode::eExclusive, {},
                                                                  can.currentTransform, alpha,
                                                                  vk::PresentModeKHR::eFifo, VK_TRUE));
    for (const vk::Image image : swapchain.getImages()) {
        Target& target = targets.emplace_back();
        target.image = image;
        target.view = vk::raii::ImageView(
            device->device,
            vk::ImageViewCreateInfo({}, image, vk::ImageViewType::e2D, format.format, {}, {kColor, 0, 1, 0, 1}));
        const vk::ImageView view = *target.view;
        target.framebuffer = vk::raii::Framebuffer(
            device->device, vk::FramebufferCreateInfo({}, *pass, view, extent.width, extent.height, 1));
        target.drawn = vk::raii::Semaphore(device->device, vk::SemaphoreCreateInfo());
    }
    if (!interfaceStarted)
        startInterface();
}

void Presenter::State::dropSwapchain()
{
    waitForQueue();
    targets.clear();
    swapchain = nullptr;
}

// ---- one frame --------------------------------------------------------------------------------

bool Presenter::State::acquire(int width, int height, std::uint32_t& index)
{
    for (int attempt = 0; attempt < 3; ++attempt) {
        if (lost || !*swapchain || int(extent.width) != width || int(extent.height) != height)
            makeSwapchain(width, height);
        if (!*swapchain)
            return false;
        // The C function, because codes that are no errors here are exceptions of the C++ one.
        const VkResult code = device->device.getDispatcher()->vkAcquireNextImageKHR(
            *device->device, *swapchain, kForever, *acquired, VK_NULL_HANDLE, &index);
        if (code == VK_SUCCESS || code == VK_SUBOPTIMAL_KHR)
            return true;
        if (code != VK_ERROR_OUT_OF_DATE_KHR && code != VK_ERROR_SURFACE_LOST_KHR)
            throw std::runtime_error("vkAcquireNextImageKHR failed (" + std::to_string(code) + ")");
        lost = lost || code == VK_ERROR_SURFACE_LOST_KHR;
        dropSwapchain();
    }
    return false;
}

// The image of a drawing; null: none. Uploads one of the host, once.
const DeviceImage* Presenter::State::onDevice(const Drawing& drawing, Upload& upload)
{
    if (!drawing.onHost) {
        upload = {};
        return drawing.onDevice.get();
    }
    if (upload.from != drawing.onHost) {
        using Usage = vk::ImageUsageFlagBits;
        const Image& image = *drawing.onHost;
        const TextureInfo info{.extent = {std::uint32_t(image.width), std::uint32_t(image.height)},
                               .usage = Usage::eTransferDst | Usage::eTransferSrc | Usage::eSampled};
        upload.image.emplace(*device, info);
        Uploader uploader(*device, image.data.size());
        const std::span<const std::byte> pixels(image.data);
        uploader.image(upload.image->texture, {&pixels, 1}, image.bytesPerPixel(), kCopied);
        uploader.finish();
        upload.from = drawing.onHost;
    }
    return &*upload.image;
}

// Copies the columns from `left` to `right`, as fractions of the width, of an image into the window.
void Presenter::State::blit(const vk::raii::CommandBuffer& buffer, const DeviceImage& from, vk::Image into, float left,
                            float right)
{
    const vk::Extent2D size = from.texture.extent;
    const auto column = [](float fraction, std::uint32_t width) { return int(std::lround(fraction * float(width))); };
    const vk::ImageSubresourceLayers layers(kColor, 0, 0, 1);
    const vk::ImageBlit region(
        layers,
        {vk::Offset3D(column(left, size.width), 0, 0), vk::Offset3D(column(right, size.width), int(size.height), 1)},
        layers,
        {vk::Offset3D(column(left, extent.width), 0, 0),
         vk::Offset3D(column(right, extent.width), int(extent.height), 1)});
    if (region.srcOffsets[0].x < region.srcOffsets[1].x && region.dstOffsets[0].x < region.dstOffsets[1].x)
        buffer.blitImage(*from.texture.image, kCopied.layout, into, vk::ImageLayout::eTransferDstOptimal, region,
                         size == extent ? vk::Filter::eNearest : vk::Filter::eLinear);
}

// Draws the images into the window, and the interface over them; ends in the layout eTransferSrcOptimal.
void Presenter::State::record(const vk::raii::CommandBuffer& buffer, const Target& target, const Shown& shown,
                              ImDrawData* interface)
{
    using Layout = vk::ImageLayout;
    constexpr auto filled = Layout::eTransferDstOptimal, drawn = Layout::eColorAttachmentOptimal;
    change(buffer, target.image, Layout::eUndefined, filled);
    const vk::ClearColorValue grey(std::array{0.25f, 0.25f, 0.25f, 1.0f});
    buffer.clearColorImage(target.image, filled, grey, vk::ImageSubresourceRange(kColor, 0, 1, 0, 1));
    change(buffer, target.image, filled, filled);
    if (const DeviceImage* picture = onDevice(shown.picture, uploads[0])) {
        const DeviceImage* other = onDevice(shown.other, uploads[1]);
        const float at = other ? std::clamp(shown.divider / float(extent.width), 0.0f, 1.0f) : 1.0f;
        blit(buffer, *picture, target.image, 0, at);
        if (at < 1)
            blit(buffer, *other, target.image, at, 1);
    }
    change(buffer, target.image, filled, drawn);
    buffer.beginRenderPass(vk::RenderPassBeginInfo(*pass, *target.framebuffer, {{0, 0}, extent}),
                           vk::SubpassContents::eInline);
    if (interface && interface->TotalVtxCount > 0) {
        const std::lock_guard lock(device->queueInUse); // newer versions of Dear ImGui upload textures here
        ImGui_ImplVulkan_RenderDrawData(interface, *buffer);
    }
    buffer.endRenderPass();
    change(buffer, target.image, drawn, kCopied.layout);
}

void Presenter::State::present(std::uint32_t index)
{
    const vk::Semaphore drawn = *targets[index].drawn;
    const vk::SwapchainKHR to = *swapchain;
    const vk::PresentInfoKHR info(drawn, to, index);
    const VkPresentInfoKHR& plain = info;
    const std::lock_guard lock(device->queueInUse);
    const VkResult code = device->device.getDispatcher()->vkQueuePresentKHR(*device->queue, &plain);
    if (code == VK_ERROR_SURFACE_LOST_KHR)
        lost = true;
    else if (code != VK_SUCCESS && code != VK_SUBOPTIMAL_KHR && code != VK_ERROR_OUT_OF_DATE_KHR)
        throw std::runtime_error("vkQueuePresentKHR failed (" + std::to_string(code) + ")");
}

void Presenter::show(const Shown& shown, ImDrawData* interface, int width, int height, Image* read)
{
    State& s = *state_;
    std::uint32_t index = 0;
    if (width <= 0 || height <= 0 || !s.acquire(width, height, index))
        return;
    if (interface)
        nameImGuiTexture(*interface);
    const State::Target& target = s.targets[index];
    const vk::raii::CommandBuffer& buffer = s.commands->begin();
    s.record(buffer, target, shown, interface);
    Memory memory(*s.device, 0);
    Buffer copy;
    if (read) {
        *read = makeImage(int(s.extent.width), int(s.extent.height), PixelType::unorm8, "window");
        copy = makeHostBuffer(memory, read->data.size(), vk::BufferUsageFlagBits::eTransferDst, /*readBack*/ true);
        copyToHost(buffer, *s.device, target.image, s.extent, copy);
    }
    change(buffer, target.image, kCopied.layout, vk::ImageLayout::ePresentSrcKHR);
    {
        const std::lock_guard lock(s.device->queueInUse); // nothing comes between the two
        s.commands->submit(*s.acquired, *target.drawn);
        s.present(index);
    }
    s.commands->wait();
    if (!read)
        return;
    std::memcpy(read->data.data(), copy.mapped, read->data.size());
    for (std::size_t i = 0; i < read->pixelCount(); ++i) {
        std::uint8_t* pixel = read->bytes8() + 4 * i;
        if (blueFirst(s.format.format))
            std::swap(pixel[0], pixel[2]);
        pixel[3] = 255;
    }
}

// ---- the presenter ----------------------------------------------------------------------------

Result<std::unique_ptr<Presenter>> Presenter::open(const std::vector<const char*>& extensions,
                                                   const WindowOptions& options,
                                                   std::function<VkSurfaceKHR(VkInstance)> makeSurface)
{
    auto state = std::make_unique<State>();
    state->makeSurface = std::move(makeSurface);
    COTAN_CHECK(state->open(extensions, options));
    return std::unique_ptr<Presenter>(new Presenter(std::move(state)));
}

Presenter::Presenter(std::unique_ptr<State> state) : state_(std::move(state)) {}

Presenter::~Presenter()
{
    state_->waitForQueue();
    if (state_->interfaceStarted)
        ImGui_ImplVulkan_Shutdown();
}

// Restarts the backend, because it frees a font texture only when it ends.
void Presenter::useFont()
{
    if (!state_->interfaceStarted)
        return;
    state_->waitForQueue();
    ImGui_ImplVulkan_Shutdown();
    state_->startInterface();
}

void Presenter::loseSurface() { state_->lost = true; }
std::shared_ptr<Device> Presenter::device() const { return state_->device->asAsked ? state_->device : nullptr; }
std::uint64_t Presenter::imagesRead() const { return state_->device->imagesRead; }

} // namespace cotan::viewer
