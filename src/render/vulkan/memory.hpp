// Device memory, buffers, images, and uploads to them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "device.hpp"

namespace cotan {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

// Rounds up to a multiple of `alignment`.
inline vk::DeviceSize aligned(vk::DeviceSize value, vk::DeviceSize alignment)
{
    return (value + alignment - 1) / alignment * alignment;
}

// Memory in blocks, allocated from front to back and freed all at once.
class Memory {
public:
    explicit Memory(const Device& device, vk::DeviceSize least = 32 << 20) : device_(&device), blockSize_(least) {}

    const Device& device() const { return *device_; }

    struct Piece {
        vk::DeviceMemory memory;
        vk::DeviceSize offset = 0;
        std::byte* mapped = nullptr; // if the memory is host visible
    };

    // Throws vk::SystemError if memory runs out. wanted: preferred properties; needed: required ones.
    Piece allocate(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags needed,
                   vk::MemoryPropertyFlags wanted = {});

private:
    struct Block {
        vk::raii::DeviceMemory memory;
        std::uint32_t type = 0;
        vk::DeviceSize size = 0;
        vk::DeviceSize used = 0;
        std::byte* mapped = nullptr;
    };
    Block& addBlock(std::uint32_t type, vk::DeviceSize size);
    std::uint32_t chooseType(std::uint32_t allowed, vk::MemoryPropertyFlags needed,
                             vk::MemoryPropertyFlags wanted) const;

    const Device* device_;
    vk::DeviceSize blockSize_;
    std::vector<Block> blocks_;
};

struct Buffer {
    vk::raii::Buffer buffer{nullptr};
    vk::DeviceSize size = 0;
    vk::DeviceAddress address = 0; // if the usage includes one
    std::byte* mapped = nullptr;   // if the memory is host visible and coherent
};

struct Texture2D {
    vk::raii::Image image{nullptr};
    vk::raii::ImageView view{nullptr};
    vk::Extent2D extent;
    std::uint32_t levels = 1;
};

Buffer makeDeviceBuffer(Memory& memory, vk::DeviceSize size, vk::BufferUsageFlags usage);
// Host visible, coherent and mapped. readBack: prefers cached memory.
Buffer makeHostBuffer(Memory& memory, vk::DeviceSize size, vk::BufferUsageFlags usage, bool readBack = false);

struct TextureInfo {
    vk::Format format = vk::Format::eR8G8B8A8Unorm;
    vk::Extent2D extent;
    std::uint32_t levels = 1;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    vk::ImageUsageFlags usage;
    vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor;
};
Texture2D makeTexture(Memory& memory, const TextureInfo& info);

// An image with memory of its own. When handed out, it is in the layout eTransferSrcOptimal.
struct DeviceImage {
    DeviceImage(const Device& device, const TextureInfo& info) : memory(device, 0), texture(makeTexture(memory, info))
    {
    }
    Memory memory;
    Texture2D texture;
};

// A command buffer that is recorded, submitted and waited for, after which it can be recorded again.
class Commands {
public:
    explicit Commands(const Device& device);
    const vk::raii::CommandBuffer& begin();
    void submitAndWait() { submit(), wait(); }
    // before: waited for; after: signalled.
    void submit(vk::Semaphore before = {}, vk::Semaphore after = {});
    void wait();

private:
    const Device* device_;
    vk::raii::CommandPool pool_{nullptr};
    vk::raii::CommandBuffer buffer_{nullptr};
    vk::raii::Fence fence_{nullptr};
};

// How an image is used: its layout, pipeline stages and accesses.
struct ImageUse {
    vk::ImageLayout layout;
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
};
inline constexpr ImageUse kCopied{vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead};
inline constexpr ImageUse kSampled{vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader,
                                   Access::eShaderSampledRead};
inline constexpr auto kDepthStages = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
inline constexpr ImageUse kDepthDrawn{vk::ImageLayout::eDepthAttachmentOptimal, kDepthStages,
                                      Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite};

void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
                const ImageUse& before, const ImageUse& after);

// Copies an image, which is used as kCopied, into a host buffer.
void copyToHost(const vk::raii::CommandBuffer& commands, const Device& device, vk::Image image, vk::Extent2D extent,
                const Buffer& target);

// Copies data into device buffers and images through one staging buffer, which is flushed when full. Call finish()
// before the data is used.
class Uploader {
public:
    // capacity: bytes of the staging buffer, which is enlarged to one row of the widest image.
    Uploader(const Device& device, vk::DeviceSize capacity);

    void buffer(const Buffer& target, vk::DeviceSize offset, std::span<const std::byte> data);
    // levels: finest first, as many as the texture has, each without padding. after: how the image is used next.
    void image(const Texture2D& target, std::span<const std::span<const std::byte>> levels, std::size_t bytesPerTexel,
               const ImageUse& after = kSampled);
    void finish();

private:
    const vk::raii::CommandBuffer& recording();
    // Returns the number of bytes that can be staged now, at most `size`. Flushes if fewer than `minimum` are free.
    vk::DeviceSize reserve(vk::DeviceSize size, vk::DeviceSize minimum);
    void level(const Texture2D& target, std::uint32_t index, std::span<const std::byte> data,
               std::size_t bytesPerTexel);

    Memory memory_;
    Commands commands_;
    Buffer staging_;
    vk::DeviceSize used_ = 0;
    const vk::raii::CommandBuffer* recording_ = nullptr;
};

} // namespace cotan
