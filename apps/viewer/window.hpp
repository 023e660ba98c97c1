// A window with a picture and an interface over it. Made by a module of its own, so that the tool starts without GLFW,
// Dear ImGui and a Vulkan loader.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "event.hpp"
#include "interface.hpp"

namespace cotan::viewer {

struct WindowOptions {
    int width = 1280, height = 720; // pixels
    std::string title;
    std::string device;      // the name of the device that is preferred for presenting
    bool validation = false; // ask for the validation layer; its messages land in messages()
    bool played = false;     // the pointer and the keys of the machine are not heard
};

// What stands in the window: the left part of one picture and the right part of another, or one alone.
struct Shown {
    const Image* picture = nullptr; // 8 bits, sRGB; stretched to the window; null: an even grey
    const Image* other = nullptr;   // right of the divider; null: none. As large as picture
    float divider = 0;              // pixels of the window from its left
    std::uint64_t serial = 0;       // differs where a picture differs
};

// What became of a dialog for a file.
struct FileAnswer {
    enum State {
        none,    // nobody asked
        open,    // someone is choosing
        closed,  // done; path is empty where nothing was chosen
        refused, // there is no such dialog here
    } state = none;
    std::string path; // or a file:// URI
};

class Window {
public:
    virtual ~Window() = default;

    // What has happened since the last call; waits for it, at most so many seconds.
    virtual std::vector<Event> poll(double seconds) = 0;
    // Gives events to the interface. Returns those that are not for it; what is chosen in it becomes an
    // EventKind::command.
    virtual std::vector<Event> interact(const Interface& interface, const std::vector<Event>& events) = 0;
    // Draws both. Errors: ErrorKind::unavailable where the device is lost.
    virtual Status show(const Interface& interface, const Shown& shown) = 0;
    // What the last show() has put into the window. Errors: ErrorKind::unavailable where it was not drawn (minimised).
    virtual Result<Image> read() = 0;

    virtual glm::ivec2 size() const = 0; // pixels; 0 where minimised
    virtual void resize(int width, int height) = 0;
    virtual void setTitle(const std::string& title) = 0;
    virtual std::string clipboard() = 0;
    virtual void setClipboard(const std::string& text) = 0;
    // The desktop's own dialog; folder: to begin in. What became of it comes from fileAnswer(), once where it is not
    // open.
    virtual void askForFile(const std::string& folder) = 0;
    virtual FileAnswer fileAnswer() = 0;
    virtual void loseSurface() = 0; // for tests: the next show() makes it anew
    virtual std::string device() const = 0;
    virtual const std::vector<std::string>& messages() const = 0; // of the validation layer
    virtual void wake() = 0;                                      // ends a poll() that waits; from any thread
};

// Errors: ErrorKind::unavailable without the module, a display, or a device that can present.
Result<std::unique_ptr<Window>> openWindow(const WindowOptions& options);

// What the module gives: its version, and the function that opens a window.
struct WindowModule {
    const char* version;
    Result<std::unique_ptr<Window>> (*open)(const WindowOptions& options);
};

} // namespace cotan::viewer
