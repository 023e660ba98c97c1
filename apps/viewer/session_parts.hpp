// What a session is made of. Events change the state (input.hpp); what it requests is done (requests.hpp); what it
// shows is asked of the renderer (pictures.hpp); what comes back goes into the state again; the interface is drawn from
// it.
#pragma once

#include <memory>
#include <mutex>

#include "dialog.hpp"
#include "files.hpp"
#include "loader.hpp"
#include "pictures.hpp"
#include "pointer_probe.hpp"
#include "session.hpp"

namespace cotan::viewer {

// Ends the window's waiting for events, from any thread, while there is a window.
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
    std::unique_ptr<Window> window; // outlives the threads of those below, which wake it
    Waker waker;
    Loader loader;
    Pictures pictures;
    PointerProbe probe;
    Dialog dialog;
    Watch watch;                      // of all files that are shown
    std::vector<std::string> watched; // what they were named after
    bool quits = false;
};

// Seconds of a clock that goes on.
double secondsNow();

// All that the window shows beside the picture, at this moment.
Interface interfaceNow(const Parts& parts);

} // namespace cotan::viewer
