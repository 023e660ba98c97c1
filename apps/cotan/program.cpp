#include "program.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#ifdef COTAN_WITH_BATCH
#include "batch/child.hpp"
#endif
#include "common.hpp"
#include "cotan/files.hpp"
#include "cotan/model.hpp"
#include "files/children.hpp"
#include "files/file_registry.hpp"
#include "files/interrupt.hpp"
#include "terminal/printable.hpp"

namespace cotan::app {

namespace {

char** programArguments = nullptr; // main's argv

// Does not use fmt::print, which throws if standard error cannot be written.
int fail(const Error& error)
{
    std::fputs(fmt::format("cotan: error: {}\n{}", printable(error.message), error.advice).c_str(), stderr);
    return int(error.kind);
}

} // namespace

int finish(const Status& status)
{
    if (const auto refused = firstRefusal(); refused && !status)
        return fail(*refused); // a reader may have replaced its message
    if (!status)
        return fail(status.error());
    const Status printed = flushOutput();
    return printed ? 0 : fail(printed.error());
}

Status startLab()
{
    std::error_code failed;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failed);
    const std::filesystem::path lab = self.parent_path() / "cotan-lab";
    if (!failed && programArguments)
        ::execv(lab.c_str(), programArguments);
    const std::string why = failed ? failed.message() : std::strerror(errno);
    return unavailableError(fmt::format("{}: the program of this command cannot be started: {}", lab.string(), why));
}

int runProgram(int argc, char** argv, int (*commandLine)(std::vector<std::string>))
{
    programArguments = argv;
    keepStatusOfChildren();
    if (isReaderProcess(argc, argv))
        return runReaderProcess();
    sandboxByDefault({.program = "/proc/self/exe"});
    removePartsOnInterrupt();
    try {
#ifdef COTAN_WITH_BATCH
        if (isJobProcess(argc, argv))
            return runJobProcess(argc, argv, commandLine);
#endif
        return commandLine({argv + std::min(argc, 1), argv + argc});
    } catch (const std::bad_alloc&) {
        return fail({ErrorKind::unavailable, "not enough memory"});
    } catch (const std::system_error& e) { // also from starting threads
        return fail({ErrorKind::unavailable,
                     e.code() == std::errc::resource_unavailable_try_again
                         ? "no more threads or processes are allowed here (ulimit -u)"
                         : std::string("unexpected: ") + e.what()});
    } catch (const std::exception& e) {
        return fail({ErrorKind::unavailable, std::string("unexpected: ") + e.what()});
    }
}

} // namespace cotan::app
