// Where the scene can be in the picture, and what is behind and around it: also pictures of light on the device.

#include <glm/gtc/packing.hpp>

#include "draw_passes.hpp"

namespace cotan {

namespace {

// BACKDROP_... of background.frag.
int backdropOf(const View& view)
{
    if (!view.background)
        return 3;
    if (view.backdrop == Backdrop::paper)
        return 2;
    return view.environmentMap && view.backdrop != Backdrop::gradient ? 1 : 0;
}

} // namespace

void HeldPicture::hold(const Device& device, std::shared_ptr<const void> newOwner, const Image& picture)
{
    if (newOwner == owner)
        return;
    std::vector<glm::uint64> halves(picture.pixelCount());
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const float* p = picture.floats() + 4 * i;
        halves[i] = glm::packHalf4x16(glm::vec4(p[0], p[1], p[2], p[3]));
    }
    owner.reset();
    texture = {};
    memory = std::make_unique<Memory>(device);
    texture = makeTexture(device, *memory,
                          {.format = vk::Format::eR16G16B16A16Sfloat,
                           .extent = {std::uint32_t(picture.width), std::uint32_t(picture.height)},
                           .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
    const std::array levels{std::as_bytes(std::span(halves))};
    Uploader uploader(device, halves.size() * sizeof(glm::uint64));
    uploader.image(texture, levels, sizeof(glm::uint64));
    uploader.finish();
    owner = std::move(newOwner);
}

vk::Rect2D rectangle(const PixelArea& a)
{
    return {{a.x0, a.y0}, {static_cast<std::uint32_t>(a.x1 - a.x0), static_cast<std::uint32_t>(a.y1 - a.y0)}};
}

// What of the picture the lists may cover.
void CommandRecorder::setAreas(DrawLists& lists, const View& view, const gpu::CotanView& constants) const
{
    const auto areaOfItems = [&](const std::vector<Item>& items) {
        PixelArea all;
        for (const Item& item : items)
            all = around(all, areaOf(constants, item.constants, item.mesh->box, view.width, view.height));
        return all;
    };
    lists.translucentArea = areaOfItems(lists.translucent);
    lists.area = around(around(areaOfItems(lists.opaque), areaOfItems(lists.mask)), lists.translucentArea);
}

PipelineKey CommandRecorder::backgroundKey(const View& view) const
{
    const PipelineKey picture = forwardKey(view, *targets_);
    return {.pass = Pass::background,
            .toneMap = picture.toneMap,
            .tone = picture.tone,
            .backdrop = backdropOf(view),
            .ground = view.ground != nullptr,
            .samples = picture.samples,
            .format = picture.format};
}

PipelineKey CommandRecorder::surroundKey(const View& view) const
{
    PipelineKey key = backgroundKey(view);
    key.pass = Pass::surround;
    key.samples = vk::SampleCountFlagBits::e1;
    key.levels = targets_->kind().shown == vk::Format::eR8G8B8A8Unorm;
    key.format = targets_->kind().shown;
    return key;
}

// The background around an area, straight into the resolved picture: there all samples of a pixel are the same.
void CommandRecorder::recordSurround(const vk::raii::CommandBuffer& commands, const View& view, const PixelArea& inside)
{
    targets_->beginSurround(commands);
    if (view.background || view.ground) {
        const PipelineKey key = surroundKey(view);
        const PixelArea& a = inside;
        for (const PixelArea& part :
             {PixelArea{0, 0, view.width, a.y0}, PixelArea{0, a.y0, a.x0, a.y1},
              PixelArea{a.x1, a.y0, view.width, a.y1}, PixelArea{0, a.y1, view.width, view.height}})
            if (!part.empty()) {
                commands.setScissor(0, rectangle(part));
                drawOver(commands, key);
            }
    }
    commands.endRendering();
}

} // namespace cotan
