// The map of depths that shadows are found in.
#include "draw_passes.hpp"

namespace cotan {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

} // namespace

// A single texel where no shadow is wanted: the descriptor must exist all the same.
void CommandRecorder::prepareShadowMap(bool needed)
{
    const std::uint32_t side = needed ? kShadowSize : 1;
    if (shadowMap_.extent.width >= side)
        return;
    TextureInfo info;
    info.format = vk::Format::eD32Sfloat;
    info.extent = vk::Extent2D(side, side);
    info.usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled;
    info.aspect = vk::ImageAspectFlagBits::eDepth;
    shadowMap_ = {};
    shadowDrawn_.reset();
    shadowMemory_ = std::make_unique<Memory>(*device_);
    shadowMap_ = makeTexture(*device_, *shadowMemory_, info);
}

// Kept from one picture to the next, as long as it shows the same.
void CommandRecorder::recordShadow(const vk::raii::CommandBuffer& commands, const GpuScene& scene,
                                   const DrawLists& lists, const ShadowView& shown)
{
    if (shadowDrawn_ == shown)
        return;
    constexpr auto kDepth = vk::ImageAspectFlagBits::eDepth;
    const auto stages = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    const auto write = Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite;
    const bool draws = shadowMap_.extent.width > 1;
    shadowDrawn_.reset();
    if (draws)
        shadowDrawn_ = shown;
    transition(commands, *shadowMap_.image, kDepth, vk::ImageLayout::eUndefined,
               vk::ImageLayout::eDepthAttachmentOptimal, Stage::eFragmentShader, {}, stages, write);
    if (draws) {
        vk::RenderingAttachmentInfo depth(*shadowMap_.view, vk::ImageLayout::eDepthAttachmentOptimal);
        depth.loadOp = vk::AttachmentLoadOp::eClear;
        depth.storeOp = vk::AttachmentStoreOp::eStore;
        depth.clearValue.depthStencil = vk::ClearDepthStencilValue(1.0f, 0);
        const vk::Rect2D area({0, 0}, shadowMap_.extent);
        vk::RenderingInfo rendering({}, area, 1);
        rendering.pDepthAttachment = &depth;
        commands.beginRendering(rendering);
        commands.setViewport(0, vk::Viewport(0, 0, kShadowSize, kShadowSize, 0.0f, 1.0f));
        commands.setScissor(0, area);
        PipelineKey key;
        key.pass = Pass::shadow;
        drawItems(commands, scene, lists.opaque, key);
        key.pass = Pass::shadowMask;
        drawItems(commands, scene, lists.mask, key);
        drawItems(commands, scene, lists.veils, key);
        commands.endRendering();
    }
    transition(commands, *shadowMap_.image, kDepth, vk::ImageLayout::eDepthAttachmentOptimal,
               vk::ImageLayout::eShaderReadOnlyOptimal, stages, write, Stage::eFragmentShader,
               Access::eShaderSampledRead);
}

} // namespace cotan
