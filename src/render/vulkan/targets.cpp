#include "draw_passes.hpp"

#include <algorithm>
#include <cstring>

#include "scene/sample_positions.hpp"

namespace cotan {

namespace {

constexpr auto kColorAspect = vk::ImageAspectFlagBits::eColor;
constexpr auto kAttachment = vk::ImageLayout::eColorAttachmentOptimal;
constexpr ImageUse kDrawnInto{kAttachment, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite};
constexpr auto kDepthRead = vk::ImageLayout::eDepthStencilReadOnlyOptimal;

vk::DeviceSize bytesPerPixel(vk::Format format)
{
    return format == vk::Format::eR32G32B32A32Sfloat ? 16 : format == vk::Format::eR16G16B16A16Sfloat ? 8 : 4;
}

} // namespace

vk::DeviceSize Targets::bytes(const Kind& kind)
{
    const vk::DeviceSize color = bytesPerPixel(kind.format), output = bytesPerPixel(kind.output);
    const auto samples = static_cast<vk::DeviceSize>(kind.samples);
    return vk::DeviceSize(kind.width) * kind.height * ((color + 4) * samples + 2 * output);
}

Targets::Targets(const Device& device, const Kind& kind) : memory_(device), kind_(kind)
{
    using ImageUsage = vk::ImageUsageFlagBits;
    const vk::Extent2D extent(kind.width, kind.height);
    color_ = makeTexture(
        memory_,
        {.format = kind.format,
         .extent = extent,
         .samples = kind.samples,
         .usage = ImageUsage::eColorAttachment | (resolves() ? ImageUsage::eSampled : ImageUsage::eTransferSrc)});
    vk::ImageUsageFlags depthUsage = ImageUsage::eDepthStencilAttachment;
    if (multisampled()) // then they hide samples of translucent layers
        depthUsage |= ImageUsage::eSampled;
    depth_ = makeTexture(memory_,
                         {.format = vk::Format::eD32Sfloat,
                          .extent = extent,
                          .samples = kind.samples,
                          .usage = depthUsage,
                          .aspect = vk::ImageAspectFlagBits::eDepth});
    readBack_ = makeHostBuffer(memory_, vk::DeviceSize(kind.width) * kind.height * bytesPerPixel(kind.output),
                               vk::BufferUsageFlagBits::eTransferDst, /*readBack*/ true);
}

// The viewport is the whole image, even if only a part of it is drawn.
void Targets::setArea(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area) const
{
    commands.setViewport(0, vk::Viewport(0, 0, float(kind_.width), float(kind_.height), 0.0f, 1.0f));
    commands.setScissor(0, area);
}

void Targets::beginColor(const vk::raii::CommandBuffer& commands, const Texture2D& target, vk::AttachmentLoadOp load,
                         const vk::Rect2D& area) const
{
    const vk::RenderingAttachmentInfo color(*target.view, kAttachment, {}, {}, {}, load);
    commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, color));
    setArea(commands, area);
}

// Chooses an image that nobody shows.
void Targets::chooseResolved()
{
    resolved_.reset();
    const auto unused = std::ranges::find_if(all_, [](const auto& image) { return image.use_count() == 1; });
    if (unused == all_.end()) {
        const auto usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc;
        all_.push_back(std::make_shared<DeviceImage>(
            memory_.device(),
            TextureInfo{.format = kind_.output, .extent = {kind_.width, kind_.height}, .usage = usage}));
        resolved_ = all_.back();
    } else {
        resolved_ = *unused;
    }
}

void Targets::beginSurround(const vk::raii::CommandBuffer& commands)
{
    chooseResolved();
    transition(commands, *resolved_->texture.image, kColorAspect,
               {vk::ImageLayout::eUndefined, Stage::eTransfer | Stage::eColorAttachmentOutput, {}}, kDrawnInto);
    beginColor(commands, resolved_->texture, vk::AttachmentLoadOp::eClear, {{0, 0}, {kind_.width, kind_.height}});
}

vk::RenderingAttachmentInfo Targets::clearedDepth(const vk::raii::CommandBuffer& commands, bool kept) const
{
    transition(
        commands, *depth_.image, vk::ImageAspectFlagBits::eDepth,
        {vk::ImageLayout::eUndefined, kDepthStages | Stage::eFragmentShader, Access::eDepthStencilAttachmentWrite},
        kDepthDrawn);
    return {*depth_.view,
            vk::ImageLayout::eDepthAttachmentOptimal,
            {},
            {},
            {},
            vk::AttachmentLoadOp::eClear,
            kept ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eDontCare,
            vk::ClearDepthStencilValue(0.0f, 0)};
}

