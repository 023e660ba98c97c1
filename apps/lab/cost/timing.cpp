#include "cost/timing.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>

#include "timing_scene.hpp"

namespace cotan::cost {

namespace {

constexpr std::uint32_t kMapSize = 64;

struct Uniforms { // the struct Draw of vertex.vert
    float projection[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    float model[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    float covectors[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

class Timer {
public:
    explicit Timer(const Device& device)
        : device_(device), gpu_(*device.opened), commands_(gpu_), memory_(gpu_), layout_(makeLayout(device))
    {
        queries_ = vk::raii::QueryPool(gpu_.device, {{}, vk::QueryType::eTimestamp, 2});
        sampler_ = vk::raii::Sampler(gpu_.device, vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear));
        uniforms_ = makeHostBuffer(memory_, sizeof(Uniforms), vk::BufferUsageFlagBits::eUniformBuffer);
        const Uniforms uniforms;
        std::memcpy(uniforms_.mapped, &uniforms, sizeof uniforms);
        makeSet();
        makeMap();
    }

    // Selects what draw() draws. Throws if the device has no render target with the requested samples.
    void use(const TimingCase& what, const std::vector<const Row*>& rows, const Grid& grid)
    {
        if (!(device_.physical.getProperties().limits.framebufferColorSampleCounts
              & vk::SampleCountFlagBits(what.samples)))
            throw std::runtime_error("the device has no render targets with this sample count");
        what_ = what;
        target_.reset();
        const auto side = std::uint32_t(what.side);
        target_.emplace(gpu_,
                        TextureInfo{.format = kColorFormat,
                                    .extent = {side, side},
                                    .samples = vk::SampleCountFlagBits(what.samples),
                                    .usage = vk::ImageUsageFlagBits::eColorAttachment});
        transition(commands_.begin(), *target_->texture.image, vk::ImageAspectFlagBits::eColor,
                   {vk::ImageLayout::eUndefined, cotan::Stage::eTopOfPipe, {}},
                   {vk::ImageLayout::eColorAttachmentOptimal, cotan::Stage::eColorAttachmentOutput,
                    Access::eColorAttachmentWrite});
        commands_.submitAndWait();
        std::vector<vk::raii::Pipeline>& pipelines = pipelines_[what.samples];
        for (std::size_t i = pipelines.size(); i < rows.size(); ++i)
            pipelines.push_back(makePipeline(device_, layout_, rows[i]->stored, vertexStage(rows[i]->stored).vertex,
                                             rows[i]->fragment, false, what.samples));
        const vk::DescriptorImageInfo image(*sampler_, *map_.view, vk::ImageLayout::eShaderReadOnlyOptimal);
        using T = vk::DescriptorType;
        const std::array buffers{vk::DescriptorBufferInfo(*uniforms_.buffer, 0, VK_WHOLE_SIZE),
                                 vk::DescriptorBufferInfo(*grid.positions.buffer, 0, VK_WHOLE_SIZE),
                                 vk::DescriptorBufferInfo(*grid.texcoords.buffer, 0, VK_WHOLE_SIZE),
                                 vk::DescriptorBufferInfo(*grid.corners.buffer, 0, VK_WHOLE_SIZE),
                                 vk::DescriptorBufferInfo(*grid.normals.buffer, 0, VK_WHOLE_SIZE),
                                 vk::DescriptorBufferInfo(*grid.triangles.buffer, 0, VK_WHOLE_SIZE)};
        const std::array writes{vk::WriteDescriptorSet(set_, 0, 0, 1, T::eUniformBuffer, nullptr, &buffers[0]),
                                vk::WriteDescriptorSet(set_, 1, 0, 1, T::eCombinedImageSampler, &image),
                                vk::WriteDescriptorSet(set_, 2, 0, 5, T::eStorageBuffer, nullptr, &buffers[1])};
        gpu_.device.updateDescriptorSets(writes, nullptr);
    }

    // Draws once and returns the time in nanoseconds.
    double draw(std::size_t pipeline, Stored stored, const Grid& grid)
    {
        const vk::raii::CommandBuffer& commands = commands_.begin();
        commands.resetQueryPool(*queries_, 0, 2);
        vk::RenderingAttachmentInfo color(*target_->texture.view, vk::ImageLayout::eColorAttachmentOptimal);
        color.loadOp = vk::AttachmentLoadOp::eDontCare;
        color.storeOp = vk::AttachmentStoreOp::eStore;
        const auto side = std::uint32_t(what_.side);
        const vk::Rect2D area({0, 0}, {side, side});
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries_, 0);
        commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, color));
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_[what_.samples][pipeline]);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_.pipeline, 0, set_, nullptr);
        commands.setViewport(0, vk::Viewport(0, 0, float(side), float(side), 0, 1));
        commands.setScissor(0, area);
        commands.bindVertexBuffers(0, *grid.vertices[std::size_t(stored)].buffer, vk::DeviceSize(0));
        const Buffer& indices = provokes(stored) ? grid.provokingIndices : grid.indices;
        commands.bindIndexBuffer(*indices.buffer, 0, vk::IndexType::eUint32);
        commands.drawIndexed(grid.indexCount, std::uint32_t(what_.layers), 0, 0, 0);
        commands.endRendering();
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries_, 1);
        commands_.submitAndWait();
        [[maybe_unused]] const auto [result, ticks] = queries_.getResults<std::uint64_t>(
            0, 2, 16, 8, vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        return double(ticks[1] - ticks[0]) * device_.nanoseconds;
    }

private:
    void makeSet()
    {
        using T = vk::DescriptorType;
        const std::array sizes{vk::DescriptorPoolSize(T::eUniformBuffer, 1),
                               vk::DescriptorPoolSize(T::eCombinedImageSampler, 1),
                               vk::DescriptorPoolSize(T::eStorageBuffer, kBuffers)};
        descriptors_ = vk::raii::DescriptorPool(gpu_.device, vk::DescriptorPoolCreateInfo({}, 1, sizes));
        // A plain handle: the pool frees the set.
        const vk::DescriptorSetAllocateInfo info(*descriptors_, *layout_.set);
        set_ = (*gpu_.device).allocateDescriptorSets(info, *gpu_.device.getDispatcher())[0];
    }

