// The parts of a session. Events change the state (input.hpp); its requests are performed (requests.hpp); images of it
// are ordered from the renderer (pictures.hpp); results go back into the state; the interface is drawn from the state.
#pragma once

#include <memory>
#include <mutex>

#include "dialog.hpp"
#include "files.hpp"
#include "loader.hpp"
#include "pictures.hpp"
#include "pointer_probe.hpp"
#include "session.hpp"
#include "tasks.hpp"
#include "tool_process.hpp"

namespace cotan::viewer {

// Wakes the window from waiting for events, from any thread, while there is a window.
class Waker {
public:
    void set(Window* window)
    {
        const std::lock_guard lock(mutex_);
        window_ = window;
    }
    void wake()
    {
        const std::lock_guard lock(mutex_);
        if (window_)
            window_->wake();
    }

private:
    std::mutex mutex_;
    Window* window_ = nullptr;
};

struct Parts {
    Parts(State first, const SessionOptions& o);

    State state;
    const SessionOptions& options;
    std::unique_ptr<Window> window; // outlives the threads of the members below, which wake it
    Waker waker;
    Loader loader;
    Pictures pictures;
    PointerProbe probe;
    Dialog dialog;
    ToolProcess tool;
    Task task;                        // that runs in it
    Watch highWatch;                  // the files of the detailed model
    Watch watch;                      // all other displayed files
    std::vector<std::string> watched; // the names that these files were found by
    std::string chosenFor;            // the command that gets the file of the dialog
    bool quits = false;
};

// Seconds of a monotonic clock.
double secondsNow();

// Everything that the window currently shows besides the image.
Interface interfaceNow(const Parts& parts);

} // namespace cotan::viewer
