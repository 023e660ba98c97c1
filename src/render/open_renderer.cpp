#include "cotan/render.hpp"

#include "core/not_built.hpp"
#include "core/try.hpp"
#include "scene/scene_check.hpp"
#include "shared_device.hpp"

namespace cotan {

namespace {

class ReferenceBackend final : public Renderer {
public:
    explicit ReferenceBackend(int threads) : threads_(threads) {}

    std::string device() const override { return "reference"; }

private:
    Status loadScene(const Scene& scene, bool) override
    {
        scene_ = &scene;
        return Done{};
    }
    Result<Image> drawLoaded(const View& view) override { return renderReference(*scene_, view, threads_, progress); }

    const Scene* scene_ = nullptr;
    int threads_;
};

} // namespace

#ifndef COTAN_WITH_VULKAN

Result<std::unique_ptr<Renderer>> openVulkanRenderer(const std::string&, bool)
{
    return notBuiltWith("Vulkan", "libvulkan-dev and glslang-tools");
}
Result<std::unique_ptr<Renderer>> openRendererOn(std::shared_ptr<Device>) { return openVulkanRenderer(); }
Result<std::shared_ptr<const DeviceImage>> drawOnDevice(Renderer&, const View&)
{
    return std::shared_ptr<const DeviceImage>();
}

#endif

Status Renderer::load(const Scene& scene, bool sameImages)
{
    Status status = checkScene(scene, "scene", {.finite = false, .pixels = false});
    if (status)
        status = loadScene(scene, sameImages && holds_);
    loaded_ = holds_ = bool(status);
    return status;
}

Result<Image> Renderer::draw(const View& view)
{
    if (!loaded_)
        return usageError("draw: no scene is loaded");
    if (progress && !progress(0))
        return stoppedError();
    return drawLoaded(view);
}

Result<std::unique_ptr<Renderer>> openRenderer(const std::string& device, int threads, bool validation)
{
    std::string note;
    if (device != "reference") {
        auto vulkan = openVulkanRenderer(device == "auto" ? "" : device, validation);
        if (vulkan || device != "auto")
            return vulkan;
        note = vulkan.error().message + "; drawing with the reference renderer";
    }
    auto renderer = std::make_unique<ReferenceBackend>(threads);
    renderer->note = std::move(note);
    return std::unique_ptr<Renderer>(std::move(renderer));
}

Result<Image> drawView(Scene scene, const View& view, const std::string& device, int threads)
{
    COTAN_TRY(renderer, openRenderer(device, threads));
    COTAN_CHECK(checkScene(scene, "scene", {.finite = false, .pixels = false}));
    if (isFrame(int(view.frame))) // the renderer rejects others
        deriveVertexFrames(scene, view.frame, TangentOrigin::stored);
    COTAN_CHECK((*renderer)->load(scene));
    return (*renderer)->draw(view);
}

} // namespace cotan
