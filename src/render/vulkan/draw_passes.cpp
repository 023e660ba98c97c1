#include "draw_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "cotan/vector.hpp"
#include "scene/sample_positions.hpp"

namespace cotan {

namespace {

glm::uvec2 split(vk::DeviceAddress address)
{
    return {static_cast<glm::uint>(address), static_cast<glm::uint>(address >> 32)};
}

// Sets addresses and flags of CotanDraw. base: address of the mesh's buffer; 0 if shaders do not read it.
void addMesh(gpu::CotanDraw& constants, vk::DeviceAddress base, const GpuMesh& mesh)
{
    if (base != 0) {
        constants.positions = split(base + mesh.offsets[kPosition]);
        constants.indices = split(base + mesh.indices);
    }
    // Streams follow the positions in the same buffer; the offset of an absent one is not read.
    const auto floatOffset = [&](Stream stream) {
        return mesh.has(stream) ? static_cast<glm::uint>((mesh.offsets[stream] - mesh.offsets[kPosition]) / 4) : 0u;
    };
    constants.texcoords = {floatOffset(kTexcoord0), floatOffset(kTexcoord1)};
    constants.flags = (mesh.has(kTexcoord0) ? COTAN_DRAW_HAS_TEXCOORDS0 : 0u)
        | (mesh.has(kTexcoord1) ? COTAN_DRAW_HAS_TEXCOORDS1 : 0u) | (mesh.has(kTangent) ? COTAN_DRAW_HAS_TANGENTS : 0u)
        | (mesh.has(kCotangentU) && mesh.has(kCotangentV) ? COTAN_DRAW_HAS_COTANGENTS : 0u);
}

// The frame of a mesh as shaders select it. From the edges of a triangle, differences give the same frame.
std::uint32_t frameBits(const GpuMesh& mesh, Frame ofView)
{
    const Frame frame = mesh.readWith.value_or(ofView);
    const bool ofTriangle = info(frame).source == FrameSource::triangle;
    return std::uint32_t(ofTriangle ? Frame::cotangent : frame) << COTAN_DRAW_FRAME_BIT;
}

// The maps that a pipeline reads, if the material has them.
std::uint32_t mapsNeeded(const PipelineKey& key)
{
    if (key.output == Output::shaded)
        return ~0u;
    const std::uint32_t alpha = key.alphaMode == AlphaMode::opaque ? 0u : COTAN_MAP_BASE_COLOR;
    return alpha | COTAN_MAP_HEIGHT | (key.output == Output::normal ? COTAN_MAP_NORMAL : 0u);
}

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

PassKeys keysOf(const View& view, const Targets& targets)
{
    const Targets::Kind& kind = targets.kind();
    const bool levels = kind.output == vk::Format::eR8G8B8A8Unorm;
    PassKeys keys;
    PipelineKey& forward = keys.forward;
    forward = {.frame = view.framesOfMeshes ? Frame{} : view.frame,
               .framesOfMeshes = view.framesOfMeshes,
               .output = view.output,
               .normalMaps = view.normalMaps,
               .samples = kind.samples,
               .format = kind.format};
    if (view.output == Output::shaded) {
        forward.shading = view.shading;
        forward.environment = view.environment;
        forward.environmentMap = view.environment && view.environmentMap;
        forward.shadows = castsShadow(view);
        forward.specularAntialiasing = view.specularAntialiasing;
        forward.separateSamples = view.samples > kMaxSharedSamples;
        forward.softShadows = forward.shadows && view.shadowSoftness > 0;
        forward.toneMap = !view.linearOutput;
        forward.tone = view.linearOutput ? forward.tone : view.toneMapping;
    }
    keys.depth = {.pass = Pass::depth, .samples = kind.samples};
    keys.marks = {.pass = Pass::marks, .samples = kind.samples};
    keys.layers = forward;
    keys.layers.pass = Pass::layers;
    keys.layers.format = vk::Format::eUndefined;
    keys.compose = {.pass = Pass::compose, .samples = kind.samples, .format = kind.format};
    keys.background = {.pass = Pass::background,
                       .toneMap = forward.toneMap,
                       .tone = forward.tone,
                       .backdrop = backdropOf(view),
                       .ground = view.ground != nullptr,
                       .samples = kind.samples,
                       .format = kind.format};
    keys.surround = keys.background;
    keys.surround.pass = Pass::surround;
    keys.surround.levels = levels;
    keys.surround.samples = vk::SampleCountFlagBits::e1;
    keys.surround.format = kind.output;
    keys.resolve = {
        .pass = Pass::resolve, .levels = levels, .multisampledSource = targets.multisampled(), .format = kind.output};
    return keys;
}

CommandRecorder::CommandRecorder(const Device& device, const Layouts& layouts)
    : device_(&device), layouts_(&layouts), pipelines_(device, layouts), commands_(device), memory_(device)
{
    viewBuffer_ = makeHostBuffer(memory_, sizeof(gpu::CotanView), vk::BufferUsageFlagBits::eUniformBuffer);
    depthSampler_ = vk::raii::Sampler(device.device, vk::SamplerCreateInfo());
    vk::SamplerCreateInfo sampler;
    sampler.magFilter = sampler.minFilter = vk::Filter::eLinear;
    sampler.addressModeU = sampler.addressModeV = vk::SamplerAddressMode::eClampToEdge;
    linearSampler_ = vk::raii::Sampler(device.device, sampler);
    sampler.compareEnable = VK_TRUE; // filters the results of comparisons
    sampler.compareOp = vk::CompareOp::eLessOrEqual;
    shadowSampler_ = vk::raii::Sampler(device.device, sampler);
    constexpr std::uint32_t kSets = 3;
    const std::array sizes{vk::DescriptorPoolSize(vk::DescriptorType::eUniformBuffer, kSets),
                           vk::DescriptorPoolSize(vk::DescriptorType::eStorageBuffer, kSets * 3),
                           vk::DescriptorPoolSize(vk::DescriptorType::eCombinedImageSampler, kSets * 4)};
    pool_ = vk::raii::DescriptorPool(device.device, vk::DescriptorPoolCreateInfo({}, kSets, sizes));
    viewSet_ = allocateSet(device, pool_, layouts.viewSet);
    composeSet_ = allocateSet(device, pool_, layouts.viewSet);
    markSet_ = allocateSet(device, pool_, layouts.viewSet);
}

CommandRecorder::DrawLists CommandRecorder::makeLists(const GpuScene& scene, const View& view, const CameraAxes& axes,
                                                      const gpu::CotanView& constants)
{
    DrawLists lists;
    for (const GpuInstance& instance : scene.instances) {
        if (!isFinite(instance.toWorld))
            continue;
        Item item;
        item.mesh = &scene.meshes[instance.mesh];
        item.material = &scene.materials[std::size_t(item.mesh->material)];
        item.constants = drawConstants(instance.toWorld, axes.eye);
        const Buffer& buffer = scene.buffers[item.mesh->buffer];
        item.buffer = &buffer;
        addMesh(item.constants, buffer.address, *item.mesh);
        item.constants.flags |= frameBits(*item.mesh, view.frame);
        // A mirroring matrix reverses the winding, and so does a raster whose rows run upward.
        item.clockwise = (item.constants.normalX.w < 0) != view.rowsUpward;
        const Bounds& box = item.mesh->box;
        const glm::dvec4 centre(box.empty() ? glm::vec3(0) : box.centre(), 1);
        const double distance = glm::length(glm::dvec3(glm::dmat4(instance.toWorld) * centre) - axes.eye);
        item.distance = std::isfinite(distance) ? distance : 0;
        const PixelArea area = areaOf(constants, item.constants, box, view.width, view.height);
        lists.area = around(lists.area, area);
        if (item.material->translucent) {
            lists.translucentArea = around(lists.translucentArea, area);
            item.constants.order = static_cast<std::uint32_t>(lists.translucent.size());
            lists.translucent.push_back(item);
            if (item.material->castsShadow)
                lists.translucentCasters.push_back(item);
        } else {
            (item.material->alphaMode == AlphaMode::mask ? lists.mask : lists.opaque).push_back(item);
        }
    }
    const auto nearer = [](const Item& a, const Item& b) { return a.distance < b.distance; };
    std::stable_sort(lists.opaque.begin(), lists.opaque.end(), nearer);
    std::stable_sort(lists.mask.begin(), lists.mask.end(), nearer);
    return lists;
}

void CommandRecorder::prepare(const View& view, const CameraAxes& axes, const gpu::CotanView& constants, bool layered)
{
    std::memcpy(viewBuffer_.mapped, &constants, sizeof constants);
    const std::vector<gpu::CotanLight> lights = lightConstants(view, axes);
    const vk::DeviceSize size = lights.size() * sizeof(gpu::CotanLight);
    if (lightBuffer_.size < size) {
        lightBuffer_ = {};
        lightMemory_ = std::make_unique<Memory>(*device_);
        lightBuffer_ = makeHostBuffer(*lightMemory_, size, vk::BufferUsageFlagBits::eStorageBuffer);
    }
    std::memcpy(lightBuffer_.mapped, lights.data(), size);
    prepareShadowMap(view.output == Output::shaded && castsShadow(view));
    if (view.environmentMap)
        environment_.hold(*device_, view.environmentMap, view.environmentMap->atlas);
    if (view.ground)
        ground_.hold(*device_, view.ground, view.ground->visibility);
    const std::uint32_t width = targets_->kind().width;
    if (layered && !(layers_ && layers_->width == width)) {
        layers_.reset(); // frees its memory first
        layers_ = std::make_unique<LayerLists>(*device_, width);
    }
    writeViewSet(layered);
}

// Sets every descriptor, even for images without layers, which no shader reads: Mesa's CPU driver (22.3) reads them.
void CommandRecorder::writeViewSet(bool layered)
{
    constexpr auto kReadOnly = vk::ImageLayout::eShaderReadOnlyOptimal;
    const auto whole = [](const Buffer& buffer) { return vk::DescriptorBufferInfo(*buffer.buffer, 0, VK_WHOLE_SIZE); };
    const vk::DescriptorBufferInfo view = whole(viewBuffer_), lights = whole(lightBuffer_);
    const vk::DescriptorBufferInfo lists = layered ? whole(layers_->lists) : lights;
    const vk::DescriptorBufferInfo layers = layered ? whole(layers_->layers) : lights;
    const vk::DescriptorImageInfo shadow(*shadowSampler_, *shadowMap_.view, kReadOnly);
    const vk::DescriptorImageInfo shadowDepth(*depthSampler_, *shadowMap_.view, kReadOnly);
    const vk::DescriptorImageInfo depth(*depthSampler_, targets_->depthView(),
                                        vk::ImageLayout::eDepthStencilReadOnlyOptimal);
    const vk::DescriptorImageInfo samples(*depthSampler_, targets_->colorView(), kReadOnly);
    const auto imageInfo = [&](const HeldTexture& held) {
        return held.owner ? vk::DescriptorImageInfo(*linearSampler_, *held.image->texture.view, kReadOnly) : shadow;
    };
    const vk::DescriptorImageInfo environment = imageInfo(environment_), ground = imageInfo(ground_);
    const auto write = [&](vk::DescriptorSet set, const vk::DescriptorBufferInfo& listsOrMarks,
                           const vk::DescriptorImageInfo& depths, const vk::DescriptorImageInfo& environmentOrSamples) {
        using W = vk::WriteDescriptorSet;
        using T = vk::DescriptorType;
        device_->device.updateDescriptorSets(
            {W(set, 0, 0, T::eUniformBuffer, {}, view), W(set, 1, 0, T::eStorageBuffer, {}, lights),
             W(set, 2, 0, T::eCombinedImageSampler, depths), W(set, 3, 0, T::eStorageBuffer, {}, listsOrMarks),
             W(set, 4, 0, T::eStorageBuffer, {}, layers), W(set, 5, 0, T::eCombinedImageSampler, environmentOrSamples),
             W(set, 6, 0, T::eCombinedImageSampler, shadowDepth), W(set, 7, 0, T::eCombinedImageSampler, ground)},
            {});
    };
    write(viewSet_, lists, shadow, environment);
    write(composeSet_, lists, layered && targets_->multisampled() ? depth : shadow,
          targets_->resolves() ? samples : environment);
    write(markSet_, lights, shadow, environment); // dropHidden puts the marks there
}

// The pipeline that draws the item in the pass of the key.
PipelineKey CommandRecorder::keyOf(PipelineKey key, const Item& item)
{
    if (isPrepass(key.pass) || key.pass == Pass::shadow) // read positions alone
        return key;
    key.extended = item.material->extended();
    key.alphaMode = item.material->alphaMode;
    if (!isShadow(key.pass))
        key.maps = item.material->maps & mapsNeeded(key);
    return key;
}

// Starts building all pipelines of the image, so that they are compiled in parallel.
void CommandRecorder::beginPipelines(const DrawLists& lists, const View& view, bool layered)
{
    std::vector<PipelineKey> keys;
    const auto add = [&](const std::vector<Item>& items, PipelineKey key) {
        for (const Item& item : items) {
            key = keyOf(key, item);
            if (keys.empty() || keys.back() != key)
                keys.push_back(key);
        }
    };
    const bool shaded = view.output == Output::shaded;
    if (dropsHidden(view)) {
        add(lists.opaque, keys_.depth);
        add(lists.opaque, keys_.marks);
    }
    add(lists.opaque, keys_.forward);
    add(lists.mask, keys_.forward);
    add(lists.translucent, layered ? keys_.layers : keys_.forward);
    if (layered)
        keys.push_back(keys_.compose);
    if (shaded && (view.background || view.ground)) {
        keys.push_back(keys_.background);
        if (targets_->resolves())
            keys.push_back(keys_.surround);
    }
    if (targets_->resolves())
        keys.push_back(keys_.resolve);
    pipelines_.begin(keys);
}

void CommandRecorder::drawItems(const vk::raii::CommandBuffer& commands, const std::vector<Item>& items,
                                PipelineKey key)
{
    std::optional<PipelineKey> bound;
    for (const Item& item : items) {
        key = keyOf(key, item);
        if (bound != key)
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.get(key));
        bound = key;
        const bool both = isShadow(key.pass) || item.material->doubleSided;
        commands.setCullMode(both ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
        commands.setFrontFace(item.clockwise ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
        const GpuMesh& mesh = *item.mesh;
        const vk::PipelineLayout layout = layouts_->pipelineOf(item.material->extended());
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 1, item.material->set, {});
        std::array<vk::Buffer, kStreamCount> buffers;
        buffers.fill(*item.buffer->buffer);
        // Without sizes every range extends to the end of its buffer.
        commands.bindVertexBuffers2(0, buffers, mesh.offsets, {}, mesh.strides);
        const bool whole = key.pass != Pass::forward || !item.visible;
        commands.bindIndexBuffer(whole ? *item.buffer->buffer : item.visible, whole ? mesh.indices : item.visibleOffset,
                                 vk::IndexType::eUint32);
        commands.pushConstants<gpu::CotanDraw>(layout, kBothStages, 0, item.constants);
        commands.drawIndexed(whole ? mesh.indexCount : item.visibleCount, 1, 0, 0, 0);
    }
}

// Draws a triangle that covers the image.
void CommandRecorder::drawFullScreen(const vk::raii::CommandBuffer& commands, const PipelineKey& key)
{
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.get(key));
    commands.setCullMode(vk::CullModeFlagBits::eNone);
    commands.setFrontFace(vk::FrontFace::eCounterClockwise);
    commands.draw(3, 1, 0, 0);
}

// Makes a single texel if no shadow is needed, because the descriptor must be valid.
void CommandRecorder::prepareShadowMap(bool needed)
{
    const std::uint32_t side = needed ? kShadowSize : 1;
    if (shadowMap_.extent.width >= side)
        return;
    shadowMap_ = {};
    shadowDrawn_.reset();
    shadowMemory_ = std::make_unique<Memory>(*device_);
    shadowMap_ =
        makeTexture(*shadowMemory_,
                    {.format = vk::Format::eD32Sfloat,
                     .extent = {side, side},
                     .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled,
                     .aspect = vk::ImageAspectFlagBits::eDepth});
}

// Redraws the shadow map if it has changed since the previous image.
void CommandRecorder::recordShadow(const vk::raii::CommandBuffer& commands, const DrawLists& lists,
                                   const ShadowView& shadowView)
{
    if (shadowDrawn_ == shadowView)
        return;
    constexpr auto kDepth = vk::ImageAspectFlagBits::eDepth;
    const bool draws = shadowMap_.extent.width > 1;
    shadowDrawn_ = draws ? std::optional(shadowView) : std::nullopt;
    transition(commands, *shadowMap_.image, kDepth, {vk::ImageLayout::eUndefined, Stage::eFragmentShader, {}},
               kDepthDrawn);
    if (draws) {
        const vk::RenderingAttachmentInfo depth(*shadowMap_.view, vk::ImageLayout::eDepthAttachmentOptimal, {}, {}, {},
                                                vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                                vk::ClearDepthStencilValue(1.0f, 0));
        const vk::Rect2D area({0, 0}, shadowMap_.extent);
        commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, 0, nullptr, &depth));
        commands.setViewport(0, vk::Viewport(0, 0, kShadowSize, kShadowSize, 0.0f, 1.0f));
        commands.setScissor(0, area);
        drawItems(commands, lists.opaque, {.pass = Pass::shadow});
        drawItems(commands, lists.mask, {.pass = Pass::shadowMask});
        drawItems(commands, lists.translucentCasters, {.pass = Pass::shadowMask});
        commands.endRendering();
    }
    transition(commands, *shadowMap_.image, kDepth, kDepthDrawn, kSampled);
}

// Records everything that writes depth, and the background.
void CommandRecorder::recordMain(const vk::raii::CommandBuffer& commands, const DrawLists& lists, const View& view)
{
    const bool shaded = view.output == Output::shaded;
    drawItems(commands, lists.opaque, keys_.forward);
    drawItems(commands, lists.mask, keys_.forward);
    if (shaded && (view.background || view.ground))
        drawFullScreen(commands, keys_.background);
    if (!shaded)
        drawItems(commands, lists.translucent, keys_.forward);
}

const vk::raii::CommandBuffer& CommandRecorder::begin()
{
    const vk::raii::CommandBuffer& commands = commands_.begin();
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_->pipeline, 0, viewSet_, {});
    return commands;
}

} // namespace cotan
