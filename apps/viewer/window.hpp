// A window with an image and an interface over it. It is in a module of its own, so that the tool starts without GLFW,
// Dear ImGui and a Vulkan loader.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "event.hpp"
#include "interface.hpp"

namespace cotan {
struct Device;
struct DeviceImage;
} // namespace cotan

namespace cotan::viewer {

struct WindowOptions {
    int width = 1280, height = 720; // pixels
    std::string title;
    std::string device;  // part of the name of the device that draws; empty: the best
    bool played = false; // ignore the machine's pointer and keys
};

// An image of 8 bits, sRGB: on the window's device or in host memory; or none.
struct Drawing {
    std::shared_ptr<const DeviceImage> onDevice;
    std::shared_ptr<const Image> onHost;

    explicit operator bool() const { return onDevice || onHost; }
    bool operator==(const Drawing&) const = default;
};

// The images in the window: the left part of one and the right part of another, or a single one.
struct Shown {
    Drawing picture;   // scaled to the window; none: uniform grey
    Drawing other;     // shown right of the divider, same size as picture; none: only picture
    float divider = 0; // window pixels from the left
};

// State and result of a file dialog.
struct FileAnswer {
    enum State {
        none,    // not requested
        open,    // the user is choosing
        closed,  // done; path is empty if nothing was chosen
        refused, // this system has no such dialog
    } state = none;
    std::string path; // or a file:// URI
};

class Window {
public:
    virtual ~Window() = default;

    // Returns the events since the last call; waits at most `seconds` for one.
    virtual std::vector<Event> poll(double seconds) = 0;
    // Passes events to the interface and returns those that it does not use. Choices in it become an
    // EventKind::command.
    virtual std::vector<Event> interact(const Interface& interface, const std::vector<Event>& events) = 0;
    // Draws images and interface. Errors: ErrorKind::unavailable if the device is lost.
    virtual Status show(const Interface& interface, const Shown& shown) = 0;
    // As show(), and copies the window to host memory. Errors: also ErrorKind::unavailable if nothing was drawn
    // (minimised).
    virtual Result<Image> showAndRead(const Interface& interface, const Shown& shown) = 0;

    virtual glm::ivec2 size() const = 0; // pixels; 0 if minimised
    virtual void resize(int width, int height) = 0;
    virtual void setTitle(const std::string& title) = 0;
    virtual std::string clipboard() = 0;
    virtual void setClipboard(const std::string& text) = 0;
    // Opens the desktop's file dialog in the folder. fileAnswer() returns its state, and its result once.
    virtual void askForFile(const std::string& folder) = 0;
    virtual FileAnswer fileAnswer() = 0;
    virtual void loseSurface() = 0; // for tests: the next show() recreates it
    // The device that renderers share, which must outlive their images. Null: it is not the one that the options ask
    // for, which cannot present.
    virtual std::shared_ptr<Device> device() const = 0;
    virtual std::uint64_t imagesRead() const = 0; // copied from the device to host memory
    virtual void wake() = 0;                      // interrupts a waiting poll(), from any thread
};

// Errors: ErrorKind::unavailable without the module, a display, or a device that can present.
Result<std::unique_ptr<Window>> openWindow(const WindowOptions& options);

// The module's interface: its version, and the function that opens a window.
struct WindowModule {
    const char* version;
    Result<std::unique_ptr<Window>> (*open)(const WindowOptions& options);
};

} // namespace cotan::viewer
