// Runs fragment shaders that take screen-space derivatives, in GLSL and HLSL, with the viewport's y down and flipped.
#include <cstring>

#include "render/vulkan/memory.hpp"
#include "shader_run.hpp"
#include "shader_vulkan.hpp"

namespace cotan::test {

namespace {

using shader_text::Language;

constexpr vk::Format kFormat = vk::Format::eR32G32B32A32Sfloat;

constexpr char kVertex[] = R"(#version 450
layout(location = 0) in vec2 at;
layout(location = 1) in vec3 n_in;
layout(location = 2) in vec3 p_in;
layout(location = 3) in vec2 uv_in;
layout(location = 4) in vec3 m_in;
layout(location = 0) out vec3 n;
layout(location = 1) out vec3 p;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec3 m;
void main()
{
    n = n_in;
    p = p_in;
    uv = uv_in;
    m = m_in;
    gl_Position = vec4(at, 0.5, 1.0);
}
)";

std::string fragmentOf(const Case& c, Language language)
{
    if (language == Language::hlsl)
        return c.text(Language::hlsl)
            + "[[vk::location(0)]] float4 main([[vk::location(0)]] float3 n : A, [[vk::location(1)]] float3 p : B,\n"
              "    [[vk::location(2)]] float2 uv : C, [[vk::location(3)]] float3 m : D) : SV_Target\n"
              "{\n    return float4("
            + c.call + ", 1.0);\n}\n";
    return "#version 450\nlayout(location = 0) in vec3 n;\nlayout(location = 1) in vec3 p;\n"
           "layout(location = 2) in vec2 uv;\nlayout(location = 3) in vec3 m;\nlayout(location = 0) out vec4 color;\n"
        + c.text(language) + "void main()\n{\n    color = vec4(" + c.call + ", 1.0);\n}\n";
}

class ShaderRenderer {
public:
    ShaderRenderer(const Device& device, const std::vector<Corner>& corners)
        : device_(device), count_(static_cast<std::uint32_t>(corners.size())), memory_(device), commands_(device)
    {
        using U = vk::BufferUsageFlagBits;
        using I = vk::ImageUsageFlagBits;
        corners_ = makeHostBuffer(memory_, corners.size() * sizeof(Corner), U::eVertexBuffer);
        std::memcpy(corners_.mapped, corners.data(), corners.size() * sizeof(Corner));
        const std::vector<float> none(kTarget * kTarget * 4, 9.0f);
        out_ = makeHostBuffer(memory_, none.size() * sizeof(float), U::eTransferDst, true);
        std::memcpy(out_.mapped, none.data(), none.size() * sizeof(float));
        target_ = makeTexture(
            memory_, {.format = kFormat, .extent = {kTarget, kTarget}, .usage = I::eColorAttachment | I::eTransferSrc});
        layout_ = vk::raii::PipelineLayout(device.device, vk::PipelineLayoutCreateInfo());
        vertex_ = module(toSpirv(kVertex, "vert", false, "vertex shader"));
    }

    std::vector<glm::dvec3> draw(const std::string& spirv)
    {
        const vk::raii::Pipeline pipeline = pipelineOf(module(spirv));
        constexpr float size = kTarget;
        std::vector<glm::dvec3> pixels;
        for (const vk::Viewport& viewport :
             {vk::Viewport(0, 0, size, size, 0, 1), vk::Viewport(0, size, size, -size, 0, 1)}) {
            submit(pipeline, viewport);
            const std::size_t floats = kTarget * kTarget * 4;
            const auto* at = reinterpret_cast<const float*>(out_.mapped);
            for (std::size_t k = 0; k < floats; k += 4)
                pixels.push_back({at[k], at[k + 1], at[k + 2]});
        }
        return pixels;
    }

private:
    vk::raii::ShaderModule module(const std::string& spirv)
    {
        const std::vector<std::uint32_t> words = wordsOf(spirv);
        return vk::raii::ShaderModule(device_.device, vk::ShaderModuleCreateInfo({}, words));
    }

