// Translucent fragments: stored in a list for each pixel and composed in depth order.
#include <algorithm>
#include <cstring>
#include <string>

#include "draw_passes.hpp"

namespace cotan {

namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr vk::DeviceSize kLayerBytes = vk::DeviceSize(128) << 20; // every device can bind 128 MiB
constexpr vk::DeviceSize kListBytes = vk::DeviceSize(16) << 20;
constexpr auto kCapacity = std::uint32_t(kLayerBytes / sizeof(gpu::CotanLayer));

void barrier(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags2 before, vk::AccessFlags2 written,
             vk::PipelineStageFlags2 after, vk::AccessFlags2 used)
{
    const vk::MemoryBarrier2 memory(before, written, after, used);
    commands.pipelineBarrier2(vk::DependencyInfo({}, memory));
}

} // namespace

LayerLists::LayerLists(const Device& device, std::uint32_t imageWidth) : memory(device), width(imageWidth)
{
    lists = makeDeviceBuffer(memory, kListBytes, Usage::eStorageBuffer | Usage::eTransferDst | Usage::eTransferSrc);
    layers = makeDeviceBuffer(memory, kLayerBytes, Usage::eStorageBuffer);
    hostCount = makeHostBuffer(memory, sizeof(std::uint32_t), Usage::eTransferDst, /*readBack*/ true);
}

void LayerLists::clear(const vk::raii::CommandBuffer& commands, std::uint32_t top, std::uint32_t rows) const
{
    const gpu::CotanLayerLists head{0, kCapacity, width, top, top + rows};
    barrier(commands, Stage::eFragmentShader | Stage::eTransfer, Access::eShaderStorageRead | Access::eTransferRead,
            Stage::eTransfer, Access::eTransferWrite);
    commands.updateBuffer<gpu::CotanLayerLists>(*lists.buffer, 0, head);
    commands.fillBuffer(*lists.buffer, sizeof head, vk::DeviceSize(rows) * width * sizeof(std::uint32_t), 0);
    barrier(commands, Stage::eTransfer, Access::eTransferWrite, Stage::eFragmentShader,
            Access::eShaderStorageRead | Access::eShaderStorageWrite);
}

void LayerLists::finish(const vk::raii::CommandBuffer& commands) const
{
    barrier(commands, Stage::eFragmentShader, Access::eShaderStorageWrite, Stage::eFragmentShader | Stage::eTransfer,
            Access::eShaderStorageRead | Access::eTransferRead);
    commands.copyBuffer(*lists.buffer, *hostCount.buffer, vk::BufferCopy(0, 0, sizeof(std::uint32_t)));
    barrier(commands, Stage::eTransfer, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
}

// Draws the translucent fragments of a band into their lists; returns the number of fragments.
std::uint32_t CommandRecorder::storeLayers(const DrawLists& lists, const vk::Rect2D& band)
{
    const vk::raii::CommandBuffer& commands = begin();
    layers_->clear(commands, static_cast<std::uint32_t>(band.offset.y), band.extent.height);
    targets_->beginLayers(commands, band);
    drawItems(commands, lists.translucent, keys_.layers);
    commands.endRendering();
    layers_->finish(commands);
    commands_.submitAndWait();
    std::uint32_t count = 0;
    std::memcpy(&count, layers_->hostCount.mapped, sizeof count);
    return count;
}

// Composes the lists of a band over the image, one sample after the other, which needs no sample shading.
void CommandRecorder::composeLayers(const vk::Rect2D& band)
{
    const vk::raii::CommandBuffer& commands = begin();
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_->pipeline, 0, composeSet_, {});
    targets_->beginCompose(commands, band);
    for (std::uint32_t sample = 0; sample < static_cast<std::uint32_t>(keys_.compose.samples); ++sample) {
        commands.pushConstants<std::uint32_t>(*layouts_->pipeline, kBothStages, 0, sample);
        drawFullScreen(commands, keys_.compose);
    }
    commands.endRendering();
    commands_.submitAndWait();
}

// Draws the image in bands of rows that are low enough for their layers to fit.
Status CommandRecorder::drawLayers(const DrawLists& lists)
{
    const PixelArea& area = lists.translucentArea;
    const auto width = static_cast<std::uint32_t>(area.x1 - area.x0), end = static_cast<std::uint32_t>(area.y1);
    constexpr vk::DeviceSize pixels = (kListBytes - sizeof(gpu::CotanLayerLists)) / sizeof(std::uint32_t);
    auto rows = static_cast<std::uint32_t>(std::max<vk::DeviceSize>(pixels / layers_->width, 1)); // per band
    for (auto top = static_cast<std::uint32_t>(area.y0); top < end && width > 0;) {
        const std::uint32_t height = std::min(rows, end - top);
        const vk::Rect2D band({area.x0, std::int32_t(top)}, {width, height});
        const std::uint32_t count = storeLayers(lists, band);
        if (count <= kCapacity) {
            composeLayers(band);
            top += height;
        } else if (height > 1) {
            rows = height / 2;
        } else {
            return unavailableError(std::to_string(count) + " translucent fragments in one row of pixels: at most "
                                    + std::to_string(kCapacity) + " can be sorted");
        }
    }
    return Done{};
}

} // namespace cotan
