#include "files/system/program.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include <unistd.h>

namespace cotan {

namespace fs = std::filesystem;

namespace {

char** programArguments = nullptr; // main's argv

} // namespace

// Undoes the choice of a parent that ignores SIGCHLD, as daemons and some CI runners do: the system would then discard
// how children ended, and `waitpid` would report nothing.
std::vector<std::string> beginProgram(int argc, char** argv)
{
    programArguments = argv;
    ::signal(SIGCHLD, SIG_DFL);
    return {argv, argv + argc};
}

std::string becomeProgram(const fs::path& program)
{
    if (programArguments != nullptr)
        ::execv(program.c_str(), programArguments);
    return programArguments != nullptr ? std::strerror(errno) : "its words are unknown";
}

fs::path programFile()
{
    std::error_code failed;
    const fs::path file = fs::read_symlink("/proc/self/exe", failed);
    return failed ? fs::path() : file;
}

fs::path sameProgram() { return "/proc/self/exe"; }

} // namespace cotan
