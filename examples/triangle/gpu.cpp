#include "gpu.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

Gpu openGpu()
{
    Gpu gpu;
    const vk::ApplicationInfo application("triangle_example", 0, nullptr, 0, VK_API_VERSION_1_3);
    gpu.instance = vk::raii::Instance(gpu.context, vk::InstanceCreateInfo({}, &application));
    const auto all = gpu.instance.enumeratePhysicalDevices();
    if (all.empty())
        throw std::runtime_error("no Vulkan device");
    const auto draws = [](const auto& device) {
        return device.getProperties().deviceType != vk::PhysicalDeviceType::eCpu;
    };
    const auto best = std::find_if(all.begin(), all.end(), draws);
    gpu.physical = best != all.end() ? *best : all.front(); // a CPU device only if there is no other
    for (const auto& extension : gpu.physical.enumerateDeviceExtensionProperties())
        gpu.meshShaders =
            gpu.meshShaders || std::string(extension.extensionName.data()) == VK_EXT_MESH_SHADER_EXTENSION_NAME;

    vk::PhysicalDeviceMeshShaderFeaturesEXT meshShader;
    meshShader.meshShader = VK_TRUE;
    vk::PhysicalDeviceVulkan13Features v13;
    v13.dynamicRendering = v13.synchronization2 = v13.maintenance4 = VK_TRUE; // maintenance4: LocalSizeId
    v13.shaderDemoteToHelperInvocation = VK_TRUE;                             // newer glslang compiles discard to this
    v13.pNext = gpu.meshShaders ? &meshShader : nullptr;
    vk::PhysicalDeviceVulkan12Features v12;
    v12.bufferDeviceAddress = VK_TRUE;
    v12.pNext = &v13;
    vk::PhysicalDeviceFeatures2 features;
    features.features.geometryShader = VK_TRUE; // needed for gl_PrimitiveID in the fragment stage
    features.pNext = &v12;
    const float priority = 1; // queue family 0 supports graphics on every desktop driver
    const vk::DeviceQueueCreateInfo queue({}, 0, 1, &priority);
    std::vector<const char*> extensions;
    if (gpu.meshShaders)
        extensions.push_back(VK_EXT_MESH_SHADER_EXTENSION_NAME);
    gpu.device = vk::raii::Device(gpu.physical, vk::DeviceCreateInfo({}, queue, {}, extensions, nullptr, &features));
    gpu.queue = vk::raii::Queue(gpu.device, 0, 0);
    gpu.pool = vk::raii::CommandPool(gpu.device, vk::CommandPoolCreateInfo());
    return gpu;
}

// Index of a memory type with the wanted properties, preferably local to the device.
static std::uint32_t memoryType(const Gpu& gpu, std::uint32_t allowed, vk::MemoryPropertyFlags wanted)
{
    const auto memory = gpu.physical.getMemoryProperties();
    for (const vk::MemoryPropertyFlags all : {wanted | vk::MemoryPropertyFlagBits::eDeviceLocal, wanted})
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
            if ((allowed >> i & 1u) && (memory.memoryTypes[i].propertyFlags & all) == all)
                return i;
    throw std::runtime_error("the device has no memory of the kind that is needed");
}

Buffer makeBuffer(const Gpu& gpu, const void* data, std::size_t bytes)
{
    Buffer b;
    const std::size_t size = bytes > 0 ? bytes : 4;
    using U = vk::BufferUsageFlagBits;
    using M = vk::MemoryPropertyFlagBits;
    b.buffer = vk::raii::Buffer(
        gpu.device, {{}, size, U::eStorageBuffer | U::eShaderDeviceAddress | U::eIndexBuffer | U::eTransferDst});
    const auto needs = b.buffer.getMemoryRequirements();
    const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
    b.memory = vk::raii::DeviceMemory(
        gpu.device, {needs.size, memoryType(gpu, needs.memoryTypeBits, M::eHostVisible | M::eHostCoherent), &flags});
    b.buffer.bindMemory(*b.memory, 0);
    b.address = gpu.device.getBufferAddress({*b.buffer});
    b.data = b.memory.mapMemory(0, VK_WHOLE_SIZE);
    if (data)
        std::memcpy(b.data, data, bytes);
    return b;
}

Target makeTarget(const Gpu& gpu, vk::Format format, vk::Extent2D size, vk::ImageUsageFlags usage,
                  vk::ImageAspectFlags aspect)
{
    Target t;
    t.image = vk::raii::Image(gpu.device,
                              {{},
                               vk::ImageType::e2D,
                               format,
                               {size.width, size.height, 1},
                               1,
                               1,
                               vk::SampleCountFlagBits::e1,
                               vk::ImageTiling::eOptimal,
                               usage});
    const auto needs = t.image.getMemoryRequirements();
    t.memory = vk::raii::DeviceMemory(gpu.device, {needs.size, memoryType(gpu, needs.memoryTypeBits, {})});
    t.image.bindMemory(*t.memory, 0);
    t.view = vk::raii::ImageView(gpu.device, {{}, *t.image, vk::ImageViewType::e2D, format, {}, {aspect, 0, 1, 0, 1}});
    return t;
}

void barrier(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
             vk::ImageLayout from, vk::ImageLayout to)
{
    using S = vk::PipelineStageFlagBits2;
    using A = vk::AccessFlagBits2;
    const vk::ImageMemoryBarrier2 b(S::eAllCommands, A::eMemoryWrite, S::eAllCommands, A::eMemoryRead | A::eMemoryWrite,
                                    from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
                                    {aspect, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, nullptr, nullptr, b));
}

vk::raii::Pipeline makePipeline(const Gpu& gpu, vk::PipelineLayout layout, std::span<const Stage> stages,
                                vk::Format color, vk::Extent2D size)
{
    std::vector<vk::raii::ShaderModule> modules;
    std::vector<vk::PipelineShaderStageCreateInfo> infos;
    for (const Stage& s : stages) {
        modules.emplace_back(gpu.device, vk::ShaderModuleCreateInfo({}, s.code.size_bytes(), s.code.data()));
        infos.emplace_back(vk::PipelineShaderStageCreateFlags(), s.stage, *modules.back(), "main");
    }
    if (stages.front().stage == vk::ShaderStageFlagBits::eCompute)
        return vk::raii::Pipeline(gpu.device, nullptr, vk::ComputePipelineCreateInfo({}, infos.front(), layout));
    const vk::PipelineVertexInputStateCreateInfo input; // empty: shaders read everything from buffers
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::Viewport viewport(0, 0, float(size.width), float(size.height), 0, 1);
    const vk::Rect2D scissor({0, 0}, size);
    const vk::PipelineViewportStateCreateInfo view({}, viewport, scissor);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.lineWidth = 1;
    const vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits::e1);
    const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eLess);
    vk::PipelineColorBlendAttachmentState attachment;
    using C = vk::ColorComponentFlagBits;
    attachment.colorWriteMask = C::eR | C::eG | C::eB | C::eA;
    const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, vk::LogicOp::eCopy, attachment);
    const vk::PipelineRenderingCreateInfo rendering(0, color, vk::Format::eD32Sfloat);
    vk::GraphicsPipelineCreateInfo info({}, infos, &input, &assembly, nullptr, &view, &raster, &samples, &depth, &blend,
                                        nullptr, layout);
    info.pNext = &rendering;
    return vk::raii::Pipeline(gpu.device, nullptr, info);
}
