#include "layers.hpp"

#include <algorithm>
#include <cstring>

#include "gpu_structs.hpp"

namespace cotan {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Usage = vk::BufferUsageFlagBits;

constexpr vk::DeviceSize kLayerBytes = vk::DeviceSize(128) << 20; // what every device can bind
constexpr vk::DeviceSize kListBytes = vk::DeviceSize(16) << 20;

void barrier(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags2 before, vk::AccessFlags2 written,
             vk::PipelineStageFlags2 after, vk::AccessFlags2 used)
{
    const vk::MemoryBarrier2 memory(before, written, after, used);
    commands.pipelineBarrier2(vk::DependencyInfo({}, memory));
}

} // namespace

LayerLists::LayerLists(const Device& device, std::uint32_t width) : memory_(device), width_(width)
{
    lists_ = makeDeviceBuffer(device, memory_, kListBytes,
                              Usage::eStorageBuffer | Usage::eTransferDst | Usage::eTransferSrc);
    layers_ = makeDeviceBuffer(device, memory_, kLayerBytes, Usage::eStorageBuffer);
    count_ = makeHostBuffer(device, memory_, sizeof(std::uint32_t), Usage::eTransferDst, /*readBack*/ true);
}

std::uint32_t LayerLists::maxRows() const
{
    const vk::DeviceSize pixels = (kListBytes - sizeof(gpu::CotanLayerLists)) / sizeof(std::uint32_t);
    return static_cast<std::uint32_t>(std::max<vk::DeviceSize>(pixels / width_, 1));
}

std::uint32_t LayerLists::capacity() const { return static_cast<std::uint32_t>(kLayerBytes / sizeof(gpu::CotanLayer)); }

void LayerLists::clear(const vk::raii::CommandBuffer& commands, std::uint32_t top, std::uint32_t rows) const
{
    const gpu::CotanLayerLists head{0, capacity(), width_, top, top + rows};
    barrier(commands, Stage::eFragmentShader | Stage::eTransfer, Access::eShaderStorageRead | Access::eTransferRead,
            Stage::eTransfer, Access::eTransferWrite);
    commands.updateBuffer<gpu::CotanLayerLists>(*lists_.buffer, 0, head);
    commands.fillBuffer(*lists_.buffer, sizeof head, vk::DeviceSize(rows) * width_ * sizeof(std::uint32_t), 0);
    barrier(commands, Stage::eTransfer, Access::eTransferWrite, Stage::eFragmentShader,
            Access::eShaderStorageRead | Access::eShaderStorageWrite);
}

void LayerLists::finish(const vk::raii::CommandBuffer& commands) const
{
    barrier(commands, Stage::eFragmentShader, Access::eShaderStorageWrite, Stage::eFragmentShader | Stage::eTransfer,
            Access::eShaderStorageRead | Access::eTransferRead);
    commands.copyBuffer(*lists_.buffer, *count_.buffer, vk::BufferCopy(0, 0, sizeof(std::uint32_t)));
    barrier(commands, Stage::eTransfer, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
}

std::uint32_t LayerLists::count() const
{
    std::uint32_t count = 0;
    std::memcpy(&count, count_.mapped, sizeof count);
    return count;
}

} // namespace cotan
