#include "painter.hpp"

#include <optional>

#include "cotan/reference/render.hpp"
#ifdef COTAN_WITH_VULKAN
#include "cotan/render/renderer.hpp"
#endif

namespace cotan::app {

namespace {

class ReferencePainter final : public Painter {
public:
    explicit ReferencePainter(int threads) : threads_(threads) {}

    Status load(const Scene& scene) override
    {
        scene_ = &scene;
        return Done{};
    }
    std::string device() const override { return "reference"; }

private:
    Result<Image> drawView(const View& view) override { return renderReference(*scene_, view, threads_, progress); }

    const Scene* scene_ = nullptr;
    int threads_;
};

#ifdef COTAN_WITH_VULKAN
class VulkanPainter final : public Painter {
public:
    explicit VulkanPainter(Renderer renderer) : renderer_(std::move(renderer)) {}

    Status load(const Scene& scene) override { return renderer_.load(scene); }
    std::string device() const override { return renderer_.deviceName(); }
    double uploadSeconds() const override { return renderer_.timings().upload; }

private:
    Result<Image> drawView(const View& view) override { return renderer_.render(view); }

    Renderer renderer_;
};

Result<std::unique_ptr<Painter>> openVulkan(const std::string& device)
{
    RendererOptions options;
    options.device = device == "auto" ? "" : device;
    auto renderer = Renderer::create(options);
    if (!renderer)
        return renderer.error();
    return std::unique_ptr<Painter>(std::make_unique<VulkanPainter>(std::move(*renderer)));
}
#else
Result<std::unique_ptr<Painter>> openVulkan(const std::string&)
{
    return unavailableError("this cotan was built without Vulkan");
}
#endif

} // namespace

Result<std::unique_ptr<Painter>> openPainter(const std::string& device, int threads, std::string& note)
{
    if (device != "reference") {
        auto vulkan = openVulkan(device);
        if (vulkan || device != "auto")
            return vulkan;
        note = vulkan.error().message + "; drawing with the reference renderer";
    }
    return std::unique_ptr<Painter>(std::make_unique<ReferencePainter>(threads));
}

} // namespace cotan::app
