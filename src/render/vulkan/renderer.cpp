// The Vulkan renderer. It draws all samples of a pixel at once or, above kMaxSharedSamples, one after the other.
#include "cotan/render.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/try.hpp"
#include "draw_passes.hpp"
#include "render/shared_device.hpp"
#include "scene/geometry.hpp"
#include "scene/sample_positions.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace {

// Runs `work` and converts exceptions to an Error.
template<class T, class Work> Result<T> guarded(const char* doing, Work work)
{
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return unavailableError(std::string(doing) + ": out of memory");
    } catch (const std::exception& e) {
        return unavailableError(std::string(doing) + ": " + reason(e));
    }
}

Status checkLimits(const Device& device, const View& view)
{
    COTAN_CHECK(checkView(view));
    const std::uint32_t largest = std::min({device.limits.maxFramebufferWidth, device.limits.maxFramebufferHeight,
                                            device.limits.maxImageDimension2D, device.limits.maxViewportDimensions[0],
                                            device.limits.maxViewportDimensions[1]});
    const std::string size = std::to_string(view.width) + "x" + std::to_string(view.height);
    if (std::uint32_t(view.width) > largest || std::uint32_t(view.height) > largest)
        return usageError("size " + size + ": " + device.name + " draws 1 to " + std::to_string(largest)
                          + " pixels per side");
    vk::DeviceSize largestHeap = 0;
    for (std::uint32_t i = 0; i < device.memory.memoryHeapCount; ++i)
        largestHeap = std::max(largestHeap, device.memory.memoryHeaps[i].size);
    const vk::DeviceSize needed = Targets::bytes(targetKind(device, view));
    if (needed > largestHeap / 10 * 9)
        return usageError("size " + size + " needs " + std::to_string(needed >> 20) + " MiB: " + device.name + " has "
                          + std::to_string(largestHeap >> 20) + " MiB");
    if (info(view.frame).source == FrameSource::triangle && !device.exact)
        return unavailableError("the frame " + std::string(name(view.frame))
                                + " needs the features geometryShader and "
                                  "bufferDeviceAddress: "
                                + device.name + " lacks them");
    return Done{};
}

// The image that the view requests, from the sum of all samples.
Image meanOf(const Image& sum, const View& view)
{
    Image image =
        makeImage(sum.width, sum.height, view.linearOutput ? PixelType::float32 : PixelType::unorm8, sum.name);
    for (int y = 0; y < sum.height; ++y)
        for (int x = 0; x < sum.width; ++x) {
            const float* p = sum.floats() + 4 * (std::size_t(y) * std::size_t(sum.width) + std::size_t(x));
            storePixel(image, x, y, glm::vec4(p[0], p[1], p[2], p[3]) / float(kSampleCount), view.dither);
        }
    return image;
}

} // namespace

// Draws the background around an area directly into the resolved image, where all samples of a pixel are equal.
void CommandRecorder::recordSurround(const vk::raii::CommandBuffer& commands, const View& view, const PixelArea& a)
{
    targets_->beginSurround(commands);
    if (view.background || view.ground) {
        for (const PixelArea& part :
             {PixelArea{0, 0, view.width, a.y0}, PixelArea{0, a.y0, a.x0, a.y1},
              PixelArea{a.x1, a.y0, view.width, a.y1}, PixelArea{0, a.y1, view.width, view.height}})
            if (!part.empty()) {
                commands.setScissor(0, rectangle(part));
                drawFullScreen(commands, keys_.surround);
            }
    }
    commands.endRendering();
}

// Resolves the samples of the area, if there are several.
void CommandRecorder::resolve(const vk::raii::CommandBuffer& commands, const PixelArea& area)
{
    if (!targets_->resolves())
        return;
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_->pipeline, 0, composeSet_, {});
    targets_->beginResolve(commands, rectangle(area));
    drawFullScreen(commands, keys_.resolve);
    commands.endRendering();
}

// Rows per submission. A CPU is slow, and a window on it would wait for the whole image.
int CommandRecorder::rowsAtOnce(const View& view, bool layered) const
{
    constexpr int kSamplesAtOnce = 1 << 19; // about 0.1 s on two cores
    if (!device_->cpu || !device_->presents || !targets_->resolves() || layered)
        return view.height;
    return std::max(kSamplesAtOnce / (view.width * view.samples) / 16 * 16, 16); // keeps pixels that share derivatives
}

