// The Vulkan renderer. Needs the Vulkan loader and GLM, nothing else at run time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

struct RendererOptions {
    std::string device;      // part of the device's name, any case; empty: the fastest kind found
    bool validation = false; // ask for the validation layer; its messages land in messages()
};

struct RenderTimings { // seconds
    double upload = 0; // of the last load()
    double draw = 0;   // of the last render(): submit to idle
    double readBack = 0;
};

// The names of all devices that can run the renderer, in order of preference.
// Errors: ErrorKind::unavailable says why there is none.
Result<std::vector<std::string>> renderDevices();

class Renderer {
public:
    // Opens a device. Errors: ErrorKind::unavailable, with the reason (no loader, no driver, no
    // device of that name, a missing feature).
    static Result<Renderer> create(const RendererOptions& options = {});

    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    // Uploads a scene; it replaces the one before. Errors: ErrorKind::unavailable when the device
    // has not enough memory; ErrorKind::input over kMostTrianglesDrawn (cotan/scene/bounds.hpp).
    // sameImages: all images are those of the scene before, in its order; their textures stay on the device.
    Status load(const Scene& scene, bool sameImages = false);

    // Draws the loaded scene. Translucent materials are composed per sample in the order of their distance,
    // whatever their number of layers; of equally far ones the one later in the scene is in front. Lists of
    // their fragments take 144 MiB of device memory.
    // Errors: ErrorKind::usage for a size the device cannot draw; ErrorKind::unavailable without the memory,
    // or for more than 2.8 million translucent fragments in one row of pixels.
    Result<Image> render(const View& view);

    const std::string& deviceName() const;
    const std::string& driver() const; // name and version
    const RenderTimings& timings() const;
    const std::vector<std::string>& messages() const; // from the validation layer

private:
    struct State;
    explicit Renderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace cotan
