// Waiting for child processes. All code of src and apps waits by this function (a test checks it).
#pragma once

#include <cerrno>

#include <sys/resource.h>
#include <sys/wait.h>

namespace cotan {

enum class Waited {
    running, // the process has not ended
    ended,   // with a known status
    lost,    // it ended, but how is unknown: SIGCHLD is ignored, or other code of this process waited for it
};

// Waits until a child process has ended; with `look`, only looks whether it has. status: as waitpid gives it, unchanged
// unless the process has ended. usage: its resources, likewise; may be null.
inline Waited waitFor(pid_t process, bool look, int& status, rusage* usage = nullptr)
{
    pid_t found;
    do
        found = ::wait4(process, &status, look ? WNOHANG : 0, usage);
    while (found < 0 && errno == EINTR);
    return found == process ? Waited::ended : found == 0 ? Waited::running : Waited::lost;
}

// The same when it does not matter how the process ended.
inline Waited waitFor(pid_t process, bool look = false)
{
    int status = 0;
    return waitFor(process, look, status);
}

} // namespace cotan
