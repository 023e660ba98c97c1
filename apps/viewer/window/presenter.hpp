// Draws images and Dear ImGui's triangles into the images of a window surface, on a device that renderers share.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <vulkan/vulkan.h>

#include "../window.hpp"

struct ImDrawData;

namespace cotan::viewer {

// For one thread. Throws std::exception if Vulkan fails.
class Presenter {
public:
    // Opens the device. makeSurface: called again if the surface is lost; may throw. extensions: instance extensions
    // that surfaces need. Errors: ErrorKind::unavailable if no device can present.
    static Result<std::unique_ptr<Presenter>> open(const std::vector<const char*>& extensions,
                                                   const WindowOptions& options,
                                                   std::function<VkSurfaceKHR(VkInstance)> makeSurface);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Draws into the window and waits. width, height: of the window; 0 draws nothing. read: gets what was drawn, unless
    // there was no surface to draw into.
    void show(const Shown& shown, ImDrawData* interface, int width, int height, Image* read = nullptr);
    void loseSurface();
    void useFont();                         // switches to Dear ImGui's current font
    std::shared_ptr<Device> device() const; // null if it is not the one that the options ask for
    std::uint64_t imagesRead() const;       // copied from the device to host memory

private:
    struct State;
    explicit Presenter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace cotan::viewer
