// The desktop's file dialog, available in and out of sandboxes: org.freedesktop.portal.FileChooser on the session bus.
// Source: XDG Desktop Portal, interfaces FileChooser and Request.
#pragma once

#include <memory>
#include <string>

#include "../window.hpp"

namespace cotan::viewer {

class Portal {
public:
    Portal();
    ~Portal();

    // Requests a dialog that starts in `folder`; answer() returns its state.
    void ask(const std::string& folder);
    // Never waits.
    FileAnswer answer();

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

} // namespace cotan::viewer
