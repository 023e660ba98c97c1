// Renderers on the device of a window, and images that stay on it.
#pragma once

#include <memory>

#include "cotan/render.hpp"

namespace cotan {

struct Device;      // vulkan/device.hpp; must outlive all images on it
struct DeviceImage; // vulkan/memory.hpp; is drawn over when nobody holds it

struct DeviceSharing {
    static Result<VulkanRenderer> open(std::shared_ptr<Device> device);
    // As VulkanRenderer::render, but the image stays on the device. Null if only the host can finish it: values instead
    // of 8 bits, more than 4 samples per pixel. Requires a loaded scene.
    static Result<std::shared_ptr<const DeviceImage>> draw(VulkanRenderer& renderer, const View& view);
};

// The same for any renderer; null too for one that is not on a window's device.
Result<std::unique_ptr<Renderer>> openRendererOn(std::shared_ptr<Device> device);
Result<std::shared_ptr<const DeviceImage>> drawOnDevice(Renderer& renderer, const View& view);

} // namespace cotan
