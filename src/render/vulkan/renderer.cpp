#include "cotan/render.hpp"

#include <chrono>

#include "draw_passes.hpp"
#include "scene/bounds.hpp"

namespace cotan {

// In the order of dependence: what is below is destroyed first.
struct Renderer::State {
    std::unique_ptr<Device> device;
    std::unique_ptr<Layouts> layouts;
    std::unique_ptr<Drawer> drawer;
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

Result<Renderer> Renderer::create(const RendererOptions& options)
{
    return guarded<Renderer>("opening the device", [&]() -> Result<Renderer> {
        Result<std::unique_ptr<Device>> device = openDevice(options);
        if (!device)
            return device.error();
        auto state = std::make_unique<State>();
        state->device = std::move(*device);
        state->layouts = std::make_unique<Layouts>(*state->device);
        state->drawer = std::make_unique<Drawer>(*state->device, *state->layouts);
        return Renderer(std::move(state));
    });
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Status Renderer::load(const Scene& scene, bool sameImages)
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

Result<Image> Renderer::render(const View& view)
{
    if (!state_->scene)
        if (const Status loaded = load(Scene{}); !loaded)
            return loaded.error();
    return guarded<Image>("drawing", [&] { return state_->drawer->draw(*state_->scene, view, state_->timings); });
}

const std::string& Renderer::deviceName() const { return state_->device->name; }
const std::string& Renderer::driver() const { return state_->device->driver; }
const RenderTimings& Renderer::timings() const { return state_->timings; }
const std::vector<std::string>& Renderer::messages() const { return *state_->device->messages; }

} // namespace cotan
