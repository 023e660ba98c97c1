// One picture from what is recorded: the samples of its pixels drawn at once, or one after the other.
#include <algorithm>
#include <chrono>
#include <optional>

#include "draw_passes.hpp"
#include "scene/sample_places.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace {

double now()
{
    const auto t = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(t).count();
}

Status checkLimits(const Device& device, const View& view)
{
    if (Status sound = checkView(view); !sound)
        return sound;
    if (view.lighting != Lighting::world)
        return unavailableError("lighting in tangent space: only the reference renderer does it "
                                "(--device reference)");
    if (view.normalMapping != NormalMapping::shading)
        return unavailableError("normal mapping by rays: only the reference renderer does it (--device reference)");
    const std::uint32_t largest = std::min({device.limits.maxFramebufferWidth, device.limits.maxFramebufferHeight,
                                            device.limits.maxImageDimension2D, device.limits.maxViewportDimensions[0],
                                            device.limits.maxViewportDimensions[1]});
    const std::string size = std::to_string(view.width) + "x" + std::to_string(view.height);
    if (std::uint32_t(view.width) > largest || std::uint32_t(view.height) > largest)
        return usageError("size " + size + ": " + device.name + " draws 1 to " + std::to_string(largest)
                          + " pixels a side");
    vk::DeviceSize room = 0;
    for (std::uint32_t i = 0; i < device.memory.memoryHeapCount; ++i)
        room = std::max(room, device.memory.memoryHeaps[i].size);
    const vk::DeviceSize needed = Targets::bytes(targetKind(device, view));
    if (needed > room / 10 * 9)
        return usageError("size " + size + " needs " + std::to_string(needed >> 20) + " MiB: " + device.name + " has "
                          + std::to_string(room >> 20));
    if (info(view.frame).source == FrameSource::triangle && !device.exact)
        return unavailableError("the frame " + std::string(name(view.frame))
                                + " needs the features geometryShader and "
                                  "bufferDeviceAddress: "
                                + device.name + " lacks them");
    return Done{};
}

// Adds the pixels of floats.
void add(Image& sum, const Image& picture)
{
    for (std::size_t i = 0; i < 4 * sum.pixelCount(); ++i)
        sum.floats()[i] += picture.floats()[i];
}

// What the view asks for, of the sums of all samples.
Image meanOf(const Image& sum, const View& view)
{
    Image image =
        makeImage(sum.width, sum.height, view.linearOutput ? PixelType::float32 : PixelType::unorm8, sum.name);
    for (int y = 0; y < sum.height; ++y)
        for (int x = 0; x < sum.width; ++x) {
            const float* p = sum.floats() + 4 * (std::size_t(y) * std::size_t(sum.width) + std::size_t(x));
            storePixel(image, x, y, glm::vec4(p[0], p[1], p[2], p[3]) / float(kPlaces), view.dither);
        }
    return image;
}

} // namespace

PipelineKey CommandRecorder::resolveKey() const
{
    PipelineKey key;
    key.pass = Pass::resolve;
    key.multisampledSource = targets_->multisampled();
    key.levels = targets_->kind().shown == vk::Format::eR8G8B8A8Unorm;
    key.format = targets_->kind().shown;
    return key;
}

// Resolves what was drawn in the area, and copies the picture.
void CommandRecorder::finish(const vk::raii::CommandBuffer& commands, const PixelArea& area)
{
    if (targets_->resolves()) {
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_->pipeline, 0, composeSet_, {});
        targets_->beginResolve(commands, rectangle(area));
        drawOver(commands, resolveKey());
        commands.endRendering();
    }
    targets_->copy(commands);
}

Result<Image> CommandRecorder::drawOnce(GpuScene& scene, const View& view, std::optional<int> sample,
                                        RenderTimings& timings)
{
    const CameraAxes axes = cameraAxes(view.camera);
    scene.setPointSampled(view.pointSampled);
    DrawLists lists = makeLists(scene, view, axes);
    const bool layered = view.output == Output::shaded && !lists.translucent.empty();
    const gpu::CotanView constants =
        viewConstants(view, axes, scene.bounds, sample ? samplePlace(*sample) : glm::dvec2(0));
    beginPipelines(lists, view, layered);
    prepare(view, axes, constants, layered);
    setAreas(lists, view, constants);
    PixelArea area{0, 0, view.width, view.height};
    if (targets_->resolves())
        area = lists.area.empty() ? PixelArea{0, 0, 1, 1} : lists.area;

    const double start = now();
    const vk::raii::CommandBuffer& commands = begin();
    recordShadow(commands, scene, lists, {constants.shadowX, constants.shadowY, constants.shadowZ, view.pointSampled});
    if (targets_->resolves())
        recordSurround(commands, view, area);
    targets_->begin(commands, rectangle(area), layered);
    recordPicture(commands, scene, lists, view);
    if (layered) {
        targets_->endOpaque(commands);
        commands_.submitAndWait();
        if (const Status ok = drawLayers(scene, lists, view); !ok)
            return ok.error();
        finish(begin(), area);
    } else {
        commands.endRendering();
        finish(commands, area);
    }
    commands_.submitAndWait();
    const double drawn = now();
    Image image = targets_->image(view.rowsUpward);
    timings.draw += drawn - start;
    timings.readBack += now() - drawn;
    return image;
}

Result<Image> CommandRecorder::draw(GpuScene& scene, const View& view, RenderTimings& timings)
{
    if (const Status ok = checkLimits(*device_, view); !ok)
        return ok.error();
    if (const Status& ok = scene.withFrame[std::size_t(view.frame)]; !ok)
        return ok.error();
    const Targets::Kind kind = targetKind(*device_, view);
    if (!targets_ || !(targets_->kind() == kind)) {
        targets_.reset(); // its memory may be needed for the new ones
        targets_ = std::make_unique<Targets>(*device_, kind);
    }
    timings.draw = timings.readBack = 0;
    if (view.output != Output::shaded || view.samples <= kMaxSharedSamples)
        return drawOnce(scene, view, std::nullopt, timings);
    Image sum = makeImage(view.width, view.height, PixelType::float32, "render");
    for (int sample = 0; sample < kPlaces; ++sample) {
        const Result<Image> picture = drawOnce(scene, view, sample, timings);
        if (!picture)
            return picture;
        add(sum, *picture);
    }
    return meanOf(sum, view);
}

} // namespace cotan
