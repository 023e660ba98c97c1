// A non-blocking file dialog of the platform.
#pragma once

#include <memory>
#include <string>

#include "cotan/result.hpp"
#include "window.hpp"

namespace cotan::viewer {

// The dialog beside the window's own: dialog_posix.cpp starts zenity or kdialog in a child process, dialog_windows.cpp
// opens that of Windows on a thread.
class SystemDialog {
public:
    SystemDialog();
    ~SystemDialog(); // closes it where the system can
    SystemDialog(const SystemDialog&) = delete;
    SystemDialog& operator=(const SystemDialog&) = delete;

    // folder: the initial one, with a separator at its end. Errors: ErrorKind::unavailable.
    Status start(const std::string& folder);
    bool open() const;
    std::string take(); // the chosen file, once; "" while it is open, or if none was chosen

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Uses the desktop portal of the window, or else the system's dialog.
class Dialog {
public:
    // Opens the dialog unless one is open. beside: a file in the initial folder.
    void ask(Window& window, const std::string& beside);
    bool open() const { return asked_ || system_.open(); }
    // Returns the chosen file once, otherwise "". Errors: ErrorKind::unavailable if there is no dialog of any kind.
    Result<std::string> take(Window& window);

private:
    std::string folder_;
    bool asked_ = false; // a portal dialog is open
    SystemDialog system_;
};

} // namespace cotan::viewer