    void makeMap()
    {
        std::vector<std::uint8_t> texels;
        for (std::uint32_t i = 0; i < kMapSize * kMapSize; ++i) {
            const double a = 0.4 * double(i % kMapSize), b = 0.3 * double(i / kMapSize);
            for (const double c : {0.3 * std::sin(a), 0.3 * std::sin(b), 0.9, 1.0})
                texels.push_back(static_cast<std::uint8_t>(std::lround((c * 0.5 + 0.5) * 255)));
        }
        using U = vk::ImageUsageFlagBits;
        map_ = makeTexture(memory_, {.extent = {kMapSize, kMapSize}, .usage = U::eSampled | U::eTransferDst});
        Uploader uploader(gpu_, texels.size());
        const auto bytes = std::as_bytes(std::span(texels));
        uploader.image(map_, {&bytes, 1}, 4);
        uploader.finish();
    }

    const Device& device_;
    const cotan::Device& gpu_;
    Commands commands_;
    Memory memory_;
    Layout layout_;
    vk::raii::QueryPool queries_{nullptr};
    std::optional<DeviceImage> target_;
    Texture2D map_;
    vk::raii::Sampler sampler_{nullptr};
    Buffer uniforms_;
    vk::raii::DescriptorPool descriptors_{nullptr};
    vk::DescriptorSet set_;
    TimingCase what_;
    std::map<int, std::vector<vk::raii::Pipeline>> pipelines_; // by samples per pixel
};

double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

constexpr char kLate[] = "the time ran out";

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Throws if all repetitions would take longer than `seconds`, estimated from the first one, which is a warm-up.
void timeCase(Timer& timer, const std::vector<const Row*>& rows, const TimingCase& what, const Grid& grid, int repeats,
              double seconds, DeviceTiming& result)
{
    timer.use(what, rows, grid);
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::vector<double>> times(rows.size());
    const double pixels = double(what.side) * what.side * what.layers;
    for (int repeat = -1; repeat < repeats; ++repeat) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double t = timer.draw(i, rows[i]->stored, grid);
            if (repeat >= 0)
                times[i].push_back(t / pixels * 1e6);
        }
        if (repeat < 0 && secondsSince(start) * (repeats + 1) > seconds)
            throw std::runtime_error(kLate);
    }
    result.cases.push_back(what);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result.rows[i].nanosecondsPerMillionPixels.push_back(median(times[i]));
        result.rows[i].repeats.push_back(std::move(times[i]));
        result.rows[i].vertices.push_back(provokes(rows[i]->stored) ? grid.provokingVertexCount : grid.vertexCount);
    }
}

void timeAll(Device& device, const std::vector<const Row*>& rows, const TimingOptions& options, DeviceTiming& result)
{
    const auto start = std::chrono::steady_clock::now();
    open(device);
    Timer timer(device);
    for (const Row* row : rows)
        result.rows.push_back({row->name, {}, {}, {}});
    std::pair<int, int> made;
    std::unique_ptr<Grid> grid;
    for (const TimingCase& what : options.cases) {
        try {
            if (secondsSince(start) > options.seconds)
                throw std::runtime_error(kLate);
            if (std::pair(what.leg, what.side) != made) {
                grid.reset();
                made = {};
                grid = makeGrid(device, what.leg, what.side);
                made = {what.leg, what.side};
            }
            timeCase(timer, rows, what, *grid, options.repeats, options.seconds - secondsSince(start), result);
        } catch (const vk::DeviceLostError&) {
            throw;
        } catch (const std::exception& e) {
            result.skipped.push_back({what, reason(e)});
        }
    }
    if (result.cases.empty() && !result.skipped.empty())
        throw std::runtime_error(result.skipped.front().why);
}

} // namespace

const std::vector<int>& triangleLegs()
{
    static const std::vector<int> legs = {4, 16, 64, 256};
    return legs;
}

std::vector<TimingCase> usualCases()
{
    std::vector<TimingCase> cases;
    for (const int leg : triangleLegs())
        cases.push_back({leg});
    return cases;
}

Result<std::vector<DeviceTiming>> timeRows(const std::vector<const Row*>& rows, const TimingOptions& options)
{
    try {
        const Instance instance = openInstance();
        std::vector<DeviceTiming> result;
        for (Device& device : listDevices(instance)) {
            if (!wanted(device.name, options.devices) || result.size() >= options.maxDevices)
                continue;
            DeviceTiming timing;
            timing.name = device.name;
            timing.driver = device.driver;
            timing.cpu = device.cpu;
            if (!device.missing.empty())
                timing.silence = device.missing;
            else if (device.nanoseconds <= 0)
                timing.silence = "the device has no timestamps";
            else if (device.cpu && !options.cpuDevices)
                timing.silence = "renders on the CPU; --time-cpu-devices times it too";
            else
                try {
                    timeAll(device, rows, options, timing);
                } catch (const std::exception& e) {
                    timing.rows.clear();
                    timing.silence = reason(e);
                }
            result.push_back(std::move(timing));
        }
        return result;
    } catch (const std::exception& e) {
        return unavailableError("Vulkan cannot be used: " + reason(e));
    }
}

} // namespace cotan::cost
