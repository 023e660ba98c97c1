#include "memory.hpp"

#include <algorithm>
#include <cstring>

#include "core/large_array.hpp"

namespace cotan {

namespace {

Buffer makeBuffer(Memory& memory, vk::DeviceSize size, vk::BufferUsageFlags usage, vk::MemoryPropertyFlags needed,
                  vk::MemoryPropertyFlags wanted)
{
    const vk::raii::Device& device = memory.device().device;
    Buffer b;
    b.size = std::max<vk::DeviceSize>(size, 4);
    b.buffer = vk::raii::Buffer(device, vk::BufferCreateInfo({}, b.size, usage));
    const Memory::Piece piece = memory.allocate(b.buffer.getMemoryRequirements(), needed, wanted);
    b.buffer.bindMemory(piece.memory, piece.offset);
    b.mapped = piece.mapped;
    if (usage & vk::BufferUsageFlagBits::eShaderDeviceAddress)
        b.address = device.getBufferAddress({*b.buffer});
    return b;
}

} // namespace

std::uint32_t Memory::chooseType(std::uint32_t allowed, vk::MemoryPropertyFlags needed,
                                 vk::MemoryPropertyFlags wanted) const
{
    const vk::PhysicalDeviceMemoryProperties& p = device_->memory;
    for (const vk::MemoryPropertyFlags flags : {needed | wanted, needed})
        for (std::uint32_t i = 0; i < p.memoryTypeCount; ++i)
            if ((allowed >> i & 1) && (p.memoryTypes[i].propertyFlags & flags) == flags)
                return i;
    throw vk::FeatureNotPresentError("the device has no memory of the required type");
}

Memory::Block& Memory::addBlock(std::uint32_t type, vk::DeviceSize size)
{
    const vk::MemoryAllocateFlagsInfo flags(device_->exact ? vk::MemoryAllocateFlagBits::eDeviceAddress
                                                           : vk::MemoryAllocateFlags());
    vk::MemoryAllocateInfo info(size, type, &flags);
    Block block{vk::raii::DeviceMemory(device_->device, info), type, size};
    const vk::MemoryPropertyFlags properties = device_->memory.memoryTypes[type].propertyFlags;
    const auto mappable = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    if ((properties & mappable) == mappable)
        block.mapped = static_cast<std::byte*>(block.memory.mapMemory(0, VK_WHOLE_SIZE));
    if (device_->cpu && block.mapped) // it is memory of this process
        requestLargePages(block.mapped, size);
    return blocks_.emplace_back(std::move(block));
}

Memory::Piece Memory::allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags needed,
                               vk::MemoryPropertyFlags wanted)
{
    const std::uint32_t type = chooseType(requirements.memoryTypeBits, needed, wanted);
    // Buffers and images may share a block, so all keep bufferImageGranularity.
    const vk::DeviceSize alignment = std::max(requirements.alignment, device_->limits.bufferImageGranularity);
    Block* block = nullptr;
    for (Block& b : blocks_)
        if (b.type == type && aligned(b.used, alignment) + requirements.size <= b.size)
            block = &b;
    if (!block)
        block = &addBlock(type, std::max(requirements.size, blockSize_));
    const vk::DeviceSize offset = aligned(block->used, alignment);
    block->used = offset + requirements.size;
    return {*block->memory, offset, block->mapped ? block->mapped + offset : nullptr};
}

Buffer makeDeviceBuffer(Memory& memory, vk::DeviceSize size, vk::BufferUsageFlags usage)
{
    return makeBuffer(memory, size, usage, {}, vk::MemoryPropertyFlagBits::eDeviceLocal);
}

Buffer makeHostBuffer(Memory& memory, vk::DeviceSize size, vk::BufferUsageFlags usage, bool readBack)
{
    return makeBuffer(memory, size, usage,
                      vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent,
                      readBack ? vk::MemoryPropertyFlagBits::eHostCached : vk::MemoryPropertyFlags());
}

Texture2D makeTexture(Memory& memory, const TextureInfo& info)
{
    const vk::raii::Device& device = memory.device().device;
    Texture2D t{.extent = info.extent, .levels = info.levels};
    t.image = vk::raii::Image(device,
                              vk::ImageCreateInfo({}, vk::ImageType::e2D, info.format, vk::Extent3D(info.extent, 1),
                                                  info.levels, 1, info.samples, vk::ImageTiling::eOptimal, info.usage));
    const Memory::Piece piece =
        memory.allocate(t.image.getMemoryRequirements(), {}, vk::MemoryPropertyFlagBits::eDeviceLocal);
    t.image.bindMemory(piece.memory, piece.offset);
    const vk::ImageSubresourceRange range(info.aspect, 0, info.levels, 0, 1);
    t.view = vk::raii::ImageView(device,
                                 vk::ImageViewCreateInfo({}, *t.image, vk::ImageViewType::e2D, info.format, {}, range));
    return t;
}

