// One frame of the window: uploads the images, draws them into the window, and the interface over them.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include "presenter.hpp"

namespace cotan::viewer {

namespace {

constexpr VkImageSubresourceLayers kLayers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
constexpr VkImageSubresourceRange kRange{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

} // namespace

std::uint32_t Presenter::memoryType(std::uint32_t bits, VkMemoryPropertyFlags flags) const
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((bits & (1u << i)) && (memory.memoryTypes[i].propertyFlags & flags) == flags)
            return i;
    throw std::runtime_error("the device has no memory of the required type");
}

VkBuffer Presenter::makeBuffer(VkDeviceSize bytes, VkBufferUsageFlags usage, VkDeviceMemory& memory)
{
    auto info = made<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = bytes;
    info.usage = usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device_, &info, nullptr, &buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device_, buffer, &needs);
    auto allocate = made<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex =
        memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkAllocateMemory(device_, &allocate, nullptr, &memory), "vkAllocateMemory");
    check(vkBindBufferMemory(device_, buffer, memory, 0), "vkBindBufferMemory");
    return buffer;
}

void Presenter::drop(HostImage& image)
{
    vkDestroyImage(device_, image.image, nullptr);
    vkFreeMemory(device_, image.memory, nullptr);
    vkDestroyBuffer(device_, image.staging, nullptr);
    vkFreeMemory(device_, image.staging_memory, nullptr);
    image = {};
}

void Presenter::keep(HostImage& into, const Image& image)
{
    if (into.width != image.width || into.height != image.height) {
        drop(into);
        auto info = made<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        info.extent = {std::uint32_t(image.width), std::uint32_t(image.height), 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        check(vkCreateImage(device_, &info, nullptr, &into.image), "vkCreateImage");
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(device_, into.image, &needs);
        auto allocate = made<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
        allocate.allocationSize = needs.size;
        allocate.memoryTypeIndex = memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        check(vkAllocateMemory(device_, &allocate, nullptr, &into.memory), "vkAllocateMemory");
        check(vkBindImageMemory(device_, into.image, into.memory, 0), "vkBindImageMemory");
        into.staging = makeBuffer(image.data.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, into.staging_memory);
        into.width = image.width;
        into.height = image.height;
    }
    void* bytes = nullptr;
    check(vkMapMemory(device_, into.staging_memory, 0, VK_WHOLE_SIZE, 0, &bytes), "vkMapMemory");
    std::memcpy(bytes, image.data.data(), image.data.size());
    vkUnmapMemory(device_, into.staging_memory);
    into.fresh = true;
}

// Changes the layout of an image and waits for all earlier commands, which is fast enough for the few of a frame.
void Presenter::barrier(VkImage image, VkImageLayout from, VkImageLayout to)
{
    auto info = made<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    info.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    info.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    info.oldLayout = from;
    info.newLayout = to;
    info.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    info.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    info.image = image;
    info.subresourceRange = kRange;
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                         nullptr, 0, nullptr, 1, &info);
}

// Copies the columns from `left` to `right`, as fractions of the width, of an image into the window.
void Presenter::blit(HostImage& from, std::uint32_t index, float left, float right)
{
    if (from.fresh) {
        barrier(from.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy whole{};
        whole.imageSubresource = kLayers;
        whole.imageExtent = {std::uint32_t(from.width), std::uint32_t(from.height), 1};
        vkCmdCopyBufferToImage(commands_, from.staging, from.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
        barrier(from.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        from.fresh = false;
    }
    const auto column = [&](float fraction, int width) { return int(std::lround(fraction * float(width))); };
    VkImageBlit region{};
    region.srcSubresource = kLayers;
    region.srcOffsets[0] = {column(left, from.width), 0, 0};
    region.srcOffsets[1] = {column(right, from.width), from.height, 1};
    region.dstSubresource = kLayers;
    region.dstOffsets[0] = {column(left, int(extent_.width)), 0, 0};
    region.dstOffsets[1] = {column(right, int(extent_.width)), int(extent_.height), 1};
    if (region.srcOffsets[0].x >= region.srcOffsets[1].x || region.dstOffsets[0].x >= region.dstOffsets[1].x)
        return;
    const bool same = from.width == int(extent_.width) && from.height == int(extent_.height);
    vkCmdBlitImage(commands_, from.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, images_[index],
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
}

void Presenter::record(std::uint32_t index, const Shown& shown, ImDrawData* interface)
{
    auto begin = made<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    const VkImage image = images_[index];
    barrier(image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkClearColorValue grey{{0.25f, 0.25f, 0.25f, 1}};
    vkCmdClearColorImage(commands_, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &grey, 1, &kRange);
    barrier(image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    if (shown.picture && picture_.image) {
        const float at = shown.other && other_.image
            ? std::clamp(shown.divider / float(std::max(1u, extent_.width)), 0.0f, 1.0f)
            : 1.0f;
        blit(picture_, index, 0, at);
        if (at < 1)
            blit(other_, index, at, 1);
    }
    barrier(image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    auto pass = made<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    pass.renderPass = pass_;
    pass.framebuffer = framebuffers_[index];
    pass.renderArea.extent = extent_;
    vkCmdBeginRenderPass(commands_, &pass, VK_SUBPASS_CONTENTS_INLINE);
    if (interface && interface->TotalVtxCount > 0)
        ImGui_ImplVulkan_RenderDrawData(interface, commands_);
    vkCmdEndRenderPass(commands_);
    barrier(image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy whole{};
    whole.imageSubresource = kLayers;
    whole.imageExtent = {extent_.width, extent_.height, 1};
    vkCmdCopyImageToBuffer(commands_, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, read_, 1, &whole);
    barrier(image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
}

} // namespace cotan::viewer
