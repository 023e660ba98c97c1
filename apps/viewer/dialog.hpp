// The platform's dialog for choosing a file, in a process of its own: nothing waits for it.
#pragma once

#include <string>

#include <sys/types.h>

#include "cotan/result.hpp"

namespace cotan::viewer {

class Dialog {
public:
    Dialog() = default;
    ~Dialog();
    Dialog(const Dialog&) = delete;
    Dialog& operator=(const Dialog&) = delete;

    // Opens it; does nothing while one is open. beside: a file of the folder to begin in.
    // Errors: ErrorKind::unavailable where there is none: neither zenity nor kdialog.
    Status ask(const std::string& beside);
    bool open() const { return child_ > 0; }
    // What was chosen, once; empty otherwise.
    std::string take();

private:
    pid_t child_ = 0;
    int pipe_ = -1;
    std::string said_;
};

} // namespace cotan::viewer
