// The desktop's own dialog for a file, as programs in and out of sandboxes get it: org.freedesktop.portal.FileChooser
// on the session's bus. Source: XDG Desktop Portal, interfaces FileChooser and Request.
#pragma once

#include <memory>
#include <string>

#include "../window.hpp"

namespace cotan::viewer {

class Portal {
public:
    Portal();
    ~Portal();

    // Asks for a dialog; what became of it comes from answer(). folder: to begin in.
    void ask(const std::string& folder);
    // Never waits.
    FileAnswer answer();

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

} // namespace cotan::viewer
