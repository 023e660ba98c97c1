// A non-blocking file dialog of the platform.
#pragma once

#include <string>

#include <sys/types.h>

#include "cotan/result.hpp"
#include "window.hpp"

namespace cotan::viewer {

// Uses the desktop portal, or else zenity or kdialog in a child process.
class Dialog {
public:
    Dialog() = default;
    ~Dialog();
    Dialog(const Dialog&) = delete;
    Dialog& operator=(const Dialog&) = delete;

    // Opens the dialog unless one is open. beside: a file in the initial folder.
    void ask(Window& window, const std::string& beside);
    bool open() const { return asked_ || child_ > 0; }
    // Returns the chosen file once, otherwise "". Errors: ErrorKind::unavailable if there is no dialog of any kind.
    Result<std::string> take(Window& window);

private:
    Status startProgram();
    std::string takeFromProgram();

    std::string folder_;
    bool asked_ = false; // a portal dialog is open
    pid_t child_ = 0;
    int pipe_ = -1;
    std::string said_;
};

} // namespace cotan::viewer