void Targets::beginDepth(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area)
{
    const vk::RenderingAttachmentInfo depth = clearedDepth(commands, false);
    commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, 0, nullptr, &depth));
    setArea(commands, area);
}

void Targets::begin(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area, bool layersFollow)
{
    transition(
        commands, *color_.image, kColorAspect,
        {vk::ImageLayout::eUndefined, Stage::eTransfer | Stage::eFragmentShader | Stage::eColorAttachmentOutput, {}},
        kDrawnInto);
    const vk::RenderingAttachmentInfo color(*color_.view, kAttachment, {}, {}, {}, vk::AttachmentLoadOp::eClear);
    const vk::RenderingAttachmentInfo depth = clearedDepth(commands, layersFollow);
    commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, color, &depth));
    setArea(commands, area);
}

void Targets::endOpaque(const vk::raii::CommandBuffer& commands)
{
    commands.endRendering();
    transition(commands, *depth_.image, vk::ImageAspectFlagBits::eDepth,
               {vk::ImageLayout::eDepthAttachmentOptimal, kDepthStages, Access::eDepthStencilAttachmentWrite},
               {kDepthRead, kDepthStages | Stage::eFragmentShader,
                Access::eDepthStencilAttachmentRead | Access::eShaderSampledRead});
}

void Targets::beginLayers(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area)
{
    const vk::RenderingAttachmentInfo depth(*depth_.view, kDepthRead, {}, {}, {}, vk::AttachmentLoadOp::eLoad,
                                            vk::AttachmentStoreOp::eNone);
    commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, 0, nullptr, &depth));
    setArea(commands, area);
}

void Targets::beginCompose(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area)
{
    const auto both = Access::eColorAttachmentRead | Access::eColorAttachmentWrite;
    transition(commands, *color_.image, kColorAspect, kDrawnInto, {kAttachment, Stage::eColorAttachmentOutput, both});
    beginColor(commands, color_, vk::AttachmentLoadOp::eLoad, area);
}

void Targets::beginResolve(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area)
{
    transition(commands, *color_.image, kColorAspect, kDrawnInto, kSampled);
    transition(commands, *resolved_->texture.image, kColorAspect, kDrawnInto, kDrawnInto);
    beginColor(commands, resolved_->texture, vk::AttachmentLoadOp::eLoad, area);
}

void Targets::finish(const vk::raii::CommandBuffer& commands, bool hostReads)
{
    const Texture2D& source = resolved_ ? resolved_->texture : color_;
    transition(commands, *source.image, kColorAspect, kDrawnInto, kCopied);
    if (hostReads)
        copyToHost(commands, memory_.device(), *source.image, source.extent, readBack_);
}

Image Targets::image(bool flipRows) const
{
    const bool floats = kind_.output == vk::Format::eR32G32B32A32Sfloat;
    Image image =
        makeImage(int(kind_.width), int(kind_.height), floats ? PixelType::float32 : PixelType::unorm8, "render");
    const std::size_t row = kind_.width * image.bytesPerPixel();
    for (std::size_t y = 0; y < kind_.height; ++y) {
        const std::size_t from = flipRows ? kind_.height - 1 - y : y;
        std::memcpy(image.data.data() + y * row, readBack_.mapped + from * row, row);
    }
    return image;
}

Targets::Kind targetKind(const Device& device, const View& view)
{
    Targets::Kind kind;
    kind.width = static_cast<std::uint32_t>(view.width);
    kind.height = static_cast<std::uint32_t>(view.height);
    const bool shaded = view.output == Output::shaded;
    const bool levels = shaded && !view.linearOutput && view.samples <= kMaxSharedSamples;
    kind.format = levels ? vk::Format::eR16G16B16A16Sfloat : vk::Format::eR32G32B32A32Sfloat;
    kind.output = levels ? vk::Format::eR8G8B8A8Unorm : kind.format;
    if (shaded && view.samples > 1 && view.samples <= kMaxSharedSamples) {
        const vk::SampleCountFlags can =
            device.physical
                .getImageFormatProperties(kind.format, vk::ImageType::e2D, vk::ImageTiling::eOptimal,
                                          vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled)
                .sampleCounts
            & device.limits.framebufferDepthSampleCounts;
        if (can & vk::SampleCountFlagBits::e4)
            kind.samples = vk::SampleCountFlagBits::e4;
    }
    return kind;
}

} // namespace cotan
