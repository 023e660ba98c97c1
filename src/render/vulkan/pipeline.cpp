#include "pipeline.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <span>

#include "core/loops.hpp"
#include "cotan_shaders.h"
#include "gpu_structs.hpp"
#include "scene/sample_positions.hpp"
#include "scene_upload.hpp"

namespace cotan {

namespace {

vk::raii::DescriptorSetLayout makeSetLayout(const Device& device, std::span<const vk::DescriptorType> types)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const vk::DescriptorType type : types)
        bindings.emplace_back(static_cast<std::uint32_t>(bindings.size()), type, 1, kBothStages);
    return vk::raii::DescriptorSetLayout(device.device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
}

// The values of shaders/constants.glsl, ordered by constant_id.
struct Specialization {
    std::array<std::uint32_t, 18> values;
    std::array<vk::SpecializationMapEntry, 18> entries;
    vk::SpecializationInfo info;

    explicit Specialization(const PipelineKey& key)
        : values{key.framesOfMeshes ? COTAN_FRAME_OF_MESH : std::uint32_t(key.frame),
                 std::uint32_t(key.output),
                 std::uint32_t(key.shading),
                 std::uint32_t(key.alphaMode),
                 key.normalMaps,
                 key.environment,
                 key.shadows,
                 key.toneMap,
                 key.maps,
                 std::uint32_t(key.tone),
                 key.environmentMap,
                 key.softShadows,
                 std::uint32_t(key.backdrop),
                 key.ground,
                 key.samples != vk::SampleCountFlagBits::e1,
                 key.specularAntialiasing,
                 key.levels,
                 std::bit_cast<std::uint32_t>(key.separateSamples ? kSampleSpacing : 1.0f)}
    {
        for (std::uint32_t i = 0; i < entries.size(); ++i)
            entries[i] = vk::SpecializationMapEntry(i, i * 4, 4);
        info = vk::SpecializationInfo(std::uint32_t(entries.size()), entries.data(), sizeof values, values.data());
    }
    Specialization(const Specialization&) = delete; // info refers to the other members
};

using Spirv = std::span<const std::uint32_t>; // words of a compiled shader

struct StageShaders {
    Spirv vertex;
    Spirv fragment; // empty: none
};

// The fragment shader of surfaces: for opaque materials, masked ones and translucent layers; for each of these without
// and with material extensions; for each of these without and with the frame `exact` (which needs the features
// geometryShader, for gl_PrimitiveID, and bufferDeviceAddress). exact: fragments can read gl_PrimitiveID.
Spirv forwardShader(const PipelineKey& key, bool exact)
{
    static constexpr Spirv kShaders[3][2][2] = {
        {{cotanForwardFrag, cotanForwardExactFrag}, {cotanForwardExtendedFrag, cotanForwardExactExtendedFrag}},
        {{cotanForwardMaskedFrag, cotanForwardExactMaskedFrag},
         {cotanForwardExtendedMaskedFrag, cotanForwardExactExtendedMaskedFrag}},
        {{cotanForwardLayersFrag, cotanForwardExactLayersFrag},
         {cotanForwardExtendedLayersFrag, cotanForwardExactExtendedLayersFrag}},
    };
    const int kind = key.pass == Pass::layers ? 2 : key.alphaMode == AlphaMode::mask ? 1 : 0;
    return kShaders[kind][key.extended ? 1 : 0][exact ? 1 : 0];
}

// exact: the device provides gl_PrimitiveID to fragments.
StageShaders shadersOf(const PipelineKey& key, bool exact)
{
    switch (key.pass) {
    case Pass::shadow: return {cotanShadowVert, {}};
    case Pass::shadowMask: return {cotanShadowVert, cotanShadowFrag};
    case Pass::depth: return {cotanPositionVert, {}};
    case Pass::marks: return {cotanPositionVert, cotanMarksFrag};
    case Pass::surround:
    case Pass::background: return {cotanBackgroundVert, cotanBackgroundFrag};
    case Pass::layers: return {cotanForwardVert, forwardShader(key, exact)};
    case Pass::compose:
        return {cotanComposeVert,
                key.samples == vk::SampleCountFlagBits::e1 ? Spirv(cotanComposeFrag)
                                                           : Spirv(cotanComposeMultisampledFrag)};
    case Pass::resolve:
        return {cotanComposeVert,
                key.multisampledSource ? Spirv(cotanResolveMultisampledFrag) : Spirv(cotanResolveFrag)};
    case Pass::forward: break;
    }
    return {cotanForwardVert,
            forwardShader(key, !key.framesOfMeshes && info(key.frame).source == FrameSource::triangle)};
}

bool hasDepth(Pass pass) { return pass != Pass::compose && pass != Pass::surround && pass != Pass::resolve; }

// Whether the pass draws a single triangle, made by the vertex stage, that covers the image.
bool coversImage(Pass pass) { return pass == Pass::background || !hasDepth(pass); }

// One binding per attribute. The strides are set while drawing; stride 0 makes the attribute constant.
struct VertexInput {
    std::array<vk::VertexInputBindingDescription, kStreamCount> bindings;
    std::array<vk::VertexInputAttributeDescription, kStreamCount> attributes;
    vk::PipelineVertexInputStateCreateInfo info;

