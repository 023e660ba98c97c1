// Runs GLSL and HLSL as compute shaders on the first usable Vulkan device.
#include <cstring>

#include "render/vulkan/memory.hpp"
#include "shader_run.hpp"
#include "shader_vulkan.hpp"

namespace cotan::test {

namespace {

class Computer {
public:
    Computer(const Device& device, const std::vector<Sample>& samples)
        : device_(device), samples_(samples), memory_(device), commands_(device)
    {
        using U = vk::BufferUsageFlagBits;
        const std::vector<Vectors> in = vectorsOf(samples);
        in_ = makeHostBuffer(memory_, in.size() * sizeof(Vectors), U::eStorageBuffer);
        std::memcpy(in_.mapped, in.data(), in.size() * sizeof(Vectors));
        const std::vector<float> none(samples.size() * 3, 9.0f);
        out_ = makeHostBuffer(memory_, none.size() * sizeof(float), U::eStorageBuffer, true);
        std::memcpy(out_.mapped, none.data(), none.size() * sizeof(float));
        const std::array bindings = {binding(0), binding(1)};
        setLayout_ = vk::raii::DescriptorSetLayout(device.device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
        layout_ = vk::raii::PipelineLayout(device.device, vk::PipelineLayoutCreateInfo({}, *setLayout_));
        const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, 2);
        pool_ = vk::raii::DescriptorPool(
            device.device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size));
        set_ = std::move(vk::raii::DescriptorSets(device.device, {*pool_, *setLayout_})[0]);
        const vk::DescriptorBufferInfo a(*in_.buffer, 0, VK_WHOLE_SIZE), b(*out_.buffer, 0, VK_WHOLE_SIZE);
        device.device.updateDescriptorSets(
            {vk::WriteDescriptorSet(*set_, 0, 0, vk::DescriptorType::eStorageBuffer, {}, a),
             vk::WriteDescriptorSet(*set_, 1, 0, vk::DescriptorType::eStorageBuffer, {}, b)},
            {});
    }

    std::vector<glm::dvec3> run(const std::vector<std::uint32_t>& spirv)
    {
        const vk::raii::ShaderModule module(device_.device, vk::ShaderModuleCreateInfo({}, spirv));
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
        const vk::raii::Pipeline pipeline(device_.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout_));
        const vk::raii::CommandBuffer& commands = commands_.begin();
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, *set_, {});
        commands.dispatch(static_cast<std::uint32_t>(samples_.size()), 1, 1);
        const vk::MemoryBarrier seen(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
        commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {}, seen,
                                 {}, {});
        commands_.submitAndWait();
        const std::string text(reinterpret_cast<const char*>(out_.mapped), samples_.size() * 3 * sizeof(float));
        return valuesOf<float>(text, 1, samples_.size())[0];
    }

private:
    static vk::DescriptorSetLayoutBinding binding(std::uint32_t k)
    {
        return {k, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute};
    }

    const Device& device_;
    const std::vector<Sample>& samples_;
    Memory memory_;
    Commands commands_;
    Buffer in_, out_;
    vk::raii::DescriptorSetLayout setLayout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::DescriptorSet set_{nullptr};
};

} // namespace

Results runVulkan(const std::vector<Case>& cases, const std::vector<Sample>& samples, shader_text::Language language)
{
    return onFirstDevice(language, [&](const Device& device, Results& results) {
        Computer computer(device, samples);
        for (const Case& c : cases)
            results.values.push_back(computer.run(wordsOf(computeSpirv(c, language))));
    });
}

} // namespace cotan::test