Commands::Commands(const Device& device) : device_(&device)
{
    pool_ = vk::raii::CommandPool(device.device, {vk::CommandPoolCreateFlagBits::eTransient, device.queueFamily});
    buffer_ = std::move(vk::raii::CommandBuffers(device.device, {*pool_, vk::CommandBufferLevel::ePrimary, 1})[0]);
    fence_ = vk::raii::Fence(device.device, vk::FenceCreateInfo());
}

const vk::raii::CommandBuffer& Commands::begin()
{
    pool_.reset();
    buffer_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    return buffer_;
}

void Commands::submit(vk::Semaphore before, vk::Semaphore after)
{
    buffer_.end();
    const vk::CommandBufferSubmitInfo commands(*buffer_);
    const vk::SemaphoreSubmitInfo first(before, 0, Stage::eAllCommands), last(after, 0, Stage::eAllCommands);
    const vk::SubmitInfo2 info({}, before ? 1 : 0, &first, 1, &commands, after ? 1 : 0, &last);
    const std::lock_guard lock(device_->queueInUse);
    device_->queue.submit2(info, *fence_);
}

void Commands::wait()
{
    while (device_->device.waitForFences(*fence_, VK_TRUE, UINT64_MAX) == vk::Result::eTimeout) {
    }
    device_->device.resetFences(*fence_);
}

void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
                const ImageUse& before, const ImageUse& after)
{
    const vk::ImageMemoryBarrier2 barrier(before.stages, before.access, after.stages, after.access, before.layout,
                                          after.layout, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
                                          {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

void copyToHost(const vk::raii::CommandBuffer& commands, const Device& device, vk::Image image, vk::Extent2D extent,
                const Buffer& target)
{
    const vk::BufferImageCopy copy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, 0, 0},
                                   vk::Extent3D(extent, 1));
    commands.copyImageToBuffer(image, kCopied.layout, *target.buffer, copy);
    const vk::MemoryBarrier2 toHost(Stage::eTransfer, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, toHost));
    ++device.imagesRead;
}

Uploader::Uploader(const Device& device, vk::DeviceSize capacity) : memory_(device), commands_(device)
{
    const vk::DeviceSize widestRow = vk::DeviceSize(device.limits.maxImageDimension2D) * 16;
    staging_ = makeHostBuffer(memory_, std::max(capacity, widestRow), vk::BufferUsageFlagBits::eTransferSrc);
}

const vk::raii::CommandBuffer& Uploader::recording()
{
    if (!recording_)
        recording_ = &commands_.begin();
    return *recording_;
}

void Uploader::finish()
{
    if (recording_)
        commands_.submitAndWait();
    recording_ = nullptr;
    used_ = 0;
}

vk::DeviceSize Uploader::reserve(vk::DeviceSize size, vk::DeviceSize minimum)
{
    used_ = aligned(used_, 16);
    if (used_ + std::min(size, minimum) > staging_.size)
        finish();
    return std::min(size, staging_.size - used_);
}

void Uploader::buffer(const Buffer& target, vk::DeviceSize offset, std::span<const std::byte> data)
{
    while (!data.empty()) {
        const vk::DeviceSize count = reserve(data.size(), 4096);
        std::memcpy(staging_.mapped + used_, data.data(), count);
        recording().copyBuffer(*staging_.buffer, *target.buffer, vk::BufferCopy(used_, offset, count));
        used_ += count;
        offset += count;
        data = data.subspan(count);
    }
}

void Uploader::level(const Texture2D& target, std::uint32_t index, std::span<const std::byte> data,
                     std::size_t bytesPerTexel)
{
    const std::uint32_t width = std::max(target.extent.width >> index, 1u);
    const std::uint32_t height = std::max(target.extent.height >> index, 1u);
    const vk::DeviceSize row = vk::DeviceSize(width) * bytesPerTexel;
    for (std::uint32_t y = 0; y < height;) {
        const vk::DeviceSize available = reserve(row * (height - y), row);
        const auto rows = static_cast<std::uint32_t>(available / row);
        std::memcpy(staging_.mapped + used_, data.data() + y * row, rows * row);
        const vk::BufferImageCopy copy(used_, 0, 0, {vk::ImageAspectFlagBits::eColor, index, 0, 1},
                                       {0, std::int32_t(y), 0}, {width, rows, 1});
        recording().copyBufferToImage(*staging_.buffer, *target.image, vk::ImageLayout::eTransferDstOptimal, copy);
        used_ += rows * row;
        y += rows;
    }
}

void Uploader::image(const Texture2D& target, std::span<const std::span<const std::byte>> levels,
                     std::size_t bytesPerTexel, const ImageUse& after)
{
    constexpr auto color = vk::ImageAspectFlagBits::eColor;
    constexpr ImageUse written{vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite};
    transition(recording(), *target.image, color, {vk::ImageLayout::eUndefined, Stage::eTopOfPipe, {}}, written);
    for (std::uint32_t i = 0; i < target.levels; ++i)
        level(target, i, levels[i], bytesPerTexel);
    transition(recording(), *target.image, color, written, after);
}

} // namespace cotan
