#include "cotan/render.hpp"

#include <chrono>

#include "draw_passes.hpp"
#include "scene/bounds.hpp"

namespace cotan {

// In the order of dependence: what is below is destroyed first.
struct VulkanRenderer::State {
    std::unique_ptr<Device> device;
    std::unique_ptr<Layouts> layouts;
    std::unique_ptr<CommandRecorder> drawer;
    std::unique_ptr<GpuScene> scene;
    RenderTimings timings;
};

namespace {

// Runs `work`; whatever it throws becomes an Error.
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

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

Result<VulkanRenderer> VulkanRenderer::create(const VulkanRendererOptions& options)
{
    return guarded<VulkanRenderer>("opening the device", [&]() -> Result<VulkanRenderer> {
        Result<std::unique_ptr<Device>> device = openDevice(options);
        if (!device)
            return device.error();
        auto state = std::make_unique<State>();
        state->device = std::move(*device);
        state->layouts = std::make_unique<Layouts>(*state->device);
        state->drawer = std::make_unique<CommandRecorder>(*state->device, *state->layouts);
        return VulkanRenderer(std::move(state));
    });
}

VulkanRenderer::VulkanRenderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
VulkanRenderer::VulkanRenderer(VulkanRenderer&&) noexcept = default;
VulkanRenderer& VulkanRenderer::operator=(VulkanRenderer&&) noexcept = default;
VulkanRenderer::~VulkanRenderer() = default;

Status VulkanRenderer::load(const Scene& scene, bool sameImages)
{
    return guarded<Done>("uploading the scene", [&]() -> Status {
        if (const Status ok = checkTrianglesDrawn(scene); !ok)
            return ok;
        const auto start = std::chrono::steady_clock::now();
        state_->drawer->forgetScene();
        Textures textures = sameImages && state_->scene ? state_->scene->takeTextures() : Textures(*state_->device);
        state_->scene.reset(); // its memory may be needed for the new one
        state_->scene = std::make_unique<GpuScene>(*state_->device, *state_->layouts, scene, std::move(textures));
        state_->timings.upload = secondsSince(start);
        return Done{};
    });
}

Result<Image> VulkanRenderer::render(const View& view)
{
    if (!state_->scene)
        if (const Status loaded = load(Scene{}); !loaded)
            return loaded.error();
    return guarded<Image>("drawing", [&] { return state_->drawer->draw(*state_->scene, view, state_->timings); });
}

const std::string& VulkanRenderer::deviceName() const { return state_->device->name; }
const std::string& VulkanRenderer::driver() const { return state_->device->driver; }
const RenderTimings& VulkanRenderer::timings() const { return state_->timings; }
const std::vector<std::string>& VulkanRenderer::messages() const { return *state_->device->messages; }

} // namespace cotan
