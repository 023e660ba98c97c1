#include "pipeline.hpp"

#include <array>

namespace cotan::cost {

namespace {

vk::raii::ShaderModule makeModule(const Device& device, std::span<const std::uint32_t> words)
{
    return vk::raii::ShaderModule(device.opened->device,
                                  vk::ShaderModuleCreateInfo({}, words.size_bytes(), words.data()));
}

std::vector<vk::VertexInputAttributeDescription> attributesOf(Stored stored)
{
    using F = vk::Format;
    std::vector<vk::VertexInputAttributeDescription> list = {
        {0, 0, F::eR32G32B32Sfloat, 0}, {1, 0, F::eR32G32B32Sfloat, 12}, {2, 0, F::eR32G32Sfloat, 24}};
    if (stored == Stored::tangent)
        list.emplace_back(3, 0, F::eR32G32B32A32Sfloat, 32);
    if (stored == Stored::cotangents) {
        list.emplace_back(3, 0, F::eR32G32B32Sfloat, 32);
        list.emplace_back(4, 0, F::eR32G32B32Sfloat, 44);
    }
    if (stored == Stored::cotangents8)
        list.emplace_back(3, 0, F::eR16G16B16A16Snorm, 32);
    if (stored == Stored::cotangents4)
        list.emplace_back(3, 0, F::eR32Uint, 32);
    if (stored == Stored::tangent2)
        list.emplace_back(3, 0, F::eR16Uint, 32);
    return list;
}

// Describes for devices older than Vulkan 1.3 what dynamic rendering describes in one structure.
vk::raii::RenderPass makeRenderPass(const Device& device)
{
    vk::AttachmentDescription attachment;
    attachment.format = kColorFormat;
    attachment.finalLayout = vk::ImageLayout::eColorAttachmentOptimal;
    const vk::AttachmentReference color(0, vk::ImageLayout::eColorAttachmentOptimal);
    vk::SubpassDescription subpass;
    subpass.setColorAttachments(color);
    return vk::raii::RenderPass(device.opened->device, vk::RenderPassCreateInfo({}, attachment, subpass));
}

} // namespace

std::uint32_t vertexFloats(Stored stored) { return 8 + static_cast<std::uint32_t>(vertexStage(stored).bytes + 3) / 4; }

Layout makeLayout(const Device& device)
{
    using T = vk::DescriptorType;
    constexpr auto kAll = vk::ShaderStageFlagBits::eAll;
    std::vector<vk::DescriptorSetLayoutBinding> bindings = {{0, T::eUniformBuffer, 1, kAll},
                                                            {1, T::eCombinedImageSampler, 1, kAll}};
    for (std::uint32_t i = 0; i < kBuffers; ++i)
        bindings.emplace_back(2 + i, T::eStorageBuffer, 1, kAll);
    Layout layout;
    layout.set = vk::raii::DescriptorSetLayout(device.opened->device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
    layout.pipeline = vk::raii::PipelineLayout(device.opened->device, vk::PipelineLayoutCreateInfo({}, *layout.set));
    if (!device.dynamicRendering)
        layout.renderPass = makeRenderPass(device);
    const vk::PushConstantRange constants(vk::ShaderStageFlagBits::eCompute, 0, kPassConstants);
    layout.pass =
        vk::raii::PipelineLayout(device.opened->device, vk::PipelineLayoutCreateInfo({}, *layout.set, constants));
    return layout;
}

namespace {

// `first` is either the vertex stage, which reads `input`, or the mesh stage.
vk::raii::Pipeline makeGraphics(const Device& device, const Layout& layout, vk::ShaderStageFlagBits first,
                                const vk::PipelineVertexInputStateCreateInfo& input,
                                std::span<const std::uint32_t> words, std::span<const std::uint32_t> fragment,
                                bool capture, int samplesAPixel = 1)
{
    const vk::raii::ShaderModule firstModule = makeModule(device, words);
    const vk::raii::ShaderModule fragmentModule = makeModule(device, fragment);
    const std::array stages{
        vk::PipelineShaderStageCreateInfo({}, first, *firstModule, "main"),
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragmentModule, "main")};
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.lineWidth = 1;
    const vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits(samplesAPixel));
    using C = vk::ColorComponentFlagBits;
    vk::PipelineColorBlendAttachmentState attachment;
    attachment.colorWriteMask = C::eR | C::eG | C::eB | C::eA;
    const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, vk::LogicOp::eCopy, attachment);
    const std::array states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, states);
    const vk::PipelineRenderingCreateInfo rendering(0, kColorFormat);
    vk::GraphicsPipelineCreateInfo info;
    if (capture)
        info.flags = vk::PipelineCreateFlagBits::eCaptureStatisticsKHR;
    info.setStages(stages);
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = *layout.pipeline;
    if (device.dynamicRendering)
        info.pNext = &rendering;
    else
        info.renderPass = *layout.renderPass;
    return vk::raii::Pipeline(device.opened->device, nullptr, info);
}

} // namespace

vk::raii::Pipeline makePipeline(const Device& device, const Layout& layout, Stored stored,
                                std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                                bool capture, int samples)
{
    const vk::VertexInputBindingDescription binding(0, vertexFloats(stored) * 4);
    const auto attributes = attributesOf(stored);
    return makeGraphics(device, layout, vk::ShaderStageFlagBits::eVertex, {{}, binding, attributes}, vertex, fragment,
                        capture, samples);
}

vk::raii::Pipeline makeMeshPipeline(const Device& device, const Layout& layout, std::span<const std::uint32_t> mesh,
                                    std::span<const std::uint32_t> fragment)
{
    return makeGraphics(device, layout, vk::ShaderStageFlagBits::eMeshEXT, {}, mesh, fragment, true);
}

vk::raii::Pipeline makePassPipeline(const Device& device, const Layout& layout, std::span<const std::uint32_t> compute)
{
    const vk::raii::ShaderModule module = makeModule(device, compute);
    const vk::ComputePipelineCreateInfo info(
        vk::PipelineCreateFlagBits::eCaptureStatisticsKHR,
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eCompute, *module, "main"), *layout.pass);
    return vk::raii::Pipeline(device.opened->device, nullptr, info);
}

} // namespace cotan::cost