Status CommandRecorder::drawOnce(GpuScene& scene, const View& view, std::optional<int> sample, Image* host)
{
    const CameraAxes axes = cameraAxes(view.camera);
    scene.setPointSampled(view.pointSampled);
    const gpu::CotanView constants =
        viewConstants(view, axes, scene.bounds, sample ? samplePosition(*sample) : glm::dvec2(0));
    DrawLists lists = makeLists(scene, view, axes, constants);
    const bool layered = view.output == Output::shaded && !lists.translucent.empty();
    keys_ = keysOf(view, *targets_);
    beginPipelines(lists, view, layered);
    prepare(view, axes, constants, layered);
    PixelArea area{0, 0, view.width, view.height};
    if (targets_->resolves())
        area = lists.area.empty() ? PixelArea{0, 0, 1, 1} : lists.area;

    if (dropsHidden(view))
        dropHidden(lists, area);
    const vk::raii::CommandBuffer& commands = begin();
    recordShadow(commands, lists, {constants.shadowX, constants.shadowY, constants.shadowZ, view.pointSampled});
    if (targets_->resolves())
        recordSurround(commands, view, area);
    const int rows = rowsAtOnce(view, layered);
    for (PixelArea band = area; band.y0 < area.y1; band.y0 = band.y1) {
        if (band.y0 > area.y0) {
            commands_.submitAndWait();
            begin();
        }
        band.y1 = std::min((band.y0 / rows + 1) * rows, area.y1);
        targets_->begin(commands, rectangle(band), layered);
        recordMain(commands, lists, view);
        if (layered) {
            targets_->endOpaque(commands);
            commands_.submitAndWait();
            COTAN_CHECK(drawLayers(lists));
            begin();
        } else {
            commands.endRendering();
        }
        resolve(commands, band);
    }
    targets_->finish(commands, host != nullptr);
    commands_.submitAndWait();
    if (host)
        *host = targets_->image(view.rowsUpward);
    return Done{};
}

bool CommandRecorder::staysOnDevice(const View& view)
{
    return view.output == Output::shaded && view.samples <= kMaxSharedSamples && !view.linearOutput && !view.rowsUpward;
}

Status CommandRecorder::draw(GpuScene& scene, const View& view, Image* host)
{
    COTAN_CHECK(checkLimits(*device_, view));
    const std::vector<Status>& has = view.framesOfMeshes ? scene.withFramesOfMeshes : scene.withFrame;
    if (const Status& ok = has[std::size_t(view.frame)]; !ok)
        return ok.error();
    const Targets::Kind kind = targetKind(*device_, view);
    if (!targets_ || !(targets_->kind() == kind)) {
        targets_.reset(); // frees its memory first
        targets_ = std::make_unique<Targets>(*device_, kind);
    }
    if (view.output != Output::shaded || view.samples <= kMaxSharedSamples)
        return drawOnce(scene, view, std::nullopt, host);
    Image sum = makeImage(view.width, view.height, PixelType::float32, "render"), image;
    for (int sample = 0; sample < kSampleCount; ++sample) {
        COTAN_CHECK(drawOnce(scene, view, sample, &image));
        for (std::size_t i = 0; i < 4 * sum.pixelCount(); ++i)
            sum.floats()[i] += image.floats()[i];
    }
    *host = meanOf(sum, view);
    return Done{};
}

namespace {

class VulkanRenderer final : public Renderer {
public:
    explicit VulkanRenderer(std::shared_ptr<Device> device)
        : device_(std::move(device)), layouts_(*device_), recorder_(*device_, layouts_)
    {
    }

    std::string device() const override { return device_->name; }
    double uploadSeconds() const override { return uploadSeconds_; }
    std::vector<std::string> messages() const override { return *device_->messages; }

    Result<std::shared_ptr<const DeviceImage>> drawOnDevice(const View& view)
    {
        using Shared = std::shared_ptr<const DeviceImage>;
        return guarded<Shared>("drawing", [&]() -> Result<Shared> {
            if (!CommandRecorder::staysOnDevice(view))
                return Shared();
            COTAN_CHECK(recorder_.draw(*scene_, view, nullptr));
            return recorder_.share();
        });
    }

private:
    Status loadScene(const Scene& scene, bool sameImages) override
    {
        return guarded<Done>("uploading the scene", [&]() -> Status {
            COTAN_CHECK(checkTrianglesDrawn(scene));
            const auto start = std::chrono::steady_clock::now();
            recorder_.forgetScene();
            Textures textures = sameImages && scene_ ? scene_->takeTextures() : Textures(*device_);
            scene_.reset(); // frees its memory first
            scene_ = std::make_unique<GpuScene>(*device_, layouts_, scene, std::move(textures));
            uploadSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            return Done{};
        });
    }

    Result<Image> drawLoaded(const View& view) override
    {
        return guarded<Image>("drawing", [&]() -> Result<Image> {
            Image image;
            COTAN_CHECK(recorder_.draw(*scene_, view, &image));
            return image;
        });
    }

    // In the order of dependence: later members are destroyed first.
    std::shared_ptr<Device> device_;
    Layouts layouts_;
    CommandRecorder recorder_;
    std::unique_ptr<GpuScene> scene_;
    double uploadSeconds_ = 0;
};

} // namespace

Result<std::unique_ptr<Renderer>> openVulkanRenderer(const std::string& device, bool validation)
{
    COTAN_TRY(opened, openDevice(device, validation));
    return openRendererOn(std::move(*opened));
}

Result<std::unique_ptr<Renderer>> openRendererOn(std::shared_ptr<Device> device)
{
    return guarded<std::unique_ptr<Renderer>>("opening the renderer", [&] {
        return std::unique_ptr<Renderer>(std::make_unique<VulkanRenderer>(std::move(device)));
    });
}

Result<std::shared_ptr<const DeviceImage>> drawOnDevice(Renderer& renderer, const View& view)
{
    auto* const vulkan = dynamic_cast<VulkanRenderer*>(&renderer);
    return vulkan ? vulkan->drawOnDevice(view) : std::shared_ptr<const DeviceImage>();
}

} // namespace cotan
