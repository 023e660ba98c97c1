// The platform's dialog for choosing a file: nothing waits for it.
#pragma once

#include <string>

#include <sys/types.h>

#include "cotan/result.hpp"
#include "window.hpp"

namespace cotan::viewer {

// The desktop's portal; where there is none zenity or kdialog, in a process of its own.
class Dialog {
public:
    Dialog() = default;
    ~Dialog();
    Dialog(const Dialog&) = delete;
    Dialog& operator=(const Dialog&) = delete;

    // Opens it; does nothing while one is open. beside: a file of the folder to begin in.
    void ask(Window& window, const std::string& beside);
    bool open() const { return asked_ || child_ > 0; }
    // What was chosen, once; empty otherwise. Errors: ErrorKind::unavailable where there is no dialog of any kind.
    Result<std::string> take(Window& window);

private:
    Status startProgram();
    std::string takeFromProgram();

    std::string folder_;
    bool asked_ = false; // the portal
    pid_t child_ = 0;
    int pipe_ = -1;
    std::string said_;
};

} // namespace cotan::viewer