    vk::raii::Pipeline pipelineOf(const vk::raii::ShaderModule& fragment)
    {
        using S = vk::ShaderStageFlagBits;
        const std::array stages = {vk::PipelineShaderStageCreateInfo({}, S::eVertex, *vertex_, "main"),
                                   vk::PipelineShaderStageCreateInfo({}, S::eFragment, *fragment, "main")};
        const vk::VertexInputBindingDescription binding(0, sizeof(Corner), vk::VertexInputRate::eVertex);
        const vk::Format two = vk::Format::eR32G32Sfloat, three = vk::Format::eR32G32B32Sfloat;
        const std::array attributes = {vk::VertexInputAttributeDescription(0, 0, two, offsetof(Corner, at)),
                                       vk::VertexInputAttributeDescription(1, 0, three, offsetof(Corner, n)),
                                       vk::VertexInputAttributeDescription(2, 0, three, offsetof(Corner, p)),
                                       vk::VertexInputAttributeDescription(3, 0, two, offsetof(Corner, uv)),
                                       vk::VertexInputAttributeDescription(4, 0, three, offsetof(Corner, texel))};
        const vk::PipelineVertexInputStateCreateInfo input({}, binding, attributes);
        const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
        const vk::Rect2D scissor({0, 0}, {kTarget, kTarget});
        const vk::PipelineViewportStateCreateInfo view({}, 1, nullptr, 1, &scissor);
        vk::PipelineRasterizationStateCreateInfo raster;
        raster.lineWidth = 1;
        const vk::PipelineMultisampleStateCreateInfo multisample({}, vk::SampleCountFlagBits::e1);
        vk::PipelineColorBlendAttachmentState attachment;
        using C = vk::ColorComponentFlagBits;
        attachment.colorWriteMask = C::eR | C::eG | C::eB | C::eA;
        const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, {}, attachment);
        const vk::DynamicState dynamicState = vk::DynamicState::eViewport;
        const vk::PipelineDynamicStateCreateInfo dynamic({}, dynamicState);
        const vk::PipelineRenderingCreateInfo rendering(0, kFormat);
        vk::GraphicsPipelineCreateInfo info({}, stages, &input, &assembly, nullptr, &view, &raster, &multisample,
                                            nullptr, &blend, &dynamic, *layout_);
        info.pNext = &rendering;
        return vk::raii::Pipeline(device_.device, nullptr, info);
    }

    void submit(const vk::raii::Pipeline& pipeline, const vk::Viewport& viewport)
    {
        using L = vk::ImageLayout;
        const vk::raii::CommandBuffer& commands = commands_.begin();
        constexpr ImageUse drawn{L::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                                 Access::eColorAttachmentWrite};
        constexpr auto colors = vk::ImageAspectFlagBits::eColor;
        transition(commands, *target_.image, colors, {L::eUndefined, Stage::eTransfer, {}}, drawn);
        const vk::RenderingAttachmentInfo color(*target_.view, L::eColorAttachmentOptimal, {}, {}, {},
                                                vk::AttachmentLoadOp::eClear);
        commands.beginRendering(vk::RenderingInfo({}, {{0, 0}, {kTarget, kTarget}}, 1, 0, color));
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        commands.setViewport(0, viewport);
        commands.bindVertexBuffers(0, *corners_.buffer, vk::DeviceSize(0));
        commands.draw(count_, 1, 0, 0);
        commands.endRendering();
        transition(commands, *target_.image, colors, drawn, kCopied);
        copyToHost(commands, device_, *target_.image, target_.extent, out_);
        commands_.submitAndWait();
    }

    const Device& device_;
    std::uint32_t count_;
    Memory memory_;
    Commands commands_;
    Buffer corners_, out_;
    Texture2D target_;
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::ShaderModule vertex_{nullptr};
};

} // namespace

Results drawVulkan(const std::vector<Case>& drawn, const std::vector<Corner>& corners, Language language)
{
    return onFirstDevice(language, [&](const Device& device, Results& results) {
        ShaderRenderer painter(device, corners);
        for (const Case& c : drawn)
            results.values.push_back(
                painter.draw(toSpirv(fragmentOf(c, language), "frag", language == Language::hlsl, c.name)));
    });
}

} // namespace cotan::test
