// Renderers on a Vulkan device, also on that of a window, and images that stay on it.
#pragma once

#include <memory>
#include <string>

#include "cotan/render.hpp"

namespace cotan {

struct Device;      // vulkan/device.hpp; must outlive all images on it
struct DeviceImage; // vulkan/memory.hpp; is drawn over when nobody holds it

// Opens a device. device: part of its name, in any case; empty: best type of device. validation: enables the validation
// layer. At run time this needs only the Vulkan loader. Errors: ErrorKind::unavailable, with the reason (no loader, no
// driver, no device of that name, a missing feature).
Result<std::unique_ptr<Renderer>> openVulkanRenderer(const std::string& device = {}, bool validation = false);

// The same on a window's device.
Result<std::unique_ptr<Renderer>> openRendererOn(std::shared_ptr<Device> device);

// As Renderer::draw, but the image stays on the device. Null if only the host can finish it: values instead of 8 bits,
// more than 4 samples per pixel, the reference renderer. Requires a loaded scene.
Result<std::shared_ptr<const DeviceImage>> drawOnDevice(Renderer& renderer, const View& view);

} // namespace cotan