    explicit VertexInput(Pass pass)
    {
        using F = vk::Format;
        constexpr std::array<F, kStreamCount> formats{
            F::eR32G32B32Sfloat, F::eR32G32B32Sfloat,    F::eR32G32Sfloat,
            F::eR32G32Sfloat,    F::eR32G32B32A32Sfloat, F::eR32G32B32A32Sfloat,
            F::eR32G32B32Sfloat, F::eR32G32B32Sfloat,    F::eR32G32B32A32Sfloat};
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < kStreamCount; ++i) {
            const bool forShadow =
                i == kPosition || i == kTexcoord0 || i == kTexcoord1 || i == kColor || i == kTexcoordOrigin;
            if (coversImage(pass) || (isShadow(pass) && !forShadow) || (isPrepass(pass) && i != kPosition))
                continue;
            bindings[count] = vk::VertexInputBindingDescription(i, 0);
            attributes[count++] = vk::VertexInputAttributeDescription(i, i, formats[i], 0);
        }
        info = vk::PipelineVertexInputStateCreateInfo({}, count, bindings.data(), count, attributes.data());
    }
    VertexInput(const VertexInput&) = delete;
};

// Blending of premultiplied colours. The destination has a factor per channel or, if the device does not support it,
// their mean.
vk::PipelineColorBlendAttachmentState blending(bool blend, bool dualSource)
{
    using C = vk::ColorComponentFlagBits;
    vk::PipelineColorBlendAttachmentState state;
    state.colorWriteMask = C::eR | C::eG | C::eB | C::eA;
    state.blendEnable = blend;
    state.srcColorBlendFactor = vk::BlendFactor::eOne;
    state.dstColorBlendFactor = dualSource ? vk::BlendFactor::eSrc1Color : vk::BlendFactor::eOneMinusSrcAlpha;
    state.srcAlphaBlendFactor = vk::BlendFactor::eOne;
    state.dstAlphaBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha;
    return state;
}

// Depth is reversed for the camera; the shadow map is not.
vk::PipelineDepthStencilStateCreateInfo depthState(Pass pass)
{
    const bool camera = pass == Pass::forward || pass == Pass::layers || pass == Pass::depth;
    vk::PipelineDepthStencilStateCreateInfo state;
    state.depthTestEnable = hasDepth(pass);
    const bool behind = pass == Pass::background || pass == Pass::marks; // also where the depth is the same
    state.depthWriteEnable = hasDepth(pass) && !behind && pass != Pass::layers;
    state.depthCompareOp = camera ? vk::CompareOp::eGreater
        : behind                  ? vk::CompareOp::eGreaterOrEqual
                                  : vk::CompareOp::eLess;
    return state;
}

} // namespace

Layouts::Layouts(const Device& device)
{
    using T = vk::DescriptorType;
    constexpr T kImage = T::eCombinedImageSampler;
    constexpr std::array viewSetTypes{
        T::eUniformBuffer, T::eStorageBuffer, kImage, T::eStorageBuffer, T::eStorageBuffer, kImage, kImage, kImage};
    static_assert(std::count(viewSetTypes.begin(), viewSetTypes.end(), kImage) == kImagesInViewSet);
    viewSet = makeSetLayout(device, viewSetTypes);
    std::vector<T> materialTypes(1 + COTAN_MAP_COUNT, kImage);
    materialTypes[0] = T::eUniformBuffer;
    extendedMaterial = makeSetLayout(device, materialTypes);
    materialTypes.resize(1 + COTAN_MAP_COUNT_PLAIN);
    material = makeSetLayout(device, materialTypes);
    const vk::PushConstantRange constants(kBothStages, 0, sizeof(gpu::CotanDraw));
    const auto pipelineWith = [&](const vk::raii::DescriptorSetLayout& layout) {
        const std::array sets{*viewSet, *layout};
        return vk::raii::PipelineLayout(device.device, vk::PipelineLayoutCreateInfo({}, sets, constants));
    };
    pipeline = pipelineWith(material);
    extendedPipeline = pipelineWith(extendedMaterial);
}

