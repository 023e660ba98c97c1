// Finds the triangles that are not hidden, before they are shaded.
#include <cstring>

#include "draw_passes.hpp"

namespace cotan {

VisibleTriangles::VisibleTriangles(const Device& device, std::uint32_t count) : memory(device, 0), capacity(count)
{
    using Usage = vk::BufferUsageFlagBits;
    const vk::DeviceSize triangles = count;
    marks = makeHostBuffer(memory, triangles * 4, Usage::eStorageBuffer, /*readBack*/ true);
    indices = makeHostBuffer(memory, triangles * 12, Usage::eIndexBuffer);
}

// Mesa's CPU driver shades all pixels of the blocks that a triangle touches when they have several samples, even where
// the depth test fails. The frame `exact` reads the index of the triangle, which changes here.
bool CommandRecorder::dropsHidden(const View& view) const
{
    const bool readsTriangle = !view.framesOfMeshes && info(view.frame).source == FrameSource::triangle;
    return device_->cpu && device_->exact && targets_->multisampled() && !readsTriangle;
}

// Draws the depth of the opaque surfaces, and marks the triangles that no sample hides. The image stays the same to the
// byte: what is left out would have written no sample.
void CommandRecorder::dropHidden(DrawLists& lists, const PixelArea& area)
{
    std::uint32_t count = 0;
    for (Item& item : lists.opaque) {
        if (!item.buffer->mapped)
            return;
        item.constants.order = count;
        count += item.mesh->indexCount / 3;
    }
    if (count == 0)
        return;
    if (!visible_ || visible_->capacity < count) {
        visible_.reset(); // frees its memory first
        visible_ = std::make_unique<VisibleTriangles>(*device_, count);
    }
    const vk::DescriptorBufferInfo marks(*visible_->marks.buffer, 0, VK_WHOLE_SIZE);
    using W = vk::WriteDescriptorSet;
    device_->device.updateDescriptorSets(W(markSet_, 3, 0, vk::DescriptorType::eStorageBuffer, {}, marks), {});
    std::memset(visible_->marks.mapped, 0, std::size_t(count) * 4);

    const vk::raii::CommandBuffer& commands = commands_.begin();
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_->pipeline, 0, markSet_, {});
    targets_->beginDepth(commands, rectangle(area));
    drawItems(commands, lists.opaque, keys_.depth);
    drawItems(commands, lists.opaque, keys_.marks);
    commands.endRendering();
    const vk::MemoryBarrier2 written(Stage::eFragmentShader, Access::eShaderStorageWrite, Stage::eHost,
                                     Access::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, written));
    commands_.submitAndWait();

    const auto* mark = reinterpret_cast<const std::uint32_t*>(visible_->marks.mapped);
    auto* const kept = reinterpret_cast<std::uint32_t*>(visible_->indices.mapped);
    std::uint32_t end = 0;
    for (Item& item : lists.opaque) {
        const auto* from = reinterpret_cast<const std::uint32_t*>(item.buffer->mapped + item.mesh->indices);
        const std::uint32_t begin = end;
        for (std::uint32_t i = 0; i + 2 < item.mesh->indexCount; i += 3)
            if (*mark++ != 0) {
                std::memcpy(kept + end, from + i, 12);
                end += 3;
            }
        item.visible = *visible_->indices.buffer;
        item.visibleOffset = vk::DeviceSize(begin) * 4;
        item.visibleCount = end - begin;
    }
}

} // namespace cotan