vk::DescriptorSet allocateSet(const Device& device, const vk::raii::DescriptorPool& pool,
                              const vk::raii::DescriptorSetLayout& layout)
{
    // vk::raii sets free themselves and would have to be destroyed before the pool; these are freed with the pool.
    const vk::DescriptorSetAllocateInfo info(*pool, *layout);
    return (*device.device).allocateDescriptorSets(info, *device.device.getDispatcher())[0];
}

vk::raii::Pipeline Pipelines::make(const PipelineKey& key) const
{
    const bool shadow = isShadow(key.pass);
    const std::uint32_t colors = shadow || isPrepass(key.pass) || key.pass == Pass::layers ? 0 : 1;
    const Specialization specialization(key);
    std::vector<vk::PipelineShaderStageCreateInfo> stages;
    std::vector<vk::raii::ShaderModule> modules; // must live until the pipeline is made
    const auto add = [&](vk::ShaderStageFlagBits stage, Spirv code, const vk::SpecializationInfo* constants) {
        const vk::ShaderModuleCreateInfo info({}, code.size_bytes(), code.data());
        const vk::ShaderModule module = *modules.emplace_back(device_->device, info);
        stages.emplace_back(vk::PipelineShaderStageCreateFlags(), stage, module, "main", constants);
    };
    const StageShaders shaders = shadersOf(key, device_->exact);
    add(vk::ShaderStageFlagBits::eVertex, shaders.vertex, nullptr);
    if (!shaders.fragment.empty())
        add(vk::ShaderStageFlagBits::eFragment, shaders.fragment, &specialization.info);

    const VertexInput vertexInput(key.pass);
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.lineWidth = 1;
    raster.depthBiasEnable = shadow;
    raster.depthBiasSlopeFactor = 1.5f;
    const vk::PipelineMultisampleStateCreateInfo multisample({}, key.samples);
    const vk::PipelineDepthStencilStateCreateInfo depth = depthState(key.pass);
    const vk::PipelineColorBlendAttachmentState attachment = blending(key.pass == Pass::compose, device_->dualSource);
    const vk::PipelineColorBlendStateCreateInfo color({}, VK_FALSE, {}, colors, &attachment);
    std::vector<vk::DynamicState> dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                          vk::DynamicState::eCullMode, vk::DynamicState::eFrontFace};
    if (!coversImage(key.pass))
        dynamic.push_back(vk::DynamicState::eVertexInputBindingStride);
    const vk::PipelineDynamicStateCreateInfo dynamicState({}, dynamic);
    const vk::PipelineRenderingCreateInfo rendering(
        0, colors, &key.format, hasDepth(key.pass) ? vk::Format::eD32Sfloat : vk::Format::eUndefined);
    vk::GraphicsPipelineCreateInfo info({}, stages, &vertexInput.info, &assembly, nullptr, &viewport, &raster,
                                        &multisample, &depth, &color, &dynamicState,
                                        layouts_->pipelineOf(key.extended));
    info.pNext = &rendering;
    return vk::raii::Pipeline(device_->device, nullptr, info);
}

void Pipelines::begin(const std::vector<PipelineKey>& keys)
{
    const auto tasks = std::make_shared<std::vector<std::packaged_task<vk::raii::Pipeline()>>>();
    for (const PipelineKey& key : keys) {
        if (made_.contains(key))
            continue;
        tasks->emplace_back([this, key] { return make(key); });
        made_[key] = tasks->back().get_future();
    }
    if (!tasks->empty())
        workers_.push_back(std::async(std::launch::async, [tasks, threads = threadsFor(tasks->size(), 1)] {
            runTasks(tasks->size(), threads, [&](std::size_t i) { (*tasks)[i](); });
        }));
}

vk::Pipeline Pipelines::get(const PipelineKey& key)
{
    const auto [entry, isNew] = made_.try_emplace(key);
    try {
        if (isNew)
            entry->second = std::async(std::launch::deferred, [this, key] { return make(key); });
        return *entry->second.get();
    } catch (...) {
        made_.erase(entry);
        throw;
    }
}

} // namespace cotan
